"""A design of a study: its row, its files, and what the robot's own command says of them."""

import json
from collections.abc import Mapping
from pathlib import Path

import thesis_pin
from thesis_pin.sweep.study import Cell, Row, judged


def row_of(
    study, *texts: str, design: int = -1
) -> tuple[Row, dict[str, Cell], Mapping[str, bytes]]:
    """A design, the last unless said, its row as a dictionary, and its files."""
    designs = thesis_pin.make_designs(study, texts)
    number = range(len(designs))[design]
    data = designs.data(study.base, number)
    row = judged(study, data, number, designs.values[number])
    names = [column.name for column in study.columns]
    return row, dict(zip(names, row.cells, strict=True)), study.written(data, ["a note"])


def asked(main, verb: str, folder: Path, files: Mapping[str, bytes], *words: str):
    """The summary of a command's report on a design that is written out."""
    for name, content in files.items():
        (folder / name).write_bytes(content)
    out = folder / "report.json"
    robot = ["--specification", str(folder / "best.toml")]
    assert main([verb, *robot, *words, "--json", str(out)]) == 0
    return json.loads(out.read_bytes())["summary"]
