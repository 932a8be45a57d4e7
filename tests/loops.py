"""Event loops in tests: a browser that another test left open runs one in the tests' own thread."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

Made = TypeVar("Made")


def beside(work: Callable[[], Made]) -> Made:
    """What ``work`` returns in a thread without a running loop."""
    with ThreadPoolExecutor(1) as thread:
        return thread.submit(work).result()
