"""Each file that a verb writes is named on standard error, in the same words everywhere."""

import ast
import re

import pytest
from commands import ROOT, VERBS, example, has, into, run

WRITERS = [name for name in VERBS if has(name, "--json")]
PYTHON = re.compile(r"\b[a-z_]+ ?= ?(False|True|None|\d)|\b[a-z_]+=( |$)")


@pytest.mark.parametrize("name", WRITERS)
def test_a_verb_says_wrote_and_the_file_for_each_file(name, tmp_path, capfd, monkeypatch):
    monkeypatch.chdir(ROOT)
    words = [*example(name, tmp_path), *into(name, tmp_path)]
    if name.endswith("audit"):
        words += ["--markdown", str(tmp_path / "audit.md")]
    if has(name, "--samples"):
        words += ["--samples", "801" if name == "scout-pin plan" else "21"]
    code, _, err = run(name, words, capfd)
    assert code == 0, err
    said = [line for line in err.splitlines() if line.startswith("wrote ")]
    written = sorted(path for path in tmp_path.iterdir() if path.is_file())
    for path in written:
        assert f"wrote {path}" in said
    folders = [path for path in tmp_path.iterdir() if path.is_dir()]
    for path in folders:
        (line,) = [line for line in said if line.startswith(f"wrote {path}: ")]
        first = line.removeprefix(f"wrote {path}: ").split(", ")[0]
        assert (path / first).is_file()
    assert len(said) == len(written) + len(folders)


def test_what_goes_to_standard_output_is_not_said_to_be_written(capfd, monkeypatch):
    monkeypatch.chdir(ROOT)
    code, out, err = run("thesis-pin formats", ["formats", "--json", "-"], capfd)
    assert (code, err) == (0, "")
    assert out.startswith("{")


def remedies():
    """(file, line, text) of every remedy of an error of the general package."""
    for path in sorted((ROOT / "thesis_pin").rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.keyword) and node.arg == "remedy":
                for part in ast.walk(node.value):
                    if isinstance(part, ast.Constant) and isinstance(part.value, str):
                        yield path.name, part.lineno, part.value


def test_no_remedy_asks_a_user_of_a_command_for_python():
    assert PYTHON.search("Name more motors, or pass check=False")
    assert PYTHON.search("Pass precision= if equations agree")
    assert not [one for one in remedies() if PYTHON.search(one[2])]
