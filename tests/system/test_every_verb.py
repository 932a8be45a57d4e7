"""What every verb of every command has, found by one walk over all of them."""

import json
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
from collections import defaultdict

import pytest
from commands import COMMANDS, MODULES, ROOT, VERBS, example, flags, has, into, run

from thesis_pin.command import progress
from thesis_pin.command.registry import found

SEEN = {
    "gait": {"--out", "--html"},
    "trajectory": {"--out", "--html"},
    "plan": {"--out", "--html"},
    "view": {"--html"},
    "workspace": {"--out"},
    "place": {"--out", "--html"},
    "thesis-pin workspace": {"--out", "--html"},
    "accuracy": {"--out", "--html"},
    "urdf": {"--out"},
    "audit": {"--html"},
    "convert": set(),
    "size": {"--out"},
    "simulate": {"--out", "--html"},
    "time": {"--out", "--html"},
    "sweep": {"--out", "--html"},
    "ik": set(),
    "fk": set(),
    "info": {"--html"},
    "new": set(),
    "from-urdf": set(),
    "check": set(),
    "formats": set(),
    "torque": {"--out", "--html"},
    "balance": {"--out", "--html"},
}
"""How one sees what a verb found, beside the terminal."""

DOCUMENT = (ROOT / "docs" / "conventions.md").read_text(encoding="utf-8")
SCHEMAS = {
    (schema, int(version)): commands
    for schema, version, commands in re.findall(
        r"^\| `([a-z-]+/[a-z-]+)` \| (\d+) \| (.*?) \|", DOCUMENT, flags=re.MULTILINE
    )
}

OWN_WORDS = {"--to", "--out", "--json", "--strict", "--specification", "--branch", "--pose"}
"""Flags whose help says what this robot or verb writes or takes there."""


@pytest.mark.parametrize("name", VERBS)
def test_a_python_function_does_the_same_and_help_names_it(name, capfd):
    _, verb = VERBS[name]
    assert callable(found(verb.python))
    code, out, _ = run(name, [verb.name, "--help"], capfd)
    assert code == 0
    assert f"Example: {name.split()[0]} {verb.example}\n" in out
    assert f"In Python: {verb.python.replace(':', '.')}\n" in out


@pytest.mark.parametrize("name", VERBS)
def test_answers_can_be_had_as_json_and_where_there_is_something_to_see_as_files(name):
    assert has(name, "--json")
    wanted = SEEN.get(name, SEEN[VERBS[name][1].name])
    assert {flag for flag in ("--out", "--html") if has(name, flag)} == wanted


@pytest.mark.parametrize("name", VERBS)
def test_the_example_of_the_help_runs_and_its_json_has_a_documented_schema(
    name, tmp_path, monkeypatch, capfd
):
    for folder in ("examples", "urdf"):
        shutil.copytree(ROOT / folder, tmp_path / folder)
    monkeypatch.chdir(tmp_path)
    words = shlex.split(VERBS[name][1].example)
    code, _, err = run(name, [*words, "--json", "answer.json"], capfd)
    assert code == 0, err
    document = json.loads((tmp_path / "answer.json").read_bytes())
    row = SCHEMAS[document["schema"], document["version"]]
    assert f"`{name}`" in row
    made = {path.name for path in tmp_path.iterdir()} - {"examples", "urdf", "answer.json"}
    assert made <= set(words)


def test_the_same_flag_has_the_same_words_in_all_commands():
    words = defaultdict(set)
    for name in VERBS:
        for action in flags(name):
            for flag in action.option_strings:
                text = re.sub(r"\(default: .*\)", "", action.help)
                choices = None if action.choices is None else tuple(action.choices)
                form = (str(action.metavar), str(action.nargs), choices)
                words[flag].add((*form, "" if flag in OWN_WORDS else text))
    various = {flag: forms for flag, forms in words.items() if len(forms) > 1}
    html = various.pop("--html")
    assert {form[:3] for form in html} == {("FILE|-", "None", None)}
    at = various.pop("--at")
    assert {form[0] for form in at} == {"SECONDS", "('NAME', 'VALUE')"}  # of a picture, of a map
    within = various.pop("--within")
    assert {form[0] for form in within} == {"SECONDS", "LENGTH"}  # of a motion, of the tool
    law = various.pop("--law")
    assert {form[2][0] for form in law} == {"given", "fastest"}  # of a time, of a path's geometry
    for flag, metavars in (("--speed", {"SPEED", "rad/s"}), ("--duration", {"SECONDS"})):
        assert {form[0] for form in various.pop(flag)} == metavars  # of playing, of motors
    # What else a flag takes where it is of something else, or of more: a walk's turn, a path's,
    # several of them to be tried.
    taken = {
        "--turn": {"DEG", "DEGREES", "RANGE"},
        "--x": {"METRES", "RANGE"},
        "--y": {"METRES", "RANGE"},
        "--z": {"METRES", "RANGE"},
        "--armature": {"kg·m²", "kg·m²[,POWER]"},  # of the servos, of motors of any size
    }
    for flag, metavars in taken.items():
        forms = various.pop(flag)
        assert len(forms) == len({form[0] for form in forms}), flag
        assert {form[0] for form in forms} == metavars
    mirror = various.pop("--mirror")
    assert {form[1:3] for form in mirror} == {("0", None), ("?", ("no", "yes", "both"))}
    per = various.pop("--per")
    assert {form[2] for form in per} == {("group", "joint", "robot"), ("joint", "robot")}
    assert various == {}


def test_a_robot_s_hooks_all_exist():
    import pollard_pin.cli
    import scout_pin.cli

    for robot in (scout_pin.cli.ROBOT, pollard_pin.cli.ROBOT):
        for hook in robot:
            if isinstance(hook, str) and ":" in hook:
                assert found(robot.name_of(hook)) is not None


def test_help_of_each_command_imports_nothing_heavy():
    for name, module in MODULES.items():
        code = (
            f"import sys; from {module} import main\n"
            "try: main(['--help'])\n"
            "except SystemExit: pass\n"
            "heavy = {'numpy', 'pinocchio', 'scipy', 'matplotlib', 'pydantic', 'rich', 'yaml'}\n"
            "sys.stderr.write(' '.join(sorted(heavy & set(sys.modules))))"
        )
        done = subprocess.run(
            [sys.executable, "-c", code],
            capture_output=True,
            text=True,
            env=os.environ | {"PYTHONPATH": str(ROOT)},
            check=False,
        )
        assert (done.returncode, done.stderr) == (0, ""), name
        assert all(verb.name in done.stdout for verb in COMMANDS[name].verbs)


SLEEPER = """
import sys, time
from thesis_pin.command import progress
enter = progress.Bar.__enter__
def slowly(bar):
    enter(bar)
    print("begun", file=sys.stderr, flush=True)
    time.sleep(600)
progress.Bar.__enter__ = slowly
from {module} import main
sys.exit(main())
"""


@pytest.mark.parametrize("name", VERBS)
def test_ctrl_c_while_a_verb_works_under_its_progress_bar_ends_with_130_and_no_file(
    name, tmp_path, monkeypatch, capfd
):
    enter = progress.Bar.__enter__

    def interrupted(bar):
        enter(bar)
        signal.raise_signal(signal.SIGINT)

    monkeypatch.setattr(progress.Bar, "__enter__", interrupted)
    monkeypatch.chdir(ROOT)
    code, said, complaint = run(name, [*example(name), *into(name, tmp_path)], capfd)
    assert (code, said) == (130, "")
    assert complaint == f"{name.split()[0]}: interrupted\n"
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", ["scout-pin plan", "pollard-pin trajectory", "thesis-pin view"])
def test_ctrl_c_from_outside_ends_a_process_with_130_and_no_file(name, tmp_path):
    out = tmp_path / "out"
    out.mkdir()
    process = subprocess.Popen(
        [
            sys.executable,
            "-c",
            SLEEPER.format(module=MODULES[name.split()[0]]),
            *example(name),
            *into(name, out),
        ],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        cwd=ROOT,
        env=os.environ | {"PYTHONPATH": str(ROOT)},
    )
    try:
        assert process.stderr.readline() == "begun\n"
        process.send_signal(signal.SIGINT)
        said, complaint = process.communicate(timeout=60)
    finally:
        process.kill()
    assert (process.returncode, said) == (130, "")
    assert complaint == f"{name.split()[0]}: interrupted\n"
    assert list(out.iterdir()) == []
