"""A sweep's folder: what was asked in ``designs.json``, the rows in Parquet, a file a chunk.

Each part is written whole, so that a run which is killed leaves what it had done, and a run that
goes on finds out from the inputs' hash whether the rows are its own.
"""

from __future__ import annotations

import hashlib
import io
import json
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from thesis_pin.errors import BadInput, CannotWrite
from thesis_pin.files import Claim
from thesis_pin.report.writers import json_bytes
from thesis_pin.sweep.designs.keys import dotted
from thesis_pin.sweep.designs.making import Designs
from thesis_pin.sweep.running.work import Task, versions
from thesis_pin.sweep.study import LOST, Cell, Row, Study

if TYPE_CHECKING:
    import pyarrow

MANIFEST = "designs.json"
"""What was asked, by which inputs and versions."""

PARTS = "rows"
"""Folder of the parts."""

SCHEMA, VERSION = "thesis-pin/sweep-designs", 1

_OF = b"thesis-pin/sweep"
"""Where a part has the hash of what it is of."""


class Store:
    """Where a sweep's rows go, and come from when it goes on.

    Args:
        folder: A claimed folder.
        study: What is asked.
        designs: Of what.
        tasks: The chunks, in order.

    Raises:
        BadInput: pyarrow isn't installed.
    """

    def __init__(
        self, folder: Claim, study: Study, designs: Designs, tasks: Sequence[Task]
    ) -> None:
        _pyarrow()
        self._folder, self._study, self._designs, self._tasks = folder, study, designs, tasks
        self._document = self.document()
        self._schema = _schema(study, designs).with_metadata({_OF: str(self._document["hash"])})

    def begin(self, resume: bool) -> None:
        """Write down what is asked, or find that the folder holds rows of the very same.

        Args:
            resume: Whether rows of an earlier run are welcome.

        Raises:
            BadInput: They aren't, or are of other inputs or versions.
        """
        ours = self._document
        there = self._folder.path / MANIFEST
        if not there.exists():
            if any((self._folder.path / PARTS).glob("*")):
                raise BadInput(
                    f"rows stand in {PARTS}/ and no {MANIFEST} says of what",
                    where=str(self._folder),
                    remedy="Remove them, or name another folder",
                )
            self._folder.add(MANIFEST, json_bytes(ours))
            return
        if not resume:
            raise BadInput(
                "a sweep stands in this folder already",
                where=str(self._folder),
                remedy="Go on with it by --resume, or name another folder",
            )
        try:
            found = json.loads(there.read_bytes())
        except (OSError, ValueError) as error:
            raise BadInput(
                f"can't read it: {error}", where=str(there), remedy="Name another folder"
            ) from None
        _same(ours, found, str(there))

    def document(self) -> dict[str, object]:
        """What is asked, JSON-ready: enough to tell whether rows are of the same."""
        study, designs = self._study, self._designs
        inputs = {
            **study.inputs,
            "base": study.base,
            "parameters": [
                {"label": one.label, "keys": list(map(dotted, one.keys)), "relative": one.relative}
                for one in designs.parameters
            ],
            "columns": [column.name for column in study.columns],
            "chunk": len(self._tasks[0].designs),
        }
        values = list(map(list, designs.values))
        return {
            "schema": SCHEMA,
            "version": VERSION,
            "designs": len(designs),
            "hash": _hash([inputs, values]),
            "versions": versions(),
            "inputs": inputs,
            "values": values,
        }

    def write(self, task: Task, rows: Sequence[Row]) -> None:
        """Write a chunk's rows.

        Raises:
            CannotWrite: They can't be written, or the folder was removed meanwhile with those that
                stood in it.
        """
        if not (self._folder.path / MANIFEST).exists():
            raise CannotWrite(
                f"{MANIFEST} was removed while the sweep wrote there, and maybe rows with it",
                where=str(self._folder),
                remedy="Begin again in another folder",
            )
        self._folder.add(_part(task.number), _parquet(self._schema, rows))

    def rows(self) -> Iterator[tuple[Task, list[Row]]]:
        """The chunks that are done, with their rows.

        Parts that can't be read or are another sweep's aren't, nor are those with a design whose
        process died, of which the machine may have been to blame.
        """
        for task in self._tasks:
            path = self._folder.path / _part(task.number)
            found = _read(path, self._schema, task) if path.exists() else None
            if found is not None and all(row.status != LOST for row in found):
                yield task, found


def _part(number: int) -> str:
    return f"{PARTS}/part-{number:05d}.parquet"


def _hash(inputs: object) -> str:
    text = json.dumps(inputs, sort_keys=True, separators=(",", ":"), default=str)
    return hashlib.sha256(text.encode()).hexdigest()


def _same(ours: Mapping[str, object], found: Mapping[str, object], where: str) -> None:
    """Refuse to go on with rows of something else, and say what differs.

    Raises:
        BadInput: It is something else.
    """
    remedy = "Name another folder, or ask for the same again"
    if not isinstance(found, dict) or found.get("schema") != SCHEMA:
        raise BadInput("it isn't of a sweep", where=where, remedy=remedy)
    if ours["hash"] != found.get("hash"):
        what = _differing(ours["inputs"], found.get("inputs")) or ["the designs' values"]
        raise BadInput(
            f"the sweep in this folder was asked something else: {', '.join(what[:6])}",
            where=where,
            remedy=remedy,
        )
    mine, theirs = ours["versions"], found.get("versions")
    if mine != theirs:
        what = [f"{one}" for one in _differing(mine, theirs)]
        raise BadInput(
            f"the sweep in this folder was begun with other versions: {', '.join(what[:6])}",
            where=where,
            remedy="Go on with those versions, or name another folder",
        )


def _differing(ours: object, found: object, before: str = "") -> list[str]:
    """Keys at which two documents differ, with both values."""
    ours, found = (json.loads(json.dumps(one, default=str)) for one in (ours, found))
    if isinstance(ours, dict) and isinstance(found, dict):
        return [
            told
            for key in {**ours, **found}
            for told in _differing(ours.get(key), found.get(key), f"{before}.{key}".strip("."))
        ]
    if ours == found:
        return []
    mine, theirs = (str(one) if len(str(one)) < 60 else "…" for one in (ours, found))
    return [f"{before} is {mine}, was {theirs}" if mine != theirs else before]


def _pyarrow() -> None:
    try:
        import pyarrow.parquet  # noqa: F401
    except ImportError:
        raise BadInput(
            "a folder of rows needs pyarrow, which writes Parquet",
            where="out",
            remedy='pip install "thesis-pin[sweep]"; without --out nothing else needs it',
        ) from None


def _schema(study: Study, designs: Designs) -> pyarrow.Schema:
    import pyarrow as pa

    kinds = {"number": pa.float64(), "flag": pa.bool_(), "text": pa.string()}
    return pa.schema(
        [
            ("design", pa.int64()),
            *(
                (one.label, pa.float64() if number else pa.string())
                for one, number in zip(designs.parameters, designs.numeric, strict=True)
            ),
            *((name, pa.string()) for name in ("status", "reason", "warnings")),
            *((column.name, kinds[column.kind]) for column in study.columns),
        ]
    )


def _parquet(schema: pyarrow.Schema, rows: Sequence[Row]) -> bytes:
    import pyarrow as pa
    from pyarrow import parquet

    values = [
        (row.design, *row.values, row.status, row.reason, row.warnings, *row.cells) for row in rows
    ]
    arrays = [
        pa.array(list(map(_plain, column)) if field.type == pa.string() else column, field.type)
        for field, column in zip(schema, zip(*values, strict=True), strict=True)
    ]
    stream = io.BytesIO()
    parquet.write_table(pa.Table.from_arrays(arrays, schema=schema), stream)
    return stream.getvalue()


def _plain(value: Cell) -> str | None:
    """A cell of a column of texts, some of which may be numbers."""
    return value if value is None or isinstance(value, str) else repr(value)


def _read(path: Path, schema: pyarrow.Schema, task: Task) -> list[Row] | None:
    """A part's rows; None if it isn't the part that belongs there."""
    import pyarrow as pa
    from pyarrow import parquet

    try:
        table = parquet.read_table(io.BytesIO(path.read_bytes()))
    except (OSError, pa.ArrowException):
        return None
    ours = table.schema.equals(schema, check_metadata=True)
    if not ours or table["design"].to_pylist() != list(task.designs):
        return None
    many = len(task.values[0])
    columns = [column.to_pylist() for column in table.columns]
    rows = []
    for values, one in zip(task.values, zip(*columns, strict=True), strict=True):
        status, reason, warnings = one[1 + many : 4 + many]
        rows.append(Row(one[0], values, status, reason, warnings, tuple(one[4 + many :])))
    return rows
