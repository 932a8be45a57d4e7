"""Torques of robots with loops, springs and rotors, read from MJCF, are MuJoCo's."""

import numpy as np
import pytest
from mujoco_twin import driven, equality_jacobian, twin

from thesis_pin.loops.dynamics import inverse_dynamics
from thesis_pin.loops.kinematics import close

BAR = '<inertial pos="0.1 0 0" mass="0.4" diaginertia="1e-3 4e-3 4e-3"/>'
ROD = '<inertial pos="0.2 0 0" mass="0.1" diaginertia="1e-5 2e-3 2e-3"/>'
TRUNK = '<inertial pos="0 0 0.1" mass="9" fullinertia="0.2 0.3 0.25 0.01 0 0.02"/>'
# A leg: two motors; a shin and a heel on springs; a rod on a ball joint from hip to heel.
LEG = f"""
<mujoco><compiler angle="radian"/><worldbody><body name="trunk" pos="0 0 1"> {TRUNK} {{root}}
<body name="hip" pos="0 0.1 0" euler="1.5708 0 0.3"> {BAR}
  <joint name="hip" axis="0 0 1" armature="0.09" damping="1"/>
  <body name="rod" pos="0 0 0.045"> {ROD} <joint name="rod" type="ball" damping="0.01"/></body>
  <body name="knee" pos="0.12 0 0.01"> {BAR} <joint name="knee" axis="0.1 0 1" ref="-0.4"/>
    <body name="shin" pos="0.06 0.05 0"> {BAR}
      <joint name="shin" stiffness="1500" springref="0.02" damping="0.1"/>
      <body name="heel" pos="0.14 0.05 0.02" euler="0.1 -0.2 0.5"> {BAR}
        <joint name="heel" stiffness="1250" axis="0.1 0.2 1"/>
</body></body></body></body></body></worldbody>
<equality><connect name="achilles" body1="rod" body2="heel" anchor="0.38 0.03 0.01"/></equality>
<actuator><motor joint="hip" gear="16"/><motor joint="knee" gear="16"/></actuator></mujoco>"""
# A four-bar with a weld that has to be one, and a wheel geared to its crank.
BARS = f"""
<mujoco><compiler angle="radian"/><worldbody>
<body name="crank"> {BAR} <joint name="crank" axis="0 1 0" damping="0.3"/>
  <body name="coupler" pos="0.2 0 0"> {BAR} <joint name="pin" axis="0 1 0"/>
    <body name="end" pos="0.3 0 0"> {BAR} <joint name="last" axis="0 1 0"/></body></body></body>
<body name="rocker" pos="0.35 0.02 0"> {BAR}
  <joint name="rocker" axis="0 1 0" armature="0.01"/></body>
<body name="wheel" pos="0 1 0"> {BAR} <joint name="wheel" axis="0 0 1"/></body>
</worldbody>
<equality><weld name="shut" body1="end" body2="rocker"/>
<joint name="teeth" joint1="wheel" joint2="crank" polycoef="0 -2.5 0 0 0"/></equality>
<actuator><motor joint="crank"/></actuator></mujoco>"""
FILES = {
    "fixed leg": LEG.format(root=""),
    "free leg": LEG.format(root="<freejoint/>"),
    "bars": BARS,
}


@pytest.mark.parametrize("name", FILES)
def test_the_torques_that_drive_mujocos_robot_are_found_from_its_motion(name, tmp_path):
    path = tmp_path / "robot.xml"
    path.write_text(FILES[name])
    pair = twin(path)
    robot, model = pair.robot, pair.model
    start, _, _ = pair.to_pinocchio(model.qpos0, np.zeros(model.nv), np.zeros(model.nv))
    for seed in range(3):
        rng = np.random.default_rng(seed)
        guess = start.copy()
        for motor, place in zip(robot.actuators, robot.actuated_q, strict=True):
            guess[place] += 0.2 * rng.normal() if motor != "crank" else 0.3
        qpos = pair.to_qpos(close(robot, guess))
        rows = equality_jacobian(model, qpos)
        _, sizes, turned = np.linalg.svd(rows)
        free = turned[(sizes > 1e-6 * sizes[0]).sum() :]
        qvel = free.T @ rng.normal(size=len(free))
        torques, dofs = 5 * rng.normal(size=len(robot.actuators)), []
        for motor in robot.actuators:
            dofs.append(int(model.jnt_dofadr[pair.names[motor]]))
        force = np.zeros(model.nv)
        force[dofs] = torques
        qacc = driven(model, qpos, qvel, force)
        found = inverse_dynamics(robot, *pair.to_pinocchio(qpos, qvel, qacc))
        np.testing.assert_allclose(found.torque, torques, rtol=0, atol=1e-9 * 5)
        np.testing.assert_allclose(found.base, 0.0, atol=1e-8)
