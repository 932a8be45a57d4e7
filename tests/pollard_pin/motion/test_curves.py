"""Curves: the thesis's, lines, arcs, splines; derivatives, ends and refusals."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from pollard_pin.motion.curves import appendix_b, arc, joined, line
from pollard_pin.motion.samples import through
from thesis_pin.errors import TrajectoryError

START, END = [0.4, 0.0, 0.0, 0.0, 0.0, 0.0], [0.5, 0.1, 0.1, 0.1, 0.2, 0.3]

PATHS = {
    "appendix B": lambda: appendix_b(),
    "appendix B, rest to rest": lambda: appendix_b(timing="rest-to-rest", duration=7),
    "line": lambda: line(START, END, 3),
    "arc": lambda: arc(START, [0.45, 0.1, 0.1], END, 3, "constant-rate"),
    "spline": lambda: through([0, 1, 2.5, 3], np.outer([0, 1, 2, 4], np.arange(6)) * 0.1),
    "segments": lambda: joined([line(START, END, 3), arc(END, [0.45, 0, 0.1], START, 2)]),
}


@pytest.mark.parametrize("name", PATHS)
def test_rates_and_accelerations_are_exact_derivatives(name):
    path, step = PATHS[name](), 1e-5
    time = np.linspace(0.013, path.duration - 0.017, 200)
    now, ahead, behind = path.at(time), path.at(time + step), path.at(time - step)
    numeric = (ahead.pose - behind.pose) / (2 * step)
    np.testing.assert_allclose(now.rate, numeric, atol=1e-7)
    numeric = (ahead.rate - behind.rate) / (2 * step)
    np.testing.assert_allclose(now.acceleration, numeric, atol=1e-5)


def test_the_curve_is_appendix_b_in_metres():
    """By hand: t = −60π at the start, 0 in the middle, 10π/3·… where sin = 1."""
    path = appendix_b(placement=[0, 0, 0])
    ends = path.sample(3).pose
    reach = 60 * np.pi * 1e-3
    np.testing.assert_allclose(
        ends[0, :3], [-0.001 * (60 * np.pi) ** 2 * 1e-3, -reach, 0], atol=1e-12
    )
    np.testing.assert_allclose(ends[1, :3], [0, 0, 0], atol=1e-12)
    np.testing.assert_allclose(ends[2, :3], [ends[0, 0], reach, 0], atol=1e-12)
    # t = 5π/3 is where sin(0.3 t) = 1.
    at = path.duration * (0.5 + (5 * np.pi / 3) / (120 * np.pi))
    np.testing.assert_allclose(path.at(at).pose[0, 2], 0.1, atol=1e-12)


def test_default_placement_duration_and_timing_are_the_specifications():
    path = appendix_b()
    assert path.duration == 20.0
    assert path.parameters["placement"] == [0.45, 0.0, 0.0]
    assert path.parameters["timing"] == "constant-rate"


@pytest.mark.parametrize("name", ["appendix B, rest to rest", "line"])
def test_rest_to_rest_begins_and_ends_at_rest(name):
    ends = PATHS[name]().sample(2)
    assert np.abs(ends.rate).max() < 1e-12
    assert np.abs(ends.acceleration).max() < 1e-12


@settings(max_examples=60, deadline=None)
@given(
    st.lists(st.floats(-0.5, 0.5), min_size=9, max_size=9),
)
def test_an_arc_passes_through_its_three_points_on_one_circle(values):
    points = np.array(values).reshape(3, 3)
    area = np.linalg.norm(np.cross(points[1] - points[0], points[2] - points[0]))
    if area < 1e-2:
        return
    path = arc([*points[0], 0, 0, 0], points[1], [*points[2], 0, 0, 0], 1.0, "constant-rate")
    fine = path.sample(20001).pose[:, :3]
    np.testing.assert_allclose(fine[0], points[0], atol=1e-9)
    np.testing.assert_allclose(fine[-1], points[2], atol=1e-9)
    gaps = np.linalg.norm(fine - points[1], axis=1)
    speed = np.linalg.norm(path.at(0.3).rate[0, :3])
    assert gaps.min() < speed / 20000
    # A circle: constant speed and an acceleration perpendicular to it.
    motion = path.sample(50)
    speeds = np.linalg.norm(motion.rate, axis=1)
    np.testing.assert_allclose(speeds, speed, rtol=1e-9)
    product = np.einsum("ni,ni->n", motion.rate, motion.acceleration)
    assert np.abs(product).max() < 1e-8 * speed**2 * (1 + speed)


def test_an_arc_through_points_on_a_line_is_refused():
    with pytest.raises(TrajectoryError, match="lie on a line"):
        arc(START, [0.45, 0.05, 0.05], END, 1.0)


def test_a_spline_passes_through_its_poses():
    poses = np.random.default_rng(1).uniform(-1, 1, (6, 6))
    time = [0, 0.5, 1.5, 2, 3, 3.5]
    path = through(time, poses)
    np.testing.assert_allclose(path.at(time).pose, poses, atol=1e-12)


def test_segments_that_do_not_meet_are_refused():
    turn = Rotation.from_euler("XYZ", [0.2, 0.1, 0.3]).magnitude()  # θ, ψ, φ of END
    with pytest.raises(TrajectoryError, match=f"pose jumps by {turn:.3g} between segments 1 and 2"):
        joined([line(START, END, 1), line(START, END, 1)])


def test_a_corner_taken_at_speed_is_refused():
    with pytest.raises(TrajectoryError, match="rate jumps"):
        joined([line(START, END, 1, "constant-rate"), line(END, START, 1, "constant-rate")])
