"""The world that Scout walks in: its own bodies, its own soles, its servos' limits."""

from dataclasses import replace

import numpy as np
import pinocchio as pin
import pytest
from scipy.linalg import eigh

import scout_pin
from scout_pin.specification import SIDES, Specification
from scout_pin.study.servo import ServoGains
from scout_pin.study.simulate.conditions import Conditions
from scout_pin.study.simulate.world import engine, gravity, time_step, walking_tree
from thesis_pin.errors import BadInput

from ...conftest import states
from ...dynamics.test_rotors import REFLECTED, geared

pytest.importorskip("mujoco", reason="MuJoCo isn't installed: pip install mujoco")

BARE = Conditions(armature=0.0)


def made(robot, conditions=BARE, masses=None):
    tree = walking_tree(robot, conditions, np.ones(13) if masses is None else masses)
    return engine(robot, tree, conditions, 5e-4)


def test_the_engine_s_inverse_dynamics_are_pinocchio_s(biped, rng):
    """Free base, random q, v, a, no rotors: to 1e-9 of the largest."""
    world = made(biped)
    for thesis in zip(*states(rng, 20), strict=True):
        q, v, a = biped.to_free_flyer(*thesis)
        expected = pin.rnea(biped.model, biped.data, q, v, a)
        error = np.abs(world.inverse(q, v, a) - expected).max()
        assert error < 1e-9 * np.abs(expected).max()


def test_rotors_are_the_specification_s_where_it_has_some_and_the_conditions_else(rng):
    robot = geared(left_only=True)
    model = made(robot, Conditions(armature=5e-4)).model
    np.testing.assert_allclose(model.dof_armature, [0.0] * 6 + [REFLECTED] * 6 + [5e-4] * 6)


def test_soles_touch_the_floor_at_the_corners_of_their_hulls(biped, rng):
    """Every corner of the specification lies in the hull that the engine's corners span."""
    from scipy.spatial import ConvexHull, Delaunay

    world = made(biped)
    q = biped.configuration(np.eye(4), rng.uniform(-0.5, 0.5, 12))
    world.place(q)
    feet = biped.forward_kinematics(q[7:])
    for side in SIDES:
        names = [world.model.geom(k).name for k in range(world.model.ngeom)]
        corners = [k for k, name in enumerate(names) if name.startswith(f"{side}_corner")]
        lowest = world.data.geom_xpos[corners] - 1e-4 * feet[side][:3, 2]
        expected = biped.sole_vertices(side, feet[side])
        assert len(corners) == len(ConvexHull(biped.specification.leg(side).sole).vertices)
        nearest = np.linalg.norm(lowest[:, None] - expected[None], axis=-1).min(axis=1)
        assert nearest.max() < 1e-9
        flat = (lowest - feet[side][:3, 3]) @ feet[side][:3, :2]
        sole = np.array(biped.specification.leg(side).sole) * (1 - 1e-9)
        assert (Delaunay(flat).find_simplex(sole) >= 0).all()


def test_only_soles_touch_the_floor_and_each_other(scout):
    world = made(scout)
    q = scout.configuration(np.eye(4), np.zeros(12))
    q[2] = 0.0  # the whole robot deep in the floor
    world.place(q)
    names = {world.model.geom(int(k)).name for k in world.data.contact.geom.ravel()}
    assert {name.split("_")[1] for name in names if name != "floor"} == {"corner"}
    for apart, meet in ((0.0285, False), (0.0275, True)):  # their inner edges are at 28.18 mm
        feet = [np.eye(4), np.eye(4)]
        feet[0][0, 3], feet[1][0, 3] = -apart, apart
        torso = np.eye(4)
        torso[:3, 3] = 0.0, 0.04, 0.21
        angles = scout.inverse_kinematics(torso, *feet)
        torso[2, 3] += 1.0  # off the floor
        world.place(scout.configuration(torso, angles))
        pairs = {
            tuple(sorted(world.model.geom(int(k)).name for k in pair))
            for pair in world.data.contact.geom
        }
        assert pairs == ({("left_plate", "right_plate")} if meet else set())


def test_gravity_leans_against_the_way_that_rises():
    ahead = gravity(replace(BARE, floor_tilt=(np.radians(3.0), 0.0)))
    np.testing.assert_allclose(
        ahead, 9.81 * np.array([0, -np.sin(np.radians(3)), -np.cos(np.radians(3))])
    )
    right = gravity(replace(BARE, floor_tilt=(0.0, np.radians(2.0))))
    np.testing.assert_allclose(
        right, 9.81 * np.array([-np.sin(np.radians(2)), 0, -np.cos(np.radians(2))])
    )


def test_masses_and_inertias_change_together(scout, rng):
    factors = rng.uniform(0.8, 1.2, 13)
    model = made(scout, masses=factors).model
    plain = made(scout).model
    np.testing.assert_allclose(model.body_mass[1:], factors * plain.body_mass[1:])
    np.testing.assert_allclose(model.body_inertia[1:], factors[:, None] * plain.body_inertia[1:])
    np.testing.assert_allclose(model.body_ipos, plain.body_ipos, atol=1e-12)


@pytest.mark.parametrize("stiffness", [20.0, 500.0, 5e4])
def test_the_usual_time_step_is_short_enough_for_any_servo(scout, stiffness):
    """A joint that stands off its command by a little swings as its servo has it, no farther."""
    conditions = Conditions(gains=ServoGains(stiffness, 0.0))
    q = scout.configuration(np.eye(4), np.full(12, 0.2))
    q[2] = 5.0  # in the air
    step = time_step(scout, conditions, q)
    world = engine(scout, walking_tree(scout, conditions, np.ones(13)), conditions, step)
    world.model.opt.gravity[:] = 0.0
    off = 0.1 * scout.stall_torque[0] / stiffness
    world.place(q)
    record = world.run(np.tile(stiffness * (q[7:] + off), (4000, 1)))
    assert np.abs(record.q[:, 7:] - q[7:]).max() < 4 * off


def test_a_time_step_too_long_for_the_servos_is_refused(scout):
    q = scout.configuration(np.eye(4), np.zeros(12))
    with pytest.raises(BadInput, match=r"too fast for steps of 0\.001 s"):
        time_step(scout, Conditions(gains=ServoGains(1e5), time_step=1e-3), q)
    with pytest.raises(BadInput, match="softer servos"):
        time_step(scout, Conditions(gains=ServoGains(1e8)), q)


def test_friction_of_the_floor_and_of_joints_are_the_specification_s_or_what_is_asked_for():
    data = Specification.read().model_dump()
    data["assumptions"]["joint_friction"] |= {"viscous": 0.02, "coulomb": 0.03}
    data["assumptions"]["floor_friction"]["coefficient"] = 0.45
    robot = scout_pin.load(Specification.model_validate(data))
    for asked, expected in ((None, 0.45), (0.3, 0.3)):
        model = made(robot, replace(BARE, friction=asked)).model
        touching = [k for k in range(model.ngeom) if "plate" not in model.geom(k).name]
        np.testing.assert_allclose(model.geom_friction[touching, 0], expected)
    np.testing.assert_allclose(model.dof_frictionloss, [0.0] * 6 + [0.03] * 12)
    np.testing.assert_allclose(model.dof_damping.ravel(), [0.0] * 6 + [0.02] * 12)


def test_a_usual_step_is_half_the_time_of_the_fastest_swing(scout):
    """Of K x = λ M x for all degrees of freedom, by SciPy."""
    q = scout.configuration(np.eye(4), np.full(12, 0.2))
    conditions = Conditions(gains=ServoGains(3000.0))
    tree = walking_tree(scout, conditions, np.ones(13))
    mass = pin.crba(tree, tree.createData(), q)
    mass = np.triu(mass) + np.triu(mass, 1).T
    fastest = np.sqrt(eigh(np.diag([0.0] * 6 + [3000.0] * 12), mass, eigvals_only=True)[-1])
    assert 0.5 / fastest < 5e-4
    assert time_step(scout, conditions, q) == pytest.approx(0.5 / fastest)
