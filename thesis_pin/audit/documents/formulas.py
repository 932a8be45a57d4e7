"""Formulas as MathML that reads without a font made for mathematics.

A dot is the letter's own accent, a bold letter is bold by its style, a bracket is as
tall as a line unless the formula asks for more, and a long sum breaks where a term ends.
"""

from __future__ import annotations

import html
import re
import unicodedata
from collections.abc import Iterator, Sequence
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

from thesis_pin.equations.parsing.layout import plain

_LOWERED = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
_DOTS = {"˙": "\u0307", "¨": "\u0308"}
_BRACKETS = frozenset("()[]|‖")
_WORDS = frozenset({"sin", "cos", "tan", "sec", "csc", "cot", "arctan", "log", "exp"})
_LEAVES = frozenset({"mi", "mn", "mo", "mtext"})
_SCRIPTED = frozenset({"msub", "msup", "msubsup"})
_PRIMES = frozenset("′″‴")
_BREAKS = frozenset("=+−×")
_LINE = 40
"""Characters after which a formula may go on in a new line."""


GAP = "\u2038"
"""Marks a place where something is missing."""
_SLIP = "slip"
_ROWS = ("mrow", "mstyle")
_MARKED = {"": "e", "b": "be"}
"""Classes of a leaf → the same with a mark."""


def mathml(formula: str, slips: Sequence[tuple[int, int]] = ()) -> str:
    """A formula as MathML; one that is broken in print is shown as its source.

    Args:
        formula: LaTeX.
        slips: From where to where something is to be marked, in order; a gap where both are the
            same. What can't be marked without another reading of the formula isn't.

    Returns:
        One ``<math>`` or, of a formula that may break into lines, several.
    """
    tree = _tree(formula)
    if tree is None:
        return f"<code>{html.escape(formula)}</code>"
    return "".join(f"<math>{line}</math>" for line in _lines(_flat(_marked(tree, formula, slips))))


def _tree(formula: str) -> Element | None:
    """What the converter makes of a formula, or of it without what it may stumble over."""
    from latex2mathml.converter import convert

    loose = re.sub(r"\\(left|right)\s*\.|\\[bB]igg?[lr]?|\\(left|right)(?![a-z])", "", formula)
    for text in (formula, loose, plain(loose)):
        try:
            return ElementTree.fromstring(convert(text).replace("xmlns=", "of="))
        except Exception:  # the converter has no common base class of its errors
            continue
    return None


def _marked(tree: Element, formula: str, slips: Sequence[tuple[int, int]]) -> Element:
    """A formula's tree with marks: with all of them or, if they change it, with each that doesn't.

    Such are a command without what it stands before, or half of a pair of braces.
    """
    said = _said(tree)
    for chosen in (slips, [one for one in slips if _said(_with(formula, [one])) == said]):
        found = _with(formula, chosen) if chosen else None
        if found is not None and _said(found) == said:
            for row in found.iter("mrow"):
                if row.get("class") == _SLIP:
                    for leaf in row.iter():
                        leaf.set(_SLIP, "")
            return found
    return tree


def _with(formula: str, slips: Sequence[tuple[int, int]]) -> Element | None:
    """A formula's tree with what is to be marked in rows of their own."""
    for start, end in reversed(slips):
        inside = formula[start:end] or GAP
        formula = f"{formula[:start]}{{\\class{{{_SLIP}}}{{{inside}}}}}{formula[end:]}"
    return _tree(formula)


_Said = tuple[str, str, tuple["_Said", ...]]
"""A node, its text, and what is in it."""


def _said(tree: Element | None) -> list[_Said]:
    """What a formula is, without rows that only hold together what is marked."""
    found: list[_Said] = []
    for node in () if tree is None else tree:
        if node.tag in _ROWS and not any(one.get("fence") == "true" for one in node):
            found += _said(node)
        elif node.text != GAP:
            found.append((node.tag, node.text or "", tuple(_inside(node))))
    return found


def _inside(node: Element) -> Iterator[_Said]:
    """What is in a node; of one with places for base, script, numerator …, each as one."""
    if node.tag in ("mtd", "msqrt", *_ROWS):
        yield from _said(node)
        return
    for child in node:
        row = _node("mrow")
        row.append(child)
        said = _said(row)
        yield said[0] if len(said) == 1 else ("mrow", "", tuple(said))


def _flat(node: Element) -> list[Element]:
    """What stands in a row, rows inside it that hold nothing together opened."""
    found: list[Element] = []
    for child in node:
        fenced = any(one.get("fence") == "true" for one in child)
        if child.tag in _ROWS and not fenced:
            found += _flat(child)
        else:
            found += _parts(_short(child))
    for left, table, right in zip(found, found[1:], found[2:], strict=False):
        if table.tag == "mtable" and left.tag == right.tag == "mn":
            left.tag = right.tag = "mo"  # these do have to grow
    return _merged(found)


def _parts(node: Element) -> list[Element]:
    """A dotted letter and the number below it side by side, as that of a plain letter is."""
    if node.tag == "msub" and node[0].tag == "mover" and (node[1].text or "").isdigit():
        number = (node[1].text or "").translate(_LOWERED)
        return [node[0], _node("mi", number, **node[0][0].attrib)]
    return [node]


def _short(node: Element) -> Element:
    """A node with as little around it as it needs."""
    if node.tag in _LEAVES:
        return _leaf(node)
    if node.tag == "mspace":
        return _node("mspace", width="1em")
    if node.tag == "mover":
        dotted = _dotted(node)
        if dotted is not None:
            return dotted
    new = _node(node.tag)
    if node.tag in ("mrow", "mtd", "msqrt"):
        new.extend(one for one in _flat(node) if one.tag != "mo" or one.text)
        return new
    new.extend(_one(child) for child in node)
    if node.tag in _SCRIPTED:
        new[1:] = [_script(part) for part in new[1:]]
    if node.tag == "msub" and new[0].tag == "mi" and (new[1].text or "").isdigit():
        new[0].text = f"{new[0].text}{(new[1].text or '').translate(_LOWERED)}"
        return new[0]
    lonely = node.tag == "msup" and not len(new[0]) and not new[0].text
    # A prime is raised by itself; a T after another superscript has to stay one.
    return new[1] if lonely and new[1].text in _PRIMES else new


def _one(node: Element) -> Element:
    """A node that has to be one: a base, a script, a numerator."""
    if node.tag not in _ROWS:
        return _short(node)
    row = _node("mrow")
    row.extend(_flat(node))
    return row[0] if len(row) == 1 else row


def _script(node: Element) -> Element:
    """A script in one node where it is all letters, digits, commas and signs."""
    plain = all(part.tag in _LEAVES and not part.attrib for part in node)
    if node.tag == "mrow" and plain and len(node):
        return _node("mn", "".join(part.text or "" for part in node))
    return node


def _leaf(node: Element) -> Element:
    text, variant = node.text or "", node.get("mathvariant", "")
    names = [unicodedata.name(letter, "") for letter in text]
    bold = "bold" in variant or any(" BOLD " in name for name in names)
    if bold:
        text = unicodedata.normalize("NFKC", text)
    if node.tag == "mi" and text in _PRIMES:
        return _node("mn", text, **_style("", node))
    if node.tag == "mo" and text in _BRACKETS and node.get("fence") != "true":
        # As an operator it would grow with all of its row.
        return _node("mn", text, **_style("", node))
    if node.tag in ("mi", "mo") and text in _WORDS:
        return _node("mtext", text + "\u2009", **_style("", node))
    if node.tag == "mi" and text.startswith("."):
        return _node("mn", text, **_style("", node))
    return _node(node.tag, text, **_style("b" if bold else "", node))


def _style(classes: str, node: Element) -> dict[str, str]:
    """A leaf's class: its own, and whether it is marked."""
    classes = _MARKED[classes] if _SLIP in node.attrib else classes
    return {"class": classes} if classes else {}


def _dotted(node: Element) -> Element | None:
    """A letter with dots; None if the accent is over something else.

    What Unicode has as one character is one. A font sets the dots of other letters into
    tall ones such as θ, so theirs stand above them.
    """
    base, accent = _one(node[0]), _DOTS.get(node[1].text or "")
    letter = base[0] if base.tag in _SCRIPTED else base
    if not accent or letter.tag not in ("mi", "mn"):
        return None
    one = unicodedata.normalize("NFC", (letter.text or "") + accent)
    if len(one) == 1:
        letter.text = one
        return base
    over = _node("mover")
    over.extend((letter, _node("mn", node[1].text or "", **_style("", node[1]))))
    if letter is base:
        return over
    base[0] = over
    return base


def _merged(row: Sequence[Element]) -> list[Element]:
    """Letters side by side in one node, and brackets with the numbers beside them."""
    found: list[Element] = []
    for node in row:
        last = found[-1] if found else node
        base = node[0] if node.tag in _SCRIPTED else node
        alike = last is not node and (base.tag, base.attrib) == (last.tag, last.attrib)
        if alike and base.tag == "mi":
            base.text = f"{last.text}{base.text}"
            found[-1] = node
        elif alike and node.tag == "mn" and _bracket(last, node):
            last.text = f"{last.text}{node.text}"
        else:
            found.append(node)
    return found


def _bracket(first: Element, second: Element) -> bool:
    return (first.text or "")[-1:] in _BRACKETS or (second.text or "")[:1] in _BRACKETS


def _node(tag: str, text: str = "", **attributes: str) -> Element:
    node = Element(tag, attributes)
    node.text = text or None
    return node


def _lines(row: Sequence[Element]) -> Iterator[str]:
    """Parts of a formula that are kept on one line."""
    line, length = "", 0
    for node in row:
        if node.tag == "mo" and node.text in _BREAKS and length > _LINE:
            yield line
            line, length = "", 0
        line += _markup(node)
        length += sum(len(text) for text in node.itertext())
    yield line


def _markup(node: Element) -> str:
    attributes = "".join(f" {name}={value}" for name, value in node.items())
    inside = html.escape(node.text or "", quote=False) + "".join(map(_markup, node))
    return f"<{node.tag}{attributes}>{inside}</{node.tag}>"
