"""Shapes that bodies collide by: boxes, balls and capsules in a link's frame."""

from __future__ import annotations

from collections.abc import Iterator

from thesis_pin.model.limits import Key
from thesis_pin.model.strict import Positive, Strict, Vector3


class Shape(Strict):
    """One of a box, a ball or a capsule, in the link's frame.

    Attributes:
        box: Lengths of its sides [m].
        sphere: Radius [m].
        capsule: Radius [m] of a bar with round ends.
        at: Centre of box or ball [m].
        rpy_deg: Turns of a box about the fixed axes x, y, z, as in a URDF [°].
        ends: The points between which a capsule's axis lies [m].
    """

    box: tuple[Positive, Positive, Positive] | None = None
    sphere: Positive | None = None
    capsule: Positive | None = None
    at: Vector3 = (0.0, 0.0, 0.0)
    rpy_deg: Vector3 = (0.0, 0.0, 0.0)
    ends: tuple[Vector3, Vector3] | None = None

    def problems(self, key: Key) -> Iterator[tuple[Key, str, object]]:
        """What is wrong between its keys: key, complaint and value."""
        kinds = [name for name in ("box", "sphere", "capsule") if getattr(self, name) is not None]
        if len(kinds) != 1:
            yield key, "needs one of box, sphere, capsule", kinds or None
            return
        if (kinds == ["capsule"]) != (self.ends is not None):
            yield key, "a capsule has ends, and nothing else has", self.ends
        if self.ends is not None and self.ends[0] == self.ends[1]:
            yield (*key, "ends"), "must differ; a ball is a sphere", self.ends
        if kinds == ["capsule"] and any(self.at):
            yield (*key, "at"), "a capsule lies between its ends", self.at
        if kinds != ["box"] and any(self.rpy_deg):
            yield (*key, "rpy_deg"), "only a box can be turned", self.rpy_deg
