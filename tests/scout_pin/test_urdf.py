"""The generated files: current, reproducible, and complete."""

from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest

import scout_pin
from scout_pin.specification import Specification
from scout_pin.urdf import files, urdf
from thesis_pin.model.loading import model_folder

from .conftest import EXAMPLES


@pytest.mark.bytes
def test_checked_in_files_are_those_the_specification_gives():
    folder = model_folder("scout")
    generated = files(Specification.read())
    present = {str(p.relative_to(folder)) for p in Path(folder).rglob("*") if p.is_file()}
    assert present == set(generated)
    for name, text in generated.items():
        assert (folder / name).read_bytes() == text.encode(), f"{name} is stale: scout-pin urdf"


def test_generating_twice_gives_the_same_bytes():
    assert files(Specification.read()) == files(Specification.read())


def test_path_constants_name_the_default_urdf():
    assert Path(scout_pin.URDF_PATH).read_text() == urdf(Specification.read())
    assert Path(scout_pin.URDF_PATH).parent == Path(scout_pin.PACKAGE_PATH)


def test_urdf_loads_from_its_path_with_plain_pinocchio_and_its_meshes():
    robot = pin.RobotWrapper.BuildFromURDF(
        scout_pin.URDF_PATH, scout_pin.PACKAGE_PATH, pin.JointModelFreeFlyer()
    )
    assert (robot.model.nq, robot.model.nv) == (19, 18)
    assert robot.model.names[1] == "root_joint"
    meshes = [g for g in robot.visual_model.geometryObjects if g.meshPath.endswith(".obj")]
    assert len(meshes) == 2


@pytest.mark.parametrize("specification", [None, EXAMPLES / "lopsided.toml"])
@pytest.mark.parametrize("inertia", ["physical", "printed"])
def test_masses_and_inertias_survive_the_urdf_to_rounding(specification, inertia):
    robot = scout_pin.load(specification, inertia=inertia)
    spec = robot.specification
    links = [spec.torso, *spec.legs.left.links, *spec.legs.right.links]
    for body, link in zip(list(robot.model.inertias)[1:], links, strict=True):
        # Pinocchio adds the massless sole to the foot, which costs a rounding.
        assert body.mass == pytest.approx(link.mass, rel=1e-15)
        np.testing.assert_allclose(body.lever, link.com, atol=1e-16)
        tensor = link.centroidal(spec.inertia_convention, inertia)
        np.testing.assert_allclose(body.inertia, tensor, rtol=0, atol=1e-18)


def test_soles_are_extruded_from_their_outlines(scout):
    mesh = files(scout.specification)["meshes/left_sole.obj"].splitlines()
    vertices = np.array([line.split()[1:] for line in mesh if line.startswith("v ")], float)
    faces = np.array([line.split()[1:] for line in mesh if line.startswith("f ")], int) - 1
    assert len(vertices) == 40
    # Volume by the divergence theorem against area (shoelace) times thickness.
    a, b, c = vertices[faces[:, 0]], vertices[faces[:, 1]], vertices[faces[:, 2]]
    volume = np.einsum("ij,ij->", a, np.cross(b, c)) / 6
    x, y = np.array(scout.specification.legs.left.sole).T
    area = abs(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))) / 2
    assert volume == pytest.approx(area * 2e-3, rel=1e-9)


def test_geometry_stands_on_the_floor_in_the_neutral_pose(scout):
    data = scout.model.createData()
    q = scout.q0.copy()
    q[2] = -scout.neutral_feet()["left"][2, 3]
    pin.forwardKinematics(scout.model, data, q)
    geometry = pin.GeometryData(scout.visual_model)
    pin.updateGeometryPlacements(scout.model, data, scout.visual_model, geometry)
    lowest = []
    for item, place in zip(scout.visual_model.geometryObjects, geometry.oMg, strict=True):
        if item.meshPath.endswith(".obj"):
            vertices = item.geometry.vertices() @ place.rotation.T + place.translation
            lowest.append(vertices[:, 2].min())
    assert len(lowest) == 2
    np.testing.assert_allclose(lowest, 0.0, atol=1e-12)
