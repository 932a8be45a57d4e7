"""The same numbers through every dialect and unit are the same gait."""

from decimal import Decimal
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import scout_pin
from scout_pin.motion.gait import BODIES
from scout_pin.motion.writing import rows_of
from scout_pin.report.movement import gait_movement
from thesis_pin.errors import BadInput, ModelWarning, UnknownName

WALK = Path(__file__).parents[3] / "examples" / "walk.toml"
TENS = {"": 0, "_m": 0, "_mm": 3, "_cm": 2, "_s": 0, "_ms": 3, "_us": 6, "_rad": 0}


@pytest.fixture(scope="module")
def columns():
    """A gait's columns to six decimals."""
    gait = scout_pin.load_gait(WALK)
    movement = gait_movement(scout_pin.load(), gait, samples=61)
    assert len(movement.time) == len(rows_of(gait, 61))
    numbers = {"t": movement.time} | {name: one for name, (_, one) in movement.poses.items()}
    texts = {name: [f"{one:.6f}" for one in values] for name, values in numbers.items()}
    return texts | dict(movement.words)


def written(columns, mark, decimal, length, time, angle, first=""):
    names, cells = [], []
    for name, values in columns.items():
        ending = ""
        if name != "support":
            ending = time if name == "t" else length if name[-1] in "xyz" else angle
            tens = TENS[ending]
            values = [f"{Decimal(one).scaleb(tens):f}".replace(".", decimal) for one in values]
        names.append(name + ending)
        cells.append(values)
    rows = [mark.join(row) for row in zip(*cells, strict=True)]
    return first + "\n".join([mark.join(names), *rows]) + "\n"


@pytest.fixture(scope="module")
def plain(columns, tmp_path_factory):
    """The gait of the plainest table."""
    file = tmp_path_factory.mktemp("plain") / "a.csv"
    file.write_text(written(columns, ",", ".", "", "", ""))
    return scout_pin.load_gait(file)


@settings(deadline=None, max_examples=40)
@given(
    st.sampled_from([(",", "."), (";", "."), (";", ","), ("\t", ","), ("|", ","), ("  ", ",")]),
    st.sampled_from(["", "_m", "_mm", "_cm"]),
    st.sampled_from(["", "_s", "_ms", "_us"]),
    st.sampled_from(["", "_rad"]),
    st.sampled_from(["", "\ufeff", "# a note; with marks, and tabs\t\n\n"]),
    st.booleans(),
)
def test_every_dialect_and_power_of_ten_gives_the_same_gait_to_the_bit(
    tmp_path_factory, columns, plain, marks, length, time, angle, first, windows
):
    file = tmp_path_factory.mktemp("tables") / "b.csv"
    text = written(columns, *marks, length, time, angle, first)
    file.write_text(text, "utf-8", newline="\r\n" if windows else "\n")
    one, two = plain, scout_pin.load_gait(file)
    assert one.phases == two.phases
    for body in BODIES:
        for first_curve, second_curve in zip(one.curves[body], two.curves[body], strict=True):
            np.testing.assert_array_equal(first_curve.c, second_curve.c)
            np.testing.assert_array_equal(first_curve.x, second_curve.x)
    assert (two.notes == one.notes) == (marks == (",", "."))


def test_degrees_give_the_same_gait_to_a_rounding(columns, tmp_path):
    (tmp_path / "a.csv").write_text(written(columns, ",", ".", "", "", ""))
    turned = {
        name + ("_deg" if name.endswith(("pitch", "roll", "yaw")) else ""): (
            [repr(float(np.degrees(float(one)))) for one in values]
            if name.endswith(("pitch", "roll", "yaw"))
            else values
        )
        for name, values in columns.items()
    }
    rows = [",".join(row) for row in zip(*turned.values(), strict=True)]
    (tmp_path / "b.csv").write_text("\n".join([",".join(turned), *rows]) + "\n")
    one, two = (scout_pin.load_gait(tmp_path / name) for name in ("a.csv", "b.csv"))
    t = np.linspace(one.start, one.end, 301)
    for body in BODIES:
        for first, second in zip(one.curves[body], two.curves[body], strict=True):
            np.testing.assert_allclose(second(t), first(t), atol=1e-15)


@pytest.mark.parametrize(
    ("name", "error", "says"),
    [
        ("torso_pich", UnknownName, "Did you mean 'torso_pitch"),
        ("torso_x_inch", UnknownName, "Did you mean 'torso_x"),
        ("torso_pitch_deg", BadInput, "'torso_pitch' and 'torso_pitch_deg' say the same"),
        ("torso_pitch", BadInput, "'torso_pitch' and 'torso_pitch' say the same"),
    ],
)
def test_a_column_too_many_is_refused_with_the_nearest(columns, name, error, says, tmp_path):
    text = written(columns, ",", ".", "", "", "").splitlines()
    rows = [text[0] + "," + name, *(line + ",0" for line in text[1:])]
    (tmp_path / "a.csv").write_text("\n".join(rows) + "\n")
    with pytest.raises(error, match=says):
        scout_pin.load_gait(tmp_path / "a.csv")


def test_names_and_supports_in_another_case_are_the_same_gait(columns, tmp_path):
    text = written(columns, ",", ".", "", "", "")
    header, _, rows = text.partition("\n")
    (tmp_path / "a.csv").write_text(text)
    (tmp_path / "b.csv").write_text(
        header.replace("t,", "Time [s],", 1).title() + "\n" + rows.replace("double", "Double")
    )
    one, two = (scout_pin.load_gait(tmp_path / name) for name in ("a.csv", "b.csv"))
    assert (one.phases, one.notes) == (two.phases, two.notes)
    for body in BODIES:
        for first, second in zip(one.curves[body], two.curves[body], strict=True):
            np.testing.assert_array_equal(first.c, second.c)


def test_a_gait_in_degrees_whose_columns_say_radians_is_asked_about(columns, tmp_path):
    turned = columns | {"torso_roll": [str(10 * k) for k in range(len(columns["t"]))]}
    (tmp_path / "a.csv").write_text(written(turned, ",", ".", "", "", ""))
    with pytest.warns(ModelWarning, match="torso_roll reach .* as in torso_roll_deg"):
        gait = scout_pin.load_gait(tmp_path / "a.csv")
    assert any("torso_roll_deg" in note for note in gait.notes)


def standing(folder, columns):
    """Four rows of a knee bend that has these columns besides."""
    file = folder / "bend.csv"
    rows = [f"{t},double" + f",{0.21 - 0.01 * (t == 1)}" * len(columns) for t in range(4)]
    file.write_text("\n".join([",".join(["t", "support", *columns]), *rows]) + "\n")
    return file


def test_places_that_a_table_leaves_out_are_zero_with_a_warning(tmp_path):
    file = standing(tmp_path, ["torso_z"])
    with pytest.warns(ModelWarning, match="left_foot_x … left_foot_yaw, right_foot_x … right_fo"):
        gait = scout_pin.load_gait(file)
    for body in BODIES[1:]:
        assert not np.any([curve([0.0, 1.5]) for curve in gait.curves[body]])
    assert any(
        "torso_x, torso_y, torso_pitch, torso_roll, torso_yaw, left_foot_x …" in one
        for one in gait.notes
    )
    report = scout_pin.gait_report(scout_pin.load(), gait, samples=11)
    assert "taken as zero" in " ".join(report.document()["notes"])


def test_angles_that_a_table_leaves_out_are_told_without_a_warning(columns, tmp_path):
    left = {name: one for name, one in columns.items() if name[-1] not in "hlw"}
    file = tmp_path / "places.csv"
    file.write_text(written(left, ",", ".", "", "", ""))
    notes = scout_pin.load_gait(file, smooth="none").notes
    assert any(one.startswith("torso_pitch, torso_roll, torso_yaw, left_foot_p") for one in notes)
    file.write_text(written(columns, ",", ".", "", "", ""))
    notes = scout_pin.load_gait(file, smooth="none").notes
    assert not any("taken as zero" in one for one in notes)
