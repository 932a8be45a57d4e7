"""docs/your_derivation.md, run as it stands: ``thesis-pin audit`` on a textbook's arm."""

import json
import re
import shlex
from pathlib import Path

import pytest

from thesis_pin.audit.derivation.said import phrases
from thesis_pin.command.main import main

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "your_derivation.md").read_text(encoding="utf-8")
FOLDER = "examples/your_derivation"
ARM = ["audit", f"{FOLDER}/two_link_arm.toml", "--model", f"{FOLDER}/two_link_arm.urdf"]


@pytest.fixture
def _here(monkeypatch):
    monkeypatch.chdir(ROOT)


def blocks(language):
    return re.findall(rf"```{language}\n(.*?)```", PAGE, re.DOTALL)


@pytest.mark.usefixtures("_here")
def test_the_pages_commands_find_both_slips(tmp_path, capsys):
    first, second, third = (shlex.split(line)[1:] for line in blocks("bash")[0].splitlines())
    assert main(first) == 0
    told = capsys.readouterr().out
    assert "11 holds, 1 misprint, 1 not checkable, 1" in told
    assert "3:G_1" in told
    assert "3:M_12" in told
    assert main(second) == 0
    assert "unexplained" in capsys.readouterr().out
    assert main([*third[:-1], str(tmp_path / third[-1])]) == 0
    page = (tmp_path / "arm.html").read_text(encoding="utf-8")
    assert "Two-link arm" in page
    assert page.count("<math") > 20


@pytest.mark.usefixtures("_here")
def test_the_pages_python_prints_the_failures(capsys):
    (code,) = blocks("python")
    exec(compile(code, "page", "exec"), {})
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines] == ["arm:3:G_1", "arm:3:M_12"]


def test_the_pages_file_is_one_and_lists_what_there_is(tmp_path):
    """Each table of the page's file stands in the schema, and each quantity in its list."""
    from thesis_pin.audit.derivation.said.file import read

    path = tmp_path / "page.toml"
    path.write_text(blocks("toml")[0] + blocks("toml")[1], encoding="utf-8")
    file, _ = read(path)
    assert file.derivation.name == "pendulum"
    listed = PAGE.split("## What a symbol can be")[1].split("##")[0]
    missing = [one for one in phrases.QUANTITIES if f"`{one}" not in listed]
    assert not missing


@pytest.mark.usefixtures("_here")
def test_json_and_document_say_the_same(tmp_path, capsys):
    target = tmp_path / "arm.json"
    assert main([*ARM, "--json", str(target), "--markdown", "-"]) == 0
    found = json.loads(target.read_bytes())
    assert found["thesis"] == "Two-link arm"
    assert {row["id"] for row in found["rows"] if row["verdict"] == "unexplained"} == {"arm:3:G_1"}
    document = capsys.readouterr().out
    assert document.startswith("# Audit of the Two-link arm")
    assert f"thesis-pin {' '.join(ARM)} --markdown FILE" in document


@pytest.mark.usefixtures("_here")
def test_bad_input_is_one_clear_error(capsys, tmp_path):
    assert main(["audit", ARM[1], "--model", "examples/delta.urdf"]) == 2
    told = capsys.readouterr().err
    assert "unknown joint 'shoulder'" in told
    assert "motor_0" in told
    assert main([*ARM, "--equation", "G_3"]) == 2
    told = capsys.readouterr().err
    assert "arm:3:G_1" in told
    assert "thesis-pin audit" in told
