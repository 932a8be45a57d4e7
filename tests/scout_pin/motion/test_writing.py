"""Gaits written down and read back."""

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
import yaml

import scout_pin
from scout_pin.motion.gait import BODIES
from scout_pin.motion.writing import rows_of, supports
from scout_pin.report.document import gait_report
from scout_pin.report.movement import gait_movement
from thesis_pin.report.exchange.movement import content, form_of
from thesis_pin.tables.writing import WrittenUnits

EXAMPLES = Path(__file__).parents[3] / "examples"
GAITS = {
    "thesis": ("thesis", None),
    "walk": (EXAMPLES / "walk.toml", None),
    "squat": (EXAMPLES / "squat.toml", None),
    "lopsided": (EXAMPLES / "lopsided_walk.toml", EXAMPLES / "lopsided.toml"),
}


@pytest.fixture(scope="module", params=GAITS)
def given(request):
    source, specification = GAITS[request.param]
    return scout_pin.load(specification), scout_pin.load_gait(source)


def values(gait, t):
    return np.array([[curve(t) for curve in gait.curves[body]] for body in BODIES])


@pytest.mark.parametrize("units", ["", "mm,deg,ms", "cm,rad,us"])
@pytest.mark.parametrize("form", ["poses", "toml"])
def test_what_is_written_reads_back_at_every_row(given, form, units, tmp_path):
    robot, gait = given
    if form == "toml" and "cm" in units:
        pytest.skip("our own format knows millimetres and degrees")
    file = tmp_path / ("a.toml" if form == "toml" else "a.csv")
    chosen = WrittenUnits.parse(units) if units else WrittenUnits()
    file.write_bytes(content(gait_movement(robot, gait, samples=101), form, chosen))
    again = scout_pin.load_gait(file)
    t = rows_of(gait, 101)
    found, wanted = values(again, t * gait.time_unit), values(gait, t)
    lengths = (slice(None), slice(3), slice(None, -1))  # the last row ends a piece of a curve
    if form == "poses":
        np.testing.assert_array_equal(found[lengths], wanted[lengths])
    np.testing.assert_allclose(found, wanted, atol=1e-15, rtol=1e-15)
    middle = (t[1:] + t[:-1]) / 2
    inside = np.abs(middle[:, None] - [p.end for p in gait.phases]).min(axis=1) > 0.3
    same = again.support(middle[inside] * gait.time_unit) == gait.support(middle[inside])
    assert same.all()


@pytest.mark.parametrize("units", ["", "mm,deg"])
def test_our_own_format_keeps_the_curves_of_a_gait_that_was_not_sampled(given, tmp_path, units):
    robot, gait = given
    file, chosen = tmp_path / "a.toml", WrittenUnits.parse(units) if units else WrittenUnits()
    file.write_bytes(content(gait_movement(robot, gait), "toml", chosen))
    again = scout_pin.load_gait(file)
    t = gait.sample_times(73)
    for body in BODIES:
        for one, two in zip(gait.curves[body], again.curves[body], strict=True):
            for order in (0, 1, 2):
                scale = max(1e-3, np.abs(one(t, order)).max())
                atol = 1e-13 * scale if units else 0.0
                np.testing.assert_allclose(two(t, order), one(t, order), atol=atol, rtol=0)
    assert (again.phases, again.time_unit) == (gait.phases, gait.time_unit)


def test_a_gait_of_more_pieces_than_a_file_may_hold_is_splined_so_that_it_can_be_read(tmp_path):
    gait = scout_pin.repeat_gait(scout_pin.load_gait(EXAMPLES / "walk.toml"), 400)
    file = tmp_path / "long.toml"
    file.write_bytes(content(gait_movement(scout_pin.load(), gait), "toml"))
    assert scout_pin.load_gait(file).end == pytest.approx(gait.end * gait.time_unit)


def test_a_gait_made_of_samples_is_written_at_its_samples(given, tmp_path):
    robot, gait = given
    first, second = tmp_path / "1.csv", tmp_path / "2.csv"
    first.write_bytes(content(gait_movement(robot, gait, samples=241), "poses"))
    once = scout_pin.load_gait(first)
    second.write_bytes(content(gait_movement(robot, once), "poses"))
    rows = [file.read_text().splitlines() for file in (first, second)]
    assert len(rows[0]) == len(rows[1])
    for one, two in zip(rows[0][:-1], rows[1][:-1], strict=True):
        # All but who stands at the row at which that changes, which either phase may have.
        assert one.split(",")[::2][1:] == two.split(",")[::2][1:]


def test_joint_angles_read_back_to_the_same_report(given, tmp_path):
    robot, gait = given
    poses, joints = tmp_path / "p.csv", tmp_path / "j.csv"
    movement = gait_movement(robot, gait, samples=241)
    poses.write_bytes(content(movement, "poses"))
    joints.write_bytes(content(movement, "joints", WrittenUnits.parse("deg")))
    one, two = (
        gait_report(robot, scout_pin.load_gait(file, robot=robot), samples=31)
        for file in (poses, joints)
    )
    np.testing.assert_allclose(two.dynamics.torque, one.dynamics.torque, atol=1e-9)


def test_ros_gets_the_report_s_own_angles_and_torques(given):
    robot, gait = given
    message = yaml.safe_load(content(gait_movement(robot, gait, samples=11), "joint-trajectory"))
    t = rows_of(gait, 11)
    motion = gait.sample(t)
    joints = scout_pin.joint_trajectory(robot, motion)
    torque = scout_pin.inverse_dynamics(robot, motion, joints).torque
    assert message["joint_names"] == list(scout_pin.JOINT_NAMES)
    for key, wanted in (("positions", joints.q), ("velocities", joints.v), ("effort", torque)):
        np.testing.assert_array_equal([point[key] for point in message["points"]], wanted)


def test_an_ending_says_what_to_write_or_it_is_asked_for():
    assert form_of("a.CSV", None) == "poses"
    assert form_of("a.csv", "ticks") == "ticks"
    assert form_of("b.yml", None) == "joint-trajectory"
    with pytest.raises(ValueError, match=r"'a\.xlsx' doesn't say what to write"):
        form_of("a.xlsx", None)


@pytest.mark.parametrize("samples", [61, 101, 1001])
@pytest.mark.parametrize("form", ["poses", "joints"])
def test_feet_stand_from_and_until_the_same_instants_when_read_back(given, form, samples, tmp_path):
    robot, gait = given
    file = tmp_path / "a.csv"
    file.write_bytes(content(gait_movement(robot, gait, samples=samples), form, WrittenUnits()))
    again = scout_pin.load_gait(file, robot=robot)
    wanted = [(p.start, p.end, p.support) for p in gait.phases if p.end > p.start]
    found = [(p.start, p.end, p.support) for p in again.phases if p.end > p.start]
    assert [support for *_, support in found] == [support for *_, support in wanted]
    times, unit = np.array([p[:2] for p in found]), gait.time_unit
    np.testing.assert_allclose(times, np.array([p[:2] for p in wanted]) * unit, atol=1e-12)


def test_where_one_foot_takes_over_from_the_other_both_stand():
    """The thesis's gait, where both do for an instant only."""
    gait = scout_pin.load_gait("thesis")
    lasting = [phase for phase in gait.phases if phase.end > phase.start]
    t = np.union1d(np.linspace(gait.start, gait.end, 81), [phase.start for phase in lasting])
    names = dict(zip(t.tolist(), supports(gait, t), strict=True))
    over = [
        phase.start
        for before, phase in pairwise(lasting)
        if {before.support, phase.support} == {"left", "right"}
    ]
    assert over
    assert [names[at] for at in over] == ["double"] * len(over)
    middle = [(phase.start + phase.end) / 2 for phase in lasting]
    assert supports(gait, np.array(middle)) == [phase.support for phase in lasting]
