"""What rows of several suites need: the nearest branch, RNEA."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np
import pinocchio as pin

RNEA = "RNEA, one thread"


def nearest(angles: np.ndarray, wanted: np.ndarray) -> float:
    """Distance [rad] from the nearest of some branches ``(k, n)`` to the wanted angles ``(n,)``.

    NaN branches don't count.
    """
    gap = np.abs((angles - wanted + np.pi) % (2 * np.pi) - np.pi).max(axis=-1)
    return float(np.nanmin(gap))


def rnea(model: pin.Model, state: Iterable[np.ndarray]) -> Callable[[], np.ndarray]:
    """Forces of a stack of states ``(n, nq)``, ``(n, nv)``, ``(n, nv)``, one column a sample."""
    columns = [np.asfortranarray(part.T) for part in state]
    tau = np.empty(columns[1].shape, order="F")
    pool = pin.ModelPool(model, 1)

    def work() -> np.ndarray:
        pin.rneaInParallel(1, pool, *columns, tau)
        return tau

    return work
