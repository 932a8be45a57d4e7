"""What a closure file may say beyond the community's schema."""

from math import inf

import pytest

from thesis_pin.errors import SpecificationError
from thesis_pin.model.formats.closure_file import ClosureFile
from thesis_pin.model.mechanism.closure_types import word_of

PLAIN = "closed_loop: [[a, b]]\ntype: [{}]\nname_mot: [m]\nthesis_pin:\n  format: 1\n"


def supplement(more="", word="3d"):
    return ClosureFile.parse(PLAIN.format(word) + more, where="f.yaml").supplement()


@pytest.mark.parametrize("word", ["3D", "6d", "hinge_z", "universal_xz", "x-z--z", "XY----"])
def test_types_are_words_or_masks_in_any_case(word):
    (closure,) = supplement(word=word).closures
    assert word_of(closure.rows) == word.lower()
    assert closure.name == "a – b"


def test_a_rod_has_a_length():
    (closure,) = supplement("  lengths: [0.3]\n", "rod").closures
    assert (closure.length, any(closure.rows)) == (0.3, False)


def test_a_motor_has_what_is_said_of_it_and_nothing_else():
    (motor,) = supplement("  motors: [{joint: m, gear: 9, effort: [null, 2]}]\n").motors
    assert (motor.name, motor.gear, motor.armature) == ("m", 9, 0.0)
    assert (motor.effort, motor.speed) == ((-inf, 2), inf)


@pytest.mark.parametrize(
    ("more", "word", "says"),
    [
        ("", "4d", r"f\.yaml:2: type\[0\]: isn't 3d, 6d, hinge_x.*xyz--z \(found '4d'\)"),
        ("", "rod", "each rod has a length"),
        ("  lengths: [0.3]\n", "3d", "nothing else has one"),
        ("  lengths: [-0.3]\n", "rod", "lengths"),
        ("  lengths: [0.3, 0.4]\n", "rod", "has 2 entries for 1 loops"),
        ("  couplings: [{name: g, coefficients: {j: 0}}]\n", "3d", "must not be zero"),
        ("  couplings: [{name: g, coefficients: {}}]\n", "3d", "coefficients"),
        (
            "  couplings: [{name: g, coefficients: {j: 1}}, {name: g, coefficients: {k: 1}}]\n",
            "3d",
            "names a coupling twice",
        ),
        ("  springs: [{joint: j, stiffness: 1}, {joint: j, stiffness: 2}]\n", "3d", "twice"),
        ("  damping: {j: -1}\n", "3d", r"damping\.j"),
        ("  root: floating\n", "3d", "root"),
        ("  rotor_inertia: [1e-5, 1e-5]\n", "3d", "has 2 entries for 1 motors"),
        ("  rotor_inertia: [-1e-5]\n", "3d", "rotor_inertia"),
        ("  gear_ratio: [0]\n", "3d", "must not be zero"),
        (
            "  gear_ratio: [50]\n  motors: [{joint: m, armature: 1}]\n",
            "3d",
            "beside gear_ratio of all",
        ),
        ("  poses: {home: {j: word}}\n", "3d", "poses"),
    ],
)
def test_what_makes_no_sense_is_told_with_its_key(more, word, says):
    with pytest.raises(SpecificationError, match=says):
        supplement(more, word)


def test_only_our_own_files_may_name_no_motor():
    text = PLAIN.format("3d").replace("[m]", "[]")
    assert ClosureFile.parse(text).supplement().motors == ()
    with pytest.raises(SpecificationError, match="name_mot: names no motor"):
        ClosureFile.parse(text.partition("thesis_pin")[0])


def test_rotors_behind_gears_are_reflected_to_the_joint():
    (motor,) = supplement("  rotor_inertia: [1.0e-5]\n  gear_ratio: [50]\n").motors
    assert (motor.gear, motor.armature) == (50, pytest.approx(0.025))  # 50² × 1e-5
    (bare,) = supplement("  rotor_inertia: [1.0e-5]\n").motors
    assert (bare.gear, bare.armature) == (1, 1e-5)


def test_what_we_add_needs_no_version_of_its_own():
    text = PLAIN.format("3d").replace("  format: 1\n", "  gear_ratio: [2]\n")
    assert ClosureFile.parse(text).supplement().motors[0].gear == 2
