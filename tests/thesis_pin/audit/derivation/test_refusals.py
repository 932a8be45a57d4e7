"""What a derivation's file gets wrong is named, with its place and what there is instead."""

from pathlib import Path

import pinocchio as pin
import pytest

from thesis_pin import audit_derivation
from thesis_pin.audit.derivation.moving import coordinates
from thesis_pin.audit.derivation.said import phrases
from thesis_pin.audit.derivation.said.constants import number
from thesis_pin.errors import BadInput, UnknownName
from thesis_pin.loops.loading import load

FOLDER = Path(__file__).parents[4] / "examples" / "your_derivation"
ARM, URDF = FOLDER / "two_link_arm.toml", FOLDER / "two_link_arm.urdf"
G_2 = "left = 'G_2'\nprinted = 'm_2 l_{c2} g c_{12}'"


def refusal(tmp_path, old, new):
    text = ARM.read_text(encoding="utf-8")
    assert old in text
    path = tmp_path / "mine.toml"
    path.write_text(text.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(BadInput) as error:
        audit_derivation(path, URDF)
    return str(error.value)


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ('"shoulder"', '"shouldr"', ["coordinates.\\theta_1", "'shouldr'", "shoulder, elbow"]),
        ("position of hand", "position of hnd", ["symbols.\\mathbf{p}", "'hnd'", "hand"]),
        ('"gravity vector"', '"gravity vektor"', ["symbols.\\mathbf{G}", "gravity vector"]),
        ('"torque"', '"weight"', ["unknown quantity 'weight'", "coriolis vector"]),
        ("hand along xz", "hand along q", ["aren't axes"]),
        ("position of hand along", "position hand along", ["at 'hand'"]),
        ('"torque"', '"torque entry 3"', ["has no entry 3", "a vector of 2"]),
        ("distance from shoulder to elbow", "position of hand along x", ["isn't constant"]),
        ("mass of link2", "mass of hand", ["hand is fixed to link2"]),
        ("mass of link2", "mass of base", ["base doesn't move"]),
        ("inertia yy of link2", "inertia of link2", ["which element"]),
        ('"gravity"', '"9.81 furlongs"', ["constants.g", "furlongs", "m/s²"]),
        ("'g' = ", "'g + h' = ", ["'g + h'", "isn't a symbol"]),
        ("'g' = ", "'K' = ", ["said twice"]),
        ("'l_2' = ", "'l_{1}' = ", ["constants.l_{1}", "what constants.l_1 says already"]),
        ("'K' = ", r"'\dot{K}' = ", ["symbols.\\dot{K}: has dots", "the one without"]),
        ('"elbow"', '"shoulder"', ["2 coordinates, made of 1 joint"]),
        ('"elbow"', '"elbow + 3"', ["the number 3 has neither joint nor unit"]),
        ('"elbow"', '"  "', ["has no joint in it"]),
        (G_2, "left = 'G_2'\nprinted = ' '", ["nothing is printed there"]),
        (G_2, "left = '0'\nprinted = '0'", ["an equation of nothing"]),
        (G_2, "printed = 'G_2'", ["an equation has two sides"]),
        ('"arm:3:G_2"', '"leg:3:G_2"', ["ids begin with the derivation's name"]),
        ('cos = "c"', 'cos = "cc"', ["derivation.cos"]),
        ('cos = "c"', "indices = { ij = [1] }", ["derivation.indices.ij", "one letter"]),
        ('cos = "c"', "indices = { i = [] }", ["a list of its numbers"]),
        ('cos = "c"', 'words = ["("]', ["derivation.words", "two letters"]),
        ("title =", "titel =", ["unknown key", "title"]),
    ],
)
def test_a_mistake_in_the_file_is_named(old, new, says, tmp_path):
    told = refusal(tmp_path, old, new)
    for part in says:
        assert part in told


def test_a_formula_that_cant_be_read_is_shown_with_line_column_and_a_mark(tmp_path):
    old = r"\tfrac12 m_2 l_1^2 \dot\theta_1^2"
    told = refusal(tmp_path, old, r"\tfrac12 m_2 l_1^2} \dot\theta_1^2").splitlines()
    text = ARM.read_text(encoding="utf-8").splitlines()
    (line,) = (k for k, one in enumerate(text, start=1) if old in one)
    column = text[line - 1].index(old) + old.index(r" \dot") + 1
    assert told[0].endswith(f"mine.toml:{line}:{column}: the formula can't be read (arm:2:K)")
    assert told[1][told[2].index("^")] == "}"


def test_an_equation_in_a_formula_is_shown_where_it_is(tmp_path):
    told = refusal(tmp_path, "'m_2 l_{c2} g c_{12}'", "'a = m_2 g'").splitlines()
    assert "has an = where one side belongs" in told[0]
    assert told[1][told[2].index("^")] == "="


def test_an_unreadable_print_is_no_mistake_if_its_correction_is_given(tmp_path):
    text = ARM.read_text(encoding="utf-8")
    printed = "'I_2 + m_2 (l_{c2}^2 + l_1 l_{c2} s_2)'"
    path = tmp_path / "mine.toml"
    path.write_text(text.replace(printed, printed.replace(")", "")), encoding="utf-8")
    (row,) = audit_derivation(path, URDF, only=["arm:3:M_12"]).rows
    assert row.verdict == "misprint"
    assert "can't be read" in row.reason


def test_an_equation_printed_whole_has_its_first_side_as_left(tmp_path):
    path = tmp_path / "mine.toml"
    text = ARM.read_text(encoding="utf-8")
    path.write_text(text.replace(G_2, "printed = ['G_2', 'm_2 l_{c2} g c_{12}']"), encoding="utf-8")
    (row,) = audit_derivation(path, URDF, only=["arm:3:G_2"]).rows
    assert (row.left, row.printed, row.verdict) == ("G_2", ("m_2 l_{c2} g c_{12}",), "holds")


def test_a_robot_with_loops_or_a_free_root_is_refused():
    folder = FOLDER.parent
    with pytest.raises(BadInput, match="closed loops"):
        audit_derivation(ARM, load(folder / "delta.urdf", folder / "delta.yaml"))
    flying = load(URDF, root_joint=pin.JointModelFreeFlyer())
    with pytest.raises(BadInput, match="root_joint has 6 degrees of freedom"):
        audit_derivation(ARM, flying)


@pytest.mark.parametrize(
    ("text", "size", "fixed"),
    [
        (2, 2.0, {"masses", "inertias", "lengths"}),
        ("0.4 m", 0.4, {"lengths"}),
        ("40cm", 0.4, {"lengths"}),
        ("250 g", 0.25, {"masses"}),
        ("12 kg·m²", 12.0, {"inertias"}),
        ("30 g cm^2", 3e-6, {"inertias"}),
        ("-90 deg", -1.5707963267948966, set()),
        ("9.81 m/s^2", 9.81, set()),
    ],
)
def test_numbers_are_read_with_their_units(text, size, fixed):
    assert number(text, "file") == (pytest.approx(size), fixed)


def test_sums_of_joints_are_read():
    found = coordinates.read(
        {"a": "-j_1 + 90 deg", "b": "j_1 + 2 * j-2", "c": "0.5 x + j_1 - 20 mm"},
        ["j_1", "other", "j-2", "x"],
        "file",
    )
    assert found.joints == ("j_1", "j-2", "x")
    x = [0.1, 0.2, 0.3]
    q = found.q(x)
    assert -q[0] + 1.5707963267948966 == pytest.approx(x[0])
    assert q[0] + 2 * q[2] == pytest.approx(x[1])
    assert 0.5 * q[3] + q[0] - 0.02 == pytest.approx(x[2])
    assert q[1] == 0


def test_words_are_read():
    read = phrases.parse("position of centre of link2 in base along xz", "file")
    assert read == phrases.Phrase("position", "link2", True, "base", "", "xz")
    assert phrases.parse("Mass Matrix entry 1 2", "file").entry == (1, 2)
    assert phrases.parse("offset y from a to b", "file").to == "b"
    with pytest.raises(UnknownName):
        phrases.parse("nothing", "file")
    with pytest.raises(BadInput, match="at 'of'"):
        phrases.parse("position of", "file")
