"""What ties bodies and joints of MuJoCo's compiled model: connects, welds, gears."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from thesis_pin.model.formats.cutting import Cutter
from thesis_pin.model.formats.mjcf.names import name_at, turned
from thesis_pin.model.formats.writer import pose
from thesis_pin.model.mechanism.description import Array
from thesis_pin.model.mechanism.supplement import Closure, Coupling, Mask

if TYPE_CHECKING:
    import mujoco

_CONNECT, _WELD, _JOINT = 0, 1, 2
"""MuJoCo's types of equalities, ``mjtEq``."""

_SITE = 6
"""``mjtObj`` of a site."""

_ROWS: dict[int, Mask] = {
    _CONNECT: (True, True, True, False, False, False),
    _WELD: (True, True, True, True, True, True),
}


@dataclass(frozen=True, eq=False)
class Equalities:
    """Equalities of a model.

    Attributes:
        model: The model.
        bodies: A name for each body.
        joints: A name for each joint.
        where: File name for messages.
        switched_off: Whether the file switches all of them off.
        passed_over: Those that aren't used are added here.
    """

    model: mujoco.MjModel
    bodies: list[str]
    joints: list[str]
    where: str
    switched_off: bool
    passed_over: list[str]

    def tied_bodies(self) -> Iterator[tuple[int, int]]:
        """Numbers of the bodies that each connect or weld ties."""
        for k in range(self.model.neq):
            if int(self.model.eq_type[k]) in _ROWS:
                one, other, _, _ = self._anchors(k)
                yield one, other

    def closures(self, made: Cutter) -> Iterator[Closure]:
        """Connects and welds.

        Args:
            made: The links, to which two frames are added for each.
        """
        for k in self._used(_CONNECT, _WELD):
            one, other, first, second = self._anchors(k)
            ends = self.bodies[one], self.bodies[other]
            name = self._name(k, " – ".join(ends))
            stem = self._name(k, "_".join(ends))
            frames = (
                made.frame(f"{stem}_1", ends[0], first, 0),
                made.frame(f"{stem}_2", ends[1], second, 0),
            )
            yield Closure(name, frames, _ROWS[int(self.model.eq_type[k])])

    def couplings(self) -> Iterator[Coupling]:
        """Joint equalities that are linear: q₁ − q₁⁰ = a₀ + a₁ (q₂ − q₂⁰)."""
        model = self.model
        start = model.qpos0[model.jnt_qposadr]
        for k in self._used(_JOINT):
            one, other = int(model.eq_obj1id[k]), int(model.eq_obj2id[k])
            shift, factor, *more = (float(a) for a in model.eq_data[k][:5])
            names = [self.joints[j] for j in (one, other) if j >= 0]
            name = self._name(k, " – ".join(names))
            if other >= 0 and any(more):
                self.passed_over.append(
                    f"{self.where}: equality {name!r}, which ties joints by a polynomial of a "
                    "higher degree than 1"
                )
                continue
            coefficients, constant = {names[0]: 1.0}, float(start[one]) + shift
            if other >= 0:
                coefficients[names[1]] = -factor
                constant -= factor * float(start[other])
            yield Coupling(name, coefficients, constant)

    def _used(self, *kinds: int) -> Iterator[int]:
        for k in range(self.model.neq):
            if int(self.model.eq_type[k]) not in kinds:
                continue
            if self.switched_off or not self.model.eq_active0[k]:
                name = self._name(k, f"number {k}")
                self.passed_over.append(f"{self.where}: equality {name!r}, which isn't active")
            else:
                yield k

    def _anchors(self, k: int) -> tuple[int, int, Array, Array]:
        """Bodies of a connect or weld, and its frame on each."""
        model, data = self.model, self.model.eq_data[k]
        one, other = int(model.eq_obj1id[k]), int(model.eq_obj2id[k])
        if int(model.eq_objtype[k]) == _SITE:
            first, second = (
                pose(model.site_pos[s], turned(model.site_quat[s])) for s in (one, other)
            )
            return int(model.site_bodyid[one]), int(model.site_bodyid[other]), first, second
        if int(model.eq_type[k]) == _CONNECT:
            return one, other, pose(data[:3]), pose(data[3:6])
        # A weld's data: its anchor on the second body, then where that stands on the first.
        return one, other, pose(data[3:6], turned(data[6:10])), pose(data[:3])

    def _name(self, k: int, otherwise: str) -> str:
        return name_at(self.model, self.model.name_eqadr[k]) or otherwise
