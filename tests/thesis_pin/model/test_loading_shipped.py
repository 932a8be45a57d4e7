"""Robots that ship are loaded without reading their URDF twice, and are the same robots."""

import pickle
import subprocess
import sys

import numpy as np
import pinocchio as pin
import pytest

import pollard_pin
import scout_pin
from pollard_pin.closure import closures, supplement
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.model.loading import LoadedRobot, check_urdf

READINGS = ("physical", "printed")


def same(quick, checked):
    for name in ("nq", "nv"):
        assert getattr(quick, name) == getattr(checked, name)
    assert list(quick.names) == list(checked.names)
    assert [f.name for f in quick.frames] == [f.name for f in checked.frames]
    for one, other in zip(quick.inertias, checked.inertias, strict=True):
        np.testing.assert_array_equal(one.toDynamicParameters(), other.toDynamicParameters())
    for one, other in zip(quick.jointPlacements, checked.jointPlacements, strict=True):
        np.testing.assert_array_equal(one.homogeneous, other.homogeneous)
    for name in ("upperPositionLimit", "upperEffortLimit", "damping", "upperDryFrictionLimit"):
        np.testing.assert_array_equal(getattr(quick, name), getattr(checked, name))


@pytest.mark.parametrize("inertia", READINGS)
@pytest.mark.parametrize("root", ["free_flyer", "thesis"])
def test_scout_is_the_robot_of_its_checked_urdf(inertia, root):
    robot = scout_pin.load(root=root, inertia=inertia)
    checked = LoadedRobot(robot.urdf, {}, pin.JointModelFreeFlyer())
    if root == "free_flyer":
        same(robot.model, checked.model)
    assert list(robot.description.joints) == list(check_urdf(robot.urdf).joints)
    assert robot.description.warnings == ()
    assert pickle.loads(pickle.dumps(robot)).description.text == robot.urdf


@pytest.mark.parametrize("inertia", READINGS)
def test_pollard_is_the_robot_of_its_checked_urdf_and_closure_file(inertia):
    robot = pollard_pin.load(inertia=inertia)
    checked = ClosedRobot(robot.urdf, closures(robot.specification))
    same(robot.model, checked.model)
    assert robot.description.supplement == checked.description.supplement
    assert robot.supplement == checked.supplement
    assert robot.motors == checked.motors
    assert [loop.frames for loop in robot.loops] == [loop.frames for loop in checked.loops]
    assert robot.description.warnings == checked.description.warnings
    assert pickle.loads(pickle.dumps(robot)).supplement == robot.supplement


def test_pollards_supplement_is_what_its_closure_file_says():
    for path in (None, pollard_pin.specification.SKEWED_PATH):
        specification = pollard_pin.Specification.read(path)
        assert supplement(specification) == closures(specification).supplement()
    data = specification.model_dump()
    data["motors"] = {"rotor_inertia": 3.7e-6, "gear_ratio": (53.1, 10, 1, 2, 3, 0.5)}
    geared = pollard_pin.Specification.model_validate(data)
    assert supplement(geared) == closures(geared).supplement()


@pytest.mark.parametrize("package", ["scout_pin", "pollard_pin"])
def test_only_what_ships_is_taken_for_sound(package):
    """Another robot's URDF is read and checked when it is loaded, a shipped one's isn't."""
    code = (
        f"import sys, {package}\n"
        f"specification = {package}.Specification.read()\n"
        "reader = 'thesis_pin.model.formats.urdf.reading'\n"
        f"{package}.load(specification)\n"
        "print(reader in sys.modules, end=' ')\n"
        f"{package}.load(specification.model_copy(update={{'name': 'other'}}))\n"
        "print(reader in sys.modules)\n"
    )
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert ran.stdout == "False True\n"
