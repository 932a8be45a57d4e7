"""Every flag of both commands with values it can't take: one message, code 2, no file."""

import argparse

import pytest

from pollard_pin.cli import main as pollard
from pollard_pin.cli import parser as pollard_parser
from scout_pin.cli import main as scout
from scout_pin.cli import parser as scout_parser

HOPELESS = {"nothing": "", "two dashes": "--", "a NUL": "\0x", "far too long": "9" * 5000}
"""Values that no flag of either command takes."""

REQUIRED = {
    ("scout", "ik"): ["left", "--position", "-0.0445", "-0.02", "-0.22"],
    ("pollard", "ik"): ["0.45", "0", "0.1", "0", "0", "0"],
    ("pollard", "fk"): ["1", "2", "3", "4", "5", "6"],
    ("pollard", "check"): ["a.urdf", "b.yaml"],
}
SERVING = ["--no-browser", "--hold", "0.01"]


def flags():
    """Each flag with a value, of each verb of both commands."""
    for robot, parser in (("scout", scout_parser()), ("pollard", pollard_parser())):
        verbs = next(a for a in parser._actions if isinstance(a, argparse._SubParsersAction))
        for verb, words in verbs.choices.items():
            for action in words._actions:
                if action.option_strings and action.nargs != 0:
                    yield robot, verb, action.option_strings[0]


def run(robot, words, capfd):
    main = scout if robot == "scout" else pollard
    try:
        code = main(words)
    except SystemExit as exit_:
        code = exit_.code
    out, err = capfd.readouterr()
    return code, out, err


@pytest.mark.parametrize(("robot", "verb", "flag"), list(flags()))
def test_hopeless_values_are_refused_before_anything_is_written(
    robot, verb, flag, tmp_path, monkeypatch, capfd
):
    monkeypatch.chdir(tmp_path)
    for name, value in HOPELESS.items():
        words = [verb, *REQUIRED.get((robot, verb), []), *(SERVING if verb == "view" else [])]
        code, out, err = run(robot, [*words, f"{flag}={value}"], capfd)
        assert code == 2, (name, out, err)
        assert err.count("error:") == 1, (name, err)
        assert out == "", name
        assert list(tmp_path.iterdir()) == [], name


@pytest.mark.parametrize("robot", ["scout", "pollard"])
def test_more_samples_than_memory_holds_is_one_message(robot, monkeypatch, capfd):
    import numpy as np

    def full(*_, **__):
        raise MemoryError

    monkeypatch.setattr(np, "linspace", full)
    verb = "gait" if robot == "scout" else "trajectory"
    code, out, err = run(robot, [verb, "--samples", "100000000"], capfd)
    assert (code, out) == (2, "")
    assert err == f"{robot}-pin: error: there isn't enough memory for this; ask for less at once\n"


@pytest.mark.parametrize("text", ["x = " + "[" * 5000, "[" * 5000])
def test_a_file_nested_too_deeply_is_refused(text, tmp_path, capfd):
    (tmp_path / "deep.toml").write_text(text)
    code, _, err = run("scout", ["info", "--specification", str(tmp_path / "deep.toml")], capfd)
    assert code == 2
    assert "the specification is" in err
