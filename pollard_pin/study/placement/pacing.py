"""A path played faster or slower: the same curve and law, another duration."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from pollard_pin.motion.path import Sampled, ToolPath
from pollard_pin.motion.variants import Variants
from thesis_pin.numeric.checks import real
from thesis_pin.numeric.piecewise import Piecewise


def played(path: ToolPath, pace: float) -> ToolPath:
    """A path played ``pace`` times as fast.

    Args:
        path: The path.
        pace: 2 takes half the time.

    Raises:
        BadInput: The pace isn't positive.
    """
    pace = real("pace", pace, low=1e-6, high=1e6)
    duration = path.duration / pace
    return replace(
        path,
        duration=duration,
        function=partial(_played, path.function, pace),
        parameters={**path.parameters, "duration": duration, "pace": pace},
        notes=(*path.notes, f"the path is played {pace:.4g} times as fast, in {duration:.4g} s"),
        variants=None if path.variants is None else _faster(path.variants, pace),
    )


def _played(function: Callable[[np.ndarray], Sampled], pace: float, time: np.ndarray) -> Sampled:
    tool, near = function(time * pace)
    faster = replace(
        tool,
        velocity=tool.velocity * pace,
        acceleration=tool.acceleration * pace**2,
        omega=tool.omega * pace,
        alpha=tool.alpha * pace**2,
    )
    return faster, near


def _faster(variants: Variants, pace: float) -> Variants:
    curves = []
    for curve in variants.curves:
        powers = pace ** np.arange(len(curve.c) - 1.0, -1.0, -1.0)
        scaled = curve.c * powers.reshape(-1, *[1] * (curve.c.ndim - 1))
        curves.append(Piecewise(scaled, curve.x / pace))
    return replace(variants, curves=tuple(curves), rate=variants.rate * pace)
