"""Robots that no one here made load, or are refused for what is wrong with them."""

import numpy as np
import pinocchio as pin
import pytest
from example_robots import urdf_files

import thesis_pin
from thesis_pin.errors import ModelError, NonPhysicalInertia
from thesis_pin.loops.loading import load

REFUSED = {
    "romeo_small.urdf": (NonPhysicalInertia, "exceeds the sum of the others by 0.00522"),
    "romeo_laas_small.urdf": (NonPhysicalInertia, "smallest is -0.00282 kg"),
    "ur3.urdf": (ModelError, "there is no <link>"),  # Pinocchio doesn't read it either
}


@pytest.mark.parametrize("file", urdf_files(), ids=lambda file: f"{file.parts[-3]}-{file.stem}")
def test_every_urdf_of_the_examples_loads_or_says_why_not(file):
    if file.name in REFUSED:
        error, says = REFUSED[file.name]
        with pytest.raises(error, match=says) as caught:
            load(file)
        assert file.name in str(caught.value)
        return
    found = load(file)
    plain = pin.buildModelFromUrdf(str(file))
    assert list(found.model.names) == list(plain.names)
    free = plain.nv - len(found.couplings)
    assert len(found.motors) == free  # without a closure file, all that nothing else moves


@pytest.mark.parametrize(
    ("name", "cuts"),
    [
        ("cassie", "left-pitch-rod-joint right-pitch-rod-joint left-shin-spring-joint"),
        ("cassie_v2", "left-pitch-rod-joint right-pitch-rod-joint left-plantar-foot-joint"),
        ("cassie_simple", ""),
        ("cassie_reduced", ""),
        ("cassie_wo_gearbox_spring", ""),
    ],
)
def test_cassies_sdfs_load_and_their_cuts_are_named(name, cuts):
    found = thesis_pin.load(f"example:{name}")
    notes = [note for note in found.description.warnings if "the loop is cut here" in note]
    assert len(notes) == len(found.loops) > 0
    for cut in cuts.split():
        assert any(f"joint '{cut}'" in note for note in notes)


def test_a_free_flyer_is_set_under_any_robot():
    fixed, flying = (
        load("example:solo12", root_joint=r) for r in (None, pin.JointModelFreeFlyer())
    )
    assert flying.model.nv == fixed.model.nv + 6
    q = pin.neutral(flying.model)
    weight = pin.rnea(flying.model, flying.model.createData(), q, np.zeros(18), np.zeros(18))[2]
    assert weight == pytest.approx(9.81 * pin.computeTotalMass(flying.model), rel=1e-12)


HEAVY = """<robot name="odd"><link name="base"/><link name="arm"><inertial>
<origin xyz="0.05 0 0"/><mass value="0.3"/>
<inertia ixx="250" ixy="0" ixz="0" iyy="250" iyz="0" izz="250"/></inertial></link>
<joint name="turn" type="continuous"><parent link="base"/><child link="arm"/>
<axis xyz="0 0 1"/></joint></robot>"""


def test_who_loads_a_robot_in_python_is_warned_of_sizes_that_cannot_be(tmp_path):
    file = tmp_path / "odd.urdf"
    file.write_text(HEAVY)
    with pytest.warns(thesis_pin.ModelWarning, match=r"odd\.urdf: .*radius of gyration is 28\.9 m"):
        robot = thesis_pin.load(file)
    assert robot.description.warnings
