"""Soles in the neutral pose: level or not, and which angles would make them so."""

from pathlib import Path

import numpy as np
import pytest

import scout_pin
from scout_pin.kinematics.neutral import tilts
from scout_pin.specification import NEW_PATH, Specification

from ..conftest import random_specification


def turned(changes, side="left", path=None):
    data = Specification.read(path).model_dump()
    beta = list(data["legs"][side]["beta_deg"])
    for number, by in changes.items():
        beta[number - 1] += by
    data["legs"][side]["beta_deg"] = tuple(beta)
    return data


EXAMPLES = Path(__file__).parents[3] / "examples"


@pytest.mark.parametrize("path", [None, NEW_PATH, EXAMPLES / "lopsided.toml"])
def test_soles_of_robots_there_are_stand_level(path):
    assert tilts(Specification.read(path)) == []


@pytest.mark.parametrize(
    "changes", [{5: 10}, {5: -3, 6: 4}, {3: 7}, {2: 5}, {1: 20, 2: 8, 3: -4, 5: 1}]
)
@pytest.mark.parametrize("side", ["left", "right"])
def test_the_angles_that_are_named_make_the_sole_level(changes, side):
    data = turned(changes, side)
    (tilt,) = tilts(Specification.model_validate(data))
    assert tilt.side == side
    beta = list(data["legs"][side]["beta_deg"])
    beta[4:] = np.degrees(tilt.level).tolist()
    data["legs"][side]["beta_deg"] = tuple(beta)
    robot = scout_pin.load(Specification.model_validate(data))
    np.testing.assert_allclose(robot.neutral_feet()[side][:3, 2], [0, 0, 1], atol=1e-12)


def test_a_rotation_about_the_vertical_is_no_tilt():
    assert tilts(Specification.model_validate(turned({1: 30}))) == []


def test_the_tilt_is_the_angle_between_the_normals(rng):
    for _ in range(20):
        spec = random_specification(rng)
        feet = scout_pin.load(spec).neutral_feet()
        found = {tilt.side: tilt.angle for tilt in tilts(spec)}
        for side, angle in found.items():
            assert np.cos(angle) == pytest.approx(feet[side][2, 2], abs=1e-12)


def test_a_tilt_that_is_meant_is_no_complaint():
    data = turned({5: 10}) | {"neutral_soles": "tilted"}
    assert tilts(Specification.model_validate(data)) == []
