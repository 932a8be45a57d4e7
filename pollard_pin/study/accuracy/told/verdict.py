"""What an accuracy study says in sentences."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from pollard_pin.study.accuracy.draws import Draws
from pollard_pin.study.accuracy.result import AccuracyNumbers, Contribution
from thesis_pin.numeric.arrays import median
from thesis_pin.tolerances import TOLERANCES

LEVEL = 0.95
"""Share of drawn robots that is told of."""

_FEW = 3


def mm(length: float) -> str:
    """A length in millimetres."""
    return f"{length * 1e3:.3g} mm" if np.isfinite(length) else "without bound"


def deg(angle: float) -> str:
    """An angle in degrees."""
    return f"{np.degrees(angle):.3g}°"


def slope(one: Contribution) -> str:
    """What one tolerance does, for a millimetre or a degree of it."""
    unit = one.parameter.unit
    factor = 1.0 if unit == "mm" else np.radians(1.0) * 1e3
    return f"{one.slope * factor:.3g} mm for each {'mm' if unit == 'mm' else '°'}"


def sentences(study: AccuracyNumbers) -> list[str]:
    """The answer, the most important first."""
    found = [*_answer(study), *_main(study)]
    if study.draws is not None:
        found += _drawn(study, study.draws)
    found += [f"Warning: {one}." for one in doubts(study)]
    found += _linear(study)
    if study.within is not None:
        found += _within(study)
    if study.stiffness is not None:
        give = study.stack.give * 1e3
        at = int(np.argmax(give))
        found.append(
            f"A force gives the tip {give.min():.3g} to {give[at]:.3g} mm for each newton (largest "
            f"at {study.place(at)}), of the motors alone: links and joints are taken as rigid."
        )
    return found


def doubts(study: AccuracyNumbers) -> list[str]:
    """What is to be known before the numbers are believed."""
    sizes = [one.size for one in study.allowed.each if one.parameter.unit == "mm"]
    widest = max(sizes, default=1.0)
    fine = (
        f"the widest tolerance of a length is {widest * 1e6:.2g} µm, which nobody makes: are they "
        "in metres?"
    )
    return [fine] * (widest < TOLERANCES.finest_length) + _bent(study)


def _bent(study: AccuracyNumbers) -> list[str]:
    """Where exact kinematics differ from linear ones."""
    bent, stack = study.bent, study.stack
    if not bent.any():
        return []
    lost = int((~np.isfinite(stack.exact)).sum())
    rest = f"; at {lost} of them the worst robot can't be assembled" if lost else ""
    where = f" (first at {study.place(int(np.argmax(bent)))})" if study.space is None else ""
    return [
        f"at {int(bent.sum())} of {len(bent)} poses exact kinematics differ from linear ones by "
        f"more than {TOLERANCES.linear:.0%} at the worst errors{where}{rest}: the tip is near a "
        "singularity, and what is linear there, root of squares and shares, means little"
    ]


def _answer(study: AccuracyNumbers) -> Iterator[str]:
    stack, k = study.stack, study.worst
    farthest, limit = stack.farthest, study.limit
    if limit is not None:
        share = float((farthest <= limit).mean())
        if study.within_limits:
            yield f"PASS: the spray tip stays within {mm(limit)} of its place at worst."
        elif study.space is None:
            yield (
                f"FAIL: the spray tip may be more than {mm(limit)} off its place, "
                + (f"on {1 - share:.1%} of the path." if share else "on the whole path.")
            )
        else:
            yield (
                f"FAIL: at {share:.0%} of the reachable positions the spray tip stays within "
                f"{mm(limit)} of its place at worst, not at all of them."
            )
    if study.space is None:
        yield (
            f"At worst the spray tip is {mm(farthest[k])} off ({study.place(k)}{_straight(study)})"
            f", {mm(farthest.mean())} in the mean of the path; by the root of the sum of squares "
            f"{mm(stack.root.max())}, in the mean {mm(stack.root.mean())}. Its direction is "
            f"{deg(stack.worst_turn.max())} off at worst, {deg(stack.root_turn.max())} by the root "
            "of the sum of squares."
        )
    else:
        least = int(np.argmin(farthest))
        yield (
            f"At worst the spray tip is {mm(farthest[least])} off at the best of {len(farthest)} "
            f"reachable positions, {study.place(least)}, {mm(float(median(farthest)))} in the "
            f"median; by the root of the sum of squares {mm(stack.root.min())} and "
            f"{mm(float(median(stack.root)))}."
        )


def _straight(study: AccuracyNumbers) -> str:
    """The linear worst case, which the tables have, where it is another number."""
    linear = mm(study.stack.worst.max())
    if linear == mm(study.stack.farthest[study.worst]):
        return ""
    return f", by exact kinematics; {linear} as far as what is linear goes, as in the table"


def _main(study: AccuracyNumbers) -> Iterator[str]:
    some = study.contributions[:_FEW]
    if not some[0].reach:
        yield "No tolerance moves the tip."
        return
    named = [f"{one.parameter.name} ({slope(one)}, {mm(one.reach)})" for one in some if one.reach]
    yield f"What moves it most: {', '.join(named)}."
    still = [one.parameter.name for one in study.contributions if not one.reach and not one.turn]
    if still:
        yield f"Without any effect on the tool: {', '.join(still)}."


def _drawn(study: AccuracyNumbers, draws: Draws) -> Iterator[str]:
    whole = int(draws.assembled.sum())
    where = "everywhere on the path" if study.space is None else "at every position"
    if whole < draws.count:
        share = np.isnan(draws.distance).mean()
        yield (
            f"Of {draws.count} drawn robots {draws.count - whole} can't be assembled {where} "
            f"({share:.1%} of all robots and poses)."
        )
    if not whole:
        return
    farthest = draws.farthest[draws.assembled]
    yield (
        f"Of {whole} drawn robots {LEVEL:.0%} stay within "
        f"{mm(float(np.quantile(farthest, LEVEL)))} {where}, half within "
        f"{mm(float(median(farthest)))}; the farthest is {mm(farthest.max())} off."
    )
    if study.limit is not None:
        inside = float((draws.farthest <= study.limit).mean())
        yield f"{inside:.1%} of them stay within {mm(study.limit)}."


def _linear(study: AccuracyNumbers) -> Iterator[str]:
    if study.bent.any():
        return
    bent = study.stack.bent.max()
    yield (
        f"Exact kinematics differ from linear ones by at most {bent * 100:.2g} % of the way, "
        "at the worst errors."
    )


def _within(study: AccuracyNumbers) -> Iterator[str]:
    found = study.within
    assert found is not None
    if not np.isfinite(found.factor):
        return
    yield (
        f"All tolerances times {down(found.factor)} keep it within {mm(found.limit)} at worst, "
        f"times {down(found.factor_root)} by the root of the sum of squares."
    )


def down(value: float) -> str:
    """A number of three digits that is no larger than it is."""
    if not np.isfinite(value) or value <= 0:
        return "any" if value > 0 else "0"
    step = 10.0 ** (np.floor(np.log10(value)) - 2)
    return f"{np.floor(value / step) * step:.3g}"
