"""c_{12} and s_1: which angles the numerals mean."""

from pathlib import Path

import pytest

from thesis_pin import audit_derivation

FOLDER = Path(__file__).parents[4] / "examples" / "your_derivation"


@pytest.fixture
def audited(tmp_path):
    """Audits a line about an example's robot whose coordinates are called otherwise."""

    def audit(robot, coordinates, symbol, left, printed):
        path = tmp_path / "mine.toml"
        path.write_text(
            "[derivation]\ntitle = 'Mine'\nname = 'mine'\ncos = 'c'\nsin = 's'\n"
            f"[coordinates]\n{coordinates}\n[symbols]\n{symbol}\n"
            "[constants]\n'l_1' = '0.45 m'\n'l_2' = '0.35 m'\n"
            f"[[equation]]\nid = 'mine:1:e'\nleft = '{left}'\nprinted = '{printed}'\n",
            encoding="utf-8",
        )
        (row,) = audit_derivation(path, FOLDER / f"{robot}.urdf", with_effects=False).rows
        return row

    return audit


HAND = r"'x' = 'position of hand along x'"


@pytest.mark.parametrize(
    ("coordinates", "printed"),
    [
        ("'\\theta_1' = 'shoulder'\n'\\theta_2' = 'elbow'", "l_1 c_1 + l_2 c_{12}"),
        ("'\\theta_2' = 'elbow'\n'\\theta_1' = 'shoulder'", "l_1 c_1 + l_2 c_{12}"),
        ("'\\theta_4' = 'shoulder'\n'\\theta_5' = 'elbow'", "l_1 c_4 + l_2 c_{45}"),
        ("'q_0' = 'shoulder'\n'q_1' = 'elbow'", "l_1 c_0 + l_2 c_{0+1}"),
        ("'\\alpha' = 'shoulder'\n'\\beta' = 'elbow'", "l_1 c_1 + l_2 c_{12}"),
    ],
)
def test_a_numeral_is_the_angle_with_this_number_else_its_place(coordinates, printed, audited):
    assert audited("two_link_arm", coordinates, HAND, "x", printed).verdict == "holds"


@pytest.mark.parametrize(
    ("coordinates", "printed"),
    [
        ("'\\theta_2' = 'elbow'\n'\\theta_1' = 'shoulder'", "l_1 c_2 + l_2 c_{12}"),
        ("'\\theta_4' = 'shoulder'\n'\\theta_5' = 'elbow'", "l_1 c_5 + l_2 c_{45}"),
    ],
)
def test_another_angle_s_numeral_fails(coordinates, printed, audited):
    row = audited("two_link_arm", coordinates, HAND, "x", printed)
    assert row.verdict == "unexplained"
    assert row.residual_printed > 0.01


def test_a_numeral_passes_over_what_slides(audited):
    """The cart's x stands first and has the same number: c_1 is the pole's."""
    coordinates = "'x_1' = 'slide'\n'\\theta_1' = 'pivot'"
    symbol = "'R' = 'rotation of pole'"
    assert audited("cart_pole", coordinates, symbol, "R_{11}", "c_1").verdict == "holds"
    assert audited("cart_pole", coordinates, symbol, "R_{11}", "s_1").verdict == "unexplained"


@pytest.mark.parametrize("printed", ["l_1 c_1", "l_1 c_7"])
def test_a_numeral_of_two_angles_or_none_says_so(printed, audited):
    coordinates = "'\\theta_1' = 'shoulder'\n'\\phi_1' = 'elbow'"
    reason = audited("two_link_arm", coordinates, HAND, "x", printed).reason
    told = {"l_1 c_1": "may be of \\theta_1 or \\phi_1", "l_1 c_7": "isn't defined anywhere"}
    assert told[printed] in reason
