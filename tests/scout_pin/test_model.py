"""Loading, and the two coordinate choices."""

import numpy as np
import pinocchio as pin
import pytest

import scout_pin
from thesis_pin.errors import BadInput, UnknownName
from thesis_pin.numeric.rotations import euler_placement

from .conftest import states


def symmetric(matrix):
    return np.triu(matrix) + np.triu(matrix, 1).T


@pytest.mark.parametrize("specification", [None, "lopsided"])
@pytest.mark.parametrize("inertia", ["physical", "printed"])
def test_both_roots_have_the_same_mass_matrix_and_forces(request, rng, specification, inertia):
    if specification:
        specification = request.getfixturevalue("lopsided").specification
    floating = scout_pin.load(specification, inertia=inertia)
    thesis = scout_pin.load(specification, root="thesis", inertia=inertia)
    q, v, a = states(rng)
    fq, fv, fa = floating.to_free_flyer(q, v, a)
    unit = np.eye(18)
    for k in range(len(q)):
        # S maps thesis velocities to free-flyer ones: v_ff = S q̇.
        s = floating.to_free_flyer(np.broadcast_to(q[k], (18, 18)), unit)[1].T
        pairs = (
            (
                s.T @ symmetric(pin.crba(floating.model, floating.data, fq[k])) @ s,
                symmetric(pin.crba(thesis.model, thesis.data, q[k])),
            ),
            (
                s.T @ pin.computeGeneralizedGravity(floating.model, floating.data, fq[k]),
                pin.computeGeneralizedGravity(thesis.model, thesis.data, q[k]),
            ),
            (
                s.T @ pin.rnea(floating.model, floating.data, fq[k], fv[k], fa[k]),
                pin.rnea(thesis.model, thesis.data, q[k], v[k], a[k]),
            ),
        )
        for ours, theirs in pairs:
            np.testing.assert_allclose(ours, theirs, atol=1e-12)


def test_coriolis_matrix_gives_the_coriolis_terms_under_both_roots(rng):
    for root in ("free_flyer", "thesis"):
        robot = scout_pin.load(root=root)
        q = pin.randomConfiguration(robot.model, -np.ones(robot.model.nq), np.ones(robot.model.nq))
        v = rng.normal(size=18)
        matrix = pin.computeCoriolisMatrix(robot.model, robot.data, q, v)
        terms = pin.nonLinearEffects(robot.model, robot.data, q, v)
        terms = terms - pin.computeGeneralizedGravity(robot.model, robot.data, q)
        np.testing.assert_allclose(matrix @ v, terms, atol=1e-12)


def test_thesis_root_places_the_torso_by_the_thesis_transformations(scout_thesis, rng):
    q = rng.uniform(-1, 1, 18)
    pin.framesForwardKinematics(scout_thesis.model, scout_thesis.data, q)
    torso = scout_thesis.data.oMf[scout_thesis.model.getFrameId("torso")]
    turn, _, _ = euler_placement("xyz", q[None, 3:6], np.zeros((1, 3)), np.zeros((1, 3)))
    np.testing.assert_allclose(torso.rotation, turn[0], atol=1e-14)
    np.testing.assert_allclose(torso.translation, q[:3], atol=1e-15)


@pytest.mark.parametrize("root", ["free_flyer", "thesis"])
def test_configuration_makes_pinocchio_reach_what_inverse_kinematics_was_asked_for(root, rng):
    robot = scout_pin.load(root=root)
    torso = pin.SE3(pin.rpy.rpyToMatrix(0.1, -0.05, 0.2), np.array([0.01, 0.02, 0.3]))
    feet = robot.forward_kinematics(rng.uniform(-0.4, 0.4, 12), torso)
    angles = robot.inverse_kinematics(torso, feet["left"], feet["right"])
    q = robot.configuration(torso, angles)
    assert q.shape == (robot.model.nq,)
    pin.framesForwardKinematics(robot.model, robot.data, q)
    for side in ("left", "right"):
        reached = robot.data.oMf[robot.sole_frames[side]].homogeneous
        np.testing.assert_allclose(reached, feet[side], atol=1e-12)
    stack = robot.configuration(torso, np.stack([angles, np.zeros(12)]))
    np.testing.assert_allclose(stack[0], q, atol=1e-15)
    np.testing.assert_array_equal(stack[1, -12:], 0.0)


@pytest.mark.parametrize("arguments", [{"root": "fixed"}, {"inertia": "guessed"}])
def test_unknown_choices_are_refused_with_the_known_ones(arguments):
    with pytest.raises(UnknownName, match="allowed"):
        scout_pin.load(**arguments)


def test_wrong_shapes_are_refused(scout):
    feet = scout.neutral_feet()
    stacks = [np.broadcast_to(place, (n, 4, 4)) for place, n in ((np.eye(4), 3), (feet["left"], 2))]
    with pytest.raises(BadInput, match="equal stacks"):
        scout.inverse_kinematics(*stacks, feet["right"])
    with pytest.raises(UnknownName, match="side"):
        scout.leg_inverse_kinematics("middle", np.eye(4))


def test_robot_offers_what_users_of_a_robot_wrapper_expect(scout):
    assert scout.q0.shape == (19,)
    assert scout.v0.shape == (18,)
    wrapper = scout.wrapper
    assert isinstance(wrapper, pin.RobotWrapper)
    assert wrapper.nv == 18
    assert wrapper.visual_model.ngeoms == scout.visual_model.ngeoms == 27
    assert wrapper.mass(scout.q0).shape == (18, 18)
    assert pin.computeTotalMass(scout.model) == pytest.approx(0.89854, abs=1e-12)


def test_public_names_are_lazy_and_all_there():
    for name in scout_pin.__all__:
        assert getattr(scout_pin, name) is not None
    with pytest.raises(AttributeError):
        scout_pin.nothing  # noqa: B018
