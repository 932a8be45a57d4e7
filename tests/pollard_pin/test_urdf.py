"""The generated files: current, reproducible, readable by everyone's tools."""

from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest
import yaml

import pollard_pin
from pollard_pin.specification import JOINT_NAMES, LINK_NAMES, SKEWED_PATH, Specification
from pollard_pin.urdf import files, urdf
from thesis_pin.loops.loading import load
from thesis_pin.model.loading import model_folder

SPECIFICATIONS = [None, SKEWED_PATH]


@pytest.mark.bytes
def test_checked_in_files_are_those_the_specifications_give():
    folder = model_folder("pollard")
    generated = {}
    for path in SPECIFICATIONS:
        generated |= files(Specification.read(path))
    present = {str(p.relative_to(folder)) for p in Path(folder).rglob("*") if p.is_file()}
    assert present == set(generated)
    for name, text in generated.items():
        assert (folder / name).read_bytes() == text.encode(), f"{name} is stale: pollard-pin urdf"


def test_generating_twice_gives_the_same_bytes():
    assert files(Specification.read()) == files(Specification.read())


def test_path_constants_name_the_default_files():
    assert Path(pollard_pin.URDF_PATH).read_text() == urdf(Specification.read())
    assert Path(pollard_pin.CLOSURE_PATH).parent == Path(pollard_pin.PACKAGE_PATH)


def test_urdf_and_closure_file_alone_give_the_same_robot(pollard, rng):
    other = load(pollard_pin.URDF_PATH, pollard_pin.CLOSURE_PATH)
    assert other.actuators == pollard.actuators
    np.testing.assert_array_equal(other.actuated, pollard.actuated)
    q, v, a = rng.uniform(-1, 1, (3, 12))
    mine = pin.rnea(pollard.model, pollard.model.createData(), q, v, a)
    theirs = pin.rnea(other.model, other.model.createData(), q, v, a)
    np.testing.assert_allclose(theirs, mine, atol=1e-15)


def test_closure_file_has_the_communitys_keys_and_one_of_ours():
    content = yaml.safe_load(Path(pollard_pin.CLOSURE_PATH).read_text())
    assert set(content) == {
        "closed_loop",
        "type",
        "name_mot",
        "joint_name",
        "joint_type",
        "thesis_pin",
    }
    # The community's loaders match motors by part of a name: each must match one joint only.
    for motor in content["name_mot"]:
        assert [name for name in JOINT_NAMES if motor in name] == [motor]


@pytest.mark.parametrize("path", SPECIFICATIONS)
@pytest.mark.parametrize("inertia", ["physical", "printed"])
def test_masses_and_inertias_survive_the_urdf_to_rounding(path, inertia):
    robot = pollard_pin.load(path, inertia=inertia)
    spec, moving = robot.specification, iter(LINK_NAMES)
    for body in list(robot.model.inertias)[1:]:
        if body.mass == 0.0:
            continue
        link = next(moving)
        assert body.mass == spec.links[link].mass
        np.testing.assert_allclose(body.lever, spec.com(link), atol=1e-16)
        tensor = spec.centroidal(link, inertia)
        # Pinocchio adds the massless frames to their link, which costs a rounding.
        rounding = 4 * np.finfo(float).eps * np.abs(tensor).max()
        np.testing.assert_allclose(body.inertia, tensor, rtol=0, atol=rounding)
    assert next(moving, None) is None


def test_limits_reach_the_model(pollard):
    np.testing.assert_allclose(pollard.model.lowerPositionLimit, pollard.lower)
    np.testing.assert_allclose(pollard.model.upperPositionLimit, pollard.upper)
    assert pollard.model.nq == pollard.model.nv == 12


def test_robot_is_a_robot_wrapper_in_all_but_name(pollard):
    wrapper = pollard.wrapper
    assert isinstance(wrapper, pin.RobotWrapper)
    assert wrapper.model.nq == 12
    assert len(pollard.visual_model.geometryObjects) > 10


def test_drawn_rods_end_at_the_drawn_ball_joints(robot):
    """At a closed pose the rod's cylinder ends where the forearm's ball sits."""
    q = robot.inverse_kinematics([0.45, 0.05, 0.05, 0.1, 0.2, 0.1]).angles
    data, geometry = robot.model.createData(), pin.GeometryData(robot.visual_model)
    pin.forwardKinematics(robot.model, data, q)
    pin.updateGeometryPlacements(robot.model, data, robot.visual_model, geometry)
    placed = {
        item.name: (item, place)
        for item, place in zip(robot.visual_model.geometryObjects, geometry.oMg, strict=True)
    }
    for i in (1, 2):
        rod, place = placed[f"chain{i}_rod_0"]
        end = place.act(np.array([0.0, 0.0, rod.geometry.halfLength]))
        balls = [
            place.translation
            for name, (item, place) in placed.items()
            if name.startswith("forearm") and type(item.geometry).__name__ == "Sphere"
        ]
        assert min(np.linalg.norm(end - ball) for ball in balls) < 1e-9
