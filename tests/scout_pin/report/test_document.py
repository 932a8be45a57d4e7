"""The gait report's data: each column and each sum is what its name says, by Pinocchio."""

import numpy as np
import pinocchio as pin
import pytest
from scipy.integrate import trapezoid
from scipy.spatial.transform import Rotation

import scout_pin
from scout_pin.specification import JOINT_NAMES, SIDES

from ..conftest import EXAMPLES

FORCES = ("fx_N", "fy_N", "fz_N", "mx_Nm", "my_Nm", "mz_Nm")


@pytest.fixture(scope="module", params=["thesis", "lopsided_walk"])
def report(request, scout, lopsided):
    robot = scout if request.param == "thesis" else lopsided
    name = request.param if request.param == "thesis" else EXAMPLES / f"{request.param}.toml"
    return scout_pin.gait_report(robot, scout_pin.load_gait(name), samples=61)


def pinocchio_q(report, columns, k):
    """Configuration of sample k from the columns' names alone, and the planned torso."""
    model = report.robot.model
    torso = report.gait.sample(report.motion.t[k : k + 1]).torso
    q = pin.neutral(model)
    q[:3] = torso.position[0]
    q[3:7] = Rotation.from_matrix(torso.rotation[0]).as_quat()
    for name in JOINT_NAMES:
        q[model.joints[model.getJointId(name)].idx_q] = columns[f"theta_{name}_rad"][k]
    return q


def test_angles_and_centre_of_mass_are_those_of_pinocchios_robot(report):
    """Soles where the gait plans them, and the centre of mass where the column says."""
    columns, model = report.columns(), report.robot.model
    data = model.createData()
    for k in range(0, len(columns["time_s"]), 7):
        q = pinocchio_q(report, columns, k)
        pin.framesForwardKinematics(model, data, q)
        planned = report.gait.sample(report.motion.t[k : k + 1])
        for side, foot in zip(SIDES, (planned.left_foot, planned.right_foot), strict=True):
            found = data.oMf[model.getFrameId(f"{side}_sole")].homogeneous
            np.testing.assert_allclose(found, foot.placement[0], atol=1e-12)
        com = pin.centerOfMass(model, data, q)
        said = [columns[f"com_{axis}_m"][k] for axis in "xyz"]
        np.testing.assert_allclose(said, com, atol=1e-12)


def test_rates_and_torques_with_the_floors_wrenches_move_pinocchios_robot(report):
    """M a + h = torques + Jᵀ wrenches, from columns by their names; the torso has no motor."""
    columns, model = report.columns(), report.robot.model
    data = model.createData()
    for k in range(0, len(columns["time_s"]), 5):
        q = pinocchio_q(report, columns, k)
        torso = report.gait.sample(report.motion.t[k : k + 1]).torso
        turn = torso.rotation[0]
        v, a, torque = np.zeros((3, 18))
        v[:3], v[3:6] = turn.T @ torso.velocity[0], turn.T @ torso.omega[0]
        a[:3] = turn.T @ torso.acceleration[0] - np.cross(v[3:6], v[:3])
        a[3:6] = turn.T @ torso.alpha[0]
        friction = report.robot.specification.assumptions.joint_friction
        for name in JOINT_NAMES:
            at = model.joints[model.getJointId(name)].idx_v
            v[at] = columns[f"theta_rate_{name}_rad_s"][k]
            a[at] = columns[f"theta_acceleration_{name}_rad_s2"][k]
            resists = friction.viscous * v[at] + friction.coulomb * np.sign(v[at])
            torque[at] = columns[f"torque_{name}_Nm"][k] - resists * (abs(v[at]) > 1e-9)
        for side in SIDES:
            wrench = np.array([columns[f"{side}_{part}"][k] for part in FORCES])
            frame = model.getFrameId(f"{side}_sole")
            torque += (
                pin.computeFrameJacobian(model, data, q, frame, pin.LOCAL_WORLD_ALIGNED).T @ wrench
            )
        np.testing.assert_allclose(pin.rnea(model, data, q, v, a), torque, atol=1e-9)


def test_the_zmp_is_where_the_floors_wrenches_have_no_level_moment(report):
    columns = report.columns()
    moment = np.zeros((len(columns["time_s"]), 3))
    for side, foot in zip(SIDES, (report.motion.left_foot, report.motion.right_foot), strict=True):
        wrench = np.stack([columns[f"{side}_{part}"] for part in FORCES], axis=1)
        zmp = np.stack([columns["zmp_x_m"], columns["zmp_y_m"], np.zeros(len(wrench))], axis=1)
        moment += wrench[:, 3:] + np.cross(foot.position - zmp, wrench[:, :3])
    np.testing.assert_allclose(moment[:, :2], 0.0, atol=1e-10)


def test_the_document_and_the_table_say_the_same(report):
    columns, document = report.columns(), report.document()
    assert document["joints"] == list(JOINT_NAMES)
    for key, unit in (
        ("theta", "rad"),
        ("theta_rate", "rad_s"),
        ("theta_acceleration", "rad_s2"),
        ("torque", "Nm"),
    ):
        for k, name in enumerate(document["joints"]):
            np.testing.assert_array_equal(document[key][:, k], columns[f"{key}_{name}_{unit}"])
    for side in SIDES:
        for k, part in enumerate(FORCES):
            values = document[f"{side}_wrench"][:, k]
            np.testing.assert_array_equal(values, columns[f"{side}_{part}"])
    for key, axes in (("com", "xyz"), ("zmp", "xy")):
        for k, axis in enumerate(axes):
            np.testing.assert_array_equal(document[key][:, k], columns[f"{key}_{axis}_m"])
    for key, name in (("time", "time_s"), ("phase", "phase"), ("margin", "margin_m")):
        np.testing.assert_array_equal(document[key], columns[name])


def test_the_summary_sums_the_columns_up(report):
    columns, summary = report.columns(), report.summary()
    time = columns["time_s"]
    for k, name in enumerate(JOINT_NAMES):
        torque, rate = columns[f"torque_{name}_Nm"], columns[f"theta_rate_{name}_rad_s"]
        assert summary["peak_torque"][k] == np.abs(torque).max()
        assert summary["peak_speed"][k] == np.abs(rate).max()
        assert summary["peak_power"][k] == np.abs(torque * rate).max()
        mean_square = trapezoid(torque**2, time) / (time[-1] - time[0])
        assert summary["rms_torque"][k] == pytest.approx(np.sqrt(mean_square), rel=1e-12)
        use = np.abs(torque) / summary["stall_torque"][k]
        use = use + np.abs(rate) / summary["no_load_speed"][k]
        assert summary["servo_use"][k] == pytest.approx(use.max(), rel=1e-12)
    margin = columns["margin_m"]
    assert summary["worst_margin"] == margin.min()
    assert summary["worst_margin_time"] == time[np.argmin(margin)]
    inside = [
        late - early
        for early, late, one, other in zip(time, time[1:], margin, margin[1:], strict=False)
        if one > 0 and other > 0
    ]
    assert summary["stable_share"] == pytest.approx(sum(inside) / (time[-1] - time[0]), abs=1e-12)
    assert summary["admissible_share"] == pytest.approx(np.mean(report.document()["admissible"]))
    assert summary["servos_carry"] == bool((summary["servo_use"] <= 1).all())
    assert summary["within_limits"] == (summary["can_walk"] and summary["servos_carry"])
    landings = [impact["time"] for impact in summary["impacts"]]
    planned = [t * report.time_unit for t, _ in report.gait.touchdowns()]
    np.testing.assert_allclose(landings, planned)


def test_friction_and_lowest_corner_are_the_worst_of_the_samples(report):
    """By hand from the wrenches' columns and the soles' corners."""
    columns, summary = report.columns(), report.summary()
    friction = report.robot.specification.assumptions.floor_friction.coefficient
    shares, lowest = [], []
    for k, (side, foot) in enumerate(
        zip(SIDES, (report.motion.left_foot, report.motion.right_foot), strict=True)
    ):
        for s, phase in enumerate(columns["phase"]):
            if phase in (side, "double"):
                x, y, z = (columns[f"{side}_{part}"][s] for part in FORCES[:3])
                if z > 0:
                    shares.append(np.hypot(x, y) / (friction * z))
                continue
            outline = np.array(report.robot.specification.leg(SIDES[k]).sole)
            for x, y in outline:
                lowest.append((foot.position[s] + foot.rotation[s] @ (x, y, 0.0))[2])
    assert summary["peak_friction_used"] == pytest.approx(max(shares), rel=1e-9)
    assert summary["lowest_corner"] == pytest.approx(min(lowest), abs=1e-12)
