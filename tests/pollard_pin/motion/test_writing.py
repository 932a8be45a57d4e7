"""Paths written down and read back."""

from pathlib import Path

import numpy as np
import pytest
import yaml

import pollard_pin
from pollard_pin.motion.files import load_path
from pollard_pin.report.movement import path_movement
from thesis_pin.report.exchange.movement import content
from thesis_pin.tables.writing import WrittenUnits

EXAMPLES = Path(__file__).parents[3] / "examples"


@pytest.fixture(scope="module")
def robot():
    return pollard_pin.load()


@pytest.fixture(scope="module")
def path():
    return load_path(EXAMPLES / "spray_arch.toml")


@pytest.mark.parametrize(
    ("form", "units"), [("poses", ""), ("poses", "mm,deg,ms"), ("poses", "cm"), ("toml", "")]
)
def test_what_is_written_reads_back_at_every_row(robot, path, form, units, tmp_path):
    file = tmp_path / ("a.toml" if form == "toml" else "a.csv")
    movement = path_movement(robot, path, samples=41)
    chosen = WrittenUnits.parse(units) if units else WrittenUnits()
    file.write_bytes(content(movement, form, chosen))
    found = load_path(file).at(movement.time).pose
    np.testing.assert_allclose(found, path.sample(41).pose, atol=1e-14)
    if units == "mm,deg,ms":
        assert file.read_text().startswith("t_ms,x_mm,y_mm,z_mm,psi_deg,theta_deg,phi_deg\n")


def test_motor_angles_are_those_of_inverse_kinematics(robot, path):
    movement = path_movement(robot, path, samples=5)
    lines = content(movement, "joints").decode().splitlines()
    assert lines[0] == ",".join(["t", *robot.actuators])
    found = np.array([list(map(float, line.split(","))) for line in lines[1:]])
    wanted = pollard_pin.joint_trajectory(robot, path.sample(5)).q
    names = list(pollard_pin.JOINT_NAMES)
    places = [names.index(name) for name in robot.actuators]
    np.testing.assert_array_equal(found[:, 1:], wanted[:, places] + 0.0)


def test_ros_gets_the_six_motors(robot, path):
    message = yaml.safe_load(content(path_movement(robot, path, samples=5), "joint-trajectory"))
    assert message["joint_names"] == list(robot.actuators)
    torque = pollard_pin.inverse_dynamics(robot, path.sample(5)).torque
    np.testing.assert_array_equal([point["effort"] for point in message["points"]], torque)
    assert message["points"][-1]["time_from_start"] == {"sec": 5, "nanosec": 0}


def test_a_table_with_tabs_has_no_commas_and_is_the_same(robot, path):
    movement = path_movement(robot, path, samples=5)
    text = content(movement, "poses", tabs=True)
    assert b"," not in text
    assert text.replace(b"\t", b",") == content(movement, "poses")
