"""Gaits from files: nodes, polynomials or constants in TOML, samples in tables.

The formats are described in docs/scout.md.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Annotated, Literal

import numpy as np

from scout_pin.coordinates import POSE_NAMES
from scout_pin.model import Scout
from scout_pin.motion.contact import Phase
from scout_pin.motion.gait import BODIES, Gait
from scout_pin.specification import BranchKeys
from thesis_pin.errors import BadInput, TrajectoryError, UnknownName
from thesis_pin.model.limits import LIMITS, Key
from thesis_pin.model.made_for import MadeFor
from thesis_pin.model.shipped import read_shipped
from thesis_pin.model.strict import Held, Positive, Strict
from thesis_pin.numeric.checks import choice
from thesis_pin.numeric.interpolation import (
    METHODS,
    MOST_COEFFICIENTS,
    constant,
    interpolate,
    join,
    jumps,
    polynomial,
)
from thesis_pin.numeric.piecewise import Piecewise
from thesis_pin.smoothing.stated import stated
from thesis_pin.tolerances import TOLERANCES

GAITS = Path(__file__).parents[1] / "gaits"
PRESETS = ("thesis", "thesis-program")

Method = Literal["linear", "quadratic", "cubic", "free", "quintic"]
Coefficients = Annotated[tuple[float, ...], Held(min_length=1, max_length=MOST_COEFFICIENTS)]


class Segment(Strict):
    """Part of a curve over an interval of t: nodes to interpolate, a polynomial, or pieces.

    A piece's coefficients count from its own start, not from t = 0 as a polynomial's do: far from
    there a polynomial's digits cancel, and curves of programs that plan keep every bit.

    ``until`` carries the last piece of a node segment past its last node, as the
    thesis does with y_B; only quadratic curves do so literally, other methods
    pass through the start of the next segment instead.
    """

    t: Annotated[tuple[float, ...], Held(min_length=2)]
    value: Annotated[tuple[float, ...], Held(min_length=1)] | None = None
    polynomial: Annotated[tuple[float, ...], Held(min_length=1)] | None = None
    pieces: Annotated[tuple[Coefficients, ...], Held(min_length=1)] | None = None
    interpolation: Method | None = None
    until: float | None = None

    @property
    def end(self) -> float:
        """Where the segment stops."""
        return self.t[-1] if self.until is None else self.until


class BodyCurves(Strict):
    """Curves of one body; a number is a constant. ``_mm`` and ``_deg`` change the unit."""

    x: float | tuple[Segment, ...] | None = None
    y: float | tuple[Segment, ...] | None = None
    z: float | tuple[Segment, ...] | None = None
    x_mm: float | tuple[Segment, ...] | None = None
    y_mm: float | tuple[Segment, ...] | None = None
    z_mm: float | tuple[Segment, ...] | None = None
    pitch: float | tuple[Segment, ...] | None = None
    roll: float | tuple[Segment, ...] | None = None
    yaw: float | tuple[Segment, ...] | None = None
    pitch_deg: float | tuple[Segment, ...] | None = None
    roll_deg: float | tuple[Segment, ...] | None = None
    yaw_deg: float | tuple[Segment, ...] | None = None


class GaitFile(BranchKeys):
    """The format of a gait's TOML file."""

    format: Literal[1]
    name: str
    source: str = ""
    time_unit: Positive
    interpolation: Method = "quadratic"
    cycle: bool = False
    torso: BodyCurves
    left_foot: BodyCurves
    right_foot: BodyCurves
    phases: Annotated[tuple[Phase, ...], Held(min_length=1, max_length=LIMITS.phases)]
    made_for: MadeFor | None = None

    def cross_check(self) -> Iterator[tuple[Key, str, object]]:
        """Phases follow each other; segments do, with as many values as nodes."""
        yield from super().cross_check()
        for k, phase in enumerate(self.phases):
            if phase.end < phase.start:
                yield ("phases", k, "end"), "a phase can't end before it starts", phase.end
            if k and phase.start != self.phases[k - 1].end:
                yield (
                    ("phases", k, "start"),
                    f"must be the end of the phase before, {self.phases[k - 1].end:g}",
                    phase.start,
                )
        if self.phases[-1].end <= self.phases[0].start:
            yield ("phases",), "the gait lasts no time", None
        for body in BODIES:
            for name, curve in getattr(self, body):
                if isinstance(curve, tuple):
                    yield from self._check_curve((body, name), curve)
            for coordinate in POSE_NAMES:
                unit = "_mm" if coordinate in "xyz" else "_deg"
                both = [
                    n
                    for n in (coordinate, coordinate + unit)
                    if getattr(getattr(self, body), n) is not None
                ]
                if len(both) > 1:
                    yield (body, both[1]), f"given twice, as {both[0]} and {both[1]}", None

    def _check_curve(
        self, key: Key, curve: tuple[Segment, ...]
    ) -> Iterator[tuple[Key, str, object]]:
        start, end = self.phases[0].start, self.phases[-1].end
        if not curve:
            yield key, "has no segment", None
            return
        for k, segment in enumerate(curve):
            here = (*key, k)
            given = (segment.value, segment.polynomial, segment.pieces)
            if sum(one is not None for one in given) != 1:
                yield here, "needs either value or polynomial or pieces", None
            if segment.value is not None and len(segment.value) != len(segment.t):
                yield (
                    (*here, "value"),
                    f"must have one value for each of the {len(segment.t)} nodes in t",
                    segment.value,
                )
            if segment.polynomial is not None and (len(segment.t) != 2 or segment.interpolation):
                yield here, "a polynomial takes t = [start, end] and no interpolation", segment.t
            if segment.pieces is not None and len(segment.pieces) != len(segment.t) - 1:
                yield (
                    (*here, "pieces"),
                    f"must have one list of coefficients for each of the {len(segment.t) - 1} "
                    "intervals between nodes in t",
                    len(segment.pieces),
                )
            if segment.pieces is not None and (segment.interpolation or segment.until is not None):
                yield here, "pieces take neither interpolation nor until", None
            if any(b <= a for a, b in zip(segment.t, segment.t[1:], strict=False)):
                yield (*here, "t"), "must increase strictly", segment.t
            if segment.until is not None and segment.until <= segment.t[-1]:
                yield (
                    (*here, "until"),
                    f"must be after the last node, {segment.t[-1]:g}",
                    segment.until,
                )
            if k and segment.t[0] != curve[k - 1].end:
                yield (
                    (*here, "t"),
                    f"must start where the segment before ends, {curve[k - 1].end:g}",
                    segment.t[0],
                )
        if curve[0].t[0] > start or curve[-1].end < end:
            yield (
                key,
                f"covers t = {curve[0].t[0]:g} to {curve[-1].end:g}; the phases need "
                f"{start:g} to {end:g}",
                None,
            )


def load_gait(
    source: str | Path = "thesis",
    interpolation: str | None = None,
    *,
    smooth: str = "auto",
    time_unit: float | None = None,
    robot: Scout | None = None,
) -> Gait:
    """Load a preset, a TOML gait or a table of samples.

    Args:
        source: One of :data:`PRESETS`, or a path ending in ``.toml`` or in one of
            :data:`~thesis_pin.tables.reading.TABLES`.
        interpolation: Method for every node segment, instead of the file's; curves then
            pass through every sample of a table.
        smooth: Of a table: ``auto`` takes its samples for as fine as they show themselves to
            be, ``none`` for exact, and a length such as ``0.1mm``, an angle such as
            ``0.05deg`` or both with a comma for no finer than that.
        time_unit: Seconds in a unit of t in which the gait will be run; None for its own.
        robot: The biped, for tables of its joints' angles; nothing else needs it.

    Raises:
        BadInput: ``smooth`` is none of these, the file can't be read, has an unknown
            ending, or a cell of a CSV file isn't a number.
        SpecificationError: The TOML is invalid; carries every problem.
        TrajectoryError: The samples of a CSV file make no motion.
    """
    how = stated(smooth)
    if interpolation is not None:
        choice("interpolation", interpolation, list(METHODS))
    if not isinstance(source, str | Path):
        raise BadInput(f"{source!r} isn't a gait", allowed=f"{', '.join(PRESETS)} or a path")
    if str(source) in PRESETS:
        file = read_shipped("gait", GaitFile, GAITS / f"{source}.toml")
        return gait_of(file, interpolation)
    from thesis_pin.tables.reading import TABLES

    path = Path(source)
    if path.suffix.lower() in TABLES:
        # With SciPy's splines, which no other gait needs.
        from scout_pin.motion.resolution.reading import gait_from_samples
        from scout_pin.motion.tables import read_gait_table

        samples = read_gait_table(path, robot)
        return gait_from_samples(samples, how, interpolation, time_unit or 1.0)
    if path.suffix.lower() != ".toml":
        raise UnknownName("gait", str(source), (*PRESETS, "a .toml file", "a .csv file"))
    from thesis_pin.model.specification import read_toml

    return gait_of(read_toml("gait", GaitFile, path), interpolation)


def gait_of(file: GaitFile, interpolation: str | None = None) -> Gait:
    """The gait of a file that has been read.

    Args:
        file: Its content.
        interpolation: Method for every node segment, instead of the file's.

    Raises:
        BadInput: A method is given, and no segment has nodes that it could be for.
        TrajectoryError: A curve jumps.
    """
    if interpolation is not None:
        _refuse_nothing_to_override(file, interpolation)
    curves = {body: _curves(file, getattr(file, body), interpolation) for body in BODIES}
    return Gait(
        file.name,
        file.source,
        file.time_unit,
        curves,
        file.phases,
        cycle=file.cycle,
        branch=file.branch_asked,
        made_for=file.made_for,
    )


def _refuse_nothing_to_override(file: GaitFile, interpolation: str) -> None:
    """Refuse a method for nodes of a gait all of whose curves are exact.

    Raises:
        BadInput: They are.
    """
    curves = [
        getattr(getattr(file, body), name) for body in BODIES for name in BodyCurves.model_fields
    ]
    segments = [one for curve in curves if isinstance(curve, tuple) for one in curve]
    if segments and all(one.value is None for one in segments):
        raise BadInput(
            f"interpolation is {interpolation!r}, and curves of the gait {file.name!r} are exact",
            allowed="a gait some of whose curves have nodes",
            remedy="Leave it out: polynomials and pieces are taken as they are",
        )


def _curves(file: GaitFile, body: BodyCurves, override: str | None) -> tuple[Piecewise, ...]:
    curves = []
    for coordinate in POSE_NAMES:
        suffix, scale = ("_mm", 1e-3) if coordinate in "xyz" else ("_deg", np.pi / 180)
        plain, scaled = getattr(body, coordinate), getattr(body, coordinate + suffix)
        curve = plain if plain is not None else scaled
        factor = 1.0 if scaled is None else scale
        start, end = file.phases[0].start, file.phases[-1].end
        if curve is None:
            curve = 0.0
        if not isinstance(curve, tuple):
            curves.append(constant(start, end, curve * factor))
            continue
        made = _join_segments(curve, override, file.interpolation)
        made = Piecewise(made.c * factor, made.x)
        _refuse_jumps(made, f"gait {file.name!r}: {coordinate}")
        curves.append(made)
    return tuple(curves)


def _refuse_jumps(curve: Piecewise, where: str) -> None:
    """Segments must meet; the thesis's own rounding leaves gaps below 0.06 mm."""
    sizes = np.abs(jumps(curve))
    if (sizes > TOLERANCES.seam).any():
        k = int(np.argmax(sizes >= sizes.max() * (1 - TOLERANCES.mirror)))  # of equals the first
        raise TrajectoryError(
            f"its value jumps by {sizes[k]:.3g}",
            where=f"{where} at t = {curve.x[k + 1]:g}",
            allowed=f"{TOLERANCES.seam:g} m or rad",
            remedy="Let each segment begin with the value the one before ends with",
        )


def _join_segments(curve: tuple[Segment, ...], override: str | None, default: str) -> Piecewise:
    pieces: list[Piecewise] = []
    for k, segment in enumerate(curve):
        if segment.polynomial is not None:
            pieces.append(polynomial(segment.t[0], segment.t[1], segment.polynomial))
            continue
        if segment.pieces is not None:
            pieces.append(_piecewise(segment.t, segment.pieces))
            continue
        values = segment.value or ()
        constant_value = len(set(values)) == 1
        method = override or segment.interpolation or default
        t = segment.t
        if segment.until is not None and method != "quadratic":
            following = curve[k + 1] if k + 1 < len(curve) else None
            if following is not None and following.value is not None:
                t, values = (*t, segment.until), (*values, following.value[0])
        if constant_value and len(values) == len(segment.t):
            pieces.append(constant(t[0], segment.end, values[0]))
            continue
        piece = interpolate(t, values, method)
        if segment.end > piece.x[-1]:
            piece = Piecewise(piece.c, np.append(piece.x[:-1], segment.end))
        pieces.append(piece)
    return join(pieces)


def _piecewise(t: Sequence[float], pieces: Sequence[Coefficients]) -> Piecewise:
    """Pieces whose coefficients count from each one's start, highest power first."""
    order = max(map(len, pieces))
    rows = [(*[0.0] * (order - len(piece)), *piece) for piece in pieces]
    return Piecewise(np.array(rows).T, np.array(t))
