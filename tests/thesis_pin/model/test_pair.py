"""What is written reads back to the same robot, whatever it was read from."""

from dataclasses import fields
from math import inf

import numpy as np
import pinocchio as pin
import pytest
from example_robots import urdf_files
from hypothesis import given, settings
from hypothesis import strategies as st

from thesis_pin.loops.loading import load
from thesis_pin.model.formats.closure_file import ClosureFile
from thesis_pin.model.formats.reading import read
from thesis_pin.model.mechanism.supplement import Closure, Coupling, Motor, Spring, Supplement
from thesis_pin.model.pair import closure_text, pair, write

FULL = Supplement(
    closures=(
        Closure("tip", ("a", "b"), (True, True, True, False, False, False)),
        Closure("hinge", ("c", "d"), (True, True, True, True, True, False)),
        Closure("rod: 'odd' \"name\"", ("é", "f"), (False,) * 6, 0.3),
        Closure("mask", ("g", "h"), (True, False, False, False, False, True)),
    ),
    couplings=(Coupling("gear", {"j": 1.0, "k": -9.33}, 0.1), Coupling("stop", {"k": 1e-05})),
    motors=(
        Motor("m", "j", 6.0, 1e-6, (-2.0, inf), 30.0),
        Motor("k", "k"),
        Motor("l", "l", effort=(-inf, 3.5)),
    ),
    joint_types={"ball": "SPHERICAL", "uni": "UJOINT_ZY"},
    springs=(Spring("k", 1500.0, -0.1),),
    armature={"j": 0.038},
    damping={"j": 1e-3},
    friction={"k": 0.2},
    poses={"home": {"j": (0.1,), "ball": (0.0, 0.0, 0.6, 0.8)}, "no": {}},
    free_root=True,
    gravity=(0.0, 0.0, -1.62),
)


def back(supplement):
    return ClosureFile.parse(closure_text(supplement, "r")).supplement()


def test_every_part_of_a_supplement_is_written_and_read_back():
    empty = Supplement()
    for field in fields(Supplement):
        assert getattr(FULL, field.name) != getattr(empty, field.name), "give it a value here"
    assert back(FULL) == FULL
    assert back(empty) == empty


@settings(deadline=None, max_examples=50)
@given(
    st.dictionaries(
        st.text(st.characters(codec="utf-8", exclude_categories=("C", "Z")), min_size=1),
        st.floats(0, 1e9),
        max_size=5,
    )
)
def test_names_and_numbers_survive_whatever_they_look_like(values):
    """yes, 1, 1e5, ~ and [ are names too, and every digit counts."""
    beside = Supplement(armature=values, motors=tuple(Motor(name, name) for name in values))
    assert back(beside) == beside


def same_robot(one, other):
    assert list(one.model.names) == list(other.model.names)
    assert [(a.name, a.kind, a.frames) for a in one.loops] == [
        (a.name, a.kind, a.frames) for a in other.loops
    ]
    assert one.motors == other.motors
    assert one.couplings == other.couplings
    q = pin.neutral(one.model)
    v, a = np.linspace(0.1, 0.5, one.model.nv), np.linspace(-0.3, 0.4, one.model.nv)
    np.testing.assert_array_equal(
        pin.rnea(one.model, one.model.createData(), q, v, a),
        pin.rnea(other.model, other.model.createData(), q, v, a),
    )


@pytest.mark.parametrize("name", ["panda", "cassie_v2", "talos_full_v2", "solo12", "baxter"])
def test_examples_of_every_kind_read_back_to_the_same_robot(name, tmp_path):
    """Tied fingers, loops cut out of an SDF, a plain tree."""
    first = load(f"example:{name}")
    urdf, closures = sorted(write(first.description, tmp_path), reverse=True)
    assert (urdf.suffix, closures.name[-14:]) == (".urdf", ".closures.yaml")
    same_robot(first, load(urdf, closures))


def test_a_urdf_is_written_as_it_was():
    file = next(file for file in urdf_files() if file.name == "panda.urdf")
    written = pair(read(file))
    assert written["panda.urdf"] == file.read_text()
    assert "panda_finger_joint2 follows panda_finger_joint1" in written["panda.closures.yaml"]


def test_relative_meshes_are_found_from_the_new_place(tmp_path):
    here, there = tmp_path / "here", tmp_path / "there"
    here.mkdir()
    (here / "a.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n")
    shape = '<visual><geometry><mesh filename="a.obj"/></geometry></visual>'
    (here / "r.urdf").write_text(f'<robot name="a/b c"><link name="base">{shape}</link></robot>')
    _, urdf = sorted(write(read(here / "r.urdf"), there))
    assert urdf.name == "a_b_c.urdf"
    (found,) = load(urdf).visual_model.geometryObjects
    assert found.meshPath == str(here / "a.obj")
