"""A closure file beside a description that closes loops itself."""

from pathlib import Path

import pytest

from thesis_pin.model.formats.closure_file import ClosureFile
from thesis_pin.model.formats.joining import joined
from thesis_pin.model.formats.urdf.reading import read_urdf
from thesis_pin.model.mechanism.closure_types import word_of

LOOPS = Path(__file__).parents[2] / "loops" / "data"
URDF = (LOOPS / "five_bar.urdf").read_text()


def closures(text):
    return ClosureFile.parse(text).supplement()


def names(description):
    return [(one.name, word_of(one.rows)) for one in description.supplement.closures]


LOOP = (
    '<loop name="{}" type="revolute"><predecessor link="{}"/><successor link="{}"/>'
    '<axis xyz="0 1 0"/></loop></robot>'
)
FILE = "closed_loop: [[left_tip, right_tip]]\ntype: ['3d']\nname_mot: [motor_left, motor_right]\n"


def test_a_closure_files_loop_replaces_the_urdfs_between_the_same_bodies():
    text = URDF.replace("</robot>", LOOP.format("drawn", "left_bar", "right_bar"))
    found = joined(read_urdf(text, where="r.urdf"), closures(FILE))
    assert names(found) == [("left_tip – right_tip", "3d")]
    (line,) = found.passed_over
    assert line == "r.urdf: <loop> 'drawn': the closure file closes it otherwise"


def test_loops_between_other_bodies_are_kept():
    text = URDF.replace("</robot>", LOOP.format("drawn", "left_crank", "right_bar"))
    found = joined(read_urdf(text), closures(FILE))
    assert names(found) == [("drawn", "hinge_z"), ("left_tip – right_tip", "3d")]


def test_frames_that_look_like_a_loop_are_closed_as_the_closure_file_says():
    text = URDF.replace("left_tip", "closing_a_1").replace("right_tip", "closing_a_2")
    alone = read_urdf(text)
    assert names(alone) == [("closing_a", "hinge_z")]
    file = FILE.replace("left_tip", "closing_a_1").replace("right_tip", "closing_a_2")
    found = joined(alone, closures(file.replace("3d", "6d")))
    assert names(found) == [("closing_a_1 – closing_a_2", "6d")]
    assert found.warnings == ()


def test_frames_that_look_like_a_loop_stay_open_with_a_warning_if_the_file_closes_others():
    text = URDF.replace("left_tip", "closing_a_1").replace("right_tip", "closing_a_2")
    file = FILE.replace("left_tip", "left_crank").replace("right_tip", "right_bar")
    found = joined(read_urdf(text, where="r.urdf"), closures(file))
    assert names(found) == [("left_crank – right_bar", "3d")]
    (line,) = found.warnings
    assert "'closing_a_1' and 'closing_a_2' look like a loop" in line


def test_a_closure_file_without_loops_leaves_those_of_the_frames():
    text = URDF.replace("left_tip", "closing_a_1").replace("right_tip", "closing_a_2")
    file = "closed_loop: []\ntype: []\nname_mot: [motor_left]\n"
    found = joined(read_urdf(text), closures(file))
    assert names(found) == [("closing_a", "hinge_z")]
    assert [motor.joint for motor in found.supplement.motors] == ["motor_left"]


@pytest.mark.parametrize(("file", "motors"), [(FILE, ["motor_left", "motor_right"]), ("", [])])
def test_motors_are_those_of_the_closure_file_also_if_it_names_none(file, motors):
    text = URDF.replace('name="motor_right"', 'name="motor_right" independent="true"')
    found = read_urdf(text)
    empty = "closed_loop: []\ntype: []\nname_mot: []\nthesis_pin: {format: 1}\n"
    found = joined(found, closures(file or empty))
    assert [motor.joint for motor in found.supplement.motors] == motors
