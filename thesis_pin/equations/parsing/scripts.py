"""Sub- and superscripts: what belongs to a name, what is a power, what a transposition."""

from __future__ import annotations

import math
import re
from dataclasses import replace

from thesis_pin.equations.formula import Node, Number, Power, Symbol, Transpose
from thesis_pin.equations.parsing.conventions import Conventions
from thesis_pin.equations.parsing.marks import Group, Mark, opened

INVERTED = ("sin", "cos", "tan")
"""Functions whose exponent -1 is an inverse function."""
_TRANSPOSED = ("top", "intercal", "mathsfT", "rmT")
_FONTS = re.compile(r"\\(mathbf|boldsymbol|mathrm|text|bm)(?![a-zA-Z])")


def with_script(node: Node, script: str, notation: Conventions) -> Node:
    """A node with a sub- or superscript, or with primes.

    Raises:
        ValueError: The script means nothing on such a node.
    """
    if "prime" in script or script.startswith("'"):
        if isinstance(node, Symbol):
            return replace(node, primes=node.primes + max(1, script.count("'")))
        raise ValueError("a prime on something that isn't a symbol")
    text = flatten(script[1:])
    if script.startswith("_"):
        if isinstance(node, Group) and isinstance(opened(node), Symbol):  # {\rm s}_1
            node = opened(node)
        if isinstance(node, Symbol):
            kept = _not_indices(script, notation) or node.kept
            return replace(node, sub=node.sub + text, kept=kept)
        raise ValueError("a subscript on something that isn't a symbol")
    if text == "circ" and isinstance(node, Number) and notation.factors is not None:
        return Number(math.radians(node.value))
    text = "T" if text in _TRANSPOSED else text
    transposed = text.endswith("T")
    label = text.removesuffix("T") if transposed else text
    if isinstance(node, Group) and label.isdigit() and not transposed:
        return Power(node, int(label))  # still an argument: c(α + β)^2 is a squared cosine
    if not isinstance(node, Mark):
        node = opened(node)
    if label == "-":  # J^{-T}
        label = "-1"
    if isinstance(node, Mark) and label.startswith("-"):
        if node.name not in INVERTED or label != "-1":
            raise ValueError(f"{node.name} with a negative exponent: write a fraction")
        return replace(node, name=f"arc{node.name}")
    if re.fullmatch(r"-\d", label):
        node = Power(node, int(label))
    elif label:
        if isinstance(node, Mark):
            node = replace(node, exponent=int(label))
        elif isinstance(node, Symbol) and _is_label(node, label, notation):
            node = replace(node, sup=node.sup + label)
        elif label.isdigit() or label in ("i", "n"):
            node = Power(node, int(label) if label.isdigit() else label)
        else:
            raise ValueError(f"a superscript {label!r} that is neither a frame nor a power")
    return Transpose(node) if transposed else node


def flatten(script: str) -> str:
    """Sub- or superscript as plain characters: ``{\\theta_{1i}}`` → ``theta1i``."""
    text = _FONTS.sub("", script)
    text = re.sub(r"\\(dot|ddot)(?![a-zA-Z])|\\[!,;: ]", "", text)
    return re.sub(r"[\\{}_\s,]", "", text)


def _not_indices(script: str, notation: Conventions) -> str:
    """Letters of a subscript that aren't indices, where there is a word in it."""
    if notation.ranges is None:
        return ""
    letters = "".join(letter for letter, _ in notation.ranges)
    words = re.findall(r"[a-zA-Z]{3,}", _FONTS.sub(" ", script))
    return letters if any(set(word) - set(letters) for word in words) else ""


def _is_label(node: Symbol, label: str, notation: Conventions) -> bool:
    return node.bold or label == "0" or not label.isdigit() or (node.base in notation.labelled)
