"""Placements judged in one stack: what a report on each of them says, and laws of symmetry."""

import itertools

import numpy as np
import pytest

import pollard_pin
from pollard_pin.kinematics.geometry import USEFUL_BRANCHES, Branch
from pollard_pin.motion.curves import line
from pollard_pin.motion.placing import Placement, place_path
from pollard_pin.report.document import trajectory_report
from pollard_pin.study.placement.judged import (
    ACTUATION,
    FOLLOWED,
    LIMITS,
    NEAREST,
    OUT,
    SERIAL,
    SPEED,
    TORQUE,
    WEIGHT,
    arms_cross,
)
from pollard_pin.study.placement.judging import Judge
from pollard_pin.study.placement.limits import with_limits
from pollard_pin.study.placement.pacing import played
from thesis_pin.errors import SingularPose, Unreachable

DEFAULT = pollard_pin.DEFAULT_BRANCH
SAMPLES = 101


@pytest.fixture(scope="module")
def curve():
    """Appendix B as it is printed."""
    return pollard_pin.appendix_b(placement=[0.0, 0.0, 0.0])


@pytest.fixture(scope="module")
def nod():
    """A path along no axis whose tool turns about all of them."""
    return line([0.42, -0.08, 0.02, 0.2, -0.1, 0.3], [0.5, 0.1, 0.1, -0.1, 0.3, -0.2], 1.5)


def grid(*axes):
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)


def reported(robot, path, **asked):
    """The reason that a report's error stands for, or the report itself."""
    try:
        report = trajectory_report(robot, path, **asked)
    except Unreachable as error:
        return (LIMITS if "leaves its limits" in str(error) else OUT), None
    except SingularPose as error:
        return (ACTUATION if "actuation" in str(error) else SERIAL), None
    return (FOLLOWED if report.within_limits else TORQUE), report


def test_every_placement_is_judged_as_a_report_on_it_would(pollard, curve):
    places = grid(np.linspace(0.3, 0.6, 4), [0.0, 0.1], np.linspace(-0.15, 0.2, 4))
    found = Judge.of(pollard, curve, 401).positions(Placement(), DEFAULT, places)
    reasons = set()
    for k, place in enumerate(places):
        reason, report = reported(pollard, place_path(curve, Placement.of(place)), samples=401)
        assert found.reason[k] == reason, place
        if report is None:
            assert np.isnan(found.margin[k])
        else:
            peaks = np.abs(report.torque).max(axis=0), np.abs(report.speed).max(axis=0)
            np.testing.assert_allclose(found.torque[k], peaks[0], rtol=1e-9, atol=1e-14)
            np.testing.assert_allclose(found.speed[k], peaks[1], rtol=1e-9, atol=1e-14)
            assert found.condition[k] == pytest.approx(report.holding.condition.max(), rel=1e-9)
            assert found.margin[k] == pytest.approx(report.solutions.margin.min(), abs=1e-12)
        reasons.add(int(found.reason[k]))
    assert {FOLLOWED, OUT, ACTUATION, TORQUE} <= reasons


def test_turned_and_mirrored_placements_too_on_every_branch(pollard, nod):
    judge = Judge.of(pollard, nod, SAMPLES)
    count = 0
    for branch, turn, mirrored in itertools.product(
        USEFUL_BRANCHES[::3], (0.0, 0.6, -1.1), (False, True)
    ):
        placement = Placement((0.02, 0.01, 0.03), turn, mirrored)
        found = judge.placements([placement], branch)
        path = place_path(nod, placement)
        reason, report = reported(pollard, path, samples=SAMPLES, branch=branch)
        assert found.reason[0] == reason
        if report is not None:
            count += 1
            np.testing.assert_allclose(
                found.torque[0], np.abs(report.torque).max(axis=0), rtol=1e-8, atol=1e-13
            )
    assert count > 10


def symmetric():
    """The thesis's robot with a forearm whose inertia has the plane y = 0 for a mirror."""
    data = pollard_pin.Specification.read().model_dump()
    (forearm,) = data["assumptions"]["replaced_inertias"]
    forearm["inertia"] = np.diag([199.423e-6, 4567e-6, 4567e-6]).tolist()
    return pollard_pin.load(pollard_pin.Specification.model_validate(data))


def mirrored_branch(branch):
    """Chains 1 and 2 in each other's place; what turned to the left turns to the right."""
    e0, f0, w, e1, f1, e2, f2 = branch
    return Branch(e0, f0, w, -e2, f2, -e1, f1)


@pytest.mark.parametrize("branch", [DEFAULT, Branch(-1, 1, 1, -1, 1, -1, 1)])
def test_the_mirror_image_asks_the_same_of_the_robots_other_side(nod, branch):
    robot = symmetric()
    judge = Judge.of(robot, nod, SAMPLES)
    here = Placement((0.01, 0.03, 0.02), 0.3)
    middle = judge.about[1]
    there = Placement((0.01, -0.03 - 2 * middle, 0.02), -0.3, True)
    one, other = (
        judge.placements([place], label)
        for place, label in ((here, branch), (there, mirrored_branch(branch)))
    )
    assert one.reason[0] == other.reason[0] == FOLLOWED
    swapped = [0, 2, 1, 3, 4, 5]
    np.testing.assert_allclose(other.torque[0][swapped], one.torque[0], rtol=1e-9, atol=1e-13)
    for name in ("condition", "margin", "clearance"):
        np.testing.assert_allclose(getattr(other, name), getattr(one, name), rtol=1e-9)


@pytest.mark.parametrize(("place", "nearest"), [((0.0, 0.0, 0.0), 4), ((-0.1, 0.0, -0.1), 7)])
def test_the_clearance_is_the_least_sine_of_the_sets_that_it_names(pollard, nod, place, nearest):
    found = Judge.of(pollard, nod, SAMPLES).placements([Placement(place)], DEFAULT)
    whole = nod.sample(SAMPLES).pose
    whole[:, :3] += place
    angles = pollard.inverse_kinematics(whole, DEFAULT).angles
    sines = np.abs(pollard.posture(angles).serial_sines).min(axis=0)
    # The volume of the base motors' directions, by singular values of unit rows from differences.
    step, pose = 1e-6, whole
    rows = np.empty((SAMPLES, 3, 3))
    for axis in range(3):  # the tool doesn't turn, so the tip moves as the wrist does
        ends = []
        for sign in (1, -1):
            moved = pose.copy()
            moved[:, axis] += sign * step
            ends.append(pollard.inverse_kinematics(moved, DEFAULT).angles[:, [0, 6, 9]])
        rows[:, :, axis] = (ends[0] - ends[1]) / (2 * step)
    unit = rows / np.linalg.norm(rows, axis=-1, keepdims=True)
    volume = np.linalg.svd(unit, compute_uv=False).prod(axis=-1).min()
    want = [*sines, volume]
    assert found.clearance[0] == pytest.approx(min(want), rel=1e-6)
    assert NEAREST[found.nearest[0]] == NEAREST[int(np.argmin(want))] == NEAREST[nearest]


def test_a_leap_by_a_turn_is_no_break_and_a_wrist_that_turns_over_is(pollard):
    rolling = line([0.45, 0.02, 0.05, 0.2, 0.1, -2.0], [0.46, 0.05, 0.06, 0.2, 0.1, 0.5], 2.0)
    angles = pollard.inverse_kinematics(rolling.sample(SAMPLES).pose, DEFAULT).angles
    assert np.abs(np.diff(angles, axis=0)).max() > 6.0  # θ1615 passes 180°
    assert Judge.of(pollard, rolling, SAMPLES).placements([Placement()], DEFAULT).reason[0] == 0
    # In the plane y = 0 the wrist is straight for an instant, between two samples.
    pitching = line([0.45, 0, 0, 0.9, 0, 0], [0.45, 0, 0.01, -1.0, 0, 0], 2.0)
    with pytest.raises(SingularPose):
        trajectory_report(pollard, pitching, samples=SAMPLES)
    found = Judge.of(pollard, pitching, SAMPLES).placements([Placement()], DEFAULT)
    assert found.reason[0] == SERIAL


@pytest.mark.parametrize(
    ("torque", "speed"),
    [([2.0, 1.5, 1.5, 0.05, 0.05, 0.01], 4.0), ([1.2, 0.8, 0.8, 0.05, 0.05, 0.01], 100.0)],
    ids=["speed binds", "torque binds"],
)
def test_the_pace_is_the_fastest_that_a_report_allows(pollard, nod, torque, speed):
    limits = with_limits(pollard, torque, speed)
    found = Judge.of(limits, nod, SAMPLES, paces=True).placements([Placement()], DEFAULT)
    pace = float(found.pace[0])
    assert found.reason[0] == FOLLOWED
    just, beyond = (
        trajectory_report(limits, played(nod, pace * more), samples=SAMPLES)
        for more in (0.9999, 1.0001)
    )
    assert just.within_limits
    assert not beyond.within_limits
    use = just.motor_use
    largest, other = use.speed.max(), use.torque.max()
    if speed > 10:
        largest, other = other, largest
    assert largest == pytest.approx(1.0, abs=5e-4)
    assert other < 0.99


def test_what_the_motors_cannot_do_is_named(pollard, curve):
    place = np.array([[0.45, 0.0, 0.0]])

    def reason(torque=None, speed=None, **asked):
        weak = with_limits(pollard, torque, speed)
        found = Judge.of(weak, curve, SAMPLES, **asked).positions(Placement(), DEFAULT, place)
        assert np.isfinite(found.torque).all()
        return found.reason[0]

    assert reason() == FOLLOWED
    assert reason(torque=1.0) == TORQUE
    assert reason(speed=1.0) == SPEED
    assert reason(torque=0.1, paces=True) == WEIGHT


def test_a_hundredth_beyond_a_limit_is_beyond_it_and_a_hundredth_below_is_not(pollard, nod):
    """Of each motor's torque and speed, as the report's peaks have them."""
    report = trajectory_report(pollard, nod, samples=SAMPLES)
    effort, velocity = pollard.specification.assumptions.joint_limits.of_motors()
    peaks = np.abs(report.torque).max(axis=0), np.abs(report.speed).max(axis=0)
    for which, (peak, reason) in enumerate(zip(peaks, (TORQUE, SPEED), strict=True)):
        for motor in np.flatnonzero(peak > 1e-6):
            for share, want in ((1.01, FOLLOWED), (0.99, reason)):
                limits = [effort.copy(), velocity.copy()]
                limits[which][motor] = share * peak[motor]
                robot = with_limits(pollard, *(one.tolist() for one in limits))
                judge = Judge.of(robot, nod, SAMPLES)
                assert judge.placements([Placement()], DEFAULT).reason[0] == want


def test_arms_that_cross_are_seen_from_above(pollard):
    """Segments against each other, with SciPy's nearest points."""
    from scipy.optimize import lsq_linear

    rng = np.random.default_rng(7)
    q = rng.uniform(-np.pi, np.pi, (200, 12))
    found = arms_cross(pollard.geometry, q)
    for k in range(len(q)):
        bases = [np.array([0.0, y]) for y in pollard.geometry.y_10]
        arms = [
            length * np.array([np.cos(q[k, joint]), np.sin(q[k, joint])])
            for length, joint in zip(pollard.geometry.x_43, (6, 9), strict=True)
        ]
        matrix = np.stack([arms[0], -arms[1]], axis=1)
        gap = lsq_linear(matrix, bases[1] - bases[0], (0.0, 1.0), tol=1e-14).cost
        assert found[k] == (gap < 1e-12)
    assert 0.1 < found.mean() < 0.9


def test_played_paths_keep_their_way_and_what_samples_leave_open(pollard, tmp_path):
    time = np.linspace(0.0, 2.0, 51)
    rows = [f"{t:.2f},{0.45 + 0.02 * np.sin(3 * t):.4f},0.0100,0,0,0,0" for t in time]
    text = "\n".join(["t,x,y,z,psi,theta,phi", *rows]) + "\n"
    (tmp_path / "slow.csv").write_text(text)
    slow = pollard_pin.load_path(tmp_path / "slow.csv")
    fast = played(slow, 2.0)
    assert fast.duration == 1.0
    at = np.linspace(0.05, 0.95, 10)
    step = 1e-5
    one, here, other = (fast.variants.others(at + k * step) for k in (-1, 0, 1))
    np.testing.assert_allclose(here.position, slow.variants.others(2 * at).position, atol=1e-13)
    np.testing.assert_allclose(
        here.velocity, (other.position - one.position) / (2 * step), atol=1e-7
    )
    np.testing.assert_allclose(
        here.acceleration, (other.velocity - one.velocity) / (2 * step), atol=1e-5
    )
    tool = fast.at(at).tool
    np.testing.assert_allclose(tool.acceleration, 4 * slow.at(2 * at).tool.acceleration, atol=1e-12)
