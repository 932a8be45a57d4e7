"""A trot for ANYmal as a table: ``python docs/anymal_trot.py`` writes examples/anymal_trot.csv.

Two diagonal feet stand at a time, four in between. On two points nothing can turn the robot about
the line between them, so the base sways, rolls and pitches in such a way that nothing has to: a
few harmonics of the stride, fitted by least squares.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pinocchio as pin
from scipy.interpolate import CubicSpline
from scipy.optimize import least_squares

import thesis_pin
from thesis_pin.contacts.balance.dynamics import foot_dynamics
from thesis_pin.contacts.standing.references import reference_poses
from thesis_pin.loops.joints import singles
from thesis_pin.loops.motion.whole import flown
from thesis_pin.report.writers import csv_bytes

ROBOT = "example:anymal_c_simple_description/anymal"
TARGET = Path(__file__).parents[1] / "examples" / "anymal_trot.csv"
STRIDE, DUTY, STEP, LIFT = 0.8, 0.65, 0.08, 0.06  # s, share of it on the floor, m, m
HARMONICS, SAMPLES, STRIDES = 4, 80, 2  # of the base; of one stride; in the table
ORDER = {"LF_FOOT": 0.0, "RH_FOOT": 0.0, "RF_FOOT": 0.5, "LH_FOOT": 0.5}  # shares of a stride


class Trot:
    """One stride, by the base's harmonics."""

    def __init__(self) -> None:
        free = pin.JointModelFreeFlyer()
        self.robot = thesis_pin.load(ROBOT, root_joint=free)
        pose = reference_poses(self.robot)["standing"]
        self.feet = thesis_pin.find_feet(self.robot, pose=pose)
        self.start = thesis_pin.stand(self.robot, self.feet, pose).q
        self.data = self.robot.model.createData()
        self.frames = [self.robot.model.getFrameId(foot.frame) for foot in self.feet]
        self.balls = np.array([foot.placement[:3, 3] for foot in self.feet])
        self.time = STRIDE * np.arange(SAMPLES) / SAMPLES
        self.home = self.places(self.start)
        self.support = np.array([self.phase(foot.name) < DUTY for foot in self.feet]).T

    def places(self, q: np.ndarray) -> np.ndarray:
        """Centres of the feet's balls in the world [m], ``(4, 3)``."""
        pin.framesForwardKinematics(self.robot.model, self.data, q)
        return np.array(
            [self.data.oMf[f].act(ball) for f, ball in zip(self.frames, self.balls, strict=True)]
        )

    def phase(self, name: str) -> np.ndarray:
        """Where in its stride a foot is, from 0, when it lands, to 1."""
        return (self.time / STRIDE + ORDER[name]) % 1.0

    def foot_paths(self) -> np.ndarray:
        """Balls' centres over the stride [m], ``(n, 4, 3)``."""
        paths = np.repeat(self.home[None], SAMPLES, axis=0)
        for k, foot in enumerate(self.feet):
            phase = self.phase(foot.name)
            swing = np.clip((phase - DUTY) / (1 - DUTY), 0.0, 1.0)
            moved = swing**3 * (10 - 15 * swing + 6 * swing**2)
            # A foot lands half a stance ahead of its home, which moves on with the base.
            ahead = STEP * (moved + DUTY / 2) + STEP * (
                np.floor(self.time / STRIDE + ORDER[foot.name])
            )
            paths[:, k, 0] += ahead - STEP * ORDER[foot.name]
            paths[:, k, 2] += LIFT * 64 * swing**3 * (1 - swing) ** 3
        return paths

    def base(self, values: np.ndarray) -> np.ndarray:
        """Shift in x, y and turns roll, pitch over the stride, ``(n, 4)``."""
        angle = 2 * np.pi * np.outer(self.time / STRIDE, np.arange(1, HARMONICS + 1))
        waves = np.concatenate([np.cos(angle), np.sin(angle)], axis=1)
        shares = values[4:].reshape(4, -1)
        return values[:4] * [1, 1, 0, 0] + waves @ shares.T

    def states(self, values: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Configurations, rates and accelerations over the stride."""
        sway = self.base(values)
        q = np.repeat(self.start[None], SAMPLES, axis=0)
        q[:, 0] += STEP * self.time / STRIDE + sway[:, 0]
        q[:, 1] += sway[:, 1]
        for k in range(SAMPLES):
            turn = pin.rpy.rpyToMatrix(sway[k, 2], sway[k, 3], 0.0)
            q[k, 3:7] = pin.Quaternion(turn).coeffs()
        paths, guess = self.foot_paths(), self.start[7:]
        for k in range(SAMPLES):
            q[k, 7:] = guess
            for _ in range(6):
                gap = paths[k] - self.places(q[k])
                if np.abs(gap).max() < 1e-12:
                    break
                q[k, 7:] += self.joint_step(q[k], gap)
            guess = q[k, 7:]
        drift = np.zeros(q.shape[1])
        drift[0] = STEP / STRIDE
        whole = np.append(self.time, STRIDE)
        steady = q - np.outer(self.time, drift)
        curve = CubicSpline(whole, np.concatenate([steady, steady[:1]]), bc_type="periodic")
        first, second = curve(self.time, 1) + drift, curve(self.time, 2)
        placed, rates, pushes = flown(q[:, :7], first[:, :7], second[:, :7])
        q[:, :7] = placed
        return q, np.column_stack([rates, first[:, 7:]]), np.column_stack([pushes, second[:, 7:]])

    def joint_step(self, q: np.ndarray, gap: np.ndarray) -> np.ndarray:
        """How the joints have to move for the balls to move by gaps ``(4, 3)``."""
        model = self.robot.model
        pin.computeJointJacobians(model, self.data, q)
        pin.updateFramePlacements(model, self.data)
        step = np.zeros(model.nv - 6)
        axes = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
        for k, frame in enumerate(self.frames):
            whole = pin.getFrameJacobian(model, self.data, frame, axes)
            arm = self.data.oMf[frame].rotation @ self.balls[k]
            jacobian = (whole[:3] - pin.skew(arm) @ whole[3:])[:, 6:]
            step += np.linalg.lstsq(jacobian, gap[k], rcond=1e-9)[0]
        return step

    def missing(self, values: np.ndarray) -> np.ndarray:
        """How far the zero-moment point is beside the line of two feet that stand [mm]."""
        q, v, a = self.states(values)
        pair = np.flatnonzero(self.support.sum(axis=1) == 2)
        found = foot_dynamics(
            self.robot,
            self.feet,
            q[pair],
            v[pair],
            a[pair],
            support=self.support[pair],
            check=False,
        )
        zmp = found.zero_moment_point[:, :2]
        beside = np.empty(len(pair))
        for row, sample in enumerate(pair):
            one, other = found.stance.origin[row, self.support[sample], :2]
            way = other - one
            beside[row] = np.linalg.det([way, zmp[row] - one]) / np.linalg.norm(way)
        return np.concatenate([1e3 * beside, 0.05 * values])


def main() -> None:
    """Fit the base and write the table."""
    trot = Trot()
    done = least_squares(trot.missing, np.zeros(4 + 8 * HARMONICS), max_nfev=8)
    print(f"beside the line by at most {np.abs(done.fun[: -len(done.x)]).max():.3f} mm")
    q, _, _ = trot.states(done.x)
    strides = [q + np.eye(q.shape[1])[0] * STEP * k for k in range(STRIDES)]
    whole = np.concatenate(strides)[: SAMPLES * STRIDES]
    columns = {"t": STRIDE * np.arange(len(whole)) / SAMPLES}
    for k, name in enumerate(("x", "y", "z", "qx", "qy", "qz", "qw")):
        columns[f"base_{name}"] = whole[:, k]
    for name, joint in singles(trot.robot.model).items():
        columns[name] = joint.position(whole)
    columns = {name: np.round(values, 9) for name, values in columns.items()}
    for k, foot in enumerate(trot.feet):
        columns[f"contact_{foot.name}"] = np.tile(trot.support[:, k], STRIDES).astype(float)
    TARGET.write_bytes(csv_bytes(columns))


if __name__ == "__main__":
    main()
