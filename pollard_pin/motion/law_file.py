"""A path and its law of motion in TOML: places over the way, and how far along when.

::

    format = 1
    name = "arch, fastest"

    [law]                 # between two times the way's second derivative is constant
    time = [0.0, …]       # [s]
    rate = [0.0, …]       # of the way [1/s]

    [[pieces]]            # smooth pieces, one after the other; quintic splines over the way
    way = [0.0, …]
    position = [[0.45, −0.15, 0.0], …]        # [m]
    orientation_deg = [[0.0, 0.0, 0.0], …]    # ψ, θ, φ

The way is any parameter that grows along the path.
"""

from __future__ import annotations

import itertools
import json
from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from pollard_pin.coordinates import pose_from_placement, pose_rotation
from pollard_pin.motion.chain import ARM, Chain, direction
from pollard_pin.motion.orientation import named_alike
from pollard_pin.motion.path import Curve, ToolPath
from pollard_pin.motion.samples import along_curves, continued
from thesis_pin.errors import TrajectoryError
from thesis_pin.model.made_for import MadeFor
from thesis_pin.model.specification import Key, NotNegative, Strict, Vector3
from thesis_pin.numeric.interpolation import free_quintic
from thesis_pin.timing.law import Law
from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]

_FEWEST, _MOST = 17, 16_385  # nodes of a piece that is written
_NEAR, _TRUE = 1e-8, 2e-4  # by how much it may be off: metres, and shares of its derivatives


class LawTable(Strict):
    """How far along it is when: times [s], and rates of the way there [1/s]."""

    time: tuple[float, ...]
    rate: tuple[NotNegative, ...]

    def faults(self) -> Iterator[tuple[Key, str, object]]:
        """What is wrong between its columns."""
        if len(self.time) != len(self.rate) or len(self.time) < 2:
            yield ("rate",), f"has {len(self.rate)} values for {len(self.time)} times", None
            return
        for k, (before, after) in enumerate(itertools.pairwise(self.time)):
            if after <= before:
                what = f"time goes from {before:g} to {after:g}; it must increase"
                yield ("time", k + 1), what, after
                return
        for k, pair in enumerate(itertools.pairwise(self.rate)):
            if not any(pair):
                yield ("rate", k + 1), "is zero twice in a row, and nothing would move", 0.0
                return

    def places(self) -> Array:
        """The way at its times, from 0 on."""
        time, rate = np.array(self.time), np.array(self.rate)
        steps = np.diff(time) * (rate[1:] + rate[:-1]) / 2
        return np.concatenate([[0.0], np.cumsum(steps)])


class Piece(Strict):
    """A smooth piece: places [m] and orientations ψ, θ, φ [deg] over the way."""

    way: tuple[float, ...]
    position: tuple[Vector3, ...]
    orientation_deg: tuple[Vector3, ...]

    def faults(self) -> Iterator[tuple[Key, str, object]]:
        """What is wrong between its columns."""
        count = len(self.way)
        if count < 2:
            yield ("way",), "needs at least two nodes", None
        for name in ("position", "orientation_deg"):
            if len(getattr(self, name)) != count:
                yield (name,), f"has {len(getattr(self, name))} rows for {count} nodes", None
        for k, (before, after) in enumerate(itertools.pairwise(self.way)):
            if after - before < TOLERANCES.step:
                what = f"goes from {before:g} to {after:g}; it must increase"
                yield ("way", k + 1), what, after
                return


def lawful(name: str, law: LawTable, pieces: Sequence[Piece]) -> ToolPath:
    """The path that a law and pieces describe.

    Raises:
        TrajectoryError: The law's way isn't the pieces', they don't follow each other, or their
            direction jumps where the law doesn't rest.
    """
    for k, (before, after) in enumerate(itertools.pairwise(pieces)):
        if after.way[0] != before.way[-1]:
            raise TrajectoryError(
                f"the way of piece {k + 1} ends at {before.way[-1]:.12g}, and the next begins at "
                f"{after.way[0]:.12g}",
                allowed="one way from the first to the last",
            )
    ends = np.array([pieces[0].way[0], *(piece.way[-1] for piece in pieces)])
    places, whole = law.places(), float(ends[-1] - ends[0])
    if abs(places[-1] - whole) > TOLERANCES.law_way * whole:
        raise TrajectoryError(
            f"the law goes {places[-1]:.12g} along, and the pieces are {whole:.12g} long",
            remedy="Write both from one motion",
        )
    ends = ends - ends[0]
    moved = Law(places * (whole / places[-1]), np.array(law.rate) * (whole / places[-1]))
    curves = [
        _curve(name, *map(np.array, (one.way, one.position, np.radians(one.orientation_deg))))
        for one in pieces
    ]
    stops = [True, *_stops(curves, moved, ends[1:-1]), True]
    chain = Chain(tuple(curves), np.ones(len(curves)), ends, np.array(stops))
    nodes = sum(len(piece.way) for piece in pieces)
    path = chain.timed(moved, name, {"nodes": nodes, "law": "from the file"})
    return path


def _stops(curves: Sequence[Curve], law: Law, meets: Array) -> Iterator[bool]:
    """Whether the law rests where pieces meet."""
    for k, place in enumerate(meets):
        before, after = curves[k], curves[k + 1]
        one, two = (
            direction(curve.function(np.array([at]))[0])
            for curve, at in ((before, before.length), (after, 0.0))
        )
        rate = float(np.interp(place, law.place, law.rate))
        jump = float(np.abs(one - two).max()) * rate
        if jump > TOLERANCES.rate_jump:
            raise TrajectoryError(
                f"the rate jumps by {jump:.3g} where pieces {k + 1} and {k + 2} meet",
                remedy="Let the law rest there",
            )
        yield rate <= TOLERANCES.rate_jump


def _curve(name: str, way: Array, position: Array, written: Array) -> Curve:
    """A piece's curve over the way from its own beginning on; ``written`` is ψ, θ, φ [rad]."""
    way = way - way[0]
    rotation = pose_rotation(np.concatenate([position, written], axis=1))
    quaternion, _, _ = continued(rotation, written, lambda k: f"node {k + 1}")
    columns = [free_quintic(way, column) for column in (*position.T, *quaternion.T)]
    names = (way, named_alike(rotation, written[0]))
    path = along_curves(columns[:3], columns[3:], names, {"path": name})
    return Curve(float(way[-1]), path.function)


def law_toml(name: str, chain: Chain, law: Law, made_for: MadeFor | None = None) -> str:
    """A path in this form; what is read from it is the same to 10 nm and 0.02 % of its bends.

    Args:
        name: Its name.
        chain: Its geometry.
        law: Over the chain's parameter.
        made_for: The robot whose motors it is the law for; None says nothing.
    """
    lines = ["format = 1", f"name = {json.dumps(name)}"]
    lines += [*([made_for.toml] if made_for else []), "", "[law]"]
    lines += [f"time = {_listed(law.time)}", f"rate = {_listed(law.rate)}"]
    for k in range(len(chain.curves)):
        way, poses = _nodes(name, chain, k)
        angles = np.degrees(poses[:, 3:]) + 0.0
        lines += ["", "[[pieces]]", f"way = {_listed(way)}"]
        lines += [f"position = {(poses[:, :3] + 0.0).tolist()}"]
        lines += [f"orientation_deg = {angles.tolist()}"]
    return "\n".join(lines) + "\n"


def _listed(values: Array) -> str:
    return f"[{', '.join(f'{value:.13g}' for value in values.tolist())}]"


def _nodes(name: str, chain: Chain, number: int) -> tuple[Array, Array]:
    """As many nodes of a piece as its spline needs."""
    count = _FEWEST
    while True:
        way = np.linspace(chain.ends[number], chain.ends[number + 1], count)
        tool, near = chain.piece(number, way)
        poses = pose_from_placement(tool.position, tool.rotation, near)
        share = np.array([0.0, 0.07, 0.23, 0.5, 0.81])
        between = (way[:-1, None] + np.diff(way)[:, None] * share).ravel()
        own, _ = chain.piece(number, between)
        found, _ = _curve(name, way, poses[:, :3], poses[:, 3:]).function(between - way[0])
        apart = np.linalg.norm(found.position - own.position, axis=1).max()
        size = _size(own.velocity, own.omega)
        wrong = max(
            _off(found.velocity, own.velocity, found.omega, own.omega) / size,
            _off(found.acceleration, own.acceleration, found.alpha, own.alpha)
            / max(_size(own.acceleration, own.alpha), size / (way[-1] - way[0])),
        )
        if (apart <= _NEAR and wrong <= _TRUE) or 2 * count > _MOST:
            return way, poses
        count = 2 * count - 1


def _off(one: Array, other: Array, turned: Array, by: Array) -> float:
    """Largest difference of derivatives, turning counted at :data:`ARM`."""
    return _size(one - other, turned - by)


def _size(vector: Array, turn: Array) -> float:
    both = np.linalg.norm(vector, axis=1) + ARM * np.linalg.norm(turn, axis=1)
    return float(both.max())
