"""Limits of planned samples and their derivatives."""

from dataclasses import fields, replace

import numpy as np
import pytest

from scout_pin.dynamics.inverse import inverse_dynamics
from scout_pin.dynamics.stability import momentum, support_margin, zero_moment_point
from scout_pin.kinematics.branches import taken_branches
from scout_pin.motion.gait import GaitMotion
from scout_pin.motion.trajectory import joint_trajectory
from scout_pin.specification import SIDES
from scout_pin.study.plan.footing import Footing
from scout_pin.study.plan.samples import Quantities, Sampler
from scout_pin.study.plan.sampling.jets import Heading, torso_motion
from scout_pin.study.plan.sampling.reach import STRAIGHT, soft_angles, softened
from scout_pin.study.plan.sampling.sharing import _binding
from thesis_pin.errors import BadInput, SingularPose, TrajectoryError
from thesis_pin.numeric.rotations import rotation
from thesis_pin.numeric.trajectory import BodyMotion

NAMES = [one.name for one in fields(Quantities)]
COUNT = 48
DOUBLE, LEFT, RIGHT = slice(0, 16), slice(16, 32), slice(32, 48)
STEPS = np.repeat([1e-7, 1e-5, 1e-4], 6)


def foot(rng, robot, side, swinging):
    """A sole on the floor beside the torso, or in a random motion above it."""
    neutral = robot.neutral_feet()[side]
    still = np.zeros((COUNT, 3))
    position, velocity, acceleration, omega, alpha = (still.copy() for _ in range(5))
    position[:, :2] = 0.8 * neutral[0, 3], neutral[1, 3]
    size = swinging.sum()
    position[swinging] += rng.uniform([-0.01, -0.01, 0.005], [0.01, 0.01, 0.025], (size, 3))
    velocity[swinging], acceleration[swinging] = rng.normal(0.0, [[[0.1]], [[0.5]]], (2, size, 3))
    omega[swinging], alpha[swinging] = rng.normal(0.0, [[[0.2]], [[1.0]]], (2, size, 3))
    turn = np.where(swinging, rng.uniform(-0.05, 0.05, COUNT), 0.0)
    return BodyMotion(rotation("x", turn), position, velocity, acceleration, omega, alpha)


@pytest.fixture
def scene(biped, rng):
    """Random jets of a torso over feet of which both, the left or the right one stand."""
    support = np.ones((COUNT, 2), dtype=bool)
    support[LEFT, 1] = support[RIGHT, 0] = False
    feet = tuple(foot(rng, biped, side, ~support[:, k]) for k, side in enumerate(SIDES))
    height = -biped.neutral_feet()["left"][2, 3]
    jets = np.zeros((COUNT, 18))
    jets[:, 2] = 0.96 * height
    jets[:, :3] += rng.uniform(-0.005, 0.005, (COUNT, 3))
    jets[:, 3:6] = rng.uniform(-0.08, 0.08, (COUNT, 3))
    jets[:, 6:12] = rng.normal(0.0, 0.1, (COUNT, 6))
    jets[:, 12:] = rng.normal(0.0, [3.0, 3.0, 1.0, 8.0, 8.0, 8.0], (COUNT, 6))
    torso = torso_motion(jets[:1]).placement[0]
    theta = biped.inverse_kinematics(torso, *(one.placement[0] for one in feet))
    branches = tuple(
        int(taken_branches(biped.legs[side], theta[None, 6 * k : 6 * k + 6])[0])
        for k, side in enumerate(SIDES)
    )
    return Sampler(biped, branches), jets, Footing.of(biped, feet, support)


def differences(sampler, jets, footing, heading=None):
    """Central differences of all quantities, and the values."""
    slopes = {name: [] for name in NAMES}
    for k, step in enumerate(STEPS):
        ends = [jets.copy(), jets.copy()]
        ends[0][:, k] += step
        ends[1][:, k] -= step
        more, less = (sampler(one, footing, slopes=False, heading=heading) for one in ends)
        for name in NAMES:
            with np.errstate(invalid="ignore"):  # ∞ − ∞ where there is no edge
                change = (getattr(more, name).value - getattr(less, name).value) / (2 * step)
            slopes[name].append(np.nan_to_num(change))
    return {name: np.stack(parts, axis=-1) for name, parts in slopes.items()}


def agree(sampler, jets, footing, but=(), heading=None):
    """Slopes of all quantities, but of ``contact`` at some samples."""
    found = sampler(jets, footing, heading=heading)
    expected = differences(sampler, jets, footing, heading)
    for name in NAMES:
        ours, other = getattr(found, name).slope, expected[name]
        if name == "contact":  # facets in any order
            some = np.setdiff1d(np.arange(COUNT), but)
            ours, other = np.sort(ours[some], axis=1), np.sort(other[some], axis=1)
        largest = np.abs(other).max(axis=(0, 1)) + 1e-9
        assert (np.abs(ours - other) <= 1e-6 * largest).all(), name
    return found


def test_slopes_are_those_of_finite_differences(scene):
    sampler, jets, footing = scene
    found = agree(sampler, jets, footing)
    assert (np.abs(found.knee.value) < STRAIGHT).all()
    here = sampler.state(jets, footing)
    bound = _binding(sampler.robot, here, np.arange(16))[1].sum(axis=1)
    assert min(bound) == 0, "wrenches inside both cones"
    assert max(bound) > 0, "and on a border"


def test_slopes_by_angles_that_count_from_a_turning_heading_are_those_of_differences(scene, rng):
    sampler, jets, footing = scene
    heading = Heading(rng.uniform(-0.05, 0.05, COUNT), 0.7)
    agree(sampler, jets, footing, heading=heading)
    straight = sampler(jets, footing, slopes=False).torque.value
    turning = sampler(jets, footing, slopes=False, heading=heading).torque.value
    assert np.abs(straight - turning).max() > 1e-3


def test_a_torso_whose_heading_turns_moves_as_its_turned_angles(rng):
    """Against SciPy's rotations, differenced twice."""
    from scipy.spatial.transform import Rotation

    angles = rng.uniform(-0.3, 0.3, (3, 3))  # of 1, t, t²
    rate, h = 0.8, 1e-3

    def turned(t):
        own = Rotation.from_euler("XYZ", angles[0] + angles[1] * t + angles[2] * t**2)
        return Rotation.from_euler("z", 0.4 + rate * t) * own

    jets = np.zeros((1, 18))
    jets[0, 3:6], jets[0, 9:12], jets[0, 15:18] = angles[0], angles[1], 2 * angles[2]
    found = torso_motion(jets, Heading(np.array([0.4]), rate))
    np.testing.assert_allclose(found.rotation[0], turned(0.0).as_matrix(), atol=1e-12)
    spins = [(turned(t + h / 2) * turned(t - h / 2).inv()).as_rotvec() / h for t in (-h, 0.0, h)]
    np.testing.assert_allclose(found.omega[0], spins[1], atol=1e-6)
    np.testing.assert_allclose(found.alpha[0], (spins[2] - spins[0]) / (2 * h), atol=1e-5)


def test_slopes_where_no_wrenches_are_admissible_are_those_of_finite_differences(scene):
    sampler, jets, footing = scene
    jets[DOUBLE, 12] = 15.0  # far outside the soles
    found = agree(sampler, jets, footing)
    violation = sampler.state(jets, footing).dynamics.double_violation[DOUBLE]
    assert (violation > 0.0).all()
    contact = sampler.robot.contacts[0]
    np.testing.assert_allclose(
        found.contact.value[DOUBLE, 0], violation / (sampler.weight * contact.length)
    )


def test_slopes_beyond_reach_are_those_of_finite_differences(scene):
    sampler, jets, footing = scene
    jets[::5, 2] *= 1.12
    # What two soles miss is measured as if both stayed where the softened legs have them.
    found = agree(sampler, jets, footing, but=np.arange(COUNT)[DOUBLE][::5])
    assert (found.knee.value[::5] > 1.0).any()
    for name in NAMES:
        assert np.isfinite(getattr(found, name).slope).all(), name


def test_quantities_are_those_of_the_judge(scene):
    sampler, jets, footing = scene
    robot, time = sampler.robot, np.zeros(COUNT)
    torso = torso_motion(jets)
    motion = GaitMotion(time, time, footing.support, torso, *footing.feet)
    joints = joint_trajectory(robot, motion)
    dynamics = inverse_dynamics(robot, motion)
    found = sampler(jets, footing, slopes=False)
    np.testing.assert_allclose(found.angle.value, joints.q, atol=1e-12)
    np.testing.assert_allclose(found.rate.value, joints.v, atol=1e-11)
    np.testing.assert_allclose(found.torque.value, dynamics.torque, atol=1e-11)
    np.testing.assert_allclose(found.knee.value, np.cos(joints.q[:, [3, 9]] + _knee_zero(robot)))
    share = np.abs(dynamics.torque) / robot.stall_torque + np.abs(joints.v) / robot.no_load_speed
    np.testing.assert_allclose(found.line(robot).value, share, atol=1e-11)
    # The zero-moment point of the bodies' momentum, by Pinocchio.
    state = sampler.state(jets, footing)
    com, rate = momentum(robot, *state.pinocchio())
    zmp = zero_moment_point(robot.mass, com, rate)
    margin = support_margin(robot, motion, zmp)
    inside = margin > 0.0
    assert inside.any()
    np.testing.assert_allclose(found.margin[inside], margin[inside], atol=1e-12)
    # Outside it is that of the edges' lines, and no farther than the polygon.
    assert (found.margin[~inside] < 0.0).all()
    assert (found.margin[~inside] >= margin[~inside] - 1e-12).all()
    np.testing.assert_allclose(found.force.value[:, 0], 1 + rate[:, 2] / sampler.weight)
    for k, alone in ((0, LEFT), (1, RIGHT)):
        contact = robot.contacts[k]
        unit = sampler.weight * contact.length
        margin = contact.margin(dynamics.sole_wrench[alone, k]) / unit
        np.testing.assert_allclose(found.contact.value[alone].max(axis=1), -margin, atol=1e-12)
    assert (found.contact.value[DOUBLE] == -1.0).all()


def test_samples_have_the_slopes_that_each_has_alone(scene):
    sampler, jets, footing = scene
    jets[:8, 12:14] *= 2.0
    found = sampler(jets, footing)
    here = sampler.state(jets, footing)
    assert len(set(_binding(sampler.robot, here, np.arange(16))[1].sum(axis=1).tolist())) > 2
    for k in range(COUNT):
        some = slice(k, k + 1)
        alone = Sampler(sampler.robot, sampler.branches)(jets[some], footing.part(some))
        for name in NAMES:
            ours, other = getattr(found, name).slope[some], getattr(alone, name).slope
            np.testing.assert_allclose(ours, other, atol=1e-10 * np.abs(other).max(), err_msg=name)


def test_what_was_evaluated_before_changes_nothing(scene):
    sampler, jets, footing = scene

    def as_anew(footing):
        fresh = Sampler(sampler.robot, sampler.branches).state(jets, footing)
        found = sampler.state(jets, footing)
        for ours, other in zip(found.pinocchio(), fresh.pinocchio(), strict=True):
            assert (ours == other).all()
        assert (found.dynamics.torque == fresh.dynamics.torque).all()

    as_anew(footing)
    jets[20, 1] += 1e-9  # in place: the array is the same one
    as_anew(footing)
    support = footing.support.copy()
    support[3] = True, False
    as_anew(replace(footing, support=support))
    for name in ("position", "velocity", "acceleration"):
        value = getattr(footing.feet[1], name).copy()
        value[25] += 1e-3
        as_anew(replace(footing, feet=(footing.feet[0], replace(footing.feet[1], **{name: value}))))


def _knee_zero(robot):
    return [robot.legs[side].beta[3] for side in SIDES]


def test_soft_angles_reach_where_legs_do_and_go_on_smoothly_beyond(scout):
    leg = scout.legs["left"]
    place = scout.leg_forward_kinematics("left", np.radians([0.0, 2.0, 20.0, -48.0, 20.0, 0.0]))
    down = np.linspace(-0.005, 0.012, 18)
    poses = np.tile(place, (len(down), 1, 1))
    poses[:, 2, 3] -= down
    theta, asked = soft_angles(leg, poses.reshape(-1, 16).T[:12], 0)
    reached = scout.leg_forward_kinematics("left", theta)
    exact = np.abs(asked) <= STRAIGHT
    assert exact.any()
    assert (asked > 1.0).any()
    np.testing.assert_allclose(reached[exact], poses[exact], atol=1e-12)
    short = np.linalg.norm(reached[:, :3, 3] - poses[:, :3, 3], axis=1)
    assert (np.diff(short[~exact]) > 0.0).all()
    assert np.cos(theta[:, 3] + leg.beta[3]).max() < 0.9901


def test_softened_cosines_have_two_derivatives():
    step = 1e-6
    for sign in (1.0, -1.0):
        at = sign * (STRAIGHT + step * np.arange(-2, 3))
        values = softened(at)
        rates = np.diff(values) / step * sign
        np.testing.assert_allclose(rates, 1.0, atol=1e-5)
        np.testing.assert_allclose(np.diff(rates) / step, 0.0, atol=0.2)
    far = softened(np.array([-5.0, 0.3, 5.0]))
    assert far[1] == 0.3
    assert (np.abs(far) < 1.0).all()


def test_a_sampler_says_what_it_cannot_use(scene):
    sampler, jets, footing = scene
    with pytest.raises(BadInput, match="jets"):
        sampler(jets[:-1], footing)
    with pytest.raises(TrajectoryError, match="no foot is in support"):
        Footing.of(sampler.robot, footing.feet, np.zeros((COUNT, 2)))
    with pytest.raises(BadInput, match="support"):
        Footing.of(sampler.robot, footing.feet, np.ones((3, 2)))


def test_hip_roll_singularities_are_refused(scout, scene):
    sampler, _, footing = scene
    if sampler.robot is not scout:
        pytest.skip("the pose is Scout's")
    q = np.zeros(12)
    q[1] = -scout.legs["left"].beta[1] + 1e-10  # sin γ2 = 0
    torso = np.eye(4)
    feet = scout.forward_kinematics(q, torso)
    still = np.zeros((1, 3))
    soles = tuple(
        BodyMotion(feet[side][None, :3, :3], feet[side][None, :3, 3], still, still, still, still)
        for side in SIDES
    )
    moving = np.zeros((1, 18))
    moving[0, 6] = 0.1
    with pytest.raises(SingularPose, match="hip roll"):
        sampler(moving, replace(footing.part(slice(1)), feet=soles))
