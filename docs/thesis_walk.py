"""How little of the thesis's gait has to change so that Scout can walk it; see docs/planning.md.

Run ``python docs/thesis_walk.py``. The feet keep the thesis's way, height and times in the air:
two steps of 52.26 mm, 30 mm high, 2 s each, 89 mm apart. What has to be added is time in which
weight goes over. The torso's curves are to be as near to the thesis's as the limits allow: each
limit a hinge, and beside it a pull towards the thesis's curves that is weakened step by step.
"""

from __future__ import annotations

import numpy as np

import scout_pin
from scout_pin.motion.contact import Phase
from scout_pin.study.plan.limits import Limits
from scout_pin.study.plan.newton import descend
from scout_pin.study.plan.request import PlanRequest
from scout_pin.study.plan.samples import Sampler
from scout_pin.study.plan.walks.clamped import Clamped
from scout_pin.study.plan.walks.course import Course, swing_curves
from scout_pin.study.plan.walks.transitions import Grid, TransitionProblem, spaced
from scout_pin.study.plan.walks.walk import chained
from thesis_pin.numeric.interpolation import constant, join

LENGTH, ASIDE, LIFT, SWING = 52.26e-3, 44.54e-3, 30e-3, 2.0
SHIFT = 1.0  # added before, between and after the steps [s]
LOWER = 8e-3  # of the pose in which it stands at last, whose knees would be straight
UNITS = np.array([0.01, 0.01, 0.01, 0.1, 0.1, 0.1])  # [m], [rad] that count alike
HARD = 10.0  # of limits beside the pull
MARKS = np.cumsum([0.0, SHIFT, SWING, SHIFT, SWING, SHIFT])


def thesis_torso(t: np.ndarray) -> np.ndarray:
    """The thesis's torso at the walk's times, held while weight goes over, ``(n, 6)``."""
    gait = scout_pin.load_gait("thesis")
    s = np.interp(t, MARKS, [0, 0, 20, 20, 40, 40])
    return np.stack([curve(s) for curve in gait.curves["torso"]], axis=1)


def course() -> Course:
    """Phases and feet; the search begins with a sway of 30 mm and 8°."""
    end = MARKS[-1]
    supports = ("double", "left", "double", "right", "double")
    phases = tuple(
        Phase(start=a, end=b, support=side)
        for a, b, side in zip(MARKS[:-1], MARKS[1:], supports, strict=True)
    )
    feet = {}
    for side, x, off in (("left", -ASIDE, MARKS[3]), ("right", ASIDE, MARKS[1])):
        y, z = swing_curves(off, off + SWING, 0.0, LENGTH, LIFT)
        fixed = [constant(0.0, end, value) for value in (x, 0, 0, 0, 0, 0)]
        for k, curve, high in ((1, y, LENGTH), (2, z, 0.0)):
            after = constant(off + SWING, end, high)
            fixed[k] = join([constant(0.0, off, 0.0), curve, after])
        feet[f"{side}_foot"] = tuple(fixed)
    last = thesis_torso(np.array([end]))[0] - [0, 0, LOWER, 0, 0, 0]
    jet = np.zeros((6, 3))
    jet[:, 0] = last
    torso = Clamped(end, round(4 * end), jet, True)
    t = np.linspace(0.0, end, 4 * torso.intervals)
    sway = np.interp(t, MARKS, [0, -1, -1, 1, 1, 0])
    wanted = thesis_torso(t)
    wanted[:, 0], wanted[:, 4] = 0.030 * sway, np.radians(8) * sway
    wanted[:, 2] -= LOWER
    return Course("right", phases, feet, torso, torso.fitted(t, wanted))


class Pulled:
    """Limits, and how far the torso is from the thesis's."""

    def __init__(self, limits: TransitionProblem, way: Course) -> None:
        self.limits, self.pull = limits, 1.0
        t = np.linspace(0.0, way.duration, 4 * way.torso.intervals)
        maps, added = way.torso.maps(t)
        self.maps, self.short = maps[0], added[:, :6] - thesis_torso(t)

    def residuals(self, x: np.ndarray, *, slopes: bool) -> tuple[np.ndarray, np.ndarray | None]:
        """As of :class:`scout_pin.study.plan.newton.Problem`."""
        beyond, of = self.limits.residuals(x, slopes=slopes)
        scale = self.pull / np.sqrt(len(self.short))
        away = (self.short + self.maps @ self.limits.free(x)) / UNITS * scale
        residual = np.concatenate([HARD * beyond, away.ravel()])
        if of is None:
            return residual, None
        # Unknowns are in the same units, so that these cancel.
        pulled = np.einsum("nk,cd->nckd", self.maps * scale, np.eye(6)).reshape(away.size, -1)
        return residual, np.concatenate([HARD * of, pulled])


def main() -> None:
    """Find it, and say what it is."""
    robot, way = scout_pin.load(), course()
    sampler = Sampler(robot, (0, 5))
    request = PlanRequest(margin=0.0, torque_reserve=0.0, speed_reserve=0.0, line_reserve=0.0)
    bounds = np.array([[-9, -9, 0.15, -0.5, -0.5, -0.5], [9, 9, 0.2344, 0.5, 0.5, 0.5]])
    grid = Grid.of(sampler, way, *spaced(way, 160))
    limits = TransitionProblem(sampler, Limits.of(robot, request), bounds, grid)
    problem = Pulled(limits, way)
    x = (way.guess / UNITS).ravel()
    for problem.pull in (0.3, 0.1, 0.05, 0.02):
        x = descend(problem, x, most=80, slow=1e-3, enough=0.0).x
    gait = chained("thesis, mended", "", [way.stretch(limits.free(x))])
    report = scout_pin.gait_report(robot, gait, samples=1601)
    t = np.linspace(0.0, way.duration, 1001)
    change = np.stack([curve(t) for curve in gait.curves["torso"]], axis=1) - thesis_torso(t)
    change *= np.array([1e3, 1e3, 1e3, *np.degrees([1, 1, 1])])
    for name, column in zip(["x", "y", "z", "pitch", "roll", "yaw"], change.T, strict=True):
        unit = "mm" if name in "xyz" else "°"
        rms = np.sqrt((column**2).mean())
        print(f"{name}: at most {np.abs(column).max():.1f} {unit}, RMS {rms:.1f} {unit}")
    print("\n".join(report.verdict()))


if __name__ == "__main__":
    main()
