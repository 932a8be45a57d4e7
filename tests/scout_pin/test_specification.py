"""Appendix B as data, and what a broken file is told."""

import numpy as np
import pytest

from scout_pin.specification import JOINT_NAMES, SCOUT_PATH, SIDES, Specification
from thesis_pin.errors import SpecificationError


def test_mass_is_the_one_the_thesis_prints():
    assert Specification.read().mass == pytest.approx(898.54e-3, abs=1e-12)


def test_soles_are_those_of_the_program_shifted_by_its_own_18_15_mm():
    # Appendix D builds the left sole by moving the right one along x.
    left, right = (np.array(Specification.read().leg(side).sole) for side in SIDES)
    order = lambda points: points[np.lexsort(points.round(6).T)]  # noqa: E731
    np.testing.assert_allclose(order(left), order(right - [18.15e-3, 0.0]), atol=1e-12)


def test_legs_mirror_each_other_in_mass_centre_and_products():
    spec = Specification.read()
    flips = [(1, 1, 1)] + [(1, -1, 1)] * 4 + [(1, 1, -1)]
    for left, right, flip in zip(spec.legs.left.links, spec.legs.right.links, flips, strict=True):
        assert left.mass == right.mass
        np.testing.assert_allclose(np.multiply(left.com, flip), right.com, atol=0)
        mirrored = np.array(left.inertia) * np.outer(flip, flip)
        np.testing.assert_allclose(mirrored, right.inertia, atol=0)


def test_links_1_and_5_are_the_same_bracket_only_as_products_about_the_joint():
    spec = Specification.read()
    one, five = spec.legs.left.links[0], spec.legs.left.links[4]

    def gap(convention):
        moments = [np.linalg.eigvalsh(x.centroidal(convention, "physical")) for x in (one, five)]
        return np.abs(moments[0] - moments[1]).max()

    assert gap("products_about_joint") < 0.1e-6
    assert gap("tensor_about_joint") > 5e-6
    assert gap("tensor_about_com") > 5e-6


def test_joint_names_are_twelve_left_leg_first_and_sorted_sides():
    assert len(set(JOINT_NAMES)) == 12
    assert [name.split("_")[0] for name in JOINT_NAMES] == ["left"] * 6 + ["right"] * 6
    # urdfdom sorts by name, so the left leg must come first in the alphabet.
    assert tuple(sorted(SIDES)) == SIDES


@pytest.fixture
def broken(tmp_path):
    def write(*replacements):
        text = SCOUT_PATH.read_text()
        for old, new in replacements:
            assert old in text
            text = text.replace(old, new, 1)
        path = tmp_path / "broken.toml"
        path.write_text(text)
        return path

    return write


def test_every_problem_is_reported_at_once_with_file_line_key_and_value(broken):
    path = broken(
        ("mass = 162.08e-3", "mass = -1"),
        ("x_3 = 74.60e-3", 'x_3 = "long"'),
        ("y_6 = 23.06e-3", "y6 = 23.06e-3"),
        ("coefficient = 0.6", "coefficient = nan"),
    )
    with pytest.raises(SpecificationError) as caught:
        Specification.read(path)
    keys = {problem.key for problem in caught.value.problems}
    assert keys == {
        "torso.mass",
        "legs.left.x_3",
        "legs.left.y_6",
        "legs.left.y6",
        "assumptions.floor_friction.coefficient",
    }
    lines = path.read_text().splitlines()
    for problem in caught.value.problems:
        name = problem.key.split(".")[-1]
        number = int(problem.where.rsplit(":", 1)[1])
        assert name in lines[number - 1] or problem.key == "legs.left.y_6"
    assert "'long'" in str(caught.value)
    assert "greater than 0" in str(caught.value)


@pytest.mark.parametrize(
    ("old", "new", "key", "says"),
    [
        ('servo = "HS-5475HB"', 'servo = "HS-1"', "legs.left.servo", "HS-5475HB"),
        ("lower_deg = -90", "lower_deg = 90", "assumptions.joint_range", "empty"),
        ("[29.40e-6, 0.04e-6, -0.04e-6]", "[99.4e-6, 0.04e-6, -0.04e-6]", "inertia", "exceeds"),
        ("[29.40e-6, 0.04e-6, -0.04e-6]", "[29.4e-6, 0.05e-6, -0.04e-6]", "inertia", "symmetric"),
        ("[-2.45e-3, 83.33e-3], # b", "[90e-3, -90e-3], # b", "legs.left.sole", "cross"),
        ('convention = "products_about_joint"', 'convention = "x"', "inertia_convention", "tensor"),
    ],
)
def test_a_wrong_value_is_named_with_its_key_and_what_is_allowed(broken, old, new, key, says):
    with pytest.raises(SpecificationError) as caught:
        Specification.read(broken((old, new)))
    assert any(key in p.key and says in p.what for p in caught.value.problems), str(caught.value)
