"""How two cones share a load, many samples at a time: each answer against the optimum's own law."""

import numpy as np
import pytest
from scipy.optimize import linprog, nnls

from thesis_pin.contacts import programme
from thesis_pin.contacts.cones import Contact
from thesis_pin.contacts.programme import ConeProgramme
from thesis_pin.contacts.sharing import scaled_sole_maps
from thesis_pin.numeric.rotations import rotation

SQUARE = np.array([[-0.05, -0.05], [0.05, -0.05], [0.05, 0.05], [-0.05, 0.05]])
CONTACT = Contact.from_outline(SQUARE, 0.6)
UNIT = np.repeat([CONTACT.length, 1.0], 3)


def shifting(count, swing=1.0):
    """A load that wanders from foot to foot, beyond them where it swings far."""
    rng = np.random.default_rng(7)
    matrix = rng.normal(size=(12, 6)) + 0.1 * rng.normal(size=(12, 6)) * np.linspace(
        0, 1, count
    ).reshape(-1, 1, 1)
    phase = np.linspace(0, 2 * np.pi, count)
    turn = rotation("z", 0.2 * np.sin(phase))
    soles = [np.tile([x, 0.0, -0.3], (count, 1)) for x in (-0.08, 0.08)]
    maps = [scaled_sole_maps(turn, sole, CONTACT.length) / UNIT for sole in soles]
    force = np.stack([2 * np.sin(phase), 3 * np.cos(phase), np.full(count, 30.0)], axis=1)
    point = np.stack(
        [0.1 * swing * np.sin(phase), 0.04 * swing * np.cos(3 * phase), np.full(count, -0.3)],
        axis=1,
    )
    total = np.concatenate([force, np.cross(point, force)], axis=1) * UNIT
    target = 2.0 * rng.normal(size=12) + np.zeros((count, 12))
    turned = np.swapaxes(matrix, 1, 2)
    return ConeProgramme(
        turned @ matrix,
        np.matmul(turned, target[:, :, None])[:, :, 0],
        (maps[0], maps[1]),
        total,
        (CONTACT.facets, CONTACT.facets),
    )


def normals_and_bounds(problem, k):
    one, other = problem.facets
    normals = np.concatenate([one @ problem.maps[0][k], -other @ problem.maps[1][k]])
    bounds = np.concatenate([np.zeros(len(one)), -other @ problem.maps[1][k] @ problem.total[k]])
    return normals, bounds


def test_every_answer_is_the_optimum(monkeypatch):
    """Its gradient is a push of the facets it lies on, and nothing else."""
    problem = shifting(600)
    asked = []
    solver = programme.daqp.solve
    monkeypatch.setattr(programme.daqp, "solve", lambda *a, **k: asked.append(1) or solver(*a, **k))
    found, possible = problem.solve(np.arange(600))
    assert possible.all()
    assert 3 < len(asked) < 100  # facets changed, and were tried on the samples that followed
    bound = 0
    for k in range(0, 600, 7):
        normals, bounds = normals_and_bounds(problem, k)
        beyond = normals @ found[k] - bounds
        assert beyond.max() < 1e-9
        push = problem.gradient[k] - problem.hessian[k] @ found[k]
        touching = beyond > -1e-9
        bound += touching.any()
        assert nnls(normals[touching].T, push)[1] < 1e-9 * np.linalg.norm(problem.gradient[k])
    assert bound > 30


def test_an_answer_is_the_same_alone_and_among_others():
    problem = shifting(300, swing=1.4)
    every = np.arange(300)
    found, possible = problem.solve(every)
    some = every[::11][::-1]
    again, also = problem.solve(some)
    np.testing.assert_array_equal(also, possible[some])
    np.testing.assert_allclose(again, found[some], rtol=1e-9, atol=1e-12)
    for k in some:
        alone = problem.solve(np.array([k]))[0][0]
        np.testing.assert_allclose(alone, found[k], rtol=1e-9, atol=1e-12)


def test_a_load_that_no_pair_of_wrenches_carries_is_told_at_its_own_sample():
    problem = shifting(200, swing=1.6)
    found, possible = problem.solve(np.arange(200))
    for k in range(0, 200, 5):
        normals, bounds = normals_and_bounds(problem, k)
        feasible = linprog(np.zeros(6), normals, bounds + 1e-9, bounds=(None, None)).status == 0
        assert possible[k] == feasible
        assert np.isnan(found[k]).all() == (not feasible)
    assert 20 < possible.sum() < 180


@pytest.mark.parametrize("count", [0, 1])
def test_no_sample_and_one_are_programmes_too(count):
    found, possible = shifting(5).solve(np.arange(count))
    assert found.shape == (count, 6)
    assert possible.all()
