"""ROS's joint trajectories as PyYAML, which ros2 topic pub reads with, understands them."""

import numpy as np
import yaml
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from thesis_pin.report.exchange.joint_trajectory import JointStates, joint_trajectory_yaml


def read(time, values, names=("hip", "no")):
    states = JointStates(names, time, *(values + k for k in range(4)))
    return yaml.safe_load(joint_trajectory_yaml(states))


@given(arrays(float, (3, 2), elements=st.floats(-1e9, 1e9)))
def test_every_number_is_a_number_to_the_bit(values):
    message = read(np.array([5.0, 5.25, 7.0000000015]), values)
    assert set(message) == {"header", "joint_names", "points"}
    assert message["joint_names"] == ["hip", "no"]
    for k, point in enumerate(message["points"]):
        assert set(point) == {
            "positions",
            "velocities",
            "accelerations",
            "effort",
            "time_from_start",
        }
        assert point["positions"] == (values[k] + 0.0).tolist()
        assert all(isinstance(one, float) for one in point["positions"])
        assert point["effort"] == (values[k] + 3 + 0.0).tolist()


def test_time_counts_from_the_first_sample_in_whole_nanoseconds():
    message = read(np.array([5.0, 5.25, 7.0000000015]), np.zeros((3, 2)))
    times = [point["time_from_start"] for point in message["points"]]
    assert times[:2] == [{"sec": 0, "nanosec": 0}, {"sec": 0, "nanosec": 250_000_000}]
    assert times[2]["sec"] == 2
    assert times[2]["nanosec"] in (1, 2)  # 1.5 in doubles


def test_samples_beside_an_instant_are_one_point_and_the_last_stays():
    time = np.array([0.0, 1.0 - 1e-9, 1.0, 1.0 + 1e-9, 2.0 - 1e-9, 2.0])
    points = read(time, np.arange(12.0).reshape(6, 2))["points"]
    assert [point["positions"][0] for point in points] == [0.0, 2.0, 10.0]


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_numbers_of_any_size_are_no_texts(value):
    (point, *_) = read(np.array([0.0, 1.0]), np.array([[value, 1.0], [2.0, 1e-05]]))["points"]
    assert all(isinstance(one, float) for one in point["positions"])
    assert point["positions"] == [value, 1.0]
