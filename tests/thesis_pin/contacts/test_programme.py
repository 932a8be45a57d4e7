"""How cones share a load, many samples at a time: each answer against the optimum's own law."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import linprog, nnls

from thesis_pin.contacts import programme
from thesis_pin.contacts.cones import Contact
from thesis_pin.contacts.programme import ConeProgramme, Held
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
        (
            Held(CONTACT.facets, maps[0], np.zeros((count, 6))),
            Held(CONTACT.facets, -maps[1], np.einsum("nij,nj->ni", maps[1], total)),
        ),
    )


def on_points(count, unknowns):
    """A load that five points in cones of their own share, with some components left open."""
    rng = np.random.default_rng(unknowns)
    angle = 2 * np.pi * np.arange(8) / 8
    facets = np.stack([np.cos(angle), np.sin(angle), np.full(8, -0.5)], axis=1)
    facets /= np.linalg.norm(facets[0])
    phase = np.linspace(0, 2 * np.pi, count)[:, None]
    cones = []
    for _ in range(5):
        start = 0.3 * rng.normal(size=3) + np.sin(phase + rng.uniform(0, 6)) * rng.normal(size=3)
        offset = start * [0.4, 0.4, 0.1] + [0, 0, 1.0]
        cones.append(Held(facets, rng.normal(size=(1, 3, unknowns)).repeat(count, axis=0), offset))
    matrix = rng.normal(size=(unknowns + 2, unknowns))
    target = rng.normal(size=unknowns + 2) + 0.5 * np.cos(phase) * rng.normal(size=unknowns + 2)
    hessian = np.tile(matrix.T @ matrix, (count, 1, 1))
    return ConeProgramme(hessian, target @ matrix, tuple(cones))


def normals_and_bounds(problem, k):
    normals = np.concatenate([cone.facets @ cone.maps[k] for cone in problem.cones])
    bounds = np.concatenate([-cone.facets @ cone.offset[k] for cone in problem.cones])
    return normals, bounds + problem.slack


def breach_of_the_optimum_s_law(problem, k, z):
    """By how much z passes a facet, and what of its gradient no facet that it lies on gives."""
    normals, bounds = normals_and_bounds(problem, k)
    beyond = normals @ z - bounds
    push = problem.gradient[k] - problem.hessian[k] @ z
    touching = beyond > -1e-9
    rest = nnls(normals[touching].T, push)[1] if touching.any() else np.linalg.norm(push)
    return beyond.max(), rest / np.linalg.norm(problem.gradient[k]), touching.any()


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
        beyond, rest, touching = breach_of_the_optimum_s_law(problem, k, found[k])
        assert beyond < 1e-9
        assert rest < 1e-9
        bound += touching
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


@pytest.mark.parametrize("unknowns", [1, 2, 4, 9])
@pytest.mark.parametrize("slack", [0.0, 0.05])
def test_any_number_of_cones_and_unknowns_has_its_optimum(unknowns, slack):
    problem = replace(on_points(400, unknowns), slack=slack)
    free = np.linalg.solve(problem.hessian, problem.gradient[..., None])[..., 0]
    found, possible = problem.least(free)
    assert possible.any()
    bound = 0
    for k in range(0, 400, 9):
        normals, bounds = normals_and_bounds(problem, k)
        feasible = linprog(
            np.zeros(unknowns), normals, bounds + 1e-9, bounds=(None, None), method="highs"
        )
        assert possible[k] == (feasible.status == 0)
        if not possible[k]:
            np.testing.assert_array_equal(found[k], free[k])
            continue
        beyond, rest, touching = breach_of_the_optimum_s_law(problem, k, found[k])
        assert beyond < 1e-9
        assert rest < 1e-9
        bound += touching
    assert bound > 5


def test_where_no_cone_is_in_the_way_nothing_is_asked_of_a_solver(monkeypatch):
    problem = replace(on_points(20, 4), slack=1e3)
    monkeypatch.setattr(programme.daqp, "solve", lambda *a, **k: pytest.fail("asked"))
    free = np.linalg.solve(problem.hessian, problem.gradient[..., None])[..., 0]
    found, possible = problem.least(free)
    np.testing.assert_array_equal(found, free)
    assert possible.all()
