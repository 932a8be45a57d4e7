"""What the library warns of, in the words of a command."""

from __future__ import annotations

import contextlib
import warnings
from collections.abc import Iterator

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
    with warnings.catch_warnings(record=True) as found:
        warnings.simplefilter("always", ModelWarning)
        yield
    odd = [str(one.message) for one in found if issubclass(one.category, ModelWarning)]
    if strict and odd:
        raise BadInput(
            "; ".join(odd), where="--strict", remedy="Correct the sizes, or leave --strict out"
        )
    for text in odd:
        say(f"warning: {text}")
    for one in found:
        if not issubclass(one.category, ModelWarning):
            warnings.showwarning(one.message, one.category, one.filename, one.lineno)
