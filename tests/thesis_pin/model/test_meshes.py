"""Meshes are found where ROS users, exporters and others put them."""

from pathlib import Path

import pinocchio as pin
import pytest

from thesis_pin.errors import ModelError
from thesis_pin.loops.loading import load
from thesis_pin.model.formats.urdf.reading import read
from thesis_pin.model.meshes import with_mesh_paths

OBJ = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n"
BODY = (
    '<inertial><origin xyz="0.1 0 0"/><mass value="1"/>'
    '<inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial>'
)


@pytest.fixture
def package(tmp_path):
    """arm_description with urdf and meshes beside each other."""
    folder = tmp_path / "ws" / "arm_description"
    (folder / "urdf").mkdir(parents=True)
    (folder / "meshes").mkdir()
    (folder / "meshes" / "arm.obj").write_text(OBJ)

    def written(name, tag="visual"):
        file = folder / "urdf" / "arm.urdf"
        shape = f'<{tag}><geometry><mesh filename="{name}"/></geometry></{tag}>'
        file.write_text(
            f'<robot name="r"><link name="base"/><link name="arm">{BODY}{shape}</link>'
            '<joint name="j" type="revolute"><parent link="base"/><child link="arm"/>'
            '<limit lower="-1" upper="1" effort="1" velocity="1"/></joint>'
            "</robot>"
        )
        return file

    return folder, written


def names(*forms):
    return pytest.mark.parametrize("name", forms)


@names(
    "package://arm_description/meshes/arm.obj",
    "model://arm_description/meshes/arm.obj",
    "../meshes/arm.obj",
    "meshes/arm.obj",
    "package:///arm_description/meshes/arm.obj",
)
def test_meshes_are_found_from_the_urdfs_folder_upwards(package, name):
    folder, written = package
    (shape,) = load(written(name)).visual_model.geometryObjects
    assert shape.meshPath == str(folder / "meshes" / "arm.obj")


@names("file://{}/meshes/arm.obj", "{}/meshes/arm.obj")
def test_absolute_names_are_taken(package, name):
    folder, written = package
    (shape,) = load(written(name.format(folder))).visual_model.geometryObjects
    assert shape.meshPath == str(folder / "meshes" / "arm.obj")


@pytest.mark.parametrize("variable", ["ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH"])
@pytest.mark.parametrize("inside", ["other", "share/other", ""])
def test_packages_of_the_environment_are_looked_in_first(package, tmp_path, variable, inside):
    _, written = package
    there = tmp_path / "elsewhere" / "other"
    (root := there / inside).mkdir(parents=True)
    (root / "arm.obj").write_text(OBJ)
    description = read(written("package://other/arm.obj"))
    text = with_mesh_paths(description, "visual", {variable: f"/nowhere:{there}"})
    assert str(root / "arm.obj") in text


def test_a_missing_mesh_is_told_with_link_and_folders_when_geometry_is_asked_for(package):
    folder, written = package
    found = load(written("package://arm_description/meshes/leg.obj"))
    assert found.model.nv == 1
    assert list(found.collision_model.geometryObjects) == []  # it has none
    with pytest.raises(ModelError) as caught:
        found.visual_model  # noqa: B018
    text = str(caught.value)
    assert "arm.urdf: link 'arm': the mesh 'package://arm_description/meshes/leg.obj'" in text
    assert f"{folder / 'urdf'} and every folder above it" in text
    assert "ROS_PACKAGE_PATH" in text


def test_pinocchio_alone_does_not_find_the_usual_layout(package):
    _, written = package
    file = written("package://arm_description/meshes/arm.obj")
    model = pin.buildModelFromUrdf(str(file))
    with pytest.raises(ValueError, match=r"arm\.obj"):
        pin.buildGeomFromUrdfString(
            model, file.read_text(), pin.GeometryType.VISUAL, package_dirs=[str(file.parent)]
        )


def test_collision_meshes_are_found_too(package):
    folder, written = package
    found = load(written("package://arm_description/meshes/arm.obj", "collision"))
    (shape,) = found.collision_model.geometryObjects
    assert shape.meshPath == str(folder / "meshes" / "arm.obj")


def test_a_mesh_that_is_no_mesh_is_our_error(package):
    folder, written = package
    (folder / "meshes" / "arm.obj").write_bytes(b"\x00\x01")
    with pytest.raises(ModelError, match="can't read its geometry"):
        load(written("../meshes/arm.obj")).visual_model  # noqa: B018


def test_meshes_of_other_formats_are_looked_for_from_their_file_too():
    found = load("example:cassie").visual_model.geometryObjects
    assert {Path(shape.meshPath).name for shape in found} >= {"pelvis.stl", "knee-spring.stl"}
