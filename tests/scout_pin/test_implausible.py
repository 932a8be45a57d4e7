"""Sizes that nobody builds: named, whatever the unit mistaken, and never on robots there are."""

import warnings
from pathlib import Path

import numpy as np
import pytest

import scout_pin
from scout_pin.implausible import implausible
from scout_pin.specification import Specification
from thesis_pin.errors import ModelWarning
from thesis_pin.model.mechanism.plausible import density

EXAMPLES = Path(__file__).parents[2] / "examples"
LENGTHS = ("x_0", "z_1", "x_2", "x_3", "x_4", "x_5", "y_6")


def changed(change):
    data = Specification.read(EXAMPLES / "lopsided.toml").model_dump()
    change(data)
    return Specification.model_validate(data)


def legs(data):
    return [data["legs"][side] for side in ("left", "right")]


def heavy_torso(data):
    data["torso"]["mass"] = 600.0


def long_shank(data):
    data["legs"]["left"]["x_4"] = 100.0


def millimetres(data):
    for leg in legs(data):
        for name in LENGTHS:
            leg[name] *= 1e3


def grams(data):
    for body in (data["torso"], *(link for leg in legs(data) for link in leg["links"])):
        body["mass"] *= 1e3
        body["inertia"] = tuple(tuple(1e3 * x for x in row) for row in body["inertia"])


def square_millimetres(data):
    data["torso"]["inertia"] = tuple(
        tuple(1e6 * x for x in row) for row in data["torso"]["inertia"]
    )


def radians(data):
    data["assumptions"]["joint_range"] |= {"lower_deg": -1.5708, "upper_deg": 1.5708}


def sole_in_millimetres(data):
    leg = data["legs"]["right"]
    leg["sole"] = tuple((1e3 * x, 1e3 * y) for x, y in leg["sole"])


def far_mass(data):
    data["torso"]["com"] = (0.0, 0.0, 40.0)


def weak(data):
    for servo in data["servos"].values():
        servo["stall_torque"] /= 1000.0


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (heavy_torso, "torso: 600 kg with moments of inertia this small"),
        (long_shank, "left_shank: it is 100 m long"),
        (millimetres, "right_thigh: it is"),
        (grams, "osmium"),
        (square_millimetres, "torso: its radius of gyration is"),
        (radians, "Are the ranges in degrees?"),
        (sole_in_millimetres, "right sole: it is"),
        (far_mass, "torso: its centre of mass is 40 m from its joint"),
        (weak, "the strongest actuator gives 0.002 N·m"),
    ],
)
def test_a_mistaken_unit_is_named_and_warned_of_when_the_robot_is_loaded(change, says):
    specification = changed(change)
    found = implausible(specification)
    assert any(says in one for one in found)
    with pytest.warns(ModelWarning) as warned:
        scout_pin.load(specification)
    assert [str(one.message) for one in warned] == found


@pytest.mark.parametrize("name", [None, "lopsided.toml"])
def test_robots_there_are_stay_unmentioned_at_any_scale(name):
    """From a quarter to ten times the size, with the masses and torques that go with it."""
    path = EXAMPLES / name if name else None
    for scale in (0.25, 1.0, 3.0, 10.0):
        data = Specification.read(path).model_dump()
        for leg in legs(data):
            for length in LENGTHS:
                leg[length] *= scale
            leg["sole"] = tuple((scale * x, scale * y) for x, y in leg["sole"])
        for body in (data["torso"], *(link for leg in legs(data) for link in leg["links"])):
            body["mass"] *= scale**3
            body["com"] = tuple(scale * x for x in body["com"])
            body["inertia"] = tuple(tuple(scale**5 * x for x in row) for row in body["inertia"])
        for servo in data["servos"].values():
            servo["stall_torque"] *= scale**3
            servo["size"] = tuple(scale * x for x in servo["size"])
        assert implausible(Specification.model_validate(data)) == []


def test_the_density_of_an_ellipsoid_is_exact_and_of_a_box_is_below_its_own():
    a, b, c = 0.1, 0.2, 0.3
    mass = 5.0
    ellipsoid = mass / 5 * np.diag([b**2 + c**2, a**2 + c**2, a**2 + b**2])
    assert density(mass, ellipsoid) == pytest.approx(mass / (4 / 3 * np.pi * a * b * c))
    box = mass / 12 * np.diag([b**2 + c**2, a**2 + c**2, a**2 + b**2])
    assert 0.85 < density(mass, box) / (mass / (a * b * c)) < 1.0


def test_the_report_says_what_it_took_as_it_was():
    specification = changed(heavy_torso)
    with warnings.catch_warnings(action="ignore", category=ModelWarning):
        robot = scout_pin.load(specification)
    report = scout_pin.gait_report(
        robot, scout_pin.load_gait(EXAMPLES / "lopsided_walk.toml"), samples=11
    )
    odd = [one for one in report.document()["assumptions"] if one["name"] == "implausible size"]
    assert [one["why"] for one in odd] == implausible(specification)
    assert report.document()["summary"]["implausible"] == implausible(specification)
