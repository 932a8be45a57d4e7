"""Inverse dynamics of any robot on its feet: torques, and what the floor does to each foot."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from thesis_pin.contacts.balance.carrying import Carrying, total_mass, velocity_scale
from thesis_pin.contacts.balance.grips import Grips
from thesis_pin.contacts.balance.result import FootDynamics
from thesis_pin.contacts.balance.sharing import SHARINGS, Problem, Shared, share
from thesis_pin.contacts.balance.stance import CHUNK, Levers, Stance, placed, stance
from thesis_pin.contacts.floor import Floor
from thesis_pin.contacts.soles.foot import Foot, by_name, check_free
from thesis_pin.errors import WrongShape
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.dynamics import inverse_dynamics
from thesis_pin.numeric.arrays import finite_array, spread, together
from thesis_pin.numeric.checks import choice, instance, real
from thesis_pin.numeric.elementwise import blocks

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

_IDLE = 1e-9  # what a contact force does to a joint that nothing holds, from which it counts


def foot_dynamics(
    robot: ClosedRobot,
    feet: Sequence[Foot],
    q: ArrayLike,
    v: ArrayLike | None = None,
    a: ArrayLike | None = None,
    *,
    support: ArrayLike | None = None,
    floor: Floor | None = None,
    sharing: str = "torque",
    slack: float = 0.0,
    sliding: ArrayLike | None = None,
    precision: float | None = None,
    check: bool = True,
) -> FootDynamics:
    """Motor torques and contact forces that a motion of a robot on its feet needs.

    The wrench that the floor has to supply in all follows from the motion. Where the feet that
    stand leave it open who carries what, ``sharing`` decides, among what friction pyramids of
    eight edges at the corners allow (7.6 % less friction than a cone at worst, never more). Where
    nothing is admissible, the same rule holds for feet glued to the floor, and ``violation`` says
    how much is missing. Damping, friction, springs and armature of the description count.

    Args:
        robot: The robot, with a free root.
        feet: Its feet.
        q: One closed configuration ``(nq,)`` or a stack ``(n, nq)``.
        v: Rates, as many, ``(n, nv)``; None for a pose that is held.
        a: Accelerations, same shape; None for none.
        support: Which feet bear load, booleans ``(feet,)`` or ``(n, feet)``; None for all.
        floor: The floor; None for a level one at height 0.
        sharing: ``torque`` for the least sum of squared torques, those of sliding motors
            multiplied by the robot's length; ``force`` for that of contact forces; ``equal`` for
            normal forces as equal as can be.
        slack: Wrench that may be missing [N·m, forces times length]: up to it forces are those of
            the nearest load that the floor can give, and what is missing stays at the root.
        sliding: See :func:`thesis_pin.loops.dynamics.inverse_dynamics`.
        precision: See :func:`thesis_pin.loops.configurations.surveying.surveyed`.
        check: Refuse motions that open loops, and loads that nothing carries.

    Returns:
        Torques and forces; arrays have samples first, also of one configuration.

    Raises:
        BadInput: The root is tied to the world, names of feet aren't unique, or the motion
            opens a loop.
        UnknownName: A foot is on a frame that isn't there, or there is no such sharing.
        SingularPose, NoSolution: As :func:`thesis_pin.loops.dynamics.inverse_dynamics`.

    Source: the base's rows of the equations of motion are the floor's wrench, as in the Scout
    thesis, 4.5–4.7 (corrected); cones of wrenches: Caron, Pham, Nakamura, ICRA 2015.
    """
    model = instance("robot", robot, ClosedRobot, "thesis_pin.load()").model
    by_name(feet)
    choice("sharing", sharing, SHARINGS)
    real("slack", slack, low=0.0, unit="N·m")
    floor = Floor() if floor is None else floor
    check_free(robot)
    q = finite_array("q", q, model.nq)
    v = np.zeros((*q.shape[:-1], model.nv)) if v is None else finite_array("v", v, model.nv)
    a = np.zeros((*q.shape[:-1], model.nv)) if a is None else finite_array("a", a, model.nv)
    q, v, a = (np.atleast_2d(x) for x in together(q=q, v=v, a=a))
    if q.ndim != 2 or not len(q):
        raise WrongShape("q", q.shape, "(nq,) or (n, nq) with at least one sample")
    stands = _support(support, len(q), feet)
    if sliding is not None:
        sliding = spread("sliding", finite_array("sliding", sliding, model.nv), q.shape[:-1])
    length = typical_length(robot, feet)
    wrench = np.zeros((len(q), len(feet), 6))
    violation, freedoms = np.zeros(len(q)), np.zeros(len(q), dtype=np.intp)
    required = np.zeros((len(q), 6))
    stood = []
    for some in blocks(len(q), CHUNK):
        slides = None if sliding is None else sliding[some]
        here, levers = placed(robot, feet, floor, q[some], v[some])
        stood.append(here)
        part = _Chunk(robot, feet, here, levers, length, (q[some], v[some], a[some]))
        found = part.share(stands[some], (sharing, slack), slides, precision)
        wrench[some], violation[some], freedoms[some], required[some] = found
    places = Stance.joined(stood)
    pushed = at_frames(feet, places, wrench)
    dynamics = inverse_dynamics(
        robot, q, v, a, external=pushed, sliding=sliding, check=check, precision=precision
    )
    return FootDynamics(
        robot=robot,
        feet=tuple(feet),
        floor=floor,
        sharing=sharing,
        stance=places,
        support=stands,
        length=length,
        wrench=wrench,
        required=required,
        violation=violation,
        freedoms=freedoms,
        loops=dynamics,
        scale=total_mass(robot) * gravity_size(robot) * length,
    )


def gravity_size(robot: ClosedRobot) -> float:
    """Size of the model's gravity [m/s²]."""
    return float(np.linalg.norm(robot.model.gravity.linear))


def typical_length(robot: ClosedRobot, feet: Sequence[Foot]) -> float:
    """What makes forces comparable to moments [m]; it doesn't depend on the pose.

    Half the diagonal of the largest sole; without soles half that of the box around all feet in
    the neutral pose; of a single point how far the centre of mass is from it there.
    """
    soles = [foot.contact.length for foot in feet if foot.kind == "sole"]
    if soles:
        return max(soles)
    places = stance(robot, feet, Floor(), robot.q0[None])
    corners = np.concatenate([points[0] for points in places.corners])
    apart = float(np.linalg.norm(np.ptp(corners, axis=0))) / 2
    return apart or float(np.linalg.norm(places.com[0] - corners[0])) or 1.0


def at_frames(feet: Sequence[Foot], places: Stance, wrench: Array) -> dict[str, Array]:
    """Wrenches about the feet's origins as wrenches on their frames, by frame, ``(n, 6)``."""
    found: dict[str, Array] = {}
    for k, foot in enumerate(feet):
        arm = places.origin[:, k] - places.frames[:, k]
        moved = wrench[:, k].copy()
        moved[:, 3:] += np.cross(arm, moved[:, :3])
        found[foot.frame] = found.get(foot.frame, 0.0) + moved
    return found


class _Chunk:
    """Some samples of a motion."""

    def __init__(
        self,
        robot: ClosedRobot,
        feet: Sequence[Foot],
        places: Stance,
        levers: Levers,
        length: float,
        state: tuple[Array, Array, Array],
    ) -> None:
        self.robot, self.feet, self.length = robot, feet, length
        self.places, self.levers = places, levers
        self.q, self.v, self.a = state

    def share(
        self, stands: Flags, rule: tuple[str, float], sliding: Array | None, precision: float | None
    ) -> tuple[Array, Array, NDArray[np.intp], Array]:
        """Wrenches, violations, open components, and the wrench about the world's origin."""
        count, feet = len(self.q), len(self.feet)
        carrying = Carrying(self.robot, self.q, precision)
        tau, root = carrying.forces(self.v, self.a, sliding)
        wrench = np.zeros((count, feet, 6))
        violation, freedoms = np.zeros(count), np.zeros(count, dtype=np.intp)
        patterns, which = np.unique(stands, axis=0, return_inverse=True)
        for number, pattern in enumerate(patterns):
            rows = np.flatnonzero(which.ravel() == number)
            grips = Grips.of(self.feet, np.flatnonzero(pattern).tolist(), self.length)
            here = self.places.part(rows)
            found = self._shared(carrying, grips, here, rows, (tau[rows], root[rows]), rule)
            wrench[rows] = grips.wrenches(here, found.unknowns, feet)
            violation[rows], freedoms[rows] = found.violation, found.freedoms
        required = root.copy()
        required[:, 3:] += np.cross(self.places.root, root[:, :3])
        return wrench, violation, freedoms, required

    def _shared(
        self,
        carrying: Carrying,
        grips: Grips,
        here: Stance,
        rows: NDArray[np.intp],
        load: tuple[Array, Array],
        rule: tuple[str, float],
    ) -> Shared:
        tau, root = load
        standing = sorted({grip.foot for grip in grips.each})
        about = here.origin[:, standing].mean(axis=1) if standing else here.com
        total = root * np.repeat([self.length, 1.0], 3)
        total[:, 3:] += np.cross(here.root - about, root[:, :3])
        sums = grips.sums(here, about)
        own = carrying.shares(tau[:, :, None], rows)
        taken = carrying.shares(grips.loads(here, self.levers.part(rows)), rows)
        felt = np.abs(taken.idle).max(axis=(0, 2), initial=0.0) > _IDLE
        total = np.concatenate([total, own.idle[:, felt, 0]], axis=1)
        sums = np.concatenate([sums, taken.idle[:, felt]], axis=1)
        unit = velocity_scale(self.robot)
        scale = total_mass(self.robot) * gravity_size(self.robot) * self.length
        problem = Problem(
            grips,
            sums,
            total,
            taken.motors * unit[:, None],
            own.motors[..., 0] * unit,
            scale if scale > 0 else 1.0,
        )
        return share(problem, *rule)


def _support(support: ArrayLike | None, count: int, feet: Sequence[Foot]) -> Flags:
    """Which feet bear load at each sample, booleans ``(n, feet)``."""
    if support is None:
        return np.ones((count, len(feet)), dtype=bool)
    found = np.asarray(support)
    if found.dtype != bool or found.shape not in ((len(feet),), (count, len(feet))):
        raise WrongShape(
            "support", found.shape, f"booleans ({len(feet)},) or ({count}, {len(feet)})"
        )
    return np.array(np.broadcast_to(found, (count, len(feet))))
