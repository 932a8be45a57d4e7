"""The path report's data: each column and each sum is what its name says, by Pinocchio."""

import numpy as np
import pinocchio as pin
import pytest
from scipy.integrate import cumulative_trapezoid, trapezoid

import pollard_pin
from pollard_pin.specification import ACTUATOR_NAMES, JOINT_NAMES


@pytest.fixture(scope="module")
def report(pollard):
    return pollard_pin.trajectory_report(pollard, pollard_pin.appendix_b(), samples=301)


def state(report, columns, k, name):
    """q, v or a of sample k from the columns' names alone."""
    found = np.empty(12)
    for joint in JOINT_NAMES:
        number = report.robot.model.getJointId(joint)
        unit = {"theta": "rad", "theta_rate": "rad_s", "theta_acceleration": "rad_s2"}[name]
        found[report.robot.model.joints[number].idx_q] = columns[f"{name}_{joint}_{unit}"][k]
    return found


def test_torques_and_ball_joint_forces_move_pinocchios_tree(report):
    """RNEA of the open tree = motors + forces on the forearm − the same on the rods."""
    columns, model = report.columns(), report.robot.model
    data = model.createData()
    for k in range(0, 301, 25):
        q, v, a = (
            state(report, columns, k, name)
            for name in ("theta", "theta_rate", "theta_acceleration")
        )
        left = pin.rnea(model, data, q, v, a).copy()
        for name in ACTUATOR_NAMES:
            left[model.joints[model.getJointId(name)].idx_v] -= columns[f"torque_{name}_Nm"][k]
        for i in (1, 2):
            force = [columns[f"loop_force_{i}_{axis}_N"][k] for axis in "xyz"]
            for frame, sign in ((f"forearm_anchor_{i}", 1), (f"chain{i}_rod_tip", -1)):
                jacobian = pin.computeFrameJacobian(
                    model, data, q, model.getFrameId(frame), pin.LOCAL_WORLD_ALIGNED
                )
                left -= sign * jacobian[:3].T @ force
        np.testing.assert_allclose(left, 0.0, atol=1e-9)


def test_rates_are_the_slopes_of_the_angles_and_poses_those_of_the_tip(report):
    columns, model = report.columns(), report.robot.model
    time, data = columns["time_s"], model.createData()
    for joint in JOINT_NAMES:
        theta, rate = columns[f"theta_{joint}_rad"], columns[f"theta_rate_{joint}_rad_s"]
        bend = columns[f"theta_acceleration_{joint}_rad_s2"]
        step = time[1] - time[0]
        slope, slopes = np.gradient(theta, time)[1:-1], np.gradient(rate, time)[1:-1]
        assert np.abs(slope - rate[1:-1]).max() < 20 * step**2 * (1 + np.abs(bend).max())
        assert np.abs(slopes - bend[1:-1]).max() < 20 * step**2 * (1 + np.abs(bend).max())
    for k in range(0, 301, 50):
        pin.framesForwardKinematics(model, data, state(report, columns, k, "theta"))
        said = [columns[f"{axis}_m"][k] for axis in "xyz"]
        tip = report.robot.forward_kinematics(
            [columns[f"theta_{name}_rad"][k] for name in ACTUATOR_NAMES]
        )
        mode = np.nanargmin(np.abs(tip.pose[:, :3] - said).max(axis=1))
        np.testing.assert_allclose(tip.pose[mode, :3], said, atol=1e-9)


def test_power_and_work_are_those_of_torque_and_speed_and_pay_for_the_energy(report):
    columns, summary = report.columns(), report.summary()
    time, model = columns["time_s"], report.robot.model
    total = np.zeros(len(time))
    for k, name in enumerate(ACTUATOR_NAMES):
        torque, speed = columns[f"torque_{name}_Nm"], columns[f"theta_rate_{name}_rad_s"]
        power = torque * speed
        np.testing.assert_allclose(columns[f"power_{name}_W"], power, rtol=1e-14)
        work = cumulative_trapezoid(power, time, initial=0)
        np.testing.assert_allclose(columns[f"work_{name}_J"], work, atol=1e-14)
        total += columns[f"work_{name}_J"]
        assert summary["peak_torque"][k] == np.abs(torque).max()
        assert summary["peak_speed"][k] == np.abs(speed).max()
        assert summary["peak_power"][k] == np.abs(power).max()
        assert summary["positive_work"][k] == pytest.approx(trapezoid(np.maximum(power, 0), time))
        assert summary["negative_work"][k] == pytest.approx(trapezoid(np.minimum(power, 0), time))
        assert summary["net_work"][k] == pytest.approx(work[-1], abs=1e-12)
        mean_square = trapezoid(torque**2, time) / (time[-1] - time[0])
        assert summary["rms_torque"][k] == pytest.approx(np.sqrt(mean_square), rel=1e-12)
    data, energies = model.createData(), []
    for k in (0, -1):
        q, v = (state(report, columns, k, name) for name in ("theta", "theta_rate"))
        kinetic = pin.computeKineticEnergy(model, data, q, v)
        energies.append(kinetic + pin.computePotentialEnergy(model, data, q))
    exchanged = summary["energy"]["exchanged"]
    assert total[-1] == pytest.approx(energies[1] - energies[0], abs=1e-4 * exchanged)
    assert summary["energy"]["change"] == pytest.approx(energies[1] - energies[0], abs=1e-12)
    assert summary["energy"]["net_work"] == pytest.approx(total[-1], abs=1e-14)


def test_the_document_and_the_table_say_the_same(report):
    columns, document = report.columns(), report.document()
    assert document["actuators"] == list(ACTUATOR_NAMES)
    assert document["joints"] == list(JOINT_NAMES)
    for key, names, unit in (
        ("theta", document["joints"], "rad"),
        ("theta_rate", document["joints"], "rad_s"),
        ("theta_acceleration", document["joints"], "rad_s2"),
        ("torque", document["actuators"], "Nm"),
        ("power", document["actuators"], "W"),
    ):
        for k, name in enumerate(names):
            np.testing.assert_array_equal(document[key][:, k], columns[f"{key}_{name}_{unit}"])
    for k, name in enumerate(document["actuators"]):
        assert document["work"][k] == columns[f"work_{name}_J"][-1]
    for i in (1, 2):
        for k, axis in enumerate("xyz"):
            values = document["loop_force"][:, i - 1, k]
            np.testing.assert_array_equal(values, columns[f"loop_force_{i}_{axis}_N"])
    for key in ("condition", "margin"):
        np.testing.assert_array_equal(document[key], columns[key])


def test_the_summary_finds_the_worst_of_the_columns(report):
    columns, summary = report.columns(), report.summary()
    time, limits = columns["time_s"], report.robot.specification.assumptions.joint_limits
    for i in (1, 2):
        force = np.sqrt(sum(columns[f"loop_force_{i}_{axis}_N"] ** 2 for axis in "xyz"))
        assert summary["peak_loop_force"][i - 1] == pytest.approx(force.max(), rel=1e-14)
        assert summary["peak_loop_force_time"][i - 1] == time[np.argmax(force)]
    condition, margin = columns["condition"], columns["margin"]
    assert summary["condition"]["least"] == condition.min()
    assert summary["condition"]["largest"] == condition.max()
    assert summary["condition"]["time"] == time[np.argmax(condition)]
    assert summary["margin"] == {"least": margin.min(), "time": time[np.argmin(margin)]}
    determinant = report.document()["determinant"]
    assert summary["determinant"]["smallest"] == np.abs(determinant).min()
    assert (np.sign(determinant) == summary["determinant"]["sign"]).all()
    shares = summary["motor_limits"]
    for k, name in enumerate(ACTUATOR_NAMES):
        torque = np.abs(columns[f"torque_{name}_Nm"]) / limits.effort
        speed = np.abs(columns[f"theta_rate_{name}_rad_s"]) / limits.velocity
        assert shares["torque_share"][k] == pytest.approx(torque.max(), rel=1e-14)
        assert shares["torque_share_time"][k] == time[np.argmax(torque)]
        assert shares["speed_share"][k] == pytest.approx(speed.max(), rel=1e-14)
        assert shares["speed_share_time"][k] == time[np.argmax(speed)]
    worst = max(shares["torque_share"].max(), shares["speed_share"].max())
    assert summary["within_limits"] == shares["within"] == bool(worst <= 1)


def test_work_goes_on_from_block_to_block_of_samples(pollard):
    """As SciPy sums it at once."""
    many = pollard_pin.trajectory_report(pollard, pollard_pin.appendix_b(), samples=9001)
    work = cumulative_trapezoid(many.power, many.joints.time, axis=0, initial=0)
    np.testing.assert_allclose(many.work_done, work, rtol=1e-12, atol=1e-14)


def test_a_tool_that_points_straight_down_has_a_report(pollard, tmp_path):
    """There ψ = 90°, and the angles have no rates."""
    file = tmp_path / "nod.toml"
    nodes = [(0.0, 70.0), (1.0, 90.0), (2.0, 110.0)]
    file.write_text(
        "format = 1\n"
        + "".join(
            f"[[poses]]\ntime = {t}\nposition = [0.45, 0, 0.05]\norientation_deg = [{psi}, 0, 0]\n"
            for t, psi in nodes
        )
    )
    report = pollard_pin.trajectory_report(pollard, pollard_pin.load_path(file), samples=201)
    assert report.doubts() == []
    assert report.document()["summary"]["within_limits"]
