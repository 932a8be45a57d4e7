"""What the library warns of, in the words of a command."""

from __future__ import annotations

import contextlib
import warnings
from collections.abc import Iterator, Sequence

from thesis_pin.command.text import say
from thesis_pin.errors import BadInput, ModelWarning


@contextlib.contextmanager
def warned(strict: bool = False) -> Iterator[None]:
    """Say each :class:`~thesis_pin.errors.ModelWarning` on standard error, or refuse all.

    Args:
        strict: Whether they are errors.

    Raises:
        BadInput: There are some and they are errors.
    """
    found: list[warnings.WarningMessage] = []
    try:
        with warnings.catch_warnings(record=True) as found:
            warnings.simplefilter("always", ModelWarning)
            yield
    except BaseException:
        _say(found)  # what was warned of may be why
        raise
    odd = [str(one.message) for one in found if issubclass(one.category, ModelWarning)]
    if strict and odd:
        raise BadInput(
            "; ".join(odd), where="--strict", remedy="Correct the sizes, or leave --strict out"
        )
    _say(found)


def _say(found: Sequence[warnings.WarningMessage]) -> None:
    for one in found:
        if issubclass(one.category, ModelWarning):
            say(f"warning: {one.message}")
        else:
            warnings.showwarning(one.message, one.category, one.filename, one.lineno)
