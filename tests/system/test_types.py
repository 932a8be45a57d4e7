"""What a type checker tells the users of the installed packages."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
DOCUMENTS = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
SNIPPETS = {
    f"{path.stem.lower()}_{number}": code
    for path in DOCUMENTS
    for number, code in enumerate(
        re.findall(r"```python\n(.*?)```", path.read_text(encoding="utf-8"), flags=re.DOTALL)
    )
}
MISTAKES = {
    "name_of_a_package": ("import scout_pin\nscout_pin.laod()", "attr-defined"),
    "name_imported": ("from pollard_pin import apendix_b", "attr-defined"),
    "name_of_thesis_pin": ("import thesis_pin\nthesis_pin.inverse_dynamic", "attr-defined"),
    "method": ("import scout_pin\nscout_pin.load().inverse_kinematic()", "attr-defined"),
    "keyword": ("import pollard_pin\npollard_pin.load(inertias='printed')", "call-arg"),
    "choice": ("import scout_pin\nscout_pin.load(inertia='print')", "arg-type"),
}
TYPES = {
    "scout_pin.load()": "scout_pin.model.Scout",
    "pollard_pin.load()": "pollard_pin.model.Pollard",
    "scout_pin.gait_report": "def (robot: scout_pin.model.Scout",
    "thesis_pin.inverse_dynamics": "def (robot: thesis_pin.loops.closures.ClosedRobot",
    "scout_pin.__version__": '"str"',
}


@pytest.fixture(scope="module")
def said(tmp_path_factory):
    """What mypy says of each snippet, run as a user would: no settings of this repository."""
    folder = tmp_path_factory.mktemp("user")
    for name, code in SNIPPETS.items():
        (folder / f"{name}.py").write_text(code, encoding="utf-8")
    for name, (code, _) in MISTAKES.items():
        (folder / f"{name}.py").write_text(code, encoding="utf-8")
    lines = ["import pollard_pin, scout_pin, thesis_pin"]
    lines += [f"reveal_type({expression})" for expression in TYPES]
    (folder / "types_told.py").write_text("\n".join(lines), encoding="utf-8")
    command = [sys.executable, "-m", "mypy", "--config-file=", "--cache-dir=cache"]
    # Pinocchio brings no types; that isn't ours to mend.
    command += ["--disable-error-code=import-untyped", *(path.name for path in folder.glob("*.py"))]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert not done.stderr
    names = [*SNIPPETS, *MISTAKES, "types_told"]
    return {
        name: [line for line in done.stdout.splitlines() if line.startswith(f"{name}.py:")]
        for name in names
    }


@pytest.mark.parametrize("name", SNIPPETS)
def test_a_snippet_of_the_documents_has_no_type_error(name, said):
    assert said[name] == []


@pytest.mark.parametrize("name", MISTAKES)
def test_a_mistake_is_told_before_the_program_runs(name, said):
    assert any(f"[{MISTAKES[name][1]}]" in line for line in said[name]), said[name]


@pytest.mark.parametrize(("expression", "type_"), TYPES.items())
def test_a_public_name_has_its_type(expression, type_, said):
    line = 2 + list(TYPES).index(expression)
    assert any(f":{line}: note:" in told and type_ in told for told in said["types_told"]), said
