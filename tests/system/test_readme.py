"""The README and documents say what the package does now."""

import re
import runpy
import shlex
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")
DOCUMENTS = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").glob("*.md"))]


def blocks(language):
    return re.findall(rf"```{language}\n(.*?)```", README, flags=re.DOTALL)


@pytest.mark.bytes
@pytest.mark.parametrize("document", ["README.md", "CONTRIBUTING.md", "docs/any_robot.md"])
def test_tables_are_what_the_package_works_out_now(document):
    renew = runpy.run_path(str(ROOT / "docs" / "readme_tables.py"))["renewed"]
    text = (ROOT / document).read_text(encoding="utf-8")
    assert renew(document, text) == text, "run: python docs/readme_tables.py"


@pytest.mark.parametrize("number", range(len(blocks("python"))))
def test_python_snippet_runs(number, capsys):
    exec(compile(blocks("python")[number], "README", "exec"), {})
    assert capsys.readouterr().out


def test_the_snippet_on_any_robot_runs_on_one():
    text = (ROOT / "docs" / "any_robot.md").read_text(encoding="utf-8")
    code = re.search(r"```python\n(.*?)```", text, flags=re.DOTALL)[1]
    for said, meant in (
        ("arm.urdf", "urdf/pollard/pollard.urdf"),
        ("loops.yaml", "urdf/pollard/pollard.closures.yaml"),
        ("motion.csv", "examples/pollard_motors.csv"),
    ):
        assert f'"{said}"' in code
        code = code.replace(f'"{said}"', f'"{ROOT / meant}"')
    found = {}
    exec(compile(code, "any_robot", "exec"), found)
    torque = found["report"].dynamics.torque
    np.testing.assert_allclose(found["dynamics"].torque, torque, atol=1e-9 * np.abs(torque).max())


def commands():
    lines = "".join(blocks("bash")).splitlines()
    return [shlex.split(line, comments=True) for line in lines if re.match(r"\w+-pin ", line)]


@pytest.mark.parametrize("words", commands(), ids=" ".join)
def test_every_command_line_of_the_readme_is_understood(words):
    import importlib

    package = words[0].replace("-", "_")
    module = "command.main" if package == "thesis_pin" else "cli"
    parsed = importlib.import_module(f"{package}.{module}").parser().parse_args(words[1:])
    assert parsed.run.name == words[1]


def test_check_command_is_the_one_ci_runs():
    assert "bash check.sh" in README
    assert "bash ./check.sh" in (ROOT / ".ci" / "run").read_text()


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda path: path.name)
def test_links_lead_to_files_that_exist(document):
    for target in re.findall(r"\]\(([^)#]+)\)", document.read_text(encoding="utf-8")):
        if not target.startswith("http"):
            assert (document.parent / target).exists(), target
