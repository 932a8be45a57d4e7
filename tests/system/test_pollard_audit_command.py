"""``pollard-pin audit`` explains equations, writes all rows, and refuses what it doesn't know."""

import json

import pytest

from pollard_pin.cli import main
from pollard_pin.thesis import catalogue
from thesis_pin.audit.thesis import Thesis


def test_the_command_explains_one_equation_by_its_short_id(capsys):
    assert main(["audit", "--equation", "2.5.3:E_7"]) == 0
    shown = capsys.readouterr().out
    assert "misprint" in shown
    assert "numbered one lower" in shown


@pytest.mark.parametrize(
    ("asked", "ids"),
    [
        ("2.60", [f"2.5.3:E_{k}" for k in (7, 10, 8, 11, 9, 12)]),
        ("(3.154)", ["3.7:3.154"]),
        ("V_22", ["D:V_22"]),
    ],
)
def test_the_command_explains_the_lines_of_a_printed_number_or_symbol(asked, ids, capsys):
    assert main(["audit", "--equation", asked]) == 0
    shown = capsys.readouterr().out
    found = [line.split()[1] for line in shown.splitlines() if line.startswith("equation ")]
    assert found == [f"pollard:{name}" for name in ids]


def test_a_whole_statement_isnt_shown_twice(capsys):
    assert main(["audit", "--equation", "2.4.2:Z"]) == 0
    shown = " ".join(capsys.readouterr().out.split())
    assert "where the whole statement (alone: " in shown


def test_the_command_writes_all_rows_as_json(pollard_audit, monkeypatch, tmp_path, capsys):
    path = tmp_path / "audit.json"
    asked = []

    def whole(thesis, **how):
        asked.append((thesis.robot, how["only"]))
        return pollard_audit

    monkeypatch.setattr(Thesis, "audit", whole)
    assert main(["audit", "--json", str(path)]) == 0
    assert asked == [("pollard", None)]
    data = json.loads(path.read_bytes())
    assert len(data["rows"]) == len(catalogue().equations)
    assert sum(data["counts"].values()) == len(data["rows"])
    assert "333 of 333" in " ".join(capsys.readouterr().out.split())


def test_an_unknown_equation_is_refused_with_names_that_exist(capsys):
    assert main(["audit", "--equation", "D:V_99"]) == 2
    message = capsys.readouterr().err
    assert "D:V_99" in message
    assert "pollard:D:V_9" in message
