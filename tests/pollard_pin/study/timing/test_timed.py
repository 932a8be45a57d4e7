"""Laws of motion along a path, judged by the report and held against toppra."""

import numpy as np
import pytest

import pollard_pin
from pollard_pin.dynamics.inverse import inverse_dynamics
from pollard_pin.motion.chain import Chain
from pollard_pin.motion.curves import arc, joined, line
from pollard_pin.motion.path import ToolMotion
from pollard_pin.motion.trajectory import joint_trajectory
from pollard_pin.specification import ACTUATORS
from pollard_pin.study.timing.course import Course
from thesis_pin.errors import BadInput, Infeasible, TrajectoryError, Unreachable

TORQUE, SPEED = np.array([2.0, 2.0, 2.0, 0.05, 0.05, 0.05]), 10.0


@pytest.fixture(scope="module")
def limits(pollard):
    return pollard_pin.motor_limits(pollard.specification, torque=TORQUE, speed=SPEED)


@pytest.fixture(scope="module")
def arch():
    """The first segment of examples/spray_arch.toml."""
    end = [0.45, 0.15, 0.0, *np.radians([0.0, 15.0, 10.0])]
    return arc([0.45, -0.15, 0.0, 0.0, 0.0, 0.0], [0.5, 0.0, 0.12], end, 3.0)


@pytest.fixture(scope="module")
def fastest(pollard, arch, limits):
    return pollard_pin.time_path(pollard, arch, limits)


def shares(report):
    torque = np.abs(report.torque).max(axis=0) / TORQUE
    return torque.max(), np.abs(report.speed).max() / SPEED


def motion_at(chain, s, rate, bend):
    """The tool's motion at places of a chain, at given ṡ and s̈."""
    tool, near = chain(s)
    moved = tool.__class__(
        tool.rotation,
        tool.position,
        tool.velocity * rate[:, None],
        tool.acceleration * rate[:, None] ** 2 + tool.velocity * bend[:, None],
        tool.omega * rate[:, None],
        tool.alpha * rate[:, None] ** 2 + tool.omega * bend[:, None],
    )
    from pollard_pin.coordinates import pose_from_placement

    return ToolMotion(s, moved, pose_from_placement(tool.position, tool.rotation, near))


def test_what_a_path_asks_for_is_what_inverse_dynamics_says(robot, rng):
    path = pollard_pin.appendix_b(robot.specification)
    course = Course.of(robot, path)
    s = np.sort(rng.uniform(0, 1, 40))
    rate, bend = rng.uniform(0, 0.5, 40), rng.uniform(-1, 1, 40)
    motion = motion_at(course.track.chain, s, rate, bend)
    # One by one: so far apart they look as if they crossed a singularity.
    joints = [joint_trajectory(robot, motion.part(np.array([k]))) for k in range(40)]
    dynamics = [
        inverse_dynamics(robot, motion.part(np.array([k])), one) for k, one in enumerate(joints)
    ]
    values = course.track.values(0, s)
    for linear, told in (
        (values.effort, np.concatenate([one.torque for one in dynamics])),
        (values.force, np.concatenate([one.loop_force for one in dynamics])),
    ):
        axes = (-1,) + (1,) * (told.ndim - 1)
        found = linear[:, 0] * bend.reshape(axes) + linear[:, 1] * rate.reshape(axes) ** 2
        np.testing.assert_allclose(found + linear[:, 2], told, atol=1e-9 * np.abs(told).max())
    motors = list(ACTUATORS)
    v, a = (np.concatenate([getattr(one, x)[:, motors] for one in joints]) for x in "va")
    np.testing.assert_allclose(values.speed * rate[:, None], v, atol=1e-12)
    found = values.speed * bend[:, None] + values.bend * rate[:, None] ** 2
    np.testing.assert_allclose(found, a, atol=1e-9)


def test_the_arch_takes_less_than_its_uniformly_scaled_law(pollard, arch, fastest):
    assert fastest.within_limits
    assert fastest.duration <= 0.36
    # Uniform scaling: torques of the same law in another time T are g + k / T².
    least = np.inf
    for seconds in np.linspace(0.35, 0.5, 31):
        path = arc(arch.at(0.0).pose[0], [0.5, 0.0, 0.12], arch.at(arch.duration).pose[0], seconds)
        if max(shares(pollard_pin.trajectory_report(pollard, path, samples=801))) <= 1.0:
            least = min(least, seconds)
    assert 0.42 < least < 0.44


def test_the_report_on_the_law_finds_every_limit_kept_and_one_of_them_used(pollard, fastest):
    report = pollard_pin.trajectory_report(pollard, fastest.path, samples=8001)
    torque, speed = shares(report)
    assert 0.999 <= torque <= 1.01
    assert speed <= 1.01
    assert report.joints.time[-1] == pytest.approx(fastest.duration)
    assert np.abs(report.joints.v[[0, -1]]).max() < 1e-6
    # The same geometry: the tool's way is on the arc's circle through the same ends.
    np.testing.assert_allclose(report.motion.pose[0], [0.45, -0.15, 0, 0, 0, 0], atol=1e-12)
    centre = circle_centre([0.45, -0.15, 0.0], [0.5, 0.0, 0.12], [0.45, 0.15, 0.0])
    radius = np.linalg.norm(report.motion.pose[:, :3] - centre, axis=1)
    np.testing.assert_allclose(radius, radius[0], rtol=1e-9)


def circle_centre(one, two, three):
    one, two, three = map(np.array, (one, two, three))
    normal = np.cross(two - one, three - one)
    rows = np.array([two - one, three - one, normal])
    right = [(two @ two - one @ one) / 2, (three @ three - one @ one) / 2, normal @ one]
    return np.linalg.solve(rows, right)


def test_toppra_finds_the_same_duration(pollard, arch, limits, fastest):
    """Its constraint asks this file's own inverse dynamics, not the study's values."""
    reason = "toppra has wheels for Linux on x86_64 only"
    toppra = pytest.importorskip("toppra", reason=reason)
    from toppra import algorithm, constraint

    toppra.setup_logging("ERROR")
    chain = Chain.of(arch.curves)

    def torque(q, rate, bend):
        # Torques are linear in s̈ and ṡ²; a negative ṡ² never comes up.
        motion = motion_at(chain, *(np.atleast_1d(x) for x in (q, rate, bend)))
        return inverse_dynamics(pollard, motion).torque[0]

    def speeds(s):
        motion = motion_at(chain, np.atleast_1d(s), np.ones(1), np.zeros(1))
        return joint_trajectory(pollard, motion).v[0, list(ACTUATORS)]

    both = np.concatenate([TORQUE, TORQUE])
    bounds = np.vstack([np.eye(6), -np.eye(6)])
    dynamic = constraint.SecondOrderConstraint(
        torque,
        lambda q: bounds,
        lambda q: both,
        1,
        discretization_scheme=constraint.DiscretizationType.Interpolation,
    )
    rate = constraint.JointVelocityConstraintVarying(
        lambda s: np.array([[-1.0, 1.0]]) * (SPEED / np.abs(speeds(np.clip(s, 0, 1))).max())
    )
    path = toppra.SplineInterpolator([0, 0.5, 1], [[0.0], [0.5], [1.0]])
    grid = np.linspace(0, 1, 401)
    solver = algorithm.TOPPRA(
        [dynamic, rate], path, gridpoints=grid, parametrizer="ParametrizeConstAccel"
    )
    found = solver.compute_trajectory(0, 0)
    assert found.duration == pytest.approx(fastest.duration, rel=0.01)


def test_appendix_b_keeps_its_limits_between_places_too(pollard, limits):
    timed = pollard_pin.time_path(pollard, pollard_pin.appendix_b(), limits)
    assert timed.within_limits
    assert timed.solved.use.points == 20
    assert 8.7 < timed.duration < 8.85
    time = np.linspace(0, timed.duration, 200_001)
    report = pollard_pin.trajectory_report(pollard, timed.path, samples=len(time))
    assert max(shares(report)) <= 1.01


def test_a_corner_is_stopped_at_and_told(pollard, limits):
    path = joined(
        [
            line([0.45, -0.1, 0, 0, 0, 0], [0.45, 0.1, 0, 0, 0, 0], 1.0),
            line([0.45, 0.1, 0, 0, 0, 0], [0.45, 0.1, 0.1, 0, 0, 0], 1.0),
        ]
    )
    timed = pollard_pin.time_path(pollard, path, limits)
    assert "the path has 1 corner, where the tool stops" in timed.path.notes
    inner = np.flatnonzero(timed.law.rate[1:-1] == 0.0)
    assert len(inner) == 1
    parts = [
        pollard_pin.time_path(
            pollard, line(path.at(a).pose[0], path.at(b).pose[0], 1.0), limits
        ).duration
        for a, b in ((0.0, 1.0), (1.0, 2.0))
    ]
    assert timed.duration == pytest.approx(sum(parts), rel=2e-3)
    with pytest.raises(TrajectoryError, match="corner"):
        pollard_pin.time_path(pollard, path, limits, law="constant-speed")


def test_pieces_that_go_on_in_one_direction_are_driven_through(pollard, limits):
    a, b, c = ([0.45, y, 0.0, 0.0, 0.0, 0.0] for y in (-0.1, 0.03, 0.1))
    whole = pollard_pin.time_path(pollard, line(a, c, 1.0), limits)
    parts = pollard_pin.time_path(pollard, joined([line(a, b, 2.0), line(b, c, 1.0)]), limits)
    assert parts.duration == pytest.approx(whole.duration, rel=2e-3)
    assert parts.law.rate[1:-1].min() > 0


def test_a_constant_speed_is_the_largest_that_the_report_allows(pollard, arch, limits):
    timed = pollard_pin.time_path(pollard, arch, limits, law="constant-speed")
    report = pollard_pin.trajectory_report(pollard, timed.path, samples=4001)
    np.testing.assert_allclose(report.tool_speed, timed.speed, rtol=1e-3)
    assert 0.995 <= max(shares(report)) <= 1.01
    assert timed.within_limits


def test_a_window_keeps_its_speed_on_the_share_of_the_way_that_was_asked_for(pollard, arch, limits):
    timed = pollard_pin.time_path(pollard, arch, limits, law="window", window=0.1, share=0.8)
    report = pollard_pin.trajectory_report(pollard, timed.path, samples=8001)
    speed, time = report.tool_speed, report.joints.time
    assert speed.max() <= timed.speed * 1.001
    way = (speed[1:] + speed[:-1]) / 2 * np.diff(time)
    slow = np.minimum(speed[1:], speed[:-1]) < timed.speed * 0.9
    assert way[~slow].sum() / way.sum() == pytest.approx(0.8, abs=0.01)
    assert max(shares(report)) <= 1.01


def test_the_law_of_least_load_takes_its_time_and_no_law_of_less_torque_does(
    pollard, arch, limits, fastest
):
    seconds = 1.4 * fastest.duration
    timed = pollard_pin.time_path(pollard, arch, limits, law="least-load", duration=seconds)
    assert timed.duration == pytest.approx(seconds, rel=1e-9)
    report = pollard_pin.trajectory_report(pollard, timed.path, samples=8001)
    share = shares(report)[0]
    assert share == pytest.approx(timed.largest_torque_share, rel=2e-3)
    assert share < 0.9
    less = pollard_pin.motor_limits(
        pollard.specification, torque=TORQUE * share * 0.99, speed=SPEED
    )
    assert pollard_pin.time_path(pollard, arch, less).duration > seconds


def test_forces_and_the_tool_s_acceleration_are_limited(pollard, arch):
    limits = pollard_pin.motor_limits(
        pollard.specification, torque=TORQUE, force=6.0, tool_acceleration=8.0, tool_speed=1.2
    )
    timed = pollard_pin.time_path(pollard, arch, limits)
    report = pollard_pin.trajectory_report(pollard, timed.path, samples=8001)
    uses = (
        report.loop_force_size.max() / 6.0,
        np.linalg.norm(report.motion.tool.acceleration, axis=1).max() / 8.0,
        report.tool_speed.max() / 1.2,
    )
    assert 0.99 <= max(uses) <= 1.01


def test_rotors_are_the_same_as_a_robot_with_them(pollard, arch):
    data = pollard.specification.model_dump()
    data["motors"] = {"rotor_inertia": 1e-5, "gear_ratio": 30.0}
    other = pollard_pin.load(pollard.specification.model_validate(data))
    own = pollard_pin.motor_limits(other.specification, torque=TORQUE)
    given = pollard_pin.motor_limits(pollard.specification, torque=TORQUE, rotor=9e-3)
    one = pollard_pin.time_path(other, arch, own).duration
    assert pollard_pin.time_path(pollard, arch, given).duration == pytest.approx(one, rel=1e-9)
    without = pollard_pin.motor_limits(pollard.specification, torque=TORQUE)
    light = pollard_pin.time_path(pollard, arch, without).duration
    assert one > 1.05 * light
    # What is given stands in place of the robot's own.
    for rotor, want in ((9e-3, one), (0.0, light)):
        instead = pollard_pin.motor_limits(other.specification, torque=TORQUE, rotor=rotor)
        found = pollard_pin.time_path(other, arch, instead).duration
        assert found == pytest.approx(want, rel=1e-9)


def test_motors_that_cannot_hold_the_robot_are_refused(pollard, arch):
    weak = pollard_pin.motor_limits(pollard.specification, torque=0.3)
    with pytest.raises(Infeasible, match="holding the robot still takes"):
        pollard_pin.time_path(pollard, arch, weak)


def test_a_path_out_of_reach_says_where_by_its_own_time(pollard):
    far = line([0.45, 0, 0, 0, 0, 0], [1.4, 0, 0, 0, 0, 0], 2.0)
    with pytest.raises(Unreachable, match="t = "):
        pollard_pin.time_path(pollard, far)


def test_a_course_of_another_robot_or_branch_is_refused(pollard, printed, arch):
    course = Course.of(pollard, arch)
    with pytest.raises(BadInput, match="another robot's"):
        pollard_pin.time_path(printed, course)
    other = next(one for one in pollard_pin.USEFUL_BRANCHES if one != course.branch)
    with pytest.raises(BadInput, match="another branch's"):
        pollard_pin.time_path(pollard, course, branch=other)
    assert pollard_pin.time_path(pollard, course).course is course


@pytest.mark.parametrize(
    ("options", "told"),
    [
        ({"law": "fastest", "duration": 2.0}, "duration belongs to the law 'least-load'"),
        ({"law": "least-load", "window": 0.1}, "window belongs to the law 'window'"),
        ({"law": "least-load"}, "needs a duration"),
        ({"law": "least-load", "duration": 0.2}, "at least 0.35"),
        ({"law": "soon"}, "soon"),
    ],
)
def test_what_does_not_belong_together_is_refused(pollard, arch, limits, options, told):
    with pytest.raises(BadInput, match=told):
        pollard_pin.time_path(pollard, arch, limits, **options)
