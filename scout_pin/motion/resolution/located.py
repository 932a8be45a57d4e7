"""Errors that name a time and the lines of a gait's file instead of a sample of ours."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

from scout_pin.motion.gait import Gait
from thesis_pin.errors import BadInput

_SAMPLE = re.compile(r"sample (\d+)")


@contextmanager
def located(gait: Gait, t: np.ndarray) -> Iterator[None]:
    """Let errors of a block name the time, and the file's lines if it has some.

    Args:
        gait: The gait.
        t: Times of the samples that the block works on, shape ``(n,)``.
    """
    try:
        yield
    except BadInput as error:
        found = _SAMPLE.search(error.where)
        if found is None or int(found[1]) >= len(t):
            raise
        at = float(t[int(found[1])])
        said = f"t = {at:g}" + ("" if gait.rows is None else f" ({gait.rows.where(at)})")
        error.where = error.where[: found.start()] + said + error.where[found.end() :]
        error.args = (error.message(),)
        raise
