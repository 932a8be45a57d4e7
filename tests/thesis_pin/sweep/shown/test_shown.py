"""A sweep as tables, document, files, figure and page."""

import csv
import io
import json
import tomllib

import pytest
from studied import BASE, Bowl, swept

from thesis_pin.report.tables import Table
from thesis_pin.report.writers import json_bytes
from thesis_pin.sweep.shown.choice import Choice
from thesis_pin.sweep.shown.document import data_files, document
from thesis_pin.sweep.shown.drawn import figures
from thesis_pin.sweep.shown.page import sweep_page
from thesis_pin.sweep.shown.tables import summary

STUDY = Bowl({0.5: "refuse", 0.25: "refuse", 1.5: "warn"})


@pytest.fixture(scope="module")
def choice():
    return Choice.of(swept("x=0,0.25,0.5,1,1.5,9", 'kind=round,a"b', study=STUDY))


def test_the_answer_says_how_many_keep_their_limits_and_which_is_best(choice):
    first, why, best, odd, kept = choice.sentences()
    assert first == "6 of 12 designs keep every limit (good)."
    assert "4 couldn't be judged: 4 impossible, x = 0.25 is no bowl" in why
    assert best.endswith("the one with the least depth is design 6: x = 1, kind = round.")
    assert odd == "2 of 12 designs have warnings, which stand in their rows."
    assert kept.startswith("Note: only what is named varies.")


def test_what_the_chosen_design_is_warned_of_is_said_with_it():
    choice = Choice.of(swept("x=0,1.5,9", study=STUDY), None, "x=1.5")
    assert "It is warned of: it leaks." in choice.sentences()


def test_reasons_that_differ_in_numbers_alone_count_as_one(choice):
    assert [(status, count) for status, _, count in choice.sweep.reasons()] == [("impossible", 4)]


def test_tables_show_the_best_and_the_front_with_what_varied(choice):
    best, front, failed = (one for one in summary(choice) if isinstance(one, Table))
    assert best.rows[0] == ["6", "1", "round", "yes", "0.09", "1"]
    assert [row[0] for row in front.rows] == ["6", "7", "8", "9"]
    assert failed.rows == [("4 impossible", "x = 0.25 is no bowl. Take another")]


def test_files_read_back_as_what_was_found(choice):
    files = data_files(choice, "scout-pin")
    assert tomllib.loads(files["best.toml"].decode())["x"] == 1.0
    rows = list(csv.DictReader(io.StringIO(files["designs.csv"].decode())))
    assert len(rows) == 12
    assert [row["kind"] for row in rows[:2]] == ["round", 'a"b']
    assert float(rows[8]["depth [m]"]) == choice.sweep.rows[8].cells[1]
    assert rows[2]["depth [m]"] == ""
    assert (rows[8]["warnings"], rows[8]["good"]) == ("it leaks", "true")
    assert rows[3]["reason"].startswith("x = 0.25 is no bowl")


def test_the_document_has_every_row_and_what_was_chosen(choice):
    found = json.loads(json_bytes(document(choice, "scout-pin")))
    assert (found["schema"], found["version"]) == ("scout-pin/sweep", 1)
    assert (found["best"], found["front"], found["feasible"], found["judged"]) == (
        *(6, [6, 7, 8, 9]),
        *(6, 8),
    )
    assert found["designs"][8]["cells"][2] == 1.5
    assert found["designs"][2] == {
        "design": 2,
        "values": [0.25, "round"],
        "status": "impossible",
        "reason": "x = 0.25 is no bowl. Take another",
        "warnings": None,
        "cells": [None] * 4,
    }


def test_a_picture_and_a_page_are_made_of_any_sweep(choice):
    assert figures(choice)["pareto.png"].startswith(b"\x89PNG")
    page = sweep_page(choice).decode()
    assert "6 of 12 designs keep every limit" in page
    assert "What could be had" in page
    three = Choice.of(choice.sweep, "depth,width,min:x", "width>1")
    assert b"<svg" in figures(three)["pareto.svg"]
    assert "Nearest to the wish" in sweep_page(three).decode()


def test_the_page_has_the_keys_that_varied_as_they_are_written():
    study = Bowl(base=BASE | {"leg_1": {"x_3": 1.0}})
    page = sweep_page(Choice.of(swept("leg_*.x_3=0,1", study=study))).decode()
    assert "<td>leg_*.x_3</td>" in page
    assert "0 to 1, 2 values" in page


def test_where_nothing_was_judged_that_is_said_and_nothing_is_drawn():
    choice = Choice.of(swept("x=0.25,0.5", study=STUDY))
    assert choice.best is None
    assert choice.sentences()[0] == "0 of 2 designs keep every limit (good)."
    assert figures(choice) == {}
    assert set(data_files(choice, "scout-pin")) == {"report.json", "designs.csv"}
    assert b"couldn&#39;t be judged" in sweep_page(choice)


def test_aims_and_wishes_are_checked_before_anything_is_judged():
    from thesis_pin.errors import BadInput
    from thesis_pin.sweep.designs.making import combined, vary

    designs = combined([vary(BASE, "x=1,2")])
    Choice.check(Bowl(), designs, "depth,min:x", "x=1")
    with pytest.raises(BadInput):
        Choice.check(Bowl(), designs, "depth", None)
