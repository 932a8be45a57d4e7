"""Numbers of things in words: one of them has no plural."""

from __future__ import annotations


def counted(number: int, one: str, many: str = "") -> str:
    """Say how many there are: 1 sample, 2 samples.

    Args:
        number: How many.
        one: What one is called, of a word or more.
        many: What several and none are called; with an s if nothing is said.
    """
    return f"{number} {one if number == 1 else many or one + 's'}"
