"""Where a robot is looked at: the pose's assembly, inside the ranges, or the least gap."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest

from thesis_pin.loops.checking.assembly import GUESSES, assembly
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.kinematics import linearized, residual
from thesis_pin.model.mechanism.supplement import Closure, Motor, Supplement

DATA = Path(__file__).parents[1] / "data"
POINT = (True, True, True, False, False, False)


def bar(name, length, mass=1.0):
    inertia = f'ixx="0.001" iyy="{mass * length**2}" izz="{mass * length**2}"'
    return (
        f'<link name="{name}"><inertial><origin xyz="{length / 2} 0 0"/><mass value="{mass}"/>'
        f'<inertia {inertia} ixy="0" ixz="0" iyz="0"/></inertial></link>'
    )


def pin_joint(name, parent, child, place, low=-3.2, high=3.2):
    return (
        f'<joint name="{name}" type="revolute"><parent link="{parent}"/><child link="{child}"/>'
        f'<origin xyz="{place} 0 0"/><axis xyz="0 0 1"/>'
        f'<limit lower="{low}" upper="{high}" effort="5" velocity="5"/></joint>'
    )


def tip(name, parent, place):
    return (
        f'<link name="{name}"/><joint name="{name}_fixed" type="fixed"><parent link="{parent}"/>'
        f'<child link="{name}"/><origin xyz="{place} 0 0"/></joint>'
    )


def four_bar(ground, crank=0.1, coupler=0.3, rocker=0.25, **ranges):
    """A planar four-bar of given lengths, lying in the plane z = 0."""
    urdf = (
        '<robot name="bars"><link name="ground"/>'
        + bar("crank", crank)
        + bar("coupler", coupler)
        + bar("rocker", rocker)
        + pin_joint("motor", "ground", "crank", 0)
        + pin_joint("elbow", "crank", "coupler", crank, *ranges.get("elbow", ()))
        + pin_joint("pivot", "ground", "rocker", ground)
        + tip("coupler_tip", "coupler", coupler)
        + tip("rocker_tip", "rocker", rocker)
        + "</robot>"
    )
    robot = ClosedRobot(urdf)
    beside = Supplement(
        closures=(Closure("knee", ("coupler_tip", "rocker_tip"), POINT),),
        motors=(Motor("motor", "motor"),),
        poses=ranges.get("poses", {}),
    )
    return ClosedRobot(replace(robot.description, supplement=beside))


@pytest.mark.parametrize("ground", [0.9, 2.0])
def test_bars_that_cannot_meet_show_the_gap_that_their_lengths_leave(ground):
    found = assembly(four_bar(ground))
    assert not found.closed
    (gap,) = found.gaps
    assert gap.distance == pytest.approx(ground - 0.1 - 0.3 - 0.25, rel=1e-6)
    assert gap.frames == ("coupler_tip", "rocker_tip")
    assert f"{(ground - 0.65) * 1e3:.3g} mm between coupler_tip and rocker_tip" in str(gap)


def test_the_least_gap_keeps_the_joints_ranges():
    # With the elbow held at a right angle crank and coupler reach √(0.1² + 0.3²) m.
    found = assembly(four_bar(0.9, elbow=(1.5707963267948966, 1.6)))
    assert found.gaps[0].distance == pytest.approx(0.9 - np.hypot(0.1, 0.3) - 0.25, rel=1e-5)
    assert found.outside == {}


def test_a_four_bar_has_two_assemblies_and_the_range_of_its_elbow_chooses():
    for low, high in ((0.05, 3.1), (-3.1, -0.05)):
        found = assembly(four_bar(0.3, elbow=(low, high)))
        assert found.closed
        assert found.outside == {}
        assert low <= found.q[1] <= high


def test_a_pose_chooses_the_assembly_and_is_named():
    one = assembly(four_bar(0.3))
    assert one.start == "the neutral pose"  # which is stretched: it is left sideways
    up, down = ({"motor": (1.0,), "elbow": (sign * 1.5,), "pivot": (2.0,)} for sign in (1, -1))
    robot = four_bar(0.3, poses={"up": up, "down": down})
    found = [assembly(robot, name) for name in ("up", "down")]
    assert [one.start for one in found] == ["pose up", "pose down"]
    assert np.sign(found[0].q[1]) != np.sign(found[1].q[1])


def test_a_pose_that_is_closed_already_is_preferred_to_one_that_is_not():
    robot = four_bar(0.3)
    closed = assembly(robot).q + 0
    names = list(robot.model.names)[1:]
    pose = {name: (float(value),) for name, value in zip(names, closed, strict=True)}
    found = assembly(four_bar(0.3, poses={"as drawn": pose}))
    assert found.start == "pose as drawn"
    np.testing.assert_allclose(found.q, closed, atol=1e-9)


@pytest.mark.parametrize("angle", [3.0, 4.0])
def test_a_joint_that_a_pose_puts_outside_its_range_stays_there_and_is_told(angle, tmp_path):
    """And nothing else is moved: neither the other joints nor a root that flies freely."""
    text = '<robot name="arm"><link name="ground"/>' + bar("a", 1.0) + bar("b", 1.0)
    text += pin_joint("first", "ground", "a", 0) + pin_joint("second", "a", "b", 1) + "</robot>"
    robot = ClosedRobot(text, root_joint=pin.JointModelFreeFlyer())
    pose = tmp_path / "pose.toml"
    pose.write_text(f"format = 1\n[joints]\nfirst = 0.5\nsecond = {angle}\n")
    found = assembly(robot, str(pose))
    np.testing.assert_allclose(found.q, [0, 0, 0, 0, 0, 0, 1, 0.5, angle], atol=1e-15)
    beyond = max(angle - 3.2, 0.0)
    assert found.outside == ({"second": pytest.approx(beyond)} if beyond else {})


def test_a_root_that_flies_freely_is_not_moved_to_close_a_loop():
    # Straight: a stretched linkage doesn't know which way to bend, so the search starts beside.
    bars = four_bar(0.5)
    robot = ClosedRobot(bars.description, root_joint=pin.JointModelFreeFlyer())
    found = assembly(robot, "neutral")
    assert found.closed
    np.testing.assert_array_equal(found.q[:7], robot.q0[:7])


def test_a_tree_is_closed_where_it_stands():
    robot = four_bar(0.3)
    tree = ClosedRobot(replace(robot.description, supplement=Supplement()))
    found = assembly(tree)
    assert (found.closed, found.gaps, found.start) == (True, (), "the neutral pose")


def test_a_limit_without_lower_and_upper_is_no_range():
    robot = four_bar(0.3)
    text = robot.urdf.replace('lower="-3.2" upper="3.2" ', "")
    assert "lower" not in text
    found = assembly(
        ClosedRobot(replace(ClosedRobot(text).description, supplement=robot.supplement))
    )
    assert found.closed
    assert found.outside == {}
    assert np.abs(found.q).max() > 0.1


def test_a_search_that_fails_gives_up_attempts_that_get_no_nearer(monkeypatch):
    steps, svd = [], np.linalg.svd
    monkeypatch.setattr(np.linalg, "svd", lambda *a, **k: steps.append(1) or svd(*a, **k))
    found = assembly(four_bar(0.9))
    assert not found.closed
    attempts = GUESSES + 3
    assert attempts < len(steps) < 40 * attempts  # 60 steps, taken twice, would be 120 each
    again = assembly(four_bar(0.9))
    np.testing.assert_array_equal(again.q, found.q)
    assert again.start == found.start


def test_one_linearization_is_residual_and_derivative():
    robot = four_bar(0.9)
    q = np.array([0.3, -0.8, 1.1])
    gap, matrix = linearized(robot, robot.model.createData(), q)
    np.testing.assert_allclose(gap, residual(robot, q), atol=1e-15)
    step = 1e-6 * np.eye(3)
    numeric = [(residual(robot, q + s) - residual(robot, q - s)) / 2e-6 for s in step]
    np.testing.assert_allclose(matrix, np.transpose(numeric), atol=1e-9)
