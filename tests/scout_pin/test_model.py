"""Loading, and the two coordinate choices."""

import numpy as np
import pinocchio as pin
import pytest

import scout_pin
from thesis_pin.errors import BadInput, SingularPose, UnknownName, WrongShape
from thesis_pin.numeric.rotations import euler_placement


def states(rng, count=40):
    q = rng.uniform(-1.2, 1.2, (count, 18))
    return q, *rng.normal(size=(2, count, 18))


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


def test_coordinates_convert_there_and_back_for_one_state_and_a_batch(scout, rng):
    q, v, a = states(rng, 60)
    for part in (slice(None), 7):
        back = scout.to_thesis(*scout.to_free_flyer(q[part], v[part], a[part]))
        for ours, given in zip(back, (q, v, a), strict=True):
            np.testing.assert_allclose(ours, given[part], atol=1e-12)
    grid = scout.to_free_flyer(q.reshape(3, 20, 18))
    assert grid[0].shape == (3, 20, 19)
    assert grid[1] is None


def test_free_flyer_velocity_is_pinocchios_difference_of_configurations(scout, rng):
    q, v, a = states(rng, 5)
    h = 1e-6
    position, velocity, acceleration = scout.to_free_flyer(q, v, a)
    later_q, later_v, _ = scout.to_free_flyer(q + h * v + 0.5 * h * h * a, v + h * a, a)
    for k in range(5):
        moved = pin.difference(scout.model, position[k], later_q[k]) / h
        np.testing.assert_allclose(moved, velocity[k], atol=1e-4)
    np.testing.assert_allclose((later_v - velocity) / h, acceleration, atol=1e-4)


def test_gimbal_lock_is_refused_on_the_way_to_thesis_coordinates(scout):
    q = np.zeros(18)
    q[4] = np.pi / 2
    with pytest.raises(SingularPose, match="φ_B"):
        scout.to_thesis(scout.to_free_flyer(q)[0])


@pytest.mark.parametrize("arguments", [{"root": "fixed"}, {"inertia": "guessed"}])
def test_unknown_choices_are_refused_with_the_known_ones(arguments):
    with pytest.raises(UnknownName, match="allowed"):
        scout_pin.load(**arguments)


def test_wrong_shapes_are_refused(scout):
    feet = scout.neutral_feet()
    stacks = [np.broadcast_to(place, (n, 4, 4)) for place, n in ((np.eye(4), 3), (feet["left"], 2))]
    with pytest.raises(BadInput, match="equal stacks"):
        scout.inverse_kinematics(*stacks, feet["right"])
    with pytest.raises(BadInput, match="quaternion"):
        scout.to_thesis(np.zeros(19))
    with pytest.raises(WrongShape, match="18"):
        scout.to_free_flyer(np.zeros(19))
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
