"""What a report says of its branches: taken, by whom, and what else would do."""

import warnings
from dataclasses import replace

import numpy as np
import pytest

import scout_pin
from scout_pin.report.drawn.page import gait_page
from scout_pin.report.tables import summary
from scout_pin.specification import Specification
from thesis_pin.errors import ModelWarning


@pytest.fixture(scope="module")
def straight():
    """The thesis's robot with both legs straight in the neutral pose, where the knees tie."""
    data = Specification.read().model_dump() | {"name": "straight"}
    data["legs"]["left"]["beta_deg"] = (180.0, 90.0, 0.0, 0.0, 75.0, 180.0)
    data["legs"]["right"]["beta_deg"] = (0.0, 90.0, 0.0, 0.0, 285.0, 0.0)
    data["assumptions"]["joint_range"] |= {"lower_deg": -120.0, "upper_deg": 120.0}
    return data


SQUAT = """
format = 1
name = "squat"
time_unit = 1.0
interpolation = "quintic"
{keys}
[torso]
y_mm = 47.13
z_mm = [ {{ t = [0, 1, 2], value = [225, 205, 225] }} ]
[left_foot]
x_mm = -44.54
[right_foot]
x_mm = 44.54
[[phases]]
start = 0
end = 2
support = "double"
"""


@pytest.fixture
def gait(tmp_path):
    def load(keys=""):
        path = tmp_path / "squat.toml"
        path.write_text(SQUAT.format(keys=keys))
        return scout_pin.load_gait(path)

    return load


def report(data, gait, **options):
    return scout_pin.gait_report(
        scout_pin.load(Specification.model_validate(data)), gait, samples=21, **options
    )


def test_a_tie_is_warned_of_and_stated_in_text_json_and_page(straight, gait):
    with pytest.warns(ModelWarning, match="backward is as near to the neutral pose"):
        found = report(straight, gait())
    sentence = found.stance.sentence()
    assert sentence.startswith("Knees bend forward (left +++, right -+-): the default")
    assert 'knee = "backward"' in sentence
    assert sentence in list(summary(found))
    parameters = found.document()["parameters"]
    assert parameters["branch"] is None
    assert parameters["branches"] == ["+++", "-+-"]
    assert parameters["knees"] == ["forward", "forward"]
    assert parameters["branch_choice"] == sentence
    assert b"Knees bend forward (left +++, right -+-)" in gait_page(found)


@pytest.mark.parametrize("way", ["forward", "backward"])
def test_who_chose_is_said_and_nothing_is_warned_of(straight, gait, way):
    other = {"forward": "backward", "backward": "forward"}[way]
    with warnings.catch_warnings():
        warnings.simplefilter("error", ModelWarning)
        by_robot = report(straight | {"knee": way}, gait())
        by_gait = report(straight | {"knee": other}, gait(f'knee = "{way}"'))
        by_argument = report(straight | {"knee": other}, gait(f'branch = "{other}"'), branch=way)
    for found, who in ((by_robot, "specification"), (by_gait, "gait"), (by_argument, "asked")):
        assert found.stance.chosen == who
        assert found.stance.knees == (way, way)
        assert found.document()["parameters"]["branch"] == way
    np.testing.assert_array_equal(by_robot.dynamics.torque, by_gait.dynamics.torque)
    np.testing.assert_array_equal(by_robot.dynamics.torque, by_argument.dynamics.torque)


def test_torques_of_a_mirror_symmetric_squat_are_mirror_images(straight, gait):
    """Half of what bends one leg forward and the other backward would break this."""
    left, right = (straight["legs"][side] for side in ("left", "right"))
    right["sole"] = tuple((-x, y) for x, y in left["sole"])
    found = report(straight | {"knee": "forward"}, gait())
    torque = found.dynamics.torque
    mirrored = torque[:, :6] * [-1, 1, -1, -1, -1, -1]
    np.testing.assert_allclose(torque[:, 6:], mirrored, atol=2e-3)  # the torso's products
    assert np.abs(torque).max() > 0.1


def test_unlike_knees_are_said_to_be_unlike(straight, gait):
    found = report(straight, gait(), branch="forward,backward")
    assert found.stance.sentence() == (
        "The left knee bends forward (+++), the right one backward (-++): as asked for."
    )


def test_where_one_way_only_serves_nothing_else_is_offered(scout):
    found = scout_pin.gait_report(scout, scout_pin.load_gait(), samples=21)
    assert found.stance.others == ()
    assert found.stance.sentence() == (
        "Knees bend forward (left +++, right -+-): nearest to the neutral pose."
    )


def test_joint_angles_a_gait_was_made_from_say_more_than_the_specification(straight, gait):
    robot = scout_pin.load(Specification.model_validate(straight | {"knee": "backward"}))
    poses = gait()
    motion = poses.sample(poses.sample_times(5))
    angles = scout_pin.joint_trajectory(robot, motion, branch="forward").q[0]
    found = scout_pin.gait_report(robot, replace(poses, reference=tuple(angles)), samples=21)
    assert found.stance.knees == ("forward", "forward")
    assert found.stance.sentence().endswith("as the gait's joint angles say.")
