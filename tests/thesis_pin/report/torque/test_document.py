"""Torques of any robot, held against balances of power and wrenches worked out by hand."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest

import pollard_pin
from thesis_pin.errors import UnknownName, WrongShape
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.joints import singles
from thesis_pin.loops.loading import load
from thesis_pin.loops.motion.files import JointMotion, read_motion
from thesis_pin.model.mechanism.supplement import Motor
from thesis_pin.report.torque.curves import unexplained
from thesis_pin.report.torque.document import torque_report
from thesis_pin.report.torque.figures import figures
from thesis_pin.report.torque.held import held_note
from thesis_pin.report.writers import csv_bytes, json_bytes

ROOT = Path(__file__).parents[4]
DATA = ROOT / "tests" / "thesis_pin" / "loops" / "data"
TIME = np.linspace(0, 1, 201)
ARM = """<robot name="arm"><link name="base"/>
<link name="rod"><inertial><origin xyz="0.5 0 0"/><mass value="2"/>
<inertia ixx="0.01" iyy="0.2" izz="0.2" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="hip" type="{kind}"><parent link="base"/><child link="rod"/><axis xyz="0 {axis}"/>
<limit lower="-3" upper="3" effort="{effort}" velocity="{velocity}"/></joint></robot>"""


def arm(kind="revolute", axis="-1 0", effort=20.0, velocity=10.0, root=None):
    text = ARM.format(kind=kind, axis=axis, effort=effort, velocity=velocity)
    return ClosedRobot(text, root_joint=root)


def told(joint, position, rate, acceleration, base=None):
    columns = (np.broadcast_to(x, TIME.shape)[:, None] for x in (position, rate, acceleration))
    return JointMotion("told", TIME, (joint,), *columns, base)


def swing(joint, start=0.0, size=0.4, speed=3.0):
    phase = speed * TIME
    return told(
        joint,
        start + size * (1 - np.cos(phase)),
        size * speed * np.sin(phase),
        size * speed**2 * np.cos(phase),
    )


def test_limbs_on_a_body_that_the_world_holds_are_told():
    """Legs of a robot that hangs by its body bear none of its weight: no walk is like that."""
    body = '<link name="body"><inertial><mass value="5"/><inertia ixx="1" iyy="1" izz="1" '
    body += 'ixy="0" ixz="0" iyz="0"/></inertial></link>'
    leg = ARM.format(kind="revolute", axis="-1 0", effort=20, velocity=10)
    leg = leg.replace('<robot name="arm"><link name="base"/>', "").replace("</robot>", "")
    right = leg.replace("rod", "rod2").replace("hip", "hip2").replace("base", "body")
    left = leg.replace("base", "body")
    walker = f'<robot name="walker">{body}{left}{{}}</robot>'
    motion = swing("hip")
    two = torque_report(ClosedRobot(walker.format(right)), motion)
    (note,) = two.notes()
    assert "The world holds body" in note
    assert "none of the 2 limbs" in note
    assert two.document()["notes"] == [note]
    flying = ClosedRobot(walker.format(right), root_joint=pin.JointModelFreeFlyer())
    for other in (ClosedRobot(walker.format("")), arm()):
        assert torque_report(other, motion).notes() == []
    assert held_note(flying) is None
    assert held_note(load(DATA / "five_bar.urdf", DATA / "five_bar.yaml")) is None


def test_a_pendulum_s_torque_is_weight_and_inertia():
    # 2 kg at 0.5 m, 0.2 kg·m² about its centre; about −y a positive turn lifts the rod.
    motion = swing("hip")
    report = torque_report(arm(), motion)
    angle, acceleration = motion.position[:, 0], motion.acceleration[:, 0]
    wanted = 2 * 9.81 * 0.5 * np.cos(angle) + (0.2 + 2 * 0.25) * acceleration
    np.testing.assert_allclose(report.dynamics.torque[:, 0], wanted, atol=1e-12)


def test_a_lift_s_force_is_in_newtons():
    report = torque_report(arm("prismatic", "0 1"), told("hip", 0.1, 0.0, 0.0))
    np.testing.assert_allclose(report.dynamics.torque, 2 * 9.81, rtol=1e-12)
    assert report.units == ("N",)
    assert "torque_hip_N" in report.columns()
    assert "hip_m" in report.columns()


def energy(robot, q, v):
    data = robot.model.createData()
    return np.array(
        [
            pin.computeKineticEnergy(robot.model, data, a, b)
            + pin.computePotentialEnergy(robot.model, data, a)
            for a, b in zip(q, v, strict=True)
        ]
    )


@pytest.mark.parametrize(("name", "joint"), [("four_bar", "motor"), ("five_bar", "motor_left")])
def test_the_motors_power_is_the_change_of_the_robot_s_energy(name, joint):
    robot = load(DATA / f"{name}.urdf", DATA / f"{name}.yaml")
    start = singles(robot.model)[joint].position(torque_start(robot))
    report = torque_report(robot, swing(joint, start=float(start), size=0.2))
    change = np.gradient(energy(robot, report.joints.q, report.joints.v), TIME)[2:-2]
    power = report.power.sum(axis=1)[2:-2]
    np.testing.assert_allclose(power, change, atol=2e-3 * np.abs(power).max())
    assert report.unexplained.max() < 1e-9


def test_a_wrench_from_outside_is_carried_by_the_motor_in_the_world_s_axes():
    # Against a moment about the world's y, which an axis along −y feels as −3; the force at
    # the axis does no work.
    motion = swing("hip")
    plain = torque_report(arm(), motion)
    pushed = torque_report(arm(), motion, external={"rod": (5, 6, 7, 1, 3, 2)})
    np.testing.assert_allclose(pushed.dynamics.torque, plain.dynamics.torque + 3.0, atol=1e-12)
    assert pushed.document()["parameters"]["external"] == {"rod": [5, 6, 7, 1, 3, 2]}
    assert "(5, 6, 7) N and (1, 3, 2) N·m act on frame rod" in " ".join(pushed.verdict())
    assert plain.document()["parameters"]["external"] == {}


@pytest.mark.parametrize(("name", "joint"), [("four_bar", "motor"), ("five_bar", "motor_left")])
def test_what_a_constant_force_does_the_motors_need_not(name, joint):
    """By the way that the frame goes."""
    robot = load(DATA / f"{name}.urdf", DATA / f"{name}.yaml")
    start = singles(robot.model)[joint].position(torque_start(robot))
    motion, force = swing(joint, start=float(start), size=0.2), np.array([3.0, -2.0, 5.0])
    frame = robot.loops[0].frames[0]
    pushed = torque_report(robot, motion, external={frame: [*force, 0, 0, 0]})
    plain = torque_report(robot, motion)
    way = []
    for q in plain.joints.q:
        pin.framesForwardKinematics(robot.model, robot.data, q)
        way.append(robot.data.oMf[robot.model.getFrameId(frame)].translation.copy())
    spared = np.gradient(np.array(way) @ force, TIME)[2:-2]
    power = (plain.power - pushed.power).sum(axis=1)[2:-2]
    assert np.abs(spared).max() > 0.1
    np.testing.assert_allclose(power, spared, atol=2e-3 * np.abs(spared).max())


def test_wrenches_on_frames_that_are_not_there_are_refused_before_anything_is_worked_out():
    with pytest.raises(UnknownName, match="'hand'"):
        torque_report(arm(), swing("hip"), external={"hand": np.zeros(6)})
    with pytest.raises(WrongShape):
        torque_report(arm(), swing("hip"), external={"rod": np.zeros(3)})


def torque_start(robot):
    from thesis_pin.loops.checking.assembly import assembly

    return assembly(robot).q


def test_pollard_s_own_closed_form_finds_the_same_torques():
    robot = load(*(ROOT / "urdf/pollard" / f"pollard.{end}" for end in ("urdf", "closures.yaml")))
    motion = read_motion(robot, ROOT / "examples" / "pollard_motors.csv")
    report = torque_report(robot, motion)
    path = pollard_pin.load_path(ROOT / "examples" / "spray_arch.toml")
    own = pollard_pin.trajectory_report(pollard_pin.load(), path, samples=101)
    np.testing.assert_allclose(report.joints.time, own.joints.time, atol=1e-8)
    # The file has nine digits.
    np.testing.assert_allclose(report.dynamics.torque, own.torque, atol=5e-8)
    np.testing.assert_allclose(report.loop_force_size, own.loop_force_size, atol=5e-7)


def test_what_samples_csv_says_reads_back_as_the_same_motion(tmp_path):
    report = torque_report(arm(), swing("hip"))
    columns = {
        name: values
        for name, values in report.columns().items()
        if name.startswith(("time", "hip"))
    }
    (tmp_path / "samples.csv").write_bytes(csv_bytes(columns))
    again = read_motion(arm(), tmp_path / "samples.csv")
    np.testing.assert_array_equal(again.position, report.motion.position)
    np.testing.assert_array_equal(again.acceleration, report.motion.acceleration)


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"effort": 5.0}, "Motor hip needs 13.41 N·m at t = 0 s; it gives -5 to 5"),
        ({"velocity": 0.5}, "Motor hip runs at 1.2 rad/s; it reaches 0.5"),
    ],
)
def test_a_motor_beyond_its_limits_is_a_no(changes, says):
    # At t = 0: 2·9.81·0.5 + 0.7·0.4·9 = 12.33 N·m.
    says = says.replace("13.41", f"{2 * 9.81 * 0.5 + 0.7 * 0.4 * 9:.4g}")
    report = torque_report(arm(**changes), swing("hip"))
    assert not report.within_limits
    assert any(says in one for one in report.verdict())
    assert torque_report(arm(), swing("hip")).within_limits


def test_a_joint_outside_its_range_is_a_no():
    report = torque_report(arm(), swing("hip", start=2.5))
    assert not report.within_limits
    (excess,) = report.outside.values()
    assert excess == pytest.approx(2.5 + 0.4 * (1 - np.cos(3 * TIME)).max() - 3, abs=1e-9)


@pytest.mark.parametrize("effort", [0, 1e308])
def test_an_effort_of_zero_or_1e308_is_no_limit_but_says_that_none_is_known(effort):
    report = torque_report(arm(effort=effort), swing("hip"))
    assert np.isinf(report.effort_limits[:, 0]).all()
    assert report.within_limits
    assert "No torque limit is known of hip." in report.verdict()


def test_a_description_s_own_motor_limits_count_too():
    one = arm()
    motors = (Motor("M", "hip", effort=(-1.0, 8.0)),)
    described = replace(one.description, supplement=replace(one.supplement, motors=motors))
    report = torque_report(ClosedRobot(described), swing("hip"))
    assert not report.within_limits
    assert any("it gives -1 to 8" in one for one in report.verdict())


def test_a_free_root_is_carried_by_the_world_with_weight_and_inertia():
    """Lifted with 2 m/s² along z, at rest in its joint: force 2·(g + 2), moment about x, y."""
    rise = np.column_stack([0 * TIME, 0 * TIME, TIME**2, *(0 * TIME for _ in range(3)), TIME**0])
    robot = arm(root=pin.JointModelFreeFlyer())
    report = torque_report(robot, told("hip", 0.0, 0.0, 0.0, base=rise))
    weight = 2 * (9.81 + 2)
    wanted = [0, 0, weight, 0, -0.5 * weight, 0]
    np.testing.assert_allclose(report.dynamics.base, [wanted] * len(TIME), atol=1e-8)
    np.testing.assert_allclose(report.dynamics.torque[:, 0], 0.5 * weight, atol=1e-8)
    assert any(
        "The world must supply" in one or "world must supply" in one for one in report.verdict()
    )


def test_a_turning_base_s_rates_are_derivatives_of_its_poses():
    from scipy.spatial.transform import Rotation

    from thesis_pin.loops.motion.whole import base_motion

    place = np.column_stack([np.sin(TIME), TIME**2, np.cos(TIME)])
    turns = Rotation.from_euler("xyz", np.column_stack([TIME, 0.5 * TIME**2, np.sin(TIME)]))
    base = np.column_stack([place, turns.as_quat()])
    robot = arm(root=pin.JointModelFreeFlyer())
    q, v, a = base_motion(robot, TIME, base)
    step = TIME[1] - TIME[0]
    model = pin.Model()
    model.addJoint(0, pin.JointModelFreeFlyer(), pin.SE3.Identity(), "root")
    moved = [pin.difference(model, q[k - 1], q[k + 1]) / (2 * step) for k in range(1, len(q) - 1)]
    np.testing.assert_allclose(v[2:-2], np.array(moved)[1:-1], atol=1e-4)
    np.testing.assert_allclose(a[3:-3], np.gradient(v, step, axis=0)[3:-3], atol=1e-3)


def test_documents_and_figures_can_be_written_and_read():
    robot = load(DATA / "four_bar.urdf", DATA / "four_bar.yaml")
    start = singles(robot.model)["motor"].position(torque_start(robot))
    report = torque_report(robot, swing("motor", start=float(start), size=0.1))
    document = json.loads(json_bytes(report.document()))
    assert (document["schema"], document["version"]) == ("thesis-pin/torque", 3)
    assert np.shape(document["torque"]) == (len(TIME), 1)
    assert document["summary"]["verdict"] == report.verdict()
    assert set(figures(report)) == {
        f"{name}.{end}" for name in ("motors", "joints", "loops") for end in ("png", "svg")
    }


def test_motors_bear_their_own_names_and_say_which_joints_they_drive():
    robot = arm()
    named = replace(robot.description.supplement, motors=(Motor("hip_drive", "hip"),))
    robot = ClosedRobot(replace(robot.description, supplement=named))
    report = torque_report(robot, swing("hip"))
    document = json.loads(json_bytes(report.document()))
    assert (document["motors"], document["motor_joints"]) == (["hip_drive"], ["hip"])
    assert {"torque_hip_drive_Nm", "power_hip_drive_W", "hip_rad"} <= set(report.columns())
    assert "the closest is hip_drive with" in report.verdict()[0]


def test_a_name_that_stands_for_several_motors_is_none_of_them():
    text = ARM.format(kind="revolute", axis="-1 0", effort=1, velocity=1)
    more = text.replace("</robot>", "") + text[text.index('<link name="rod"') :].replace(
        'name="rod"', 'name="rod_2"'
    ).replace('name="hip"', 'name="hip_2"').replace('child link="rod"', 'child link="rod_2"')
    robot = ClosedRobot(more)
    both = (Motor("drive", "hip"), Motor("drive", "hip_2"))
    robot = ClosedRobot(
        replace(robot.description, supplement=replace(robot.supplement, motors=both))
    )
    assert [motor.name for motor in robot.motors] == ["drive", "hip_2"]


def test_a_load_left_over_by_rounding_is_drawn_as_none():
    report = torque_report(arm(), swing("hip"))
    rounding = np.full(len(TIME), 3e-16)
    rounding[7] = 2e-3
    report = replace(report, dynamics=replace(report.dynamics, unexplained=rounding))
    plot = unexplained(report)
    (curve,) = plot.curves
    assert np.flatnonzero(curve.y).tolist() == [7]
    assert [limit.value for limit in plot.limits] == [1e-6]
