"""Times from a tool speed: along any curve, with ramps, and refusals with their place."""

import numpy as np
import pytest

from pollard_pin.motion.feed import at_speed
from pollard_pin.motion.files import load_path
from pollard_pin.motion.path import PEAK, TIMINGS, timing_law
from thesis_pin.errors import BadInput, SpecificationError, TrajectoryError

ANGLE = np.linspace(0, np.pi, 25) ** 1.2 / np.pi**0.2  # unevenly spread
HALF_CIRCLE = np.column_stack([0.4 + 0.1 * np.cos(ANGLE), 0.1 * np.sin(ANGLE), 0.05 + 0 * ANGLE])
STILL = np.broadcast_to(np.eye(3), (25, 3, 3))


def speeds(path, count=2001):
    return np.linalg.norm(path.sample(count).tool.velocity, axis=1)


@pytest.mark.parametrize("timing", TIMINGS)
def test_the_tool_moves_at_the_speed_between_its_ramps(timing):
    path = at_speed(HALF_CIRCLE, STILL, 0.05, timing)
    found = speeds(path)
    assert found.max() == pytest.approx(0.05, rel=1e-6)
    length = 0.1 * np.pi  # of a half circle, by hand
    assert path.duration == pytest.approx(length / 0.05 * PEAK[timing], rel=1e-4)
    assert np.trapezoid(found, dx=path.duration / 2000) == pytest.approx(length, rel=1e-4)
    if timing != "constant-rate":
        assert found[[0, -1]].max() < 1e-12
    if timing != "rest-to-rest":
        np.testing.assert_allclose(found[201:-201], 0.05, rtol=1e-6)


def test_velocities_and_accelerations_are_exact_derivatives():
    path = at_speed(HALF_CIRCLE, STILL, np.linspace(0.03, 0.08, 25))
    time, h = np.linspace(0.02, path.duration - 0.02, 150), 1e-5
    now, ahead, behind = (path.at(time + dt).tool for dt in (0, h, -h))
    np.testing.assert_allclose(
        now.velocity, (ahead.position - behind.position) / (2 * h), atol=1e-8
    )
    np.testing.assert_allclose(
        now.acceleration, (ahead.velocity - behind.velocity) / (2 * h), atol=1e-5
    )


def test_a_speed_at_each_position_is_kept_there():
    given = np.linspace(0.03, 0.08, 25) ** 0.5
    path = at_speed(HALF_CIRCLE, STILL, given, "constant-rate")
    motion = path.sample(8001)
    gaps = np.linalg.norm(motion.pose[:, None, :3] - HALF_CIRCLE, axis=2)
    found = np.linalg.norm(motion.tool.velocity, axis=1)[gaps.argmin(axis=0)]
    np.testing.assert_allclose(found, given, rtol=1e-3)


@pytest.mark.parametrize("timing", TIMINGS)
def test_timing_laws_run_from_0_to_1_with_exact_derivatives(timing):
    time, h = np.linspace(0.01, 2.99, 333), 1e-6
    s, first, second = timing_law(timing, 3.0, time)
    ahead, behind = (timing_law(timing, 3.0, time + dt) for dt in (h, -h))
    np.testing.assert_allclose(first, (ahead[0] - behind[0]) / (2 * h), atol=1e-8)
    np.testing.assert_allclose(second, (ahead[1] - behind[1]) / (2 * h), atol=1e-5)
    ends = timing_law(timing, 3.0, np.array([0.0, 3.0]))
    np.testing.assert_allclose(ends[0], [0, 1], atol=1e-15)
    fine = timing_law(timing, 3.0, np.linspace(0, 3, 3001))[1]
    assert fine.max() * 3.0 == pytest.approx(PEAK[timing], rel=1e-9)
    assert (np.diff(s) > 0).all()


TABLE = "x_mm,y_mm,z_mm,psi_deg,theta_deg,phi_deg{}\n400,-50,100,0,0,0{}\n420,0,110,0,5,0{}\n"
LAST = "400,50,100,0,0,0{}\n"


@pytest.mark.parametrize(
    ("unit", "value"), [("mm_s", "50"), ("m_s", "0.05"), ("mm_min", "3000"), ("m_min", "3")]
)
@pytest.mark.parametrize("name", ["feed", "speed"])
def test_a_column_of_speed_takes_the_place_of_time(tmp_path, name, unit, value):
    file = tmp_path / "path.csv"
    cell = f",{value}"
    file.write_text(TABLE.format(f",{name}_{unit}", cell, cell) + LAST.format(cell))
    path = load_path(file)
    assert speeds(path).max() == pytest.approx(0.05, rel=1e-6)
    assert any("tool speed of 50 mm/s" in note for note in path.notes)
    np.testing.assert_allclose(path.sample(2).pose[:, 1], [-0.05, 0.05], atol=1e-12)
    bare = tmp_path / "bare.csv"
    bare.write_text(TABLE.format("", "", "") + LAST.format(""))
    same = load_path(bare, feed=0.05)
    np.testing.assert_allclose(same.sample(9).pose, path.sample(9).pose, atol=1e-9)


def test_what_has_neither_time_nor_one_speed_is_refused(tmp_path):
    file = tmp_path / "path.csv"
    file.write_text(TABLE.format("", "", "") + LAST.format(""))
    with pytest.raises(BadInput, match="neither a column of time nor a speed"):
        load_path(file)
    cell = ",50"
    file.write_text(TABLE.format(",feed_mm_s", cell, cell) + LAST.format(cell))
    with pytest.raises(BadInput, match="the path has a column 'feed_mm_s'"):
        load_path(file, feed=0.1)
    file.write_text(TABLE.format(",t", ",0", ",1") + LAST.format(",2"))
    for given in ({"feed": 0.1}, {"timing": "ramped"}):
        with pytest.raises(BadInput, match="the path has times"):
            load_path(file, **given)


@pytest.mark.parametrize(
    ("rows", "says"),
    [
        (["400,0,100", "400,0,100", "400,50,100"], r"csv:3: the spray tip stays where it was"),
        (["400,0,100", "400,50,100", "400,0,100"], r"csv:3: the path turns back on itself"),
        (["400,0,100"], "1 pose;"),
    ],
)
def test_positions_a_speed_gives_no_time_are_refused_with_the_line(tmp_path, rows, says):
    file = tmp_path / "path.csv"
    lines = [f"{row},0,0,0" for row in rows]
    file.write_text("\n".join(["x_mm,y_mm,z_mm,psi,theta,phi", *lines]))
    with pytest.raises(TrajectoryError, match=says):
        load_path(file, feed=0.05)


def test_a_speed_that_is_none_is_refused_with_the_line(tmp_path):
    file = tmp_path / "path.csv"
    file.write_text(TABLE.format(",feed_mm_s", ",50", ",0") + LAST.format(",50"))
    with pytest.raises(TrajectoryError, match=r"csv:3: the tool speed is 0 m/s"):
        load_path(file)


SEGMENTS = """
format = 1
[start]
position = [0.4, -0.1, 0.1]
[[segments]]
kind = "arc"
via = [0.5, 0.0, 0.1]
position = [0.4, 0.1, 0.1]
{how}
"""


@pytest.mark.parametrize("timing", TIMINGS)
def test_a_segment_may_say_its_speed_instead_of_its_duration(tmp_path, timing):
    """An arc through (0.4, ∓0.1) and (0.5, 0) is a half circle of radius 0.1."""
    file = tmp_path / "path.toml"
    file.write_text(SEGMENTS.format(how=f'speed = 0.05\ntiming = "{timing}"'))
    path = load_path(file)
    assert path.duration == pytest.approx(0.1 * np.pi / 0.05 * PEAK[timing])
    assert speeds(path).max() == pytest.approx(0.05, rel=1e-9)


@pytest.mark.parametrize("how", ["", "duration = 1.0\nspeed = 0.1"])
def test_a_segment_needs_one_of_both(tmp_path, how):
    file = tmp_path / "path.toml"
    file.write_text(SEGMENTS.format(how=how))
    with pytest.raises(SpecificationError, match="needs either a duration or a speed"):
        load_path(file)


def test_poses_without_times_take_a_speed(tmp_path):
    file = tmp_path / "path.toml"
    poses = "".join(
        f"[[poses]]\nposition = [{x:.17g}, {y:.17g}, {z:.17g}]\n" for x, y, z in HALF_CIRCLE
    )
    file.write_text(f'format = 1\nspeed = 0.05\ntiming = "rest-to-rest"\n{poses}')
    expected = at_speed(HALF_CIRCLE, STILL, 0.05, "rest-to-rest")
    found = load_path(file)
    assert found.duration == pytest.approx(expected.duration)
    np.testing.assert_allclose(found.sample(9).pose, expected.sample(9).pose, atol=1e-9)
    file.write_text(f'format = 1\nspeed = 0.05\ninterpolation = "cubic"\n{poses}')
    with pytest.raises(SpecificationError, match='must be "free"'):
        load_path(file)


def test_a_segment_that_only_turns_needs_a_duration(tmp_path):
    file = tmp_path / "path.toml"
    file.write_text(
        'format = 1\n[start]\nposition = [0.4, 0, 0.1]\n[[segments]]\nkind = "line"\n'
        "position = [0.4, 0, 0.1]\norientation_deg = [0, 30, 0]\nspeed = 0.1\n"
    )
    with pytest.raises(TrajectoryError, match="stays where it is"):
        load_path(file)


def test_the_curve_between_far_positions_is_noted():
    """Corners of a square: a spline through them isn't straight, by hand 20 mm and more."""
    corners = np.array([[0.4, 0, 0], [0.5, 0, 0], [0.5, 0.1, 0], [0.4, 0.1, 0]])
    path = at_speed(corners, STILL[:4], 0.05)
    note = path.notes[-1]
    assert "leaves the straight lines" in note
    assert float(note.rpartition(" by up to ")[2].removesuffix(" mm")) > 10
