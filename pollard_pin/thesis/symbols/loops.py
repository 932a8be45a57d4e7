"""The two sides of each loop and what the thesis calls their parts.

Source: Pollard thesis, (2.1) – (2.7), (2.24) – (2.44), (2.89) – (2.131).
"""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np

from pollard_pin.thesis.state import Matrices, State
from thesis_pin.equations.dual import inverse


def frame(state: State, name: str) -> Matrices | None:
    """The transforms that rename a side of a loop (2.25 – 2.110)."""
    return state.kept(("frame", name), lambda s: _frame(s, name), rank=2)


def _frame(state: State, name: str) -> Matrices | None:
    t = state.transform
    if name == "T_LDn":
        return t("pose")
    if name == "T_LDn2":
        return inverse(t("T_03") @ t("T_315")) @ t("pose") @ t("nozzle")
    if name == "T_LI":
        return _product(state, "Rx", "theta_1615", "Rz", "theta_1716", "Rx", "theta_1817")
    if name == "T_LDn3":
        back = _product(state, "Rz", "theta_1716", "Rx", "theta_1817")
        second = frame(state, "T_LDn2")
        assert second is not None
        return second @ inverse(back)
    match = re.fullmatch(r"T_L(D|l|I)([12])([23]?)", name)
    if match is None or (match[1] != "D" and match[3]):
        return None
    i = match[2]
    if match[1] != "D":
        return t("ball_i", i)
    side_chain = t("T_02i", i) @ t("T_24i", i) @ t("T_48i", i)
    found = inverse(side_chain) @ t("T_03") @ t("T_311i", i)
    if match[3]:
        found = found @ inverse(_product(state, "Rz", f"theta_1110{i}"))
    if match[3] == "3":
        found = found @ inverse(_product(state, "Ry", f"theta_109{i}"))
    return found


def element(state: State, letter: str, i: str, row: int, column: int) -> Matrices:
    """Element of the transform a letter stands for: b_13 of T_LDn2, e_31 of T_LDi2.

    None for a side chain's where no chain is meant.
    """
    name = _LETTERS[letter].replace("i", i)

    def made(state: State) -> Matrices | None:
        found = frame(state, name)
        return None if found is None else found[..., row - 1, column - 1]

    return state.kept(("element", name, row, column), made, rank=0)


_LETTERS = {
    **{"a": "T_LDn", "b": "T_LDn2", "c": "T_LDn3"},
    **{"d": "T_LDi", "e": "T_LDi2", "f": "T_LDi3"},
}
"""What the elements of a transform are called (2.25 – 2.127)."""


def _product(state: State, *moves: str) -> Matrices:
    result: Matrices = np.eye(4)
    for move, name in zip(moves[::2], moves[1::2], strict=True):
        result = state.after(result, move, name)
    return result


def side(state: State, k: int, i: str = "") -> Matrices:
    """Ec_1 … Ec_4: last columns of both sides of (2.3) and (2.90), shape ``(n, 4)``.

    Those of a side chain are seen from frame 5i, after β54, as (2.98) and (2.100) are. Where
    the state has offsets (:func:`in_base_axes`), Ec_2 and Ec_4 move as the thesis differentiates
    them: along the base's axes, which θ21 and θ21i don't turn.
    """
    return state.kept(("side", k, i), lambda s: _side(s, k, i), rank=1)


def _side(state: State, k: int, i: str) -> Matrices:
    t = state.transform
    if k == 1:
        return t("T_315")[..., 3]
    if k == 2:
        found = inverse(t("T_03")) @ t("T_LD0")
        return (_in_base(state, "2", "Ry", "theta_21") @ found)[..., 3]
    tilt = inverse(state.after(np.eye(4), "Rx", "beta_54i", i))
    if k == 3:
        return (tilt @ t("T_48i", i))[..., 3]
    turned = _in_base(state, f"4{i}", "Rz", f"theta_21{i}", tilt) @ tilt
    return (turned @ inverse(t("T_02i", i) @ t("T_24i", i)) @ t("T_03") @ t("T_311i", i))[..., 3]


def _in_base(
    state: State, of: str, move: str, angle: str, tilt: Matrices | None = None
) -> Matrices:
    """What turns Ec into the base's axes and shifts it by the state's offset, if it has any."""
    if f"offset_x_{of}" not in state.constants:
        return np.eye(4)
    shift = _product(state, *(part for x in "xyz" for part in (x, f"offset_{x}_{of}")))
    turn = state.after(np.eye(4), move, angle)
    return shift @ (turn if tilt is None else tilt @ turn @ inverse(tilt))


def in_base_axes(state: State, *, places: bool = False) -> State:
    """States where X and Z of (2.12), and those of a side chain, are taken along the base's axes.

    Args:
        state: States, not moved.
        places: Whether X, Y, Z themselves are, as (2.20) prints them; else only what is made of
            them by differentiating, while they have the values that (2.18) needs.
    """
    constants = dict(state.constants)
    keys = (("2", 2, ""), ("41", 4, "1"), ("42", 4, "2"))
    zero = {f"offset_{x}_{of}": np.zeros(state.size) for of, _, _ in keys for x in "xyz"}
    bare = replace(state, constants={**constants, **zero})
    for of, k, i in keys:
        gap = side(state, k, i) - side(bare, k, i)
        for column, x in enumerate("xyz"):
            constants[f"offset_{x}_{of}"] = gap[..., column] * (not places)
    return replace(state, constants=constants)


def opening(state: State, i: str = "") -> Matrices:
    """|Ec_1|² − |Ec_2|², or |Ec_3|² − |Ec_4|² of a side chain, shape ``(n,)``."""
    return state.kept(("opening", i), lambda s: _opening(s, i), rank=0)


def _opening(state: State, i: str) -> Matrices:
    first, second = (side(state, k, i)[..., :3] for k in ((3, 4) if i else (1, 2)))
    return (first * first).sum(axis=-1) - (second * second).sum(axis=-1)


def between(state: State, name: str, i: str = "") -> Matrices | None:
    """Vector r_ab of a loop equation: from origin b to origin a, base frame [m], ``(n, 3)``.

    Args:
        state: States.
        name: Frame numbers as printed, without comma: "10", "1918", "1451".
        i: Chain, where the equation is a side chain's.
    """
    own = _SPANS_I.get(name.removesuffix(i)) if i and name.endswith(i) else None
    spans = own or _SPANS_0.get(name)
    if spans is None:
        return None
    start, end = (placement(state, path, i)[..., :3, 3] for path in spans)
    return end - start


def placement(state: State, path: Path, i: str = "") -> Matrices:
    """Placement at the end of a path, base frame, shape ``(..., 4, 4)``."""

    def made(state: State) -> Matrices:
        if not path:
            return np.eye(4)
        move, name = path[-1]
        sign = -1 if move[0] == "-" else 1
        before = placement(state, path[:-1], i)
        return state.after(before, move.removeprefix("-"), name, i, sign)

    return state.kept(("placement", path, i), made, rank=2)


Path = tuple[tuple[str, str], ...]
"""Elementary moves from the base: ("-z", "z_32i") goes down by z_32i."""

_TO_1: Path = (("z", "z_10"),)
_TO_2: Path = (*_TO_1, ("Ry", "theta_21"))
_TO_3: Path = (*_TO_2, ("x", "x_32"))
_TO_4: Path = (*_TO_3, ("Ry", "theta_43"))
_TO_5: Path = (*_TO_4, ("Rz", "theta_54"))
_TO_14: Path = (*_TO_5, ("x", "x_65"))
_TO_15: Path = (*_TO_14, ("x", "x_1514"))
_TO_16: Path = (*_TO_15, ("Rx", "theta_1615"))
_TO_17: Path = (*_TO_16, ("Rz", "theta_1716"))
_TO_18: Path = (*_TO_17, ("Rx", "theta_1817"))
_TIP: Path = (
    *(("x", "x"), ("y", "y"), ("z", "z")),
    *(("Rx", "theta"), ("Ry", "psi"), ("Rz", "phi")),
)
_TO_1I: Path = (("y", "signed_y_10i"),)
_TO_2I: Path = (*_TO_1I, ("Rz", "theta_21i"))
_TO_3I: Path = (*_TO_2I, ("x", "slant_x_32i"), ("y", "slant_y_32i"), ("-z", "z_32i"))
_TO_4I: Path = (*_TO_3I, ("x", "x_43i"))
_TO_5I: Path = (*_TO_4I, ("Rx", "beta_54i"))
_TO_6I: Path = (*_TO_5I, ("Ry", "theta_65i"))
_TO_7I: Path = (*_TO_6I, ("Rz", "theta_76i"))
_TO_13I: Path = (*_TO_14, ("-Rz", "beta_1413i"))
_TO_12I: Path = (*_TO_13I, ("-z", "z_1312i"))
PATHS: dict[str, Path] = {
    **{"1": _TO_1, "2": _TO_2, "3": _TO_3, "4": _TO_4, "5": _TO_5, "14": _TO_14, "15": _TO_15},
    **{"16": _TO_16, "17": _TO_17, "18": _TO_18},
    **{"1i": _TO_1I, "2i": _TO_2I, "3i": _TO_3I, "4i": _TO_4I, "5i": _TO_5I},
    **{"6i": _TO_6I, "7i": _TO_7I, "8i": (*_TO_7I, ("x", "x_87i"))},
    **{"11i": (*_TO_12I, ("-x", "x_1211i")), "12i": _TO_12I, "13i": _TO_13I, "p": _TIP},
}
"""Paths to the thesis's frames (2.4.1, 2.7.1); p is the tool's, as the pose gives it (A.1)."""

_SPANS_0: dict[str, tuple[Path, Path]] = {
    "10": ((), _TO_2),
    "32": (_TO_2, _TO_3),
    "145": (_TO_5, _TO_14),
    "1514": (_TO_14, _TO_15),
    "1918": (_TO_18, (*_TO_18, ("x", "x_1918"))),
    "5": ((), _TIP),
}
_SPANS_I: dict[str, tuple[Path, Path]] = {
    "10": ((), _TO_2I),
    "32": (_TO_2I, _TO_3I),
    "43": (_TO_3I, _TO_4I),
    "87": (_TO_7I, (*_TO_7I, ("x", "x_87i"))),
    "145": (_TO_5, _TO_14),
    "1514": (_TO_14, _TO_15),
    "1312": (_TO_12I, _TO_13I),
    "1211": ((*_TO_12I, ("-x", "x_1211i")), _TO_12I),
}
