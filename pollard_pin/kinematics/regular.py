"""Where the inverse kinematics loses rank, and rates don't exist."""

from __future__ import annotations

import numpy as np

from pollard_pin.kinematics.geometry import Geometry
from pollard_pin.kinematics.linkage import Linkage
from pollard_pin.kinematics.screws import Posture
from thesis_pin.errors import SingularPose
from thesis_pin.numeric.elementwise import ARRAYS, Elementwise, Number
from thesis_pin.tolerances import TOLERANCES


def serial_sines(geometry: Geometry, known: Linkage) -> tuple[Number, ...]:
    """Sines that vanish where the inverse kinematics loses rank.

    sin θ43, cos θ54, sin θ1716 and, for each side chain, the sine between rod and the plane
    of arm and vertical, and cos θ76i. Names: :attr:`Posture.SERIAL_NAMES`.
    """
    values = [known.s43, known.c54, known.bend]
    for side, numbers in zip(known.sides, geometry.sides, strict=True):
        values += [side.across / numbers.rod, side.span / numbers.rod]
    return tuple(values)


def singular(xp: Elementwise, geometry: Geometry, known: Linkage) -> bool:
    """Whether rates don't exist at some posture."""
    least = TOLERANCES.near_singular
    return any(xp.some((-least < sine) & (sine < least)) for sine in serial_sines(geometry, known))


def check_regular(
    geometry: Geometry,
    known: Linkage,
    time: np.ndarray | None = None,
    first: int = 0,
    xp: Elementwise = ARRAYS,
) -> None:
    """Refuse postures in which rates don't exist.

    Args:
        geometry: The robot's lengths.
        known: The postures, of floats or of arrays ``(n,)``.
        time: Their times [s], for the message.
        first: Number of the first of them, for the message.
        xp: For floats or for arrays.

    Raises:
        SingularPose: Names the first one and the direction that is lost.
    """
    if not singular(xp, geometry, known):
        return
    sines = np.column_stack([np.atleast_1d(one) for one in serial_sines(geometry, known)])
    lost = np.abs(sines) < TOLERANCES.near_singular
    sample, which = (int(k) for k in np.argwhere(lost)[0])
    raise SingularPose(
        f"rates don't exist: {Posture.SERIAL_NAMES[which]} (sine {sines[sample, which]:.1e})",
        where=(f"pose {first + sample}" if first + sample or len(sines) > 1 else "pose")
        + ("" if time is None else f" at t = {time[sample]:.6g} s"),
        allowed=f"sines above {TOLERANCES.near_singular:.0e}",
        remedy="Move the path away from this posture, or choose another branch",
    )
