"""What limits are put on, at planned samples, with its derivatives by the torso's jet.

The evaluation that cycles, starts and stops are planned with: given the torso's motion, the
feet's and who stands, how far inside its support the zero-moment point is, what the floor, the
servos, the knees and the joints' ranges are asked for.

Example:
    >>> sampler = Sampler(robot, branches)  # doctest: +SKIP
    >>> found = sampler(jets, Footing.of(robot, feet, support))  # doctest: +SKIP
    >>> found.margin.min(), found.line(robot).value.max()  # doctest: +SKIP
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from scout_pin.dynamics.inverse import walking
from scout_pin.model import Scout
from scout_pin.study.plan.footing import Footing
from scout_pin.study.plan.sampling.floor import contacts, pressed
from scout_pin.study.plan.sampling.jets import Heading
from scout_pin.study.plan.sampling.reach import STRAIGHT
from scout_pin.study.plan.sampling.sloped import Sloped
from scout_pin.study.plan.sampling.slopes import state_slopes
from scout_pin.study.plan.sampling.state import State, state
from thesis_pin.errors import WrongShape
from thesis_pin.numeric.arrays import finite_array
from thesis_pin.numeric.checks import instance
from thesis_pin.numeric.trajectory import BodyMotion
from thesis_pin.tolerances import GRAVITY


@dataclass(frozen=True)
class Quantities:
    """What limits are put on at n samples.

    Attributes:
        edge: Signed distance of the zero-moment point inside each edge of the support polygon
            [m], ``(n, h)``; ∞ where a polygon has fewer edges. Its least is the margin.
        force: Vertical force of the floor, relative to the weight, ``(n, 1)``.
        contact: By what the wrenches pass the facets of the soles' cones that they are nearest
            to, friction and yaw moment included, relative to the weight times the sole's
            length, ``(n, 8)``; in double support the wrench that is missing, or −1.
        torque: Of the joints [N·m], ``(n, 12)``.
        rate: Of the joints [rad/s], ``(n, 12)``.
        angle: Of the joints [rad], ``(n, 12)``.
        knee: Cosine that each knee is asked for, beyond ±1 out of reach, ``(n, 2)``.
    """

    edge: Sloped
    force: Sloped
    contact: Sloped
    torque: Sloped
    rate: Sloped
    angle: Sloped
    knee: Sloped

    @property
    def margin(self) -> np.ndarray:
        """How far the zero-moment point is inside the support polygon [m], ``(n,)``.

        Outside it is minus the distance from an edge's line, which next to a corner is less than
        that from the polygon.
        """
        return np.asarray(self.edge.value.min(axis=1))

    def line(self, robot: Scout) -> Sloped:
        """|τ|/τ_stall + |θ̇|/ω_no-load of each joint, ``(n, 12)``; 1 is a servo's limit."""
        shares = self.torque.size.times(1.0 / robot.stall_torque)
        return shares.plus(self.rate.size.times(1.0 / robot.no_load_speed))

    def part(self, samples: np.ndarray | slice) -> Quantities:
        """Some samples."""
        return Quantities(*(getattr(self, one.name).part(samples) for one in fields(self)))


class Sampler:
    """Evaluates what limits are put on.

    Args:
        robot: The biped, with a free-flyer root.
        branches: Number of each leg's branch of inverse kinematics, left then right; see
            :data:`scout_pin.BRANCHES`.
        straight: Cosine of a knee's angle, straight or folded, up to which angles are exact;
            beyond it they are softened, and nothing is to be planned there.
    """

    def __init__(self, robot: Scout, branches: tuple[int, int], straight: float = STRAIGHT) -> None:
        self.robot, self.branches = walking(robot), branches
        self.weight, self.straight = robot.mass * GRAVITY, straight
        self._last: _Kept | None = None

    def __call__(
        self,
        jets: np.ndarray,
        footing: Footing,
        *,
        slopes: bool = True,
        heading: Heading | None = None,
    ) -> Quantities:
        """Evaluate samples.

        Args:
            jets: Of the torso: x, y, z [m], pitch, roll, yaw [rad], their rates, their
                accelerations, shape ``(n, 18)``.
            footing: The feet.
            slopes: Whether to work out derivatives; else each slope is None.
            heading: What the torso's angles count from; None for the world's y.

        Raises:
            SingularPose: A leg's Jacobian loses rank otherwise than by a straight knee.
        """
        instance("footing", footing, Footing, "Footing.of()")
        jets = finite_array("jets", jets, None, 18)
        if len(jets) != footing.count:
            raise WrongShape("jets", jets.shape, f"({footing.count}, 18), as the footing")
        here, rate = self.state(jets, footing, heading), heading.rate if heading else 0.0
        of = state_slopes(self.robot, jets, footing, here, self.straight, rate) if slopes else None

        def known(value: np.ndarray, name: str) -> Sloped:
            return Sloped(value, None if of is None else getattr(of, name))

        wrench = known(here.dynamics.sole_wrench, "wrench")
        moved = None if of is None else of.sole
        edge, force = pressed(footing, here.feet, wrench, moved, self.weight)
        return Quantities(
            edge,
            force,
            contacts(
                self.robot.contacts,
                footing.support,
                here.feet,
                here.dynamics,
                wrench,
                self.weight,
            ),
            known(here.dynamics.torque, "torque"),
            known(here.joints.v, "rate"),
            known(here.joints.q, "angle"),
            known(here.knee, "knee"),
        )

    def state(self, jets: np.ndarray, footing: Footing, heading: Heading | None = None) -> State:
        """Joints, torques and wrenches of samples."""
        # A search asks for slopes where it has just been: every fourth state is the one before.
        if self._last is None or not self._last.of(jets, footing, heading):
            found = state(self.robot, self.branches, jets, footing, self.straight, heading)
            self._last = _Kept(jets.copy(), footing, heading, found)
        return self._last.state


@dataclass(frozen=True)
class _Kept:
    """A state with what it is of."""

    jets: np.ndarray
    footing: Footing
    heading: Heading | None
    state: State

    def of(self, jets: np.ndarray, footing: Footing, heading: Heading | None) -> bool:
        """Whether it is that of these jets, feet and heading."""
        mine = self.footing
        return (
            np.array_equal(jets, self.jets)
            and _same_heading(heading, self.heading)
            and np.array_equal(footing.support, mine.support)
            and all(map(_alike, footing.feet, mine.feet))
        )


def _same_heading(one: Heading | None, other: Heading | None) -> bool:
    if one is None or other is None:
        return one is other
    return one.rate == other.rate and np.array_equal(one.angle, other.angle)


def _alike(one: BodyMotion, other: BodyMotion) -> bool:
    pairs = ((getattr(one, part.name), getattr(other, part.name)) for part in fields(one))
    return all(a is b or np.array_equal(a, b) for a, b in pairs)
