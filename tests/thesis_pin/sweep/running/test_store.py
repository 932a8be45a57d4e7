"""A sweep's folder: rows that read back to the bit, and only of the very same question."""

import json
import shutil
import sys

import pyarrow.parquet as parquet
import pytest
from studied import BASE, Bowl

from thesis_pin.errors import BadInput, Busy, CannotWrite
from thesis_pin.files import Claim
from thesis_pin.sweep.designs.making import combined, vary
from thesis_pin.sweep.running import store
from thesis_pin.sweep.running.runner import sweep_designs


def designs(*texts):
    return combined([vary(BASE, text) for text in texts or ("x=0,0.1,2", "kind=round,7")])


STUDY = Bowl({0.1: "refuse"})


@pytest.fixture
def folder(tmp_path):
    sweep_designs(STUDY, designs(), jobs=1, out=tmp_path / "out")
    return tmp_path / "out"


def test_rows_read_back_to_the_bit(folder):
    again = sweep_designs(STUDY, designs(), out=folder, resume=True)
    assert again.effort.judged == 0
    assert again.rows == sweep_designs(STUDY, designs(), jobs=1).rows


def test_parts_are_parquet_that_others_read(folder):
    table = parquet.read_table(folder / "rows")
    assert table.column_names == [
        *("design", "x", "kind", "status", "reason", "warnings"),
        *("good", "depth", "width", "colour"),
    ]
    assert table["design"].to_pylist() == list(range(6))
    assert table["x"].to_pylist() == [0.0, 0.0, 0.1, 0.1, 2.0, 2.0]
    assert table["kind"].to_pylist() == ["round", "7.0"] * 3
    assert table["depth"].to_pylist()[2:4] == [None, None]
    assert table["good"].type == "bool"


def test_what_was_asked_stands_beside_the_rows(folder):
    found = json.loads((folder / "designs.json").read_bytes())
    assert found["schema"] == "thesis-pin/sweep-designs"
    assert found["inputs"]["base"]["legs"]["left"]["length"] == 0.3
    assert found["inputs"]["parameters"][0] == {"label": "x", "keys": ["x"], "relative": False}
    assert found["values"][4] == [2.0, "round"]
    assert set(found["versions"]) >= {"thesis-pin", "pin", "numpy", "scipy", "python"}


@pytest.mark.parametrize(
    ("study", "made", "told"),
    [
        (Bowl({0.1: "refuse"}, version="2"), designs(), "version is 2, was 1"),
        (Bowl(base={**BASE, "count": 4}), designs(), "base.count is 4, was 3"),
        (STUDY, designs("x=0,0.1,3", "kind=round,7"), "the designs' values"),
        (STUDY, designs("x=0,0.1,2"), "parameters"),
    ],
)
def test_a_sweep_that_asks_something_else_is_refused_with_what_differs(folder, study, made, told):
    with pytest.raises(BadInput, match="was asked something else") as error:
        sweep_designs(study, made, out=folder, resume=True)
    assert told in str(error.value)


def test_other_versions_are_refused_by_name(folder, monkeypatch):
    monkeypatch.setattr(store, "versions", lambda: {"numpy": "9.9"})
    with pytest.raises(BadInput, match=r"begun with other versions: .*numpy is 9.9, was "):
        sweep_designs(STUDY, designs(), out=folder, resume=True)


def test_rows_that_stand_there_are_never_replaced_unasked(folder):
    before = {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    with pytest.raises(BadInput, match="a sweep stands in this folder already") as error:
        sweep_designs(STUDY, designs(), out=folder)
    assert "--resume" in str(error.value)
    assert before == {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}


@pytest.mark.parametrize("harm", [b"", b"PAR1 nonsense", None])
def test_parts_that_are_no_parts_are_worked_out_again(folder, harm):
    part = sorted((folder / "rows").iterdir())[1]
    right = part.read_bytes()
    other = sorted((folder / "rows").iterdir())[2].read_bytes()
    part.write_bytes(other if harm is None else harm)
    found = sweep_designs(STUDY, designs(), jobs=1, out=folder, resume=True)
    assert found.effort.judged == 1
    assert found.rows == sweep_designs(STUDY, designs(), jobs=1).rows
    assert part.read_bytes() == right


def test_a_part_of_another_sweep_of_the_same_form_is_worked_out_again(folder, tmp_path):
    other = Bowl({0.1: "refuse"}, base={**BASE, "legs": {"left": {"length": 9.0}}})
    sweep_designs(other, designs(), jobs=1, out=tmp_path / "other")
    name = "rows/part-00000.parquet"
    (folder / name).write_bytes((tmp_path / "other" / name).read_bytes())
    found = sweep_designs(STUDY, designs(), jobs=1, out=folder, resume=True)
    assert found.effort.judged == 1
    assert found.rows == sweep_designs(STUDY, designs(), jobs=1).rows


def test_rows_without_a_word_of_what_they_are_of_are_refused(folder):
    (folder / "designs.json").unlink()
    for resume in (False, True):
        with pytest.raises(BadInput, match=r"no designs.json says of what"):
            sweep_designs(STUDY, designs("x=1,2"), jobs=1, out=folder, resume=resume)


def test_a_folder_that_is_removed_meanwhile_is_no_folder_with_half_the_rows(tmp_path):
    def remove(done, total):
        if done == 2:
            shutil.rmtree(tmp_path / "out")

    with pytest.raises(CannotWrite, match="was removed while the sweep wrote there"):
        sweep_designs(STUDY, designs(), jobs=1, out=tmp_path / "out", progress=remove)
    assert not (tmp_path / "out").exists()


def test_designs_whose_process_died_are_tried_again(tmp_path):
    question = designs("x=0,0.5,1")
    dies = Bowl({0.5: "die"})
    before = sweep_designs(dies, question, jobs=1, out=tmp_path / "out")
    assert [row.status for row in before.rows] == ["done", "lost", "done"]
    found = sweep_designs(Bowl(), question, jobs=1, out=tmp_path / "out", resume=True)
    assert found.effort.judged == 1
    assert found.rows == sweep_designs(Bowl(), question, jobs=1).rows


def test_a_folder_of_a_damaged_question_is_refused(folder):
    (folder / "designs.json").write_text("{")
    with pytest.raises(BadInput, match="can't read it"):
        sweep_designs(STUDY, designs(), out=folder, resume=True)
    (folder / "designs.json").write_text('{"schema": "other"}')
    with pytest.raises(BadInput, match="it isn't of a sweep"):
        sweep_designs(STUDY, designs(), out=folder, resume=True)


def test_two_sweeps_dont_write_to_one_folder(tmp_path):
    with Claim(tmp_path / "out"), pytest.raises(Busy):
        sweep_designs(STUDY, designs(), out=tmp_path / "out")


def test_a_folder_that_cant_be_is_said_before_anything_is_judged(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(CannotWrite):
        sweep_designs(Bowl({0.0: "die"}), designs(), out=tmp_path / "file" / "out")


def test_without_pyarrow_the_error_names_the_extra_and_no_folder_is_no_harm(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyarrow.parquet", None)
    with pytest.raises(BadInput, match=r"pip install \"thesis-pin\[sweep\]\""):
        sweep_designs(STUDY, designs(), out=tmp_path / "out")
    assert len(sweep_designs(STUDY, designs("x=1"), jobs=1).rows) == 1
