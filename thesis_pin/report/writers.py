"""Documents and tables of samples as bytes: JSON and CSV that read back exactly."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from thesis_pin.errors import NotFinite


def json_bytes(document: object) -> bytes:
    """A document of dicts, lists, numbers, strings, None and NumPy arrays as JSON.

    A zero has no sign in it.

    Raises:
        NotFinite: Some number is NaN or infinite, which JSON can't say.
    """
    import orjson

    _refuse_not_finite(document, ())
    options = orjson.OPT_SERIALIZE_NUMPY | orjson.OPT_INDENT_2 | orjson.OPT_APPEND_NEWLINE
    # Indenting ten thousand rows of twelve numbers costs more than computing them.
    if any(isinstance(value, np.ndarray) and value.size > 10_000 for value in _values(document)):
        options &= ~orjson.OPT_INDENT_2
    # orjson takes C-contiguous arrays only; others go through lists.
    plain = _without_signed_zeros(document)
    return orjson.dumps(plain, option=options, default=lambda value: value.tolist())


def _without_signed_zeros(value: object) -> object:
    """The same document with 0 for −0, which says nothing and looks like an error."""
    if isinstance(value, Mapping):
        return {key: _without_signed_zeros(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_without_signed_zeros(item) for item in value]
    if isinstance(value, float) or (isinstance(value, np.ndarray) and value.dtype.kind == "f"):
        return value + 0.0
    return value


def _values(document: object) -> list[object]:
    return list(document.values()) if isinstance(document, Mapping) else []


def _refuse_not_finite(value: object, path: tuple[object, ...]) -> None:
    if isinstance(value, Mapping):
        for key, item in value.items():
            _refuse_not_finite(item, (*path, key))
    elif isinstance(value, np.ndarray) and value.dtype.kind == "f" and not np.isfinite(value).all():
        index = tuple(int(k) for k in np.argwhere(~np.isfinite(value))[0])
        raise NotFinite("output " + ".".join(map(str, path)), index)
    elif isinstance(value, float) and not np.isfinite(value):
        raise NotFinite("output " + ".".join(map(str, path)), ())
    elif isinstance(value, list | tuple):
        for k, item in enumerate(value):
            _refuse_not_finite(item, (*path, k))


def csv_bytes(columns: Mapping[str, np.ndarray | Sequence[str]]) -> bytes:
    """Columns of equal length as CSV with a header; numbers read back exactly, −0 as 0.

    Args:
        columns: Name → values, shape ``(n,)``; strings are kept, NaN becomes empty.
    """
    groups: list[list[bytes]] = []
    for numeric, group in itertools.groupby(columns.values(), key=_is_float):
        values = list(group)
        groups += [number_rows(np.column_stack(values))] if numeric else map(_text_rows, values)
    lines = [",".join(columns).encode(), *map(b",".join, zip(*groups, strict=True))]
    return b"\n".join(lines) + b"\n"


def _is_float(values: object) -> bool:
    return isinstance(values, np.ndarray) and values.dtype.kind == "f"


def _text_rows(values: Iterable[object]) -> list[bytes]:
    return [str(value).encode() for value in values]


def number_rows(table: np.ndarray) -> list[bytes]:
    """The rows of a table ``(n, k)`` as text that reads back exactly; NaN becomes empty."""
    import orjson

    table = table + 0.0
    if not table.size or np.isinf(table).any():  # which JSON can't say
        return [",".join("" if v != v else repr(v) for v in row).encode() for row in table.tolist()]
    text = orjson.dumps(table, option=orjson.OPT_SERIALIZE_NUMPY)
    return text[2:-2].replace(b"null", b"").split(b"],[")
