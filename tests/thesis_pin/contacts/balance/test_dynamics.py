"""Inverse dynamics on feet against statics, momentum, and forward dynamics of two engines."""

import mujoco
import numpy as np
import pinocchio as pin
import pytest
from standing_robots import FLOORS, ROBOTS, at_rest, random_pose, random_states, standing

import thesis_pin
from thesis_pin.contacts.balance.dynamics import foot_dynamics
from thesis_pin.contacts.floor import Floor
from thesis_pin.contacts.soles.foot import Foot
from thesis_pin.contacts.standing.placing import stand
from thesis_pin.errors import BadInput, UnknownName, WrongShape

SOLES = ("talos", "g1")


def shadow(floor, points):
    """Where points fall straight down on the floor."""
    down = np.array([0.0, 0.0, -1.0])
    return points + floor.above(points)[:, None] / -(floor.normal @ down) * down


def sum_about_origin(found):
    """Force and moment of all contact wrenches about the world's origin."""
    force = found.wrench[..., :3].sum(axis=1)
    arms = np.cross(found.stance.origin, found.wrench[..., :3])
    return np.concatenate([force, (found.wrench[..., 3:] + arms).sum(axis=1)], axis=1)


@pytest.mark.parametrize("floor", FLOORS.values(), ids=FLOORS)
@pytest.mark.parametrize("name", ROBOTS)
def test_forces_of_a_held_pose_are_the_weight_and_press_below_the_centre_of_mass(name, floor):
    robot, feet, _ = standing(name)
    rng = np.random.default_rng(1)
    q = np.array([random_pose(name, rng, floor) for _ in range(10)])
    found = foot_dynamics(robot, feet, q, floor=floor)
    data = robot.model.createData()
    com = np.array([pin.centerOfMass(robot.model, data, one) for one in q])
    weight = pin.computeTotalMass(robot.model) * 9.81
    assert np.allclose(found.wrench[..., :3].sum(axis=1), [0, 0, weight], atol=1e-9 * weight)
    assert np.allclose(found.zero_moment_point, shadow(floor, com), atol=1e-9)
    if name != "bolt":  # two points can't press beside their line
        assert np.allclose(found.centre_of_pressure, shadow(floor, com), atol=1e-9)
        assert np.abs(found.loops.base).max() < 1e-9 * weight
    inside = found.margin[found.level < 1e-9]
    assert (found.admissible[found.level < 1e-9] <= (inside > -1e-9)).all()


@pytest.mark.parametrize("floor", FLOORS.values(), ids=FLOORS)
@pytest.mark.parametrize("name", ROBOTS)
def test_newton_and_euler_close_over_the_whole_robot(name, floor):
    robot, feet, _ = standing(name)
    q, v, a = random_states(name, np.random.default_rng(2), 10, floor)
    found = foot_dynamics(robot, feet, q, v, a, floor=floor)
    data, mass = robot.model.createData(), pin.computeTotalMass(robot.model)
    for k in range(len(q)):
        pin.computeCentroidalMomentumTimeVariation(robot.model, data, q[k], v[k], a[k])
        com, rate = data.com[0], data.dhg.vector
        force = rate[:3] - mass * robot.model.gravity.linear
        expected = np.concatenate([force, rate[3:] + np.cross(com, force)])
        size = np.abs(expected).max()
        assert np.allclose(found.required[k], expected, rtol=0, atol=1e-9 * size)
        if name != "bolt":
            assert np.allclose(sum_about_origin(found)[k], expected, rtol=0, atol=1e-9 * size)


@pytest.mark.parametrize("name", ["talos", "anymal", "solo12", "g1"])
def test_forward_dynamics_with_torques_and_contact_forces_returns_the_accelerations(name):
    robot, feet, _ = standing(name)
    model, floor = robot.model, FLOORS["slope"]
    q, v, a = random_states(name, np.random.default_rng(3), 5, floor)
    found = foot_dynamics(robot, feet, q, v, a, floor=floor)
    data = model.createData()
    for k in range(len(q)):
        tau = np.zeros(model.nv)
        tau[robot.actuated] = found.torque[k]
        tau -= model.damping * v[k] + model.upperDryFrictionLimit * np.sign(v[k])
        pin.framesForwardKinematics(model, data, q[k])
        pushed = [pin.Force.Zero() for _ in range(model.njoints)]
        for j, foot in enumerate(feet):
            joint = model.frames[model.getFrameId(foot.frame)].parentJoint
            place = pin.SE3(np.eye(3), found.stance.origin[k, j])
            pushed[joint] += data.oMi[joint].actInv(place.act(pin.Force(found.wrench[k, j])))
        assert np.allclose(pin.aba(model, data, q[k], v[k], tau, pushed), a[k], rtol=0, atol=1e-8)


@pytest.mark.parametrize("name", SOLES)
def test_one_sole_carries_what_pinocchio_s_constrained_dynamics_gives_it(name):
    robot, feet, _ = standing(name)
    model, foot = robot.model, feet[0]
    rng = np.random.default_rng(4)
    frame = model.getFrameId(foot.frame)
    for _ in range(5):
        q = random_pose(name, rng, Floor())
        v, a = at_rest(robot, frame, q, rng)
        found = foot_dynamics(robot, feet, q, v, a, support=np.array([True, False]))
        assert found.freedoms[0] == 0
        tau = np.zeros(model.nv)
        tau[robot.actuated] = found.torque[0]
        tau -= model.damping * v + model.upperDryFrictionLimit * np.sign(v)
        info = model.frames[frame]
        held = pin.RigidConstraintModel(
            pin.ContactType.CONTACT_6D, model, info.parentJoint, info.placement, pin.LOCAL
        )
        data, constraint = model.createData(), held.createData()
        constraints, workings = pin.StdVec_RigidConstraintModel(), pin.StdVec_RigidConstraintData()
        constraints.append(held)
        workings.append(constraint)
        pin.initConstraintDynamics(model, data, constraints, workings)
        moved = pin.constraintDynamics(model, data, q, v, tau, constraints, workings)
        constraint = workings[0]
        assert np.allclose(moved, a, rtol=0, atol=1e-8)
        pin.framesForwardKinematics(model, data, q)
        place = pin.SE3(np.eye(3), found.stance.origin[0, 0])
        ours = data.oMf[frame].actInv(place.act(pin.Force(found.wrench[0, 0]))).vector
        theirs = constraint.contact_force.vector
        assert np.allclose(ours, theirs, rtol=0, atol=1e-8 * np.abs(theirs).max())


def as_mjcf(model):
    """A tree of hinges below a free root, written body by body from Pinocchio's numbers."""

    def numbers(values):
        return " ".join(repr(float(x)) for x in np.ravel(values))

    def body(joint):
        place, inertia = model.jointPlacements[joint], model.inertias[joint]
        turn = pin.Quaternion(place.rotation).coeffs()[[3, 0, 1, 2]]
        i = inertia.inertia
        full = [i[0, 0], i[1, 1], i[2, 2], i[0, 1], i[0, 2], i[1, 2]]
        moves = "<freejoint/>"
        if joint > 1:
            data = model.createData()
            pin.computeJointJacobians(model, data, pin.neutral(model))
            column = pin.getJointJacobian(model, data, joint, pin.LOCAL)
            axis = column[3:, model.joints[joint].idx_v]
            moves = f'<joint name="{model.names[joint]}" axis="{numbers(axis)}"/>'
        inside = "".join(
            body(k) for k in range(joint + 1, model.njoints) if model.parents[k] == joint
        )
        return (
            f'<body name="b{joint}" pos="{numbers(place.translation)}" quat="{numbers(turn)}">'
            f'{moves}<inertial pos="{numbers(inertia.lever)}" mass="{inertia.mass!r}" '
            f'fullinertia="{numbers(full)}"/>{inside}</body>'
        )

    return (
        '<mujoco><compiler boundmass="0" balanceinertia="false"/>'
        f'<option gravity="0 0 -9.81"/><worldbody>{body(1)}</worldbody></mujoco>'
    )


@pytest.mark.parametrize("name", ["anymal", "solo12", "talos", "g1"])
def test_mujoco_with_the_forces_for_contacts_moves_as_it_was_asked(name):
    robot, feet, _ = standing(name)
    model = robot.model
    engine = mujoco.MjModel.from_xml_string(as_mjcf(model))
    state = mujoco.MjData(engine)
    q, v, a = random_states(name, np.random.default_rng(5), 5, Floor())
    found = foot_dynamics(robot, feet, q, v, a)
    places = [engine.joint(n).dofadr[0] for n in list(model.names)[2:]]
    for k in range(len(q)):
        turn = pin.Quaternion(*q[k][[6, 3, 4, 5]]).toRotationMatrix()
        state.qpos[:7] = q[k][[0, 1, 2, 6, 3, 4, 5]]
        state.qvel[:6] = [*(turn @ v[k][:3]), *v[k][3:6]]
        state.qfrc_applied[:], state.xfrc_applied[:] = 0.0, 0.0
        for joint, dof in zip(range(2, model.njoints), places, strict=True):
            info = model.joints[joint]
            state.qpos[dof + 1], state.qvel[dof] = q[k][info.idx_q], v[k][info.idx_v]
        resisted = model.damping * v[k] + model.upperDryFrictionLimit * np.sign(v[k])
        for motor, name_of in enumerate(robot.actuators):
            at = robot.actuated[motor]
            state.qfrc_applied[engine.joint(name_of).dofadr[0]] = (
                found.torque[k, motor] - resisted[at]
            )
        mujoco.mj_kinematics(engine, state)
        mujoco.mj_comPos(engine, state)
        for j, foot in enumerate(feet):
            joint = model.frames[model.getFrameId(foot.frame)].parentJoint
            number = engine.body(f"b{joint}").id
            force, moment = found.wrench[k, j, :3], found.wrench[k, j, 3:]
            arm = found.stance.origin[k, j] - state.xipos[number]
            state.xfrc_applied[number] += [*force, *(moment + np.cross(arm, force))]
        mujoco.mj_forward(engine, state)
        linear = turn @ (a[k][:3] + np.cross(v[k][3:6], v[k][:3]))
        assert np.allclose(state.qacc[:3], linear, rtol=0, atol=1e-8)
        assert np.allclose(state.qacc[3:6], a[k][3:6], rtol=0, atol=1e-8)
        order = [model.joints[joint].idx_v for joint in range(2, model.njoints)]
        assert np.allclose(state.qacc[places], a[k][order], rtol=0, atol=1e-8)


def test_damping_friction_and_armature_of_the_description_count():
    robot, feet, _ = standing("talos")
    model = robot.model
    assert model.damping[6:].any() or model.upperDryFrictionLimit[6:].any()
    q, v, a = random_states("talos", np.random.default_rng(6), 1, Floor())
    one = np.array([True, False])
    with_losses = foot_dynamics(robot, feet, q, v, a, support=one)
    at_rest_of_friction = foot_dynamics(
        robot, feet, q, v, a, support=one, sliding=np.zeros(model.nv)
    )
    lost = with_losses.torque - at_rest_of_friction.torque
    expected = model.upperDryFrictionLimit * np.sign(v[0])
    assert np.allclose(lost[0], expected[robot.actuated], rtol=0, atol=1e-9)
    assert np.allclose(with_losses.wrench, at_rest_of_friction.wrench, rtol=0, atol=1e-9)
    geared = thesis_pin.load(f"example:{ROBOTS['talos']}", root_joint=pin.JointModelFreeFlyer())
    armature = np.array(geared.model.armature)
    armature[6:] += 0.1
    geared.model.armature = armature
    heavier = foot_dynamics(geared, feet, q, v, a, support=one)
    more = heavier.torque - with_losses.torque
    assert np.allclose(more[0], 0.1 * a[0][robot.actuated], rtol=0, atol=1e-9)


def test_heel_and_toe_on_one_frame_carry_what_an_edge_between_them_does():
    robot, feet, pose = standing("talos")
    ends = np.array([[0.1, 0.0], [-0.08, 0.0]])
    edges, points = [], []
    for foot in feet:
        edges.append(Foot.of(foot.frame, ends, placement=foot.placement))
        for end, word in zip(ends, ("toe", "heel"), strict=True):
            place = foot.placement.copy()
            place[:3, 3] += place[:3, :2] @ end
            points.append(Foot.of(foot.frame, name=f"{foot.name}_{word}", placement=place))
    q = stand(robot, edges, pose).q
    whole, parts = foot_dynamics(robot, edges, q), foot_dynamics(robot, points, q)
    assert np.allclose(parts.torque, whole.torque, rtol=0, atol=1e-9)
    assert np.allclose(sum_about_origin(parts), sum_about_origin(whole), rtol=0, atol=1e-9)
    assert np.allclose(parts.loops.base, whole.loops.base, rtol=0, atol=1e-9)
    assert (parts.normal_force > 1.0).all()


def test_one_sole_on_a_slope_uses_the_tangent_of_its_friction_and_lies_as_far_off_as_it_is_long():
    robot, feet, pose = standing("talos")
    floor, angle = Floor(slope=np.radians(10)), np.radians(10)
    one = np.array([True, False])
    found = foot_dynamics(robot, feet, stand(robot, feet, pose, floor).q, floor=floor, support=one)
    assert found.friction_used[0, 0] == pytest.approx(np.tan(angle) / feet[0].friction, rel=1e-9)
    assert np.isnan(found.friction_used[0, 1])
    level = foot_dynamics(robot, feet, stand(robot, feet, pose).q, floor=floor, support=one)
    assert level.level[0] == pytest.approx(0.21 * np.sin(angle), abs=1e-6)  # its sole's length


def test_a_stack_gives_what_each_sample_gives_alone():
    robot, feet, _ = standing("anymal")
    q, v, a = random_states("anymal", np.random.default_rng(7), 4, Floor())
    support = np.array([[1, 1, 1, 1], [1, 0, 0, 1], [1, 1, 1, 0], [0, 0, 0, 0]], dtype=bool)
    whole = foot_dynamics(robot, feet, q, v, a, support=support)
    for k in range(4):
        one = foot_dynamics(robot, feet, q[k], v[k], a[k], support=support[k])
        assert np.allclose(one.torque[0], whole.torque[k], rtol=0, atol=1e-9)
        assert np.allclose(one.violation[0], whole.violation[k], rtol=0, atol=1e-9)
    assert not whole.wrench[3].any()
    assert whole.violation[3] > 1.0


def test_feet_and_robots_that_make_no_sense_are_refused():
    robot, feet, pose = standing("bolt")
    with pytest.raises(BadInput, match="two feet are called"):
        foot_dynamics(robot, [feet[0], feet[0]], pose)
    with pytest.raises(BadInput, match="no foot"):
        foot_dynamics(robot, [], pose)
    with pytest.raises(UnknownName, match="FL_FOOD"):
        foot_dynamics(robot, [Foot.of("FL_FOOD")], pose)
    with pytest.raises(UnknownName, match="torque"):
        foot_dynamics(robot, feet, pose, sharing="fair")
    with pytest.raises(WrongShape, match="support"):
        foot_dynamics(robot, feet, pose, support=[True, True, True])
    tied = thesis_pin.load("example:bolt")
    with pytest.raises(BadInput, match="tied to the world"):
        foot_dynamics(tied, feet, tied.q0)
