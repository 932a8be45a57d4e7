"""Errors of all three packages: one base class, one message each.

Every error says what is wrong, where, what the value was, what is allowed and
how to mend it. Subclasses keep the values as attributes, so that a program can
react to them without reading the text.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Callable, Sequence
from dataclasses import dataclass

LONGEST = 1000
"""Characters that a message quotes of any one thing."""

MOST_NAMES = 40
"""Names that a message lists."""

MOST_PROBLEMS = 50
"""Problems of one file that a message lists; the error carries all of them."""


def escaped(text: str, most: int = LONGEST, *, keep: str = "\n") -> str:
    """Text that can go to any terminal: shortened, and no control character is left raw.

    Args:
        text: What a user or a file gave.
        most: Characters at most; longer text loses its middle.
        keep: Control characters that stay.
    """
    if len(text) > most:
        text = f"{text[: most - 40]} … {text[-36:]}"
    if text.isprintable():
        return text
    # Cc and Cf would move the cursor or turn the writing round, Cs can't be encoded.
    return "".join(
        repr(c)[1:-1] if c not in keep and unicodedata.category(c)[0] in "CZ" and c != " " else c
        for c in text
    )


class ThesisPinError(Exception):
    """Base class: catching it catches everything these packages raise on purpose."""

    def __reduce__(self) -> tuple[object, ...]:
        """Errors of other processes arrive with their words and values."""
        return _arrived, (type(self), self.args, vars(self))


def _arrived(
    kind: type[ThesisPinError], args: tuple[object, ...], values: dict[str, object]
) -> ThesisPinError:
    error = kind.__new__(kind, *args)
    vars(error).update(values)
    return error


class BadInput(ThesisPinError, ValueError):
    """What the caller gave can't be used.

    Args:
        what: What is wrong, as a full clause.
        where: File, line, key, joint or sample; empty if it is obvious.
        allowed: What would have been accepted.
        remedy: How to mend it.
    """

    def __init__(self, what: str, *, where: str = "", allowed: str = "", remedy: str = "") -> None:
        self.what, self.where = escaped(what), escaped(where, keep="")
        self.allowed, self.remedy = escaped(allowed), escaped(remedy)
        super().__init__(self.message())

    def message(self) -> str:
        """What, where, allowed and remedy in one text."""
        text = f"{self.where}: {self.what}" if self.where else self.what
        if self.allowed:
            text += f"; allowed: {self.allowed}"
        if self.remedy:
            text += f". {self.remedy}"
        return text


class CannotWrite(BadInput):
    """An output can't be written where it was asked for; the commands end with exit code 3."""


class Busy(CannotWrite):
    """Another run is writing to the same place."""


@dataclass(frozen=True)
class Problem:
    """One thing wrong in a file.

    Attributes:
        where: File, with the line if it is known.
        key: Dotted key of the value.
        what: What is wrong and what is allowed.
        value: The value found, shortened for printing.
    """

    where: str
    key: str
    what: str
    value: str = ""

    def __str__(self) -> str:
        found = f" (found {escaped(self.value, keep='')})" if self.value else ""
        where, key, what = (escaped(x, keep="") for x in (self.where, self.key, self.what))
        return f"{where}: {key}: {what}{found}"


class SpecificationError(BadInput):
    """A file doesn't describe what it should; carries every problem at once."""

    def __init__(self, kind: str, problems: Sequence[Problem]) -> None:
        self.kind, self.problems = kind, tuple(problems)
        count = f"{len(self.problems)} problem" + ("s" if len(self.problems) > 1 else "")
        listed = [f"\n  {problem}" for problem in self.problems[:MOST_PROBLEMS]]
        if (more := len(self.problems) - len(listed)) > 0:
            listed.append(f"\n  … and {more} more")
        super().__init__(f"{count} in the {kind}")
        self.what += "".join(listed)  # each is escaped and shortened by itself
        self.args = (self.message(),)


class WrongShape(BadInput):
    """An array has the wrong shape."""

    def __init__(self, name: str, shape: tuple[int, ...], allowed: str) -> None:
        self.name, self.shape = name, shape
        super().__init__(f"{name} has shape {shape}", allowed=allowed)


class NotFinite(BadInput):
    """An array holds NaN or infinity."""

    def __init__(self, name: str, index: tuple[int, ...]) -> None:
        self.name, self.index = name, index
        super().__init__(f"{name} isn't finite at index {index}", allowed="finite numbers")


class UnknownName(BadInput):
    """A name isn't among those that exist."""

    def __init__(
        self,
        kind: str,
        name: object,
        known: Sequence[str],
        *,
        where: str = "",
        remedy: str = "",
    ) -> None:
        self.kind, self.name, self.known = kind, name, tuple(known)
        # Of many, what was meant is to be among those that are shown.
        shown = sorted(known, key=_unlike(name)) if len(known) > MOST_NAMES else known
        listed = ", ".join(escaped(one, 100, keep="") for one in shown[:MOST_NAMES])
        if len(known) > MOST_NAMES:
            listed += f", … ({len(known)} in all)"
        super().__init__(f"unknown {kind} {name!r}", where=where, allowed=listed, remedy=remedy)


def _unlike(name: object) -> Callable[[str], bool]:
    """Whether a name that exists neither contains the one that was said nor resembles it."""
    from difflib import SequenceMatcher

    said = str(name)[:100].lower()

    def unlike(other: str) -> bool:
        known = other.lower()
        return (
            said not in known and SequenceMatcher(None, said, known).ratio() < 0.7
        )  # panda and pandda: 0.91

    return unlike


class ModelWarning(UserWarning):
    """A model can be used, but something in its file is odd enough to look at."""


class ModelError(BadInput):
    """A model file can't be turned into a mechanism that makes sense."""


class Undecidable(ModelError):
    """Nobody can tell whether some equation of the loops is real; a precision decides.

    Args:
        what: What is wrong, as a full clause.
        where: Where.
        allowed: What would have been accepted.
        remedy: How to mend it.
        weakest: By how much the doubtful equation differs from the others [rad].
        noise: By how much equations differ that are dependent [rad].
        least: By how much an equation has to differ to be taken as real [rad].
        loops: Names of the loops and couplings that it is made of.
    """

    def __init__(
        self,
        what: str,
        *,
        where: str = "",
        allowed: str = "",
        remedy: str = "",
        weakest: float,
        noise: float,
        least: float,
        loops: Sequence[str],
    ) -> None:
        self.weakest, self.noise, self.least, self.loops = weakest, noise, least, tuple(loops)
        super().__init__(what, where=where, allowed=allowed, remedy=remedy)

    @property
    def precision(self) -> float:
        """A precision with which the doubtful equation counts as dependent [rad]."""
        return float(f"{2 * self.weakest:.0e}")

    def but(self, what: str) -> Undecidable:
        """The same with other words."""
        kept = {"where": self.where, "allowed": self.allowed, "remedy": self.remedy}
        return Undecidable(
            what,
            **kept,
            weakest=self.weakest,
            noise=self.noise,
            least=self.least,
            loops=self.loops,
        )


class NonPhysicalInertia(ModelError):
    """No distribution of positive mass has this inertia.

    Args:
        link: Name of the link.
        eigenvalues: Eigenvalues of the 4×4 pseudo-inertia matrix, ascending.
        principal: Principal moments about the centre of mass [kg·m²], ascending.
        where: File and line.
    """

    def __init__(
        self,
        link: str,
        eigenvalues: Sequence[float],
        principal: Sequence[float],
        *,
        where: str = "",
    ) -> None:
        self.link, self.eigenvalues, self.principal = link, tuple(eigenvalues), tuple(principal)
        moments = ", ".join(f"{value:.6g}" for value in principal)
        if principal[0] <= 0:
            broken = f"the smallest is {principal[0]:.3g} kg·m², which isn't positive"
        elif principal[0] + principal[1] < principal[2]:
            excess = principal[2] - principal[0] - principal[1]
            broken = f"the largest exceeds the sum of the others by {excess:.3g} kg·m²"
        else:
            broken = "the mass isn't positive"
        super().__init__(
            f"the inertia isn't physical: principal moments {moments} kg·m² and {broken} "
            f"(smallest pseudo-inertia eigenvalue {eigenvalues[0]:.3g})",
            where=f"{where}: link {link!r}" if where else f"link {link!r}",
            allowed="positive mass, positive moments, each at most the sum of the other two",
        )


class Unreachable(BadInput):
    """No joint angles reach a pose, or none inside the limits."""


class SingularPose(BadInput):
    """Rates or forces don't exist at a pose, because its Jacobian has lost rank."""


class TrajectoryError(BadInput):
    """A gait or path isn't a motion the robot can be asked to make."""


class NoSupportForce(BadInput):
    """The floor would have to pull: no zero-moment point exists."""


class NoSolution(BadInput):
    """A system of equations has no solution.

    Args:
        what: Which system, as a full clause.
        residual: Least norm of what is left over, over all unknowns, in ``unit``.
        unit: Unit of the residual.
        remedy: What to use instead.
    """

    def __init__(self, what: str, residual: float, unit: str, *, remedy: str = "") -> None:
        self.residual, self.unit = residual, unit
        super().__init__(f"{what}: {residual:.6g} {unit} stay unbalanced", remedy=remedy)


class Infeasible(BadInput):
    """No law of motion keeps the limits: already at rest one of them is exceeded.

    Args:
        what: Which limit.
        share: How much of it is used.
        place: Where on the path, by its parameter.
        where: The same in words.
    """

    def __init__(self, what: str, share: float, place: float, *, where: str = "") -> None:
        self.limit, self.share, self.place = what, share, place
        super().__init__(
            f"holding the robot still takes {share:.1%} of the {what}",
            where=where or f"s = {place:.6g} of the path",
            remedy="Allow more, or move the path",
        )
