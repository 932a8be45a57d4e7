"""Reading TOML files into validated objects, with every mistake reported at once.

The robots' specifications, gaits and paths are all read through
:func:`read_toml`; a message names file, line, key, the value found and what is
allowed there.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar, cast

from thesis_pin.errors import BadInput, Problem, SpecificationError
from thesis_pin.model.limits import LIMITS, bounded
from thesis_pin.model.limits import Key as Key
from thesis_pin.model.plain import Doubt, plainly
from thesis_pin.model.source import read_text
from thesis_pin.model.strict import Assumption as Assumption
from thesis_pin.model.strict import NotNegative as NotNegative
from thesis_pin.model.strict import Positive as Positive
from thesis_pin.model.strict import Strict as Strict
from thesis_pin.model.strict import SymmetricMatrix as SymmetricMatrix
from thesis_pin.model.strict import Vector2 as Vector2
from thesis_pin.model.strict import Vector3 as Vector3
from thesis_pin.numeric.checks import brief, shown

if TYPE_CHECKING:
    from pydantic import BaseModel

File = TypeVar("File", bound="BaseModel | Strict")

_PART = r"""(?:"[^"\n]*+"|'[^'\n]*+'|[\w\-]++)[ \t]*+\.[ \t]*+"""
_DOTTED = re.compile(rf"""(?<![\w\-"'.])(?:{_PART}){{{LIMITS.nesting},}}+""")
"""A key of more parts than :data:`LIMITS` has levels."""

XML = (
    "It is XML, as a URDF is: thesis-pin reads those as they are, and scout-pin from-urdf makes "
    "a specification of a biped's"
)
"""What mends a robot's description in place of TOML."""


def read_toml(kind: str, schema: type[File], path: str | Path) -> File:
    """Read and validate a TOML file.

    Args:
        kind: What the file is, for messages ("specification", "gait", …).
        schema: What it must satisfy, a :class:`~thesis_pin.model.strict.Strict`.
        path: The file.

    Returns:
        The validated object.

    Raises:
        BadInput: The file can't be opened, is too large or isn't TOML.
        SpecificationError: It is TOML but breaks the schema; carries every problem.
    """
    return parse_toml(kind, schema, read_text(kind, path), where=str(path))


def parse_toml(kind: str, schema: type[File], text: str, *, where: str = "<text>") -> File:
    """The same as :func:`read_toml`, for text already in memory."""
    if not isinstance(text, str):
        raise BadInput(f"the {kind} is {shown(text)}", allowed="text", where=where)
    _check_dots(kind, text, where)
    try:
        data = tomllib.loads(text)
    except ValueError as error:  # also whole numbers of more than 4300 digits
        remedy = XML if text.lstrip("\ufeff \t\r\n").startswith("<") else ""
        raise BadInput(
            f"the {kind} isn't valid TOML: {error}", where=where, remedy=remedy
        ) from None
    except RecursionError:
        raise BadInput(f"the {kind} is nested too deeply", where=where) from None
    return validate(kind, schema, data, where=where, lines=key_lines(text))


def _check_dots(kind: str, text: str, where: str) -> None:
    """Refuse very long dotted keys, over which tomllib takes quadratic time."""
    if match := _DOTTED.search(text):
        raise BadInput(
            f"the {kind} has a key of {match[0].count('.') + 1} parts",
            where=f"{where}:{text.count(chr(10), 0, match.start()) + 1}",
            allowed=f"at most {LIMITS.nesting} levels",
        )


def validate(
    kind: str,
    schema: type[File],
    data: object,
    *,
    where: str = "<data>",
    lines: dict[Key, int] | None = None,
) -> File:
    """Validate data against a schema, raising one error that lists every problem.

    Args:
        kind: What the data is, for messages.
        schema: What they must satisfy.
        data: Nested dicts and lists.
        where: File or place, for messages.
        lines: Line of each key, from :func:`key_lines`.

    Raises:
        SpecificationError: With a :class:`Problem` for each thing wrong.
    """
    lines = lines or {}

    def place(key: Key) -> str:
        line = _line_of(key, lines)
        return f"{where}:{line}" if line else where

    def told(key: Key, what: str, value: object) -> Problem:
        return Problem(place(key), _dotted(key), what, "" if value is None else brief(value))

    data, problems = bounded(data)
    if problems:
        raise SpecificationError(kind, [told(*problem) for problem in problems])
    result = _plainly(schema, data)
    if result is None:
        result = _by_pydantic(kind, schema, data, place)
    if isinstance(result, Strict) and (wrong := [told(*one) for one in result.cross_check()]):
        raise SpecificationError(kind, wrong)
    return result


def _plainly(schema: type[File], data: object) -> File | None:
    """The object, if there is no doubt that data stand for one."""
    if not issubclass(schema, Strict):
        return None
    try:
        return cast(File, plainly(schema, data))
    except Doubt:
        return None


def _by_pydantic(kind: str, schema: type[File], data: object, place: Callable[[Key], str]) -> File:
    """The object, or every problem in words."""
    from pydantic import ValidationError

    found: list[Problem] = []
    try:
        # Strict: true isn't 1 and "0.33" isn't 0.33. Files have lists where we have tuples.
        return cast(File, schema.model_validate(data, strict=True))
    except ValidationError as error:
        for detail in error.errors(include_url=False):
            key = _real_key(detail["loc"], data)
            message = detail["msg"].removeprefix("Value error, ")
            message = message[:1].lower() + message[1:]
            if detail["type"] == "extra_forbidden":
                message = "unknown key" + _known_keys(schema, key)
            # A value that is missing has nothing to show; tables are too long to.
            value = "" if detail["type"] == "missing" else brief(detail["input"])
            found.append(Problem(place(key), _dotted(key), message, value))
        unique = {(p.key, p.what): p for p in found}
        raise SpecificationError(kind, list(unique.values())) from None


def key_lines(text: str) -> dict[Key, int]:
    """Line number of every table and key of a TOML text.

    tomllib forgets where a value stood. This recognises the plain layout
    (headers, ``key = …`` at the start of a line); a key it misses is reported
    with the line of its table.
    """
    header = re.compile(r"^\s*(\[\[?)\s*([^\[\]]+?)\s*\]\]?\s*(#.*)?$")
    assignment = re.compile(r"^\s*([A-Za-z0-9_\-.\"']+)\s*=")
    lines: dict[Key, int] = {}
    counts: dict[Key, int] = {}
    prefix: Key = ()
    for number, line in enumerate(text.split("\n"), start=1):
        if match := header.match(line):
            prefix = ()
            for name in (part.strip().strip("\"'") for part in match[2].split(".")):
                prefix = (*prefix, name)
                if prefix in counts:
                    prefix = (*prefix, counts[prefix])
            if match[1] == "[[":
                while prefix and isinstance(prefix[-1], int):
                    prefix = prefix[:-1]
                counts[prefix] = counts.get(prefix, -1) + 1
                prefix = (*prefix, counts[prefix])
            lines.setdefault(prefix, number)
        elif match := assignment.match(line):
            names = [part.strip("\"'") for part in match[1].split(".")]
            lines.setdefault((*prefix, *names), number)
    return lines


def _line_of(key: Key, lines: dict[Key, int]) -> int | None:
    for length in range(len(key), 0, -1):
        if key[:length] in lines:
            return lines[key[:length]]
    return None


def _real_key(location: Sequence[str | int], data: Any) -> Key:
    """Drop the names of union members that pydantic mixes into a location."""
    key: list[str | int] = []
    for number, part in enumerate(location):
        if isinstance(data, dict):
            if part in data or number == len(location) - 1:
                key.append(part)
                data = data.get(part)
        elif isinstance(data, list | tuple) and isinstance(part, int):
            key.append(part)
            data = data[part] if part < len(data) else None
    return tuple(key)


def _known_keys(schema: object, key: Key) -> str:
    """List the keys allowed beside an unknown one, where the schema makes that plain."""
    current: Any = schema
    for part in key[:-1]:
        if isinstance(part, int):
            continue
        fields = getattr(current, "model_fields", {})
        if part not in fields:
            return ""
        current = fields[part].annotation
        arguments = getattr(current, "__args__", ())
        current = next((a for a in (current, *arguments) if hasattr(a, "model_fields")), current)
    fields = getattr(current, "model_fields", {})
    return f" (known here: {', '.join(fields)})" if fields else ""


def _dotted(key: Key) -> str:
    text = ""
    for part in key:
        text += f"[{part}]" if isinstance(part, int) else ("." if text else "") + str(part)
    return text or "(whole file)"
