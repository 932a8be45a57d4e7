"""Ellipsoids along the path: half axes and axes are those of the errors' squares."""

import numpy as np
import pytest

import pollard_pin
from pollard_pin.study.accuracy.exact import reached
from pollard_pin.study.accuracy.study import workspace_accuracy
from pollard_pin.study.accuracy.told.curves import map_figure
from pollard_pin.study.accuracy.told.page import scene


def test_ellipsoids_are_as_long_in_each_direction_as_the_root_of_squares_along_it(pollard):
    path = pollard_pin.appendix_b(pollard.specification)
    study = pollard_pin.path_accuracy(pollard, path, samples=61, draws=0)
    found = scene(study)
    bodies = [item for item in found.items if item.group == "errors"]
    label = next(group.label for group in found.groups if group.name == "errors")
    scale = float(label.split(",")[1].split()[0])
    assert len(bodies) == 25
    rng = np.random.default_rng(0)
    for body in bodies[::6]:
        place = body.local[:3, 3]
        k = int(np.argmin(np.linalg.norm(study.pose[:, :3] - place, axis=1)))
        np.testing.assert_allclose(study.pose[k, :3], place)
        each = study.allowed.whole(np.diag(study.allowed.sizes) * 1e-3)
        away = reached(pollard.specification, study.angles[k : k + 1], each[..., None]).tip[:, 0]
        away = (away - place) * 1e3
        for direction in rng.normal(size=(5, 3)):
            direction /= np.linalg.norm(direction)
            expected = np.sqrt(((away @ direction) ** 2).sum()) * scale
            half = np.array(body.geometry["radii"]) * (body.local[:3, :3].T @ direction)
            assert np.linalg.norm(half) == pytest.approx(expected, rel=2e-3)
        assert np.linalg.det(body.local[:3, :3]) == pytest.approx(1.0)


@pytest.mark.parametrize(("limit", "outlined"), [(1e-4, False), (5e-3, True)])
def test_the_map_speaks_of_an_outline_only_where_it_draws_one(limit, outlined, pollard):
    x, z = np.linspace(0.4, 0.7, 7), np.linspace(-0.3, 0.1, 7)
    figure = map_figure(workspace_accuracy(pollard, x, 0.0, z, within=limit))
    assert ("orange" in figure.get_suptitle()) == outlined
