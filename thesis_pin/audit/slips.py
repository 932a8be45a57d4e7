"""A slip that several printed lines share, explained once."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Cause:
    """One finding with many symptoms.

    Attributes:
        title: A few words, for tables.
        enters: Line of the derivation where the slip enters, as "(2.20)".
        explanation: What went wrong and what follows, for a reader who has the thesis open.
    """

    title: str
    enters: str
    explanation: str
