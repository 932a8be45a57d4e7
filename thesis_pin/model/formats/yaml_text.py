"""YAML text → plain data with the line of every key, and nothing that could surprise.

The community's closure files are flat: mappings, lists, words and numbers. Aliases,
tags, dates and keys that aren't words are refused, which also keeps a few bytes
from growing into gigabytes.
"""

from __future__ import annotations

import re

import yaml

from thesis_pin.errors import BadInput
from thesis_pin.model.limits import LIMITS
from thesis_pin.model.specification import Key
from thesis_pin.numeric.checks import shown

_SCALARS = {f"tag:yaml.org,2002:{name}" for name in ("str", "int", "float", "bool", "null")}


class _Refused(yaml.MarkedYAMLError):
    """YAML that is none of a closure file's business."""

    def __init__(self, problem: str, mark: object) -> None:
        super().__init__(None, None, problem, mark)  # type: ignore[arg-type]


class _Loader(yaml.SafeLoader):
    """Composes nodes; aliases and deep nesting are refused before they are followed."""

    depth = 0

    def compose_node(self, parent: yaml.Node | None, index: object) -> yaml.Node | None:
        event = self.peek_event()  # type: ignore[no-untyped-call]
        if isinstance(event, yaml.AliasEvent):
            raise _Refused("aliases aren't taken: write the value out", event.start_mark)
        self.depth += 1
        if self.depth > LIMITS.nesting:
            raise _Refused(f"nested deeper than {LIMITS.nesting} levels", event.start_mark)
        node: yaml.Node | None = super().compose_node(parent, index)  # type: ignore[arg-type]
        self.depth -= 1
        return node


EXPONENTIAL = (
    re.compile(r"[-+]?([0-9]+(\.[0-9]*)?|\.[0-9]+)[eE][-+]?[0-9]+"),
    list("-+.0123456789"),
)
"""Numbers as 1e-5, and what they begin with.

YAML 1.1, which is what PyYAML reads and writes, takes them for words; 1.2 and everybody else don't.
"""

_Loader.add_implicit_resolver("tag:yaml.org,2002:float", *EXPONENTIAL)


def parse_yaml(kind: str, text: str, *, where: str) -> tuple[object, dict[Key, int]]:
    """Data of a YAML text, and the line of every key and list entry.

    Args:
        kind: What the text is, for messages.
        text: The text.
        where: File, for messages.

    Raises:
        BadInput: It isn't YAML, or uses more of it than mappings with words as keys,
            lists, words and numbers.
    """
    lines: dict[Key, int] = {}
    try:
        loader = _Loader(text)  # takes no hold of anything that had to be given back
        node = loader.get_single_node()
        data = None if node is None else _plain(loader, node, (), lines)
    except _Refused as error:
        mark = error.problem_mark
        here = where if mark is None else f"{where}:{mark.line + 1}"
        raise BadInput(f"the {kind} isn't plain YAML: {error.problem}", where=here) from None
    except yaml.YAMLError as error:
        reason = " ".join(str(error).split())
        raise BadInput(f"the {kind} isn't valid YAML: {reason}", where=where) from None
    except RecursionError:
        raise BadInput(f"the {kind} is nested too deeply", where=where) from None
    return data, lines


def _plain(loader: _Loader, node: yaml.Node, key: Key, lines: dict[Key, int]) -> object:
    """The data of a node, with the lines of what is in it."""
    lines.setdefault(key, node.start_mark.line + 1)
    if isinstance(node, yaml.SequenceNode) and node.tag == "tag:yaml.org,2002:seq":
        return [_plain(loader, one, (*key, k), lines) for k, one in enumerate(node.value)]
    if isinstance(node, yaml.MappingNode) and node.tag == "tag:yaml.org,2002:map":
        return _mapping(loader, node, key, lines)
    if not isinstance(node, yaml.ScalarNode) or node.tag not in _SCALARS:
        raise _Refused(f"{node.tag.rpartition(':')[2]} isn't taken: write a word", node.start_mark)
    try:
        return loader.construct_object(node)
    except ValueError:  # a whole number of more than 4300 digits, or one like 0_
        raise _Refused(f"{shown(node.value)} isn't a number", node.start_mark) from None


def _mapping(
    loader: _Loader, node: yaml.MappingNode, key: Key, lines: dict[Key, int]
) -> dict[str, object]:
    result: dict[str, object] = {}
    for name_node, value in node.value:
        if name_node.tag != "tag:yaml.org,2002:str":
            raise _Refused("a key isn't a word", name_node.start_mark)
        name = name_node.value
        if name in result:
            # YAML's own loaders keep the last of repeated keys in silence.
            raise _Refused(f"the key {shown(name)} is given twice", name_node.start_mark)
        lines[(*key, name)] = name_node.start_mark.line + 1
        result[name] = _plain(loader, value, (*key, name), lines)
    return result
