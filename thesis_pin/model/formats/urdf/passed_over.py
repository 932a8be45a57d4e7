"""Elements of a URDF that describe something and that nothing here uses."""

from __future__ import annotations

from thesis_pin.errors import MOST_NAMES
from thesis_pin.model.formats.xml import Element

_USED = frozenset(("link", "joint", "material", "loop", "coupling"))
_IN_JOINT = ("safety_controller", "calibration")


def passed_over(root: Element, where: str) -> tuple[str, ...]:
    """Each kind of element that is passed over, how often it stands there and its names."""
    found: dict[str, list[tuple[str, int]]] = {}
    for child in root:
        assert isinstance(child, Element)
        tag = str(child.tag).rpartition("}")[2]
        if tag not in _USED:
            name = child.get("name") or child.get("reference") or child.get("link") or ""
            found.setdefault(tag, []).append((name, child.line))
        if tag == "joint":
            for inner in child:
                assert isinstance(inner, Element)
                if inner.tag in _IN_JOINT:
                    of = child.get("name", "")
                    found.setdefault(str(inner.tag), []).append((of, inner.line))
    return tuple(_told(tag, places, where) for tag, places in found.items())


def _told(tag: str, places: list[tuple[str, int]], where: str) -> str:
    names = list(dict.fromkeys(name for name, _ in places if name))
    listed = ", ".join(names[:MOST_NAMES]) + (", …" if len(names) > MOST_NAMES else "")
    times = f" ({len(places)} times)" if len(places) > 1 else ""
    return f"{where}:{places[0][1]}: <{tag}>{times} isn't used" + (f": {listed}" if names else "")
