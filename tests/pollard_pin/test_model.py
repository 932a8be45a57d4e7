"""load() and the package's public names."""

import os
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

import pollard_pin
from pollard_pin.dynamics.inverse import inverse_dynamics_at
from pollard_pin.specification import ACTUATORS, PASSIVE, SKEWED_PATH, Specification
from thesis_pin.errors import BadInput, SpecificationError, UnknownName
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.model.loading import LoadedRobot


@pytest.mark.parametrize("name", pollard_pin.__all__)
def test_every_public_name_exists_and_stays_what_it_is(name):
    first, second = getattr(pollard_pin, name), getattr(pollard_pin, name)
    assert first is second
    assert not isinstance(first, ModuleType)


def test_an_unknown_name_is_an_attribute_error():
    with pytest.raises(AttributeError, match="pollard_pin attribute nothing"):
        pollard_pin.nothing  # noqa: B018


def test_importing_the_package_imports_nothing_heavy():
    code = "import sys, pollard_pin; print({'numpy', 'pinocchio', 'pydantic'} & set(sys.modules))"
    done = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        check=True,
        env=os.environ | {"PYTHONPATH": str(Path(__file__).parents[2])},
    )
    assert done.stdout.strip() == "set()"


def test_load_takes_nothing_a_path_or_a_specification(skewed):
    assert pollard_pin.load().specification.name == "pollard"
    spec = Specification.read(SKEWED_PATH)
    again = pollard_pin.load(spec)
    assert again.urdf == skewed.urdf == pollard_pin.load(str(SKEWED_PATH)).urdf


def test_robot_is_loaded_closed_and_knows_its_motors(pollard):
    assert isinstance(pollard, LoadedRobot)
    assert isinstance(pollard, ClosedRobot)
    assert pollard.actuators == pollard_pin.ACTUATOR_NAMES
    assert tuple(pollard.actuated) == ACTUATORS
    assert tuple(pollard.passive) == PASSIVE
    assert [type(m).__name__ for m in pollard.constraint_models] == [
        "PointAnchorConstraintModel"
    ] * 2
    assert len(pollard.rigid_constraint_models()) == 2
    assert pollard.mass == pytest.approx(0.92)


def test_inertia_readings_differ_and_others_are_refused(pollard, printed):
    assert pollard.urdf != printed.urdf
    np.testing.assert_array_equal(pollard.geometry.anchors, printed.geometry.anchors)
    with pytest.raises(UnknownName, match="physical, printed"):
        pollard_pin.load(inertia="guessed")


def test_a_missing_or_broken_file_is_named(tmp_path):
    with pytest.raises(BadInput, match=r"none\.toml: can't read the specification"):
        pollard_pin.load(tmp_path / "none.toml")
    (tmp_path / "empty.toml").write_text("")
    with pytest.raises(SpecificationError, match=r"empty\.toml"):
        pollard_pin.load(tmp_path / "empty.toml")


def test_robots_do_not_share_state(pollard, skewed, rng):
    """Two robots used in turns answer as each does alone."""
    pose = np.array([0.46, 0.02, 0.03, 0.1, 0.05, -0.1])
    alone = [robot.inverse_kinematics(pose).angles for robot in (pollard, skewed)]
    for _ in range(3):
        for robot, angles in zip((pollard, skewed), alone, strict=True):
            np.testing.assert_array_equal(robot.inverse_kinematics(pose).angles, angles)
            rest = inverse_dynamics_at(robot, angles, np.zeros(12), np.zeros(12))
            assert np.isfinite(rest.torque).all()
