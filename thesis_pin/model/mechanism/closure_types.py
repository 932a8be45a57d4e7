"""Words for what a closure ties: ``3d``, ``6d``, ``hinge_z``, … ↔ rows of the relative twist.

=================  =====  ==========================================================
word               rows   what stays free between the two frames
=================  =====  ==========================================================
``3d``             3      all turns: a ball joint
``6d``             6      nothing: a weld
``hinge_z``        5      turning about z of both frames, which stay parallel
``universal_xy``   4      turning about x of the first and y of the second frame,
                          which stay perpendicular: the row is the turn about z
``rod``            1      all but the distance of the origins
``xyz--z``         any    what is ``-``: first three letters are translations, last
                          three turns, all in the first frame's axes
=================  =====  ==========================================================
"""

from __future__ import annotations

from typing import Literal, TypeAlias

from thesis_pin.model.mechanism.supplement import Mask

JointType: TypeAlias = Literal[
    "SPHERICAL",
    "FIXED",
    "CARDAN",
    "UJOINT_XY",
    "UJOINT_YX",
    "UJOINT_YZ",
    "UJOINT_ZY",
    "UJOINT_XZ",
    "UJOINT_ZX",
]
"""Types of joints that a URDF can't express; CARDAN is our older word for UJOINT_XY."""

_FREE = {"hinge": ("x", "y", "z"), "universal": ("xy", "yx", "yz", "zy", "xz", "zx")}
_AXES = "xyzxyz"
_ROD: Mask = (False, False, False, False, False, False)

WORDS = (
    "3d",
    "6d",
    *(f"{kind}_{axes}" for kind, all_axes in _FREE.items() for axes in all_axes),
    "rod",
)
"""Every word that has a name; masks such as ``xyz--z`` are understood beside them."""


def rows_of(word: str) -> Mask | None:
    """Rows of a word, in any case; None if it is none."""
    word = word.lower()
    kind, _, free = word.partition("_")
    if word == "rod":
        return _ROD
    if word in ("3d", "6d"):
        return _mask("xyz---" if word == "3d" else "xyzxyz")
    if free in _FREE.get(kind, ()):
        return _mask("xyz" + "".join("-" if axis in free else axis for axis in "xyz"))
    fits = len(word) == 6 and all(a in (b, "-") for a, b in zip(word, _AXES, strict=True))
    return _mask(word) if fits and word != "------" else None


def word_of(rows: Mask) -> str:
    """The word of rows; a mask if they have no name, ``rod`` if there are none."""
    named = {rows_of(word): word for word in reversed(WORDS)}
    mask = "".join(axis if row else "-" for axis, row in zip(_AXES, rows, strict=True))
    return named.get(rows, mask)


def _mask(letters: str) -> Mask:
    tx, ty, tz, rx, ry, rz = (letter != "-" for letter in letters)
    return tx, ty, tz, rx, ry, rz
