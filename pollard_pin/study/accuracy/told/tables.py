"""An accuracy study for people: tables and paragraphs."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from pollard_pin.study.accuracy.parameters import COLUMNS
from pollard_pin.study.accuracy.result import AccuracyNumbers
from pollard_pin.study.accuracy.told.verdict import down, sentences
from thesis_pin.report.tables import Part, Table

SHOWN = 12
"""Tolerances that are listed on a terminal."""

_WORDS = {
    "lengths": "lengths",
    "angles": "mounting angles",
    "axes": "tilted axes",
    "offsets": "shifted axes",
    "motors": "motor positions",
    "play": "play",
    "backlash": "backlash",
    "encoder": "encoders",
    "zero": "zeros",
}


def contributions_table(study: AccuracyNumbers, most: int | None = None) -> Table:
    """What each tolerance does, the most important first.

    Args:
        study: The study.
        most: How many are listed; None for all of them, with the means of their slopes.
    """
    every = study.contributions
    rows = []
    for one in every[:most]:
        unit = one.parameter.unit
        factor = 1.0 if unit == "mm" else np.radians(1.0) * 1e3
        rows.append(
            (
                one.parameter.name,
                f"±{one.tolerance.written:.3g} {'mm' if unit == 'mm' else '°'}",
                f"{one.slope * factor:.3f}",
                f"{one.mean * factor:.3f}",
                f"{one.reach * 1e3:.3f}",
                f"{np.degrees(one.turn):.4f}",
                f"{one.share:.1%}",
            )
        )
    heads = ("what is off", "by", "mm/unit", "mean", "mm", "°", "share")
    note = (
        f"mm/unit: {_level(study)} way of the tip for a millimetre or a degree; share: of the "
        "variance."
    )
    whole = Table("What matters most", heads, rows, note)
    return whole if most is None else whole.only(whole.title, (0, 1, 2, 4, 5, 6))


def kinds_table(study: AccuracyNumbers) -> Table:
    """What each kind of tolerance does, and all of them together."""
    stack, rows = study.stack, []
    counts = {kind: len(of) for kind, of in study.allowed.kinds.items()}
    for kind, numbers in stack.kinds.items():
        rows.append((_WORDS[kind], str(counts[kind]), *_four(study.typical(numbers.T))))
    everything = np.stack([stack.worst, stack.root, stack.worst_turn, stack.root_turn], axis=1)
    rows.append(("all together", str(len(study.allowed.each)), *_four(study.typical(everything))))
    heads = ("tolerances", "", "worst mm", "root mm", "worst °", "root °")
    note = (
        f"{_level(study).capitalize()} of all poses, linear in the errors; worst: at their worst "
        "signs; root: root of the sum of squares."
    )
    return Table(_title(study), heads, rows, note)


def within_table(study: AccuracyNumbers) -> list[Table]:
    """Which equal tolerances keep the tip within the limit."""
    found = study.within
    if found is None:
        return []
    rows = []
    for one in found.equal:
        unit = "mm" if one.unit == "mm" else "°"
        name = _WORDS.get(one.of, one.of)
        rows.append(
            (name, str(one.count), f"±{down(one.worst)} {unit}", f"±{down(one.root)} {unit}")
        )
    title = f"Equal tolerances that keep the tip within {found.limit * 1e3:.4g} mm"
    note = "Each with everything else exact; worst case by exact kinematics, rounded down."
    return [Table(title, ("of these alone", "", "worst case", "root sum square"), rows, note)]


def summary(study: AccuracyNumbers) -> Iterator[Part]:
    """The study in tables and paragraphs."""
    yield kinds_table(study)
    yield contributions_table(study, SHOWN)
    more = len(study.contributions) - SHOWN
    if more > 0:
        yield f"{more} more do less; --out writes all of them (sensitivities.csv)."
    yield from within_table(study)
    yield from ("", *sentences(study))
    yield from (f"Note: {one}." for one in notes(study))


def notes(study: AccuracyNumbers) -> list[str]:
    """What was chosen, and what the numbers rest on."""
    ways: dict[str, dict[str, None]] = {}
    for one in study.allowed.each:
        ways.setdefault(one.distribution, {})[one.parameter.kind] = None
    said = {
        "uniform": "anything within a tolerance is as likely",
        "normal": "a tolerance is three standard deviations",
        "ends": "play is at one end or the other",
    }
    named = len({one.parameter.column for one in study.allowed.each})
    found = [*study.allowed.notes, *(study.path.notes if study.path is not None else ())]
    if study.draws is not None:
        drawn = [
            said[way] + (f" ({', '.join(map(_WORDS.__getitem__, kinds))})" if len(ways) > 1 else "")
            for way, kinds in sorted(ways.items())
        ]
        found.append(f"drawn robots: {'; '.join(drawn)}")
    if study.allowed.source != "default":
        found.append(
            f"{named} of {len(COLUMNS)} numbers of the robot have a tolerance "
            f"({study.allowed.source})"
            f"{'; the others are taken as exact' if named < len(COLUMNS) else ''}"
        )
    return found


def _level(study: AccuracyNumbers) -> str:
    return "largest" if study.space is None else "median"


def _title(study: AccuracyNumbers) -> str:
    name = study.robot.specification.name
    if study.path is not None:
        return f"{name} on {study.path.name}, {len(study.pose)} samples"
    return f"{name}, {len(study.pose)} positions"


def _four(values: np.ndarray) -> tuple[str, ...]:
    one, two, three, four = values
    return (
        f"{one * 1e3:.3f}",
        f"{two * 1e3:.3f}",
        f"{np.degrees(three):.4f}",
        f"{np.degrees(four):.4f}",
    )
