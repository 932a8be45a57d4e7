"""What is written reads back exactly, and what can't be said is refused."""

import json

import numpy as np
import pytest

from thesis_pin.errors import NotFinite
from thesis_pin.report.writers import csv_bytes, json_bytes


def test_json_refuses_what_it_cannot_say_and_names_the_place():
    for bad in (np.nan, np.inf):
        with pytest.raises(NotFinite, match=r"a\.b"):
            json_bytes({"a": {"b": np.array([1.0, bad])}})
        with pytest.raises(NotFinite, match="x"):
            json_bytes({"x": [1.0, bad]})
    data = {"x": np.eye(2)[:, ::-1], "y": None, "z": np.float64(0.1), "big": np.zeros(20_000)}
    read = json.loads(json_bytes(data))
    assert read["x"] == [[0.0, 1.0], [1.0, 0.0]]
    assert read["z"] == 0.1


def test_csv_reads_back_exactly():
    values = np.array([0.1, 1 / 3, -2e-17, np.nan])
    lines = csv_bytes({"x": values, "name": ["a", "b", "c", "d"]}).decode().splitlines()
    assert lines[0] == "x,name"
    assert [float(line.split(",")[0]) for line in lines[1:4]] == values[:3].tolist()
    assert lines[4] == ",d"


def test_csv_of_numbers_and_words_reads_back_exactly_also_what_json_cannot_say():
    numbers = np.random.default_rng(3).normal(size=50) * 10.0 ** np.arange(-25, 25)
    infinite = np.where(np.arange(50) == 7, np.inf, numbers[::-1])
    columns = {"a": numbers, "b": -numbers, "word": ["x"] * 50, "c": infinite, "n": np.arange(50)}
    header, *lines = csv_bytes(columns).decode().splitlines()
    assert header == "a,b,word,c,n"
    rows = [line.split(",") for line in lines]
    for k, expected in enumerate(columns.values()):
        column = [row[k] for row in rows]
        assert column == expected if k == 2 else np.array_equal(np.array(column, float), expected)
    assert csv_bytes({"a": np.zeros(0)}) == b"a\n"


def test_no_zero_has_a_sign():
    values = {"one": -0.0, "list": [-0.0, {"deep": np.array([-0.0, -1.0])}], "text": "-0.0"}
    assert b"-0.0" not in json_bytes(values | {"text": ""})
    assert json.loads(json_bytes(values))["text"] == "-0.0"
    assert b"-0" not in csv_bytes({"a": np.array([-0.0, 0.0]), "b": np.array([0.0, -0.0])})
