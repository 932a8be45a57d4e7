"""The trajectory report: the thesis's curve, energy, refusals, documented JSON."""

import json

import numpy as np
import pytest

import pollard_pin
from pollard_pin import DEFAULT_BRANCH
from pollard_pin.dynamics.inverse import inverse_dynamics_at
from pollard_pin.motion.curves import appendix_b, line
from pollard_pin.report.document import SCHEMA, VERSION, trajectory_report
from thesis_pin.errors import SingularPose, UnknownName, Unreachable
from thesis_pin.report.writers import json_bytes


@pytest.fixture(scope="module")
def report(printed):
    return trajectory_report(printed, appendix_b(printed.specification))


def test_default_run_with_printed_inertias_has_the_prototypes_peaks(report):
    peaks = report.actuators.peak_torque
    np.testing.assert_allclose(peaks[:3], [1.75, 1.28, 1.27], atol=0.005)
    assert (peaks[3:] <= 0.014).all()
    assert report.actuators.peak_power[:3].max() <= 1.95
    assert report.loop_force_size.max() == pytest.approx(4.1, abs=0.05)
    assert report.path.duration == 20.0
    assert report.path.parameters["timing"] == "constant-rate"


def test_net_work_is_the_change_of_energy(report):
    energy = report.summary()["energy"]
    assert energy["net_work"] == pytest.approx(-2.79e-3, abs=1e-5)
    assert energy["relative_error"] < 1e-5
    assert energy["exchanged"] > 20.0


def test_condition_margin_and_determinant_are_those_of_the_prototype(report):
    summary = report.summary()
    assert summary["condition"]["least"] == pytest.approx(10.3, abs=0.05)
    assert summary["condition"]["largest"] == pytest.approx(14.3, abs=0.05)
    assert summary["margin"]["least"] == pytest.approx(0.32, abs=0.005)
    assert np.unique(np.sign(report.holding.base_determinant)).size == 1


def test_three_motors_leave_about_one_percent_unexplained(printed):
    path = appendix_b(printed.specification)
    three = trajectory_report(printed, path, motors="three")
    assert 0.005 < three.summary()["missing_share"] < 0.014
    assert (three.torque[:, 3:] == 0).all()
    six = trajectory_report(printed, path)
    assert np.abs(three.torque[:, :3] - six.torque[:, :3]).max() < 0.02


def test_the_other_reading_of_the_inertias_is_reported(report, pollard):
    reading, peaks = report.other_reading
    assert reading == "physical"
    other = trajectory_report(pollard, appendix_b(pollard.specification))
    np.testing.assert_allclose(peaks, other.actuators.peak_torque, rtol=1e-12)
    assert 1.5 < peaks[0] < 1.6


@pytest.mark.parametrize("actuators", ["six", "three"])
def test_document_has_the_documented_keys_and_shapes(robot, actuators):
    count = 41
    report = trajectory_report(
        robot, appendix_b(robot.specification), samples=count, motors=actuators
    )
    document = json.loads(json_bytes(report.document()))
    assert (document["schema"], document["version"]) == (SCHEMA, VERSION)
    shapes = {
        "actuators": (6,),
        "joints": (12,),
        "time": (count,),
        "pose": (count, 6),
        "theta": (count, 12),
        "theta_rate": (count, 12),
        "theta_acceleration": (count, 12),
        "torque": (count, 6),
        "power": (count, 6),
        "work": (6,),
        "loop_force": (count, 2, 3),
        "condition": (count,),
        "determinant": (count,),
        "margin": (count,),
    }
    for key, shape in shapes.items():
        assert np.shape(document[key]) == shape, key
    assert document["actuator_symbols"] == ["θ21", "θ211", "θ212", "θ1615", "θ1716", "θ1817"]
    assert {"parameters", "assumptions", "summary"} <= document.keys()
    assert all(one["why"] for one in document["assumptions"])
    assert ("missing_force" in document) == (actuators == "three")


def test_an_assumed_time_or_place_is_listed_only_where_it_is_used(robot):
    def listed(**asked):
        path = appendix_b(robot.specification, **asked)
        found = trajectory_report(robot, path, samples=11).assumptions()
        return {one["name"]: one for one in found if one["name"] in ("motion", "placement")}

    own = robot.specification.assumptions
    assert listed()["placement"]["position"] == list(own.placement.position)
    elsewhere = listed(placement=[0.5, 0.0, 0.15])
    assert set(elsewhere) == {"motion"}
    assert elsewhere["motion"]["duration"] == own.motion.duration
    slower = listed(duration=40.0)
    assert set(slower) == {"motion", "placement"}
    assert "duration" not in slower["motion"]
    assert slower["motion"]["timing"] == own.motion.timing
    other = {"constant-rate": "rest-to-rest", "rest-to-rest": "constant-rate"}[own.motion.timing]
    assert set(listed(duration=40.0, timing=other)) == {"placement"}


def test_columns_repeat_the_document(report):
    columns = report.columns()
    assert len({len(values) for values in columns.values()}) == 1
    np.testing.assert_array_equal(columns["torque_chain0_shoulder_Nm"], report.torque[:, 0])
    np.testing.assert_array_equal(columns["loop_force_2_z_N"], report.dynamics.loop_force[:, 1, 2])


def test_the_unshifted_print_is_refused_with_the_reason(pollard):
    with pytest.raises(Unreachable, match="too near to the shoulder"):
        trajectory_report(pollard, appendix_b(placement=[0, 0, 0]))


@pytest.mark.parametrize("x", [0.2, 0.3, 0.45, 0.6, 0.75])
def test_shifted_by_20_to_75_cm_the_curve_is_reachable(pollard, x):
    poses = appendix_b(placement=[x, 0, 0]).sample(501).pose
    assert pollard.inverse_kinematics(poses).valid.all()


def test_a_path_across_an_actuation_singularity_is_refused_with_the_place(pollard):
    """Along z = −0.1 the determinant vanishes near x = 0.31 (found by the test itself)."""
    path = line([0.45, 0, -0.1, 0, 0, 0], [0.25, 0, -0.1, 0, 0, 0], 1.0, "constant-rate")
    with pytest.raises(SingularPose, match="determinant of the three base") as caught:
        trajectory_report(pollard, path, samples=101)
    time = float(caught.value.where.split()[2])

    def determinant(t):
        q = pollard.inverse_kinematics(path.at(t).pose).angles
        return pollard.actuation(q).base_determinant[0]

    assert determinant(time - 1e-4) * determinant(time + 1e-4) < 0
    assert abs(determinant(time)) < 1e-4


def test_a_path_through_a_straight_wrist_is_refused_with_the_place(pollard):
    middle = pollard.inverse_kinematics([0.45, 0.03, 0.02, 0.0, 0.0, 0.0]).angles.copy()
    middle[4] = 0.0
    through = pollard.pose(middle)
    offset = np.array([0, 0, 0, 0.2, 0, 0])
    path = line(through - offset, through + offset, 1.0, "constant-rate")
    for samples in (100, 101):  # one of them has a sample on the singularity itself
        with pytest.raises(SingularPose, match=r"wrist|serial singularity") as caught:
            trajectory_report(pollard, path, samples=samples)
        assert "t =" in str(caught.value)


def test_an_angle_that_leaves_its_limits_on_the_way_is_refused():
    data = pollard_pin.Specification.read().model_dump()
    upper = [360.0] * 12
    upper[6] = -30.0
    data["assumptions"]["joint_limits"]["upper_deg"] = tuple(upper)
    tight = pollard_pin.load(pollard_pin.Specification.model_validate(data))
    with pytest.raises(Unreachable, match=r"chain1_shoulder \(θ211\)"):
        trajectory_report(tight, appendix_b())


def test_angles_along_a_path_do_not_jump_by_a_turn(pollard):
    """The rods of chains with the elbow down pass ±180°."""
    down = pollard_pin.Branch.parse("++--+++")
    report = trajectory_report(pollard, appendix_b(), branch=down)
    assert np.abs(np.diff(report.joints.q, axis=0)).max() < 0.2
    assert np.abs(report.joints.q).max() > np.pi


def test_few_samples_are_not_mistaken_for_a_break(skewed):
    """60 samples of 18 periods change by more than the rates foretell, and nothing breaks."""
    report = trajectory_report(skewed, appendix_b(skewed.specification), samples=60)
    assert np.abs(np.diff(report.joints.q, axis=0)).max() > 1.0


def test_an_unknown_number_of_actuators_is_refused(pollard):
    with pytest.raises(UnknownName, match="six, three"):
        trajectory_report(pollard, appendix_b(), motors="four")


def test_longer_durations_tend_to_the_static_torques(pollard):
    slow = trajectory_report(pollard, appendix_b(duration=2000), samples=201)
    zero = np.zeros_like(slow.joints.q)
    static = inverse_dynamics_at(pollard, slow.joints.q, zero, zero).torque
    np.testing.assert_allclose(slow.torque, static, atol=1e-4)
    fast = trajectory_report(pollard, appendix_b(duration=20), samples=201)
    assert np.abs(fast.torque - static).max() > 0.1


def test_the_branch_of_the_report_is_the_one_asked_for(report, printed):
    assert report.branch == DEFAULT_BRANCH
    assert printed.branch_of(report.joints.q[100]) == DEFAULT_BRANCH


def test_the_tool_s_speed_is_the_slope_of_its_path(pollard):
    report = pollard_pin.trajectory_report(pollard, appendix_b(duration=10.0), samples=8001)
    slope = np.gradient(report.motion.pose[:, :3], report.joints.time, axis=0)
    expected = np.linalg.norm(slope, axis=1)[2:-2]
    np.testing.assert_allclose(report.tool_speed[2:-2], expected, rtol=1e-4)
    said = report.summary()["tool_speed"]
    assert said["largest"] == report.tool_speed.max()
    assert report.columns()["tool_speed_m_s"] is report.tool_speed


def test_assumed_numbers_are_told_with_units_and_few_digits():
    from pollard_pin.report.tables import resting_on

    entry = {"name": "joint_limits", "velocity": [1.0, 5.235987755982988], "why": "given"}
    assert list(resting_on([entry]))[1] == "- joint limits (velocity (1, 5.235987756) rad/s): given"
