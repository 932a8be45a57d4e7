"""The three commands as the tests that walk over all their verbs see them."""

import argparse
import shlex
from functools import cache
from pathlib import Path

from pollard_pin.cli import COMMAND as POLLARD
from scout_pin.cli import COMMAND as SCOUT
from thesis_pin.command.main import COMMAND as THESIS

ROOT = Path(__file__).parents[1]
COMMANDS = {command.name: command for command in (SCOUT, POLLARD, THESIS)}
MODULES = {
    "scout-pin": "scout_pin.cli",
    "pollard-pin": "pollard_pin.cli",
    "thesis-pin": "thesis_pin.command.main",
}
VERBS = {
    f"{command.name} {verb.name}": (command, verb)
    for command in COMMANDS.values()
    for verb in command.verbs
}
WRITTEN = {"scout-pin new": "my_biped.toml"}
"""Words of examples that name a file which the verb writes."""
OUTPUTS = (
    *("--to", "--out", "--write", "--html", "--json", "--markdown", "--errata", "--film"),
    "--picture",
)


@cache
def flags(name):
    """The options and words of a verb's parser, in order."""
    command, verb = VERBS[name]
    verbs = next(
        action
        for action in command.parser(verb.name)._actions
        if isinstance(action, argparse._SubParsersAction)
    )
    return [action for action in verbs.choices[verb.name]._actions if action.dest != "help"]


def has(name, flag):
    """Whether a verb has a flag."""
    return any(flag in action.option_strings for action in flags(name))


def example(name, folder=None):
    """A verb's example without its outputs; those it can't do without, in a folder."""
    words = shlex.split(VERBS[name][1].example)
    return [
        str(folder / word) if folder is not None and word == WRITTEN.get(name) else word
        for word, before in zip(words, ["", *words], strict=False)
        if word not in OUTPUTS and before not in OUTPUTS
    ]


def into(name, folder):
    """Flags that write what a verb can write into a folder."""
    words = ["--json", str(folder / "answer.json")]
    words += ["--out", str(folder / "made")] * has(name, "--out")
    words += ["--to", str(folder / "made.csv")] * has(name, "--to")
    return words + ["--html", str(folder / "page.html")] * has(name, "--html")


def run(name, words, capfd):
    """Run a command in this process: exit code, standard output, standard error."""
    capfd.readouterr()
    try:
        code = COMMANDS[name.split()[0]].main(words)
    except SystemExit as end:
        code = end.code
    out, err = capfd.readouterr()
    return code, out, err
