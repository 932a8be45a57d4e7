"""Frames that vectors are seen from and that rotations turn between.

A vector is seen from a frame: ``(frame, "")``. A rotation takes what is seen from one
frame to another: ``(to, from)``. Products join them, transposes swap them. Where a
value may be of several kinds (a rotation that both legs have), it carries all of them
and a product keeps those that fit.
"""

from __future__ import annotations

Frames = frozenset[tuple[str, str]]
"""What the rows and the columns of a value belong to; several if either is possible."""

_ANY = "*"
ANY: Frames = frozenset({(_ANY, _ANY)})
"""Of a value that carries no frames: a scalar, generalized coordinates, a transform."""


def seen_from(frame: str) -> Frames:
    """Frames of a vector seen from a frame."""
    return frozenset({(frame, "")})


def turning(*pairs: tuple[str, str]) -> Frames:
    """Frames of a rotation: ``(to, from)``, or several if it is the same on each leg."""
    return frozenset(pairs)


def columns_seen_from(frame: str) -> Frames:
    """Frames of a matrix, such as a Jacobian, whose columns are vectors seen from a frame."""
    return frozenset({(frame, _ANY)})


def same(first: Frames, second: Frames) -> Frames:
    """Frames of two values that are added or compared; empty if none fit."""
    if first is ANY:
        return second
    if second is ANY:
        return first
    return frozenset(
        (_either(a, c), _either(b, d))
        for a, b in first
        for c, d in second
        if _fit(a, c) and _fit(b, d)
    )


def joined(first: Frames, second: Frames) -> Frames:
    """Frames of a product; empty if none fit."""
    if first is ANY and second is ANY:
        return ANY
    return frozenset((a, d) for a, b in first for c, d in second if _fit(b, c))


def swapped(frames: Frames) -> Frames:
    """Frames of a transpose or an inverse."""
    return ANY if frames is ANY else frozenset((b, a) for a, b in frames)


def rows(frames: Frames) -> Frames:
    """Frames of one column of a matrix."""
    return ANY if frames is ANY else frozenset((a, _ANY) for a, _ in frames)


def described(frames: Frames) -> str:
    """Frames in words, to be put after what has them; "" if it carries none."""
    if frames == ANY:
        return ""
    outer, inner = (sorted({pair[k] for pair in frames} - {"", _ANY}) for k in (0, 1))
    to, of = (f"frame {' or '.join(names)}" for names in (outer, inner))
    if outer and inner:
        return f" that turns from {of} to {to}"
    return f" seen from {to if outer else of}" if outer or inner else ""


def _fit(first: str, second: str) -> bool:
    return first == second or _ANY in (first, second)


def _either(first: str, second: str) -> str:
    return second if first == _ANY else first
