"""The example notebooks run from top to bottom, and are stored without what they print."""

from pathlib import Path

import nbformat
import pytest
from nbclient import NotebookClient

BOOKS = sorted((Path(__file__).parents[2] / "examples" / "notebooks").glob("*.ipynb"))

SHOWS = {
    "scout": ("Scout can walk this gait", "<iframe", "image/png"),
    "pollard": ("16 of 16 branches reach the pose", "<iframe", "image/png"),
    "any_robot": ("No motor exceeds its limits", "Feet", "image/png"),
}


@pytest.mark.filterwarnings("default")  # the kernel's client warns of its own future
@pytest.mark.parametrize("path", BOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs_and_shows_what_it_promises(path, monkeypatch):
    monkeypatch.setenv("PYTHONPATH", str(path.parents[2]))
    book = nbformat.read(path, as_version=4)
    NotebookClient(book, timeout=120, resources={"metadata": {"path": str(path.parent)}}).execute()
    shown = repr([cell.outputs for cell in book.cells if cell.cell_type == "code"])
    for words in SHOWS[path.stem]:
        assert words in shown
    assert " at 0x" not in shown


@pytest.mark.parametrize("path", BOOKS, ids=lambda path: path.stem)
def test_a_notebook_is_stored_without_outputs(path):
    for cell in nbformat.read(path, as_version=4).cells:
        assert cell.get("outputs", []) == []
        assert cell.get("execution_count") is None
