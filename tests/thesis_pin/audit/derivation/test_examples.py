"""Textbooks' derivations: what is right holds, and planted slips are found."""

from collections import Counter
from pathlib import Path

import numpy as np
import pytest

from thesis_pin import audit_derivation
from thesis_pin.audit.derivation.auditing import thesis
from thesis_pin.audit.mutation.trial import Trials
from thesis_pin.audit.rows import HOLDS

FOLDER = Path(__file__).parents[4] / "examples" / "your_derivation"


def rows(name, **changes):
    report = audit_derivation(FOLDER / f"{name}.toml", FOLDER / f"{name}.urdf", **changes)
    return {row.id.split(":")[2]: row for row in report.rows}


def test_both_planted_slips_of_the_arm_are_found_and_nothing_else():
    found = rows("two_link_arm")
    assert {name for name, row in found.items() if row.failed} == {"M_12", "G_1"}
    assert {name for name, row in found.items() if row.verdict == "holds"} == {
        *("p", "J", "K", "P", "Lagrange", "M_11", "M_22", "C", "V", "G_2", "motion"),
    }


def test_a_slip_with_its_correction_is_a_misprint_with_place_kind_and_effect():
    row = rows("two_link_arm")["M_12"]
    assert row.verdict == "misprint"
    assert row.residual_corrected < HOLDS < row.residual_printed
    assert row.places == ("member 2, symbol 9: s_2 should be c_2",)
    assert row.effect["generalized force [-]"] > 0.01


def test_a_slip_without_correction_is_unexplained_and_has_its_effect():
    row = rows("two_link_arm")["G_1"]
    assert row.verdict == "unexplained"
    assert row.effect["generalized force [-]"] > 0.1


def test_a_symbol_that_only_the_file_defines_counts_where_it_is_used():
    row = rows("two_link_arm")["h"]
    assert row.verdict == "not checkable"
    assert row.reason.startswith("stated, not checkable: it defines h")


def test_all_of_the_cart_pole_holds_with_its_numbers_typed_in():
    assert {row.verdict for row in rows("cart_pole").values()} == {"holds"}


def changed(tmp_path, name, *changes):
    text = (FOLDER / f"{name}.toml").read_text(encoding="utf-8")
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    path = tmp_path / f"{name}.toml"
    path.write_text(text, encoding="utf-8")
    report = audit_derivation(path, FOLDER / f"{name}.urdf")
    return {row.id.split(":")[2]: row for row in report.rows}, report


@pytest.mark.parametrize(
    ("old", "new", "failing"),
    [
        (
            r"- \frac{\partial L}{\partial \theta_1}",
            r"+ \frac{\partial L}{\partial \theta_1}",
            "Lagrange",
        ),
        (r"+ 2 l_1 l_{c2} c_2)'", r"+ l_1 l_{c2} c_2)'", "M_11"),
        (r"'m_2 l_{c2} g c_{12}'", r"'m_2 l_{c2} g s_{12}'", "G_2"),
        (r"-h \dot\theta_1^2 \end", r"-h \dot\theta_1 \end", "V"),
        (r"-h \dot\theta_1 & 0 \end", r"h \dot\theta_1 & 0 \end", "C"),
        (r"& l_2 c_{12} \end", r"& l_2 c_{1} \end", "J"),
        (r"l_1 s_1 + l_2 s_{12} \end", r"l_1 s_1 - l_2 s_{12} \end", "p"),
        (r"+ I_2)(\dot\theta_1 + \dot\theta_2)^2", r"+ I_2)(\dot\theta_1 - \dot\theta_2)^2", "K"),
        (r"m_2 g (l_1 s_1", r"m_1 g (l_1 s_1", "P"),
        (r"\ddot{\mathbf{q}} + \mathbf{C}", r"\dot{\mathbf{q}} + \mathbf{C}", "motion"),
    ],
)
def test_another_slip_fails_its_line(old, new, failing, tmp_path):
    found, _ = changed(tmp_path, "two_link_arm", (old, new))
    assert {name for name, row in found.items() if row.failed} == {"M_12", "G_1", failing}


def test_a_line_that_holds_for_this_robot_alone_says_so(tmp_path):
    """m_2 for m_1 goes unseen on an arm of two equal links; on others it doesn't."""
    urdf = (FOLDER / "two_link_arm.urdf").read_text(encoding="utf-8").replace('"1.7"', '"3.0"')
    (tmp_path / "arm.urdf").write_text(urdf, encoding="utf-8")
    text = (FOLDER / "two_link_arm.toml").read_text(encoding="utf-8")
    text = text.replace("printed = 'm_2 l_{c2} g c_{12}'", "printed = 'm_1 l_{c2} g c_{12}'")
    (tmp_path / "arm.toml").write_text(text, encoding="utf-8")
    report = audit_derivation(tmp_path / "arm.toml", tmp_path / "arm.urdf")
    (row,) = (one for one in report.rows if one.id == "arm:3:G_2")
    assert row.verdict == "holds"
    assert "holds with this robot's numbers" in row.note
    assert "1 hold with this robot's numbers alone" in report.states
    others = [one.note for one in report.rows if one is not row]
    assert not any("this robot's numbers" in note for note in others)


def test_an_undefined_symbol_is_its_lines_error_alone(tmp_path):
    change = ("printed = 'm_2 l_{c2} g c_{12}'", "printed = 'm_2 l_{c3} g c_{12}'")
    found, _ = changed(tmp_path, "two_link_arm", change)
    row = found["G_2"]
    assert row.verdict == "unexplained"
    assert "l_c3 isn't defined anywhere (near it: l_c" in row.reason
    assert found["motion"].verdict == "holds"


def test_a_line_of_the_wrong_shape_says_what_belongs_there(tmp_path):
    change = (r"\mathbf{V}(\mathbf{q}, \dot{\mathbf{q}})'", r"\mathbf{M}(\mathbf{q})'")
    found, _ = changed(tmp_path, "two_link_arm", change)
    assert "is a vector of 2 where a 2×2 matrix belongs" in found["V"].reason


def test_a_misprinted_definition_has_the_effect_of_the_lines_that_use_it(tmp_path):
    old = "printed = '-m_2 l_1 l_{c2} \\sin\\theta_2'"
    new = (
        "printed = 'm_2 l_1 l_{c2} \\sin\\theta_2'\n"
        "corrected = '-m_2 l_1 l_{c2} \\sin\\theta_2'\n"
        'attribution = "thesis"\nwhy = "(10)"'
    )
    found, _ = changed(tmp_path, "two_link_arm", (old, new))
    assert found["h"].verdict == "misprint"
    assert found["h"].effect["generalized force [-]"] > 0.05
    assert found["V"].verdict == "holds"


@pytest.mark.parametrize(
    ("old", "new", "line", "guess"),
    [
        (r"'m_2 l_{c2} g c_{12}'", r"'m_2 l_{c2} g s_{12}'", "G_2", "s_{12} should be c_{12}"),
        (r"'m_2 l_{c2} g c_{12}'", r"'-m_2 l_{c2} g c_{12}'", "G_2", "- should be +"),
        (r"'m_2 l_{c2} g c_{12}'", r"'m_2 l_{c1} g c_{12}'", "G_2", "l_{c1} should be l_{c2}"),
        (r"'m_2 l_{c2} g c_{12}'", r"'m_2 g c_{12}'", "G_2", "l_{c2} is missing"),
        (r"'I_2 + m_2 l_{c2}^2'", r"'I_2 + m_2 l_{c2}'", "M_22", "l_{c2} should be l_{c2}^2"),
        (r"+ 2 l_1 l_{c2} c_2)'", r"+ l_1 l_{c2} c_2)'", "M_11", "2 is missing"),
        (
            r"\dot\theta_2^2) \\ -h",
            r"\dot\theta_1^2) \\ -h",
            "V",
            r"\theta_1^2 should be \theta_2^2",
        ),
        (r"m_2 g (l_1 s_1", r"m_1 g (l_1 s_1", "P", "m_1 should be m_2"),
        (r"'I_2 + m_2 l_{c2}^2'", r"'2 I_2 + m_2 l_{c2}^2'", "M_22", "2 should not be there"),
        (
            "left = 'G_2'\nprinted = 'm_2 l_{c2} g c_{12}'",
            "left = 'G_2 - m_2 l_{c2} g s_{12}'\nprinted = '0'",
            "G_2",
            "left side, symbol 6: s_{12} should be c_{12}",
        ),
        (  # 0 = 0 if the bodies were points, which is no reason
            "left = 'G_2'\nprinted = 'm_2 l_{c2} g c_{12}'",
            r"left = '(M_{22} - m_2 l_{c2}^2) \theta_1'"
            "\nprinted = '(M_{22} - m_2 l_{c2}^2) \\theta_2'",
            "G_2",
            r"\theta_2 should be \theta_1",
        ),
        (r"'I_1 + I_2 + m_1", r"'I_1 + m_1", "M_11", "without the bodies' inertias"),
    ],
)
def test_a_single_slip_is_guessed_where_nothing_is_given(old, new, line, guess, tmp_path):
    found, _ = changed(tmp_path, "two_link_arm", (old, new))
    assert guess in found[line].note


def test_of_letters_with_the_same_number_that_of_the_slip_is_guessed(tmp_path):
    """ℓ and d are 40 cm both; ℓ_0 was meant to be an ℓ."""
    changes = (
        ("'\\ell' = \"40 cm\"", "'\\ell' = \"40 cm\"\n'\\ell_0' = 7\nd = \"40 cm\""),
        (r"1/2 (J + m \ell^2)", "1/2 (J + m d^2)"),
        (r"'m g \ell \cos\theta'", r"'m g \ell_0 \cos\theta'"),
    )
    found, _ = changed(tmp_path, "cart_pole", *changes)
    assert found["T"].verdict == "holds"
    assert found["U"].note == r"with one change it would hold: symbol 3: \ell_0 should be \ell"


def test_an_index_of_an_inertia_is_one_of_its_letters(tmp_path):
    """Σ I_i is no line of point masses: a half too few in it is said."""
    half = (
        r"\sum_{i=1}^{2} \frac12 I_i \dot\theta_i^2 + \frac12 I_2 \dot\theta_1^2 + I_2 \dot\theta_1"
    )
    rest = r"\frac12 m_1 l_{c1}^2 \dot\theta_1^2 + \frac12 m_2 (l_1^2 \dot\theta_1^2"
    rest += r" + l_{c2}^2 (\dot\theta_1 + \dot\theta_2)^2 + 2 l_1 l_{c2} c_2 \dot\theta_1"
    for first, told in ((r"\frac12 I_i", ""), ("I_i", r"\frac { 1 } { 2 } is missing")):
        line = (
            half.replace(r"\frac12 I_i", first)
            + rf" \dot\theta_2 + {rest} (\dot\theta_1 + \dot\theta_2))"
        )
        old = "left = 'G_2'\nprinted = 'm_2 l_{c2} g c_{12}'"
        found, _ = changed(tmp_path, "two_link_arm", (old, f"left = 'K'\nprinted = '{line}'"))
        assert (found["G_2"].verdict == "holds") == (not told)
        assert told in found["G_2"].note


def test_two_slips_in_a_line_are_no_single_change(tmp_path):
    two = (r"'m_2 l_{c2} g c_{12}'", r"'m_1 l_{c2} g s_{12}'")
    found, _ = changed(tmp_path, "two_link_arm", two)
    assert (found["G_2"].verdict, found["G_2"].note) == ("unexplained", "")


def test_no_slip_planted_in_a_line_that_holds_goes_unseen():
    """Signs, indices, dots, factors, sines for cosines, terms dropped, digits: all of them."""
    for name in ("two_link_arm", "cart_pole", "double_pendulum", "spherical_pendulum"):
        found = thesis(FOLDER / f"{name}.toml", FOLDER / f"{name}.urdf")
        trials = Trials(found.catalogue(), found.ground(found.catalogue()), each=100)
        with np.errstate(divide="ignore"):  # some slips divide by zero
            answers = Counter(
                trial.answer for one in found.catalogue().equations for trial in trials.of(one)
            )
        assert answers["caught"] > 100
        assert answers["missed"] == answers["same"] == 0


@pytest.mark.parametrize("name", ["double_pendulum", "spherical_pendulum"])
def test_all_of_both_pendulums_holds(name):
    """In absolute angles; and with a pole, where a line has no value."""
    found = rows(name)
    assert {line: row.verdict for line, row in found.items() if row.verdict != "holds"} == {}


def test_point_masses_of_a_book_and_bodies_of_a_robot_are_told_apart(tmp_path):
    urdf = (FOLDER / "double_pendulum.urdf").read_text(encoding="utf-8")
    head, _, tail = urdf.rpartition('ixx="0" iyy="0" izz="0"')
    path = tmp_path / "pendulum.urdf"
    path.write_text(f'{head}ixx="1e-3" iyy="1e-3" izz="1e-3"{tail}', encoding="utf-8")
    report = audit_derivation(FOLDER / "double_pendulum.toml", path)
    found = {row.id.split(":")[2]: row for row in report.rows}
    assert found["x"].verdict == found["Q_1"].verdict == "holds"
    for name in ("T", "Q_2"):
        assert found[name].verdict == "unexplained"
        assert "would hold for point masses" in found[name].note


def test_a_robot_written_in_millimetres_is_told_from_slips(tmp_path):
    """400 for 0.4 m, 14000 for 0.014 kg·m²: the book's lines would hold but for that."""
    urdf = (FOLDER / "cart_pole.urdf").read_text(encoding="utf-8")
    for old, new in (("-0.4", "-400"), ("0.014", "14000")):
        assert old in urdf
        urdf = urdf.replace(old, new)
    (tmp_path / "mm.urdf").write_text(urdf, encoding="utf-8")
    report = audit_derivation(FOLDER / "cart_pole.toml", tmp_path / "mm.urdf")
    assert {row.verdict for row in report.rows} == {"unexplained"}
    assert all("robot's lengths were in mm" in row.note for row in report.rows)


def test_a_slip_that_is_too_small_in_a_small_robot_is_no_matter_of_millimetres(tmp_path):
    """All lengths come from the robot. A thousandth of it hides J behind the cart's mass."""
    changes = (
        ("'\\ell' = \"40 cm\"", "'a' = \"position of centre of pole in pole along z\""),
        ("'J' = \"0.014 kg m^2\"", "'J' = \"inertia yy of pole\""),
        ("[symbols]", "[symbols]\n'\\ell' = '= -a'"),
    )
    found, _ = changed(tmp_path, "cart_pole", *changes)
    assert found["T"].verdict == "holds"
    slip = (r"1/2 (J + m \ell^2) \dot", r"1/2 (2 J + m \ell^2) \dot")
    found, _ = changed(tmp_path, "cart_pole", *changes, slip)
    assert "2 should not be there" in found["T"].note


@pytest.mark.parametrize(
    ("length", "note"), [("40.001", "it holds to 2e-05: a number"), ("41", "")]
)
def test_a_rounded_number_is_told_from_slips(length, note, tmp_path):
    """0.001 cm of 40 are 2.5e-5 of it: 2e-05."""
    found, _ = changed(tmp_path, "cart_pole", ("'\\ell' = \"40 cm\"", f"'\\ell' = \"{length} cm\""))
    assert found["U"].verdict == "unexplained"
    assert found["U"].note[: len(note) or None] == note


def test_a_line_without_a_value_is_its_own_error(tmp_path):
    new = r"'m_2 l_{c2} g c_{12} + 1/(\theta_1 - \theta_1)'"
    found, _ = changed(tmp_path, "two_link_arm", (r"'m_2 l_{c2} g c_{12}'", new))
    assert found["G_2"].reason == "isn't finite"


def test_the_ur5_of_a_data_sheet_holds_on_the_urdf_of_another_source():
    """An index stands for all six joints, and a formula for six matrices."""
    rows = audit_derivation(FOLDER / "ur5.toml", "example:ur5_robot").rows
    assert [row.verdict for row in rows] == ["not checkable", "holds", "holds", "holds"]


def test_an_index_runs_over_all_that_the_header_says(tmp_path):
    """A slip that only the sixth joint shows."""
    text = (FOLDER / "ur5.toml").read_text(encoding="utf-8")
    path = tmp_path / "ur5.toml"
    path.write_text(text.replace('d_6 = "82.3 mm"', 'd_6 = "83.2 mm"'), encoding="utf-8")
    rows = audit_derivation(path, "example:ur5_robot", only=["ur:1:T"]).rows
    assert rows[0].verdict == "unexplained"


def test_a_robot_too_light_to_tell_slips_says_so(tmp_path):
    urdf = (FOLDER / "double_pendulum.urdf").read_text(encoding="utf-8")
    path = tmp_path / "light.urdf"
    path.write_text(urdf.replace('"2.0"', '"2e-9"').replace('"1.5"', '"1e-9"'), encoding="utf-8")
    told = audit_derivation(FOLDER / "double_pendulum.toml", path, only=["dp:1:x"]).states
    assert "a slip in one of them can go unseen" in told
    usual = audit_derivation(FOLDER / "double_pendulum.toml", FOLDER / "double_pendulum.urdf")
    assert "unseen" not in usual.states
