"""Newton's method on Pinocchio, and SciPy's searches on the same equations."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
import pinocchio as pin


class Leg:
    """Scout's left leg alone, and where its sole is to go."""

    def __init__(self, robot: pin.RobotWrapper, poses: np.ndarray, starts: np.ndarray) -> None:
        names = [n for n in robot.model.names if n.startswith("right") or n == "root_joint"]
        joints = [robot.model.getJointId(name) for name in names]
        self.model = pin.buildReducedModel(robot.model, joints, pin.neutral(robot.model))
        self.frame = self.model.getFrameId("left_sole")
        self.pairs = [(pin.SE3(pose), start) for pose, start in zip(poses, starts, strict=True)]
        self.data = self.model.createData()

    def newton(self) -> list[np.ndarray]:
        """The usual loop: Newton steps until the sole is there."""
        return [self._newton(target, start) for target, start in self.pairs]

    def _newton(self, target: pin.SE3, start: np.ndarray) -> np.ndarray:
        q = start.copy()
        for _ in range(100):
            error = self._gap(q, target)
            if np.linalg.norm(error) < 1e-10:
                break
            jacobian = pin.computeFrameJacobian(self.model, self.data, q, self.frame, pin.LOCAL)
            q = q + np.linalg.lstsq(jacobian, error, rcond=None)[0]
        return q

    def fsolve(self) -> list[np.ndarray]:
        """SciPy's on the same six equations."""
        from scipy.optimize import fsolve

        return [fsolve(self._gap, start, args=(target,)) for target, start in self.pairs]

    def _gap(self, q: np.ndarray, target: pin.SE3) -> np.ndarray:
        pin.framesForwardKinematics(self.model, self.data, q)
        return np.asarray(pin.log6(self.data.oMf[self.frame].actInv(target)).vector)

    def rates(
        self, angles: np.ndarray, velocity: np.ndarray, acceleration: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """Rates and accelerations of motions of the sole, linear then angular, ``(n, 6)`` each."""
        model, data, axes = self.model, self.data, pin.LOCAL_WORLD_ALIGNED
        v, a, zero = np.empty(angles.shape), np.empty(angles.shape), np.zeros(model.nv)
        for k, q in enumerate(angles):
            jacobian = pin.computeFrameJacobian(model, data, q, self.frame, axes)
            v[k] = np.linalg.solve(jacobian, velocity[k])
            pin.forwardKinematics(model, data, q, v[k], zero)
            bias = pin.getFrameClassicalAcceleration(model, data, self.frame, axes).vector
            a[k] = np.linalg.solve(jacobian, acceleration[k] - bias)
        return v, a


class Tree:
    """Pollard's open tree, its loops as six equations; the other six are a pose or the motors.

    Args:
        robot: The robot.
        angles: Closed configurations ``(n, 12)``; searches begin 0.05 rad beside them.
        motors: Places of the motors in them.
    """

    def __init__(self, robot: pin.RobotWrapper, angles: np.ndarray, motors: Sequence[int]) -> None:
        self.model, self.data = robot.model, robot.model.createData()
        self.tip = self.model.getFrameId("tool_tip")
        ends = [(f"forearm_anchor_{i}", f"chain{i}_rod_tip") for i in (1, 2)]
        self.loops = [tuple(self.model.getFrameId(name) for name in pair) for pair in ends]
        self.motors, self.unit = list(motors), np.eye(12)[list(motors)]
        self.pairs = []
        for one in angles:
            pin.framesForwardKinematics(self.model, self.data, one)
            self.pairs.append((self.data.oMf[self.tip].copy(), one))

    def by_pose(self) -> list[np.ndarray]:
        """Newton's method on the tool's poses."""
        return [
            self._newton(lambda q, t=target: self._pose_gap(q, t), one + 0.05, self.tip)
            for target, one in self.pairs
        ]

    def by_motors(self) -> list[np.ndarray]:
        """Newton's method on the motors' angles."""
        return [
            self._newton(lambda q, m=one[self.motors]: self._motor_gap(q, m), one + 0.05, None)
            for _, one in self.pairs
        ]

    def squares(self) -> list[np.ndarray]:
        """SciPy's least squares on the tool's poses."""
        from scipy.optimize import least_squares

        return [
            least_squares(self._pose_gap, one + 0.05, args=(target,), xtol=1e-12, ftol=1e-12).x
            for target, one in self.pairs
        ]

    def rates(
        self, angles: np.ndarray, velocity: np.ndarray, acceleration: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """Rates and accelerations of motions of the tool, linear then angular, ``(n, 6)`` each."""
        model, data, axes, zero = self.model, self.data, pin.LOCAL_WORLD_ALIGNED, np.zeros(12)
        v, a = np.empty(angles.shape), np.empty(angles.shape)

        def bias(frame: int) -> np.ndarray:
            return pin.getFrameClassicalAcceleration(model, data, frame, axes).vector

        for k, q in enumerate(angles):
            pin.computeJointJacobians(model, data, q)
            pin.updateFramePlacements(model, data)
            tool = pin.getFrameJacobian(model, data, self.tip, axes)
            jacobian = np.concatenate([tool, *self._loop_rows()])
            v[k] = np.linalg.solve(jacobian, np.concatenate([velocity[k], np.zeros(6)]))
            pin.forwardKinematics(model, data, q, v[k], zero)
            wanted = [acceleration[k] - bias(self.tip)]
            wanted += [bias(second)[:3] - bias(first)[:3] for first, second in self.loops]
            a[k] = np.linalg.solve(jacobian, np.concatenate(wanted))
        return v, a

    def _newton(
        self, gap: Callable[[np.ndarray], np.ndarray], start: np.ndarray, tip: int | None
    ) -> np.ndarray:
        q = start.copy()
        for _ in range(50):
            error = gap(q)
            if np.linalg.norm(error) < 1e-10:
                break
            pin.computeJointJacobians(self.model, self.data, q)
            first = (
                self.unit
                if tip is None
                else pin.getFrameJacobian(self.model, self.data, tip, pin.LOCAL)
            )
            q = q - np.linalg.solve(np.concatenate([first, *self._loop_rows()]), error)
        return q

    def _loop_rows(self) -> list[np.ndarray]:
        axes = pin.LOCAL_WORLD_ALIGNED
        return [
            pin.getFrameJacobian(self.model, self.data, first, axes)[:3]
            - pin.getFrameJacobian(self.model, self.data, second, axes)[:3]
            for first, second in self.loops
        ]

    def _loop_gap(self, q: np.ndarray) -> list[np.ndarray]:
        pin.framesForwardKinematics(self.model, self.data, q)
        places = self.data.oMf
        return [places[a].translation - places[b].translation for a, b in self.loops]

    def _pose_gap(self, q: np.ndarray, target: pin.SE3) -> np.ndarray:
        loops = self._loop_gap(q)
        tip = pin.log6(target.actInv(self.data.oMf[self.tip])).vector
        return np.concatenate([tip, *loops])

    def _motor_gap(self, q: np.ndarray, motors: np.ndarray) -> np.ndarray:
        return np.concatenate([q[self.motors] - motors, *self._loop_gap(q)])
