"""Samples that are alike, of very many."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from thesis_pin.numeric.elementwise import blocks

Groups = list[tuple[int, NDArray[np.intp]]]
"""The first sample of each kind, and all of it."""


def alike(count: int, keys: Callable[[slice], NDArray[np.float64]]) -> Groups:
    """Samples of equal keys, in the order of the keys.

    Args:
        count: Number of samples.
        keys: Gives those of some samples, shape ``(m, k)``, each the same every time.
    """
    # Alike within a block first, then over all blocks: a key a sample would weigh too much.
    number = np.empty(count, dtype=np.intp)
    kinds: list[NDArray[np.float64]] = []
    firsts: list[NDArray[np.intp]] = []
    for part in blocks(count):
        some = keys(part)
        # Neighbours are alike as a rule: that leaves a row a stretch to sort, of some thousand.
        begins = np.concatenate([[True], (some[1:] != some[:-1]).any(axis=1)])
        runs = np.flatnonzero(begins)
        kind, first, inverse = np.unique(some[runs], axis=0, return_index=True, return_inverse=True)
        number[part] = inverse.ravel()[np.cumsum(begins) - 1] + sum(map(len, kinds))
        kinds.append(kind)
        firsts.append(runs[first] + part.start)
    _, first, inverse = np.unique(
        np.concatenate(kinds), axis=0, return_index=True, return_inverse=True
    )
    number = inverse.ravel()[number]
    order = np.argsort(number, kind="stable")
    members = np.split(order, np.cumsum(np.bincount(number))[:-1])
    return list(zip(np.concatenate(firsts)[first].tolist(), members, strict=True))
