"""Friction counts where a joint is known to move, and widens the interval elsewhere."""

import numpy as np
import pytest

from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.dynamics import inverse_dynamics
from thesis_pin.loops.motion.files import read_motion
from thesis_pin.report.torque.document import torque_report

FRICTION = 0.7
ARM = f"""<robot name="arm"><link name="base"/>
<link name="rod"><inertial><origin xyz="0.5 0 0"/><mass value="2"/>
<inertia ixx="0.01" iyy="0.2" izz="0.2" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="hip" type="revolute"><parent link="base"/><child link="rod"/><axis xyz="0 -1 0"/>
<limit lower="-3" upper="3" effort="100" velocity="10"/>
<dynamics damping="0" friction="{FRICTION}"/></joint></robot>"""
WEIGHT = 2 * 9.81 * 0.5
TIME = np.arange(0.0, 4.0, 5e-3)


@pytest.fixture(scope="module")
def arm():
    return ClosedRobot(ARM)


def reported(arm, tmp_path, angle):
    rows = zip(TIME, angle, strict=True)
    (tmp_path / "m.csv").write_text("t,hip\n" + "".join(f"{t:.3f},{x:.4f}\n" for t, x in rows))
    return torque_report(arm, read_motion(arm, tmp_path / "m.csv"))


def test_a_joint_that_rests_before_it_moves_has_no_friction_while_it_rests(arm, tmp_path):
    started = np.maximum(TIME - 2.0, 0.0)
    angle = 0.3 * started**3 * (started < 10)
    report = reported(arm, tmp_path, angle)
    torque = report.dynamics.torque[:, 0]
    resting = TIME < 1.5
    np.testing.assert_allclose(torque[resting], WEIGHT, atol=0.05)
    moving = TIME > 2.8
    true = WEIGHT * np.cos(angle) + 0.7 * 1.8 * started + FRICTION
    np.testing.assert_allclose(torque[moving][:-40], true[moving][:-40], rtol=0.02)
    high = report.headlines.torque_band[1, :, 0]
    at = report.headlines.time
    assert (high[at < 1.5] >= WEIGHT + 0.95 * FRICTION).all()
    (peak,) = report.headlines.peak_torque
    assert peak.low < true.max() < peak.high


def test_a_joint_that_never_moves_has_none_and_none_is_left_open(arm, tmp_path):
    report = reported(arm, tmp_path, np.full(len(TIME), 0.2))
    assert report.headlines is None
    np.testing.assert_allclose(report.dynamics.torque[:, 0], WEIGHT * np.cos(0.2), atol=1e-9)


def test_which_way_friction_is_overcome_can_be_told(arm):
    q, still = np.array([0.1]), np.zeros(1)
    free, up, down = (
        inverse_dynamics(arm, q, still, still, sliding=[way]).torque[0] for way in (0, 1, -1)
    )
    assert up - free == pytest.approx(FRICTION)
    assert free - down == pytest.approx(FRICTION)
