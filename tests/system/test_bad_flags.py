"""Every verb's example with one thing wrong in it: one message, code 2, no file."""

import re

import pytest
from commands import ROOT, VERBS, example, flags, into, run

ERROR = re.compile(r"^[a-z]+-pin( [a-z-]+)?: error: ", flags=re.MULTILINE)

NUMBERS = {
    "--time-unit": {"2.5"},
    "--duration": {"2.5"},
    "--speed": {"2.5"},
    "--hold": {"2.5"},
    "--at": {"0", "2.5"},
    "--fps": {"2.5"},
    "--size": set(),
    "--formats": set(),
    "--dpi": set(),
    "--samples": set(),
    "--repeat": set(),
    "--feed": {"2.5"},
    "--torque": {"2.5"},
    "--loop-force": {"2.5"},
    "--tool-speed": {"2.5"},
    "--tool-acceleration": {"2.5"},
    "--speed-window": {"2.5"},
    "--share": {"2.5"},
    "--stiffness": {"0", "2.5"},
    "--damping": {"0", "2.5"},
    "--time-step": set(),
    "--mass-error": {"0"},
    "--servo-zero-error": {"0", "2.5"},
    "--draws": set(),
    "--draw": set(),
    "--seed": {"0"},
    "--armature": {"0"},
    "--servo-stiffness": {"2.5"},
    "--servo-damping": {"0", "2.5"},
    "--floor-tilt": {"0", "-1", "2.5"},
    "--voltage": {"2.5"},
    "--no-load-speed": {"2.5"},
    "--power": {"2.5"},
    "--rating": set(),
    "--within": {"2.5"},
    "--walk": {"2.5"},
    "--factor": {"2.5"},
    "--precision": {"0"},
    "--points": set(),
    "--length": {"2.5"},
    "--jobs": set(),
    "--port": {"0"},
    "--position": {"0", "-1", "2.5"},
    "--rotation": {"0", "-1", "2.5"},
    "--placement": {"0", "-1", "2.5"},
    "--orientation": {"0", "-1", "2.5"},
    "--x": {"0", "-1", "2.5"},
    "--y": {"0", "-1", "2.5"},
    "--z": {"0", "-1", "2.5"},
    "pose": {"0", "-1", "2.5"},
    "motors": {"0", "-1", "2.5"},
    "--sole": {"2.5"},
    "--servo": {"2.5"},
    "--friction": {"2.5"},
    "--external": set(),
    "--floor-height": {"0", "-1", "2.5"},
    "--slope": {"0", "2.5"},
    "--step-length": {"2.5"},
    "--side": {"0", "-1", "2.5"},
    "--turn": {"0", "-1", "2.5"},
    "--best": set(),
    "--condition": {"2.5"},
    "--step-time": {"2.5"},
    "--walking-speed": {"2.5"},
    "--foot-spacing": set(),
    "--lift": {"2.5"},
    "--margin": {"0", "2.5"},
    "--torque-reserve": {"0", "2.5"},
    "--speed-reserve": {"0", "2.5"},
    "--line-reserve": {"0", "2.5"},
    "--pitch": {"2.5"},
    "--roll": {"2.5"},
    "--yaw": {"2.5"},
    "--knee": {"2.5"},
    "--height": set(),
    "--steps": set(),
    "--servo-rate": {"2.5"},
    "--meshcat": set(),
}
"""What of :data:`JUNK` each flag that takes numbers has a use for."""
JUNK = ("nan", "inf", "-inf", "-1e999", "0", "-1", "2.5", "1_0x", "eleven")

READ = (
    *("--specification", "--gait", "--path", "--pose", "--servos", "--list", "--designs"),
    "--tolerances",
    *("file", "closures", "motion", "servos"),
)
"""Flags and words that name a file to read."""
FILES = {
    "missing": None,
    "empty": "",
    "of another kind": "%PDF-1.4\n",
    "with a wrong key": "format = 1\nnonsense = 1\n",
    "with NaN": "format = 1\nname = nan\n",
    "not text": b"\xff\xfe\x00\x9f",
    "a folder": "folder",
}

SWEEPING = (
    ["--json", "-", "--html", "-"],
    ["--vary", "nothing"],
    ["--vary", "name="],
    ["--vary", "name=1:2"],
    ["--random"],
    ["--seed", "1"],
    ["--draw", "5", "--pair"],
    ["--pair"],
    ["--jobs", "2", "--scheduler", "tcp://127.0.0.1:1"],
    ["--keys", "nothing.*"],
    ["--measure", "nothing"],
    ["--pareto", "mass"],
    ["--pareto", "mass,nothing"],
    ["--pareto", "mass,within_limits"],
    ["--wish", "mass"],
    ["--wish", "mass<heavy"],
    ["--wish", "nothing<1"],
)
CONTRADICTIONS = {
    "scout-pin gait": [
        ["--json", "-", "--html", "-"],
        ["--branch=+-"],
        ["--figure", "4.1"],
        ["--align", "phase"],
    ],
    "scout-pin view": [
        ["--port", "0"],
        ["--hold", "1"],
        ["--no-browser"],
        ["--meshcat"],
        ["--branch=+-"],
        ["--sliders"],
        ["--align", "time"],
    ],
    "scout-pin sweep": [
        *SWEEPING,
        ["--vary", "servo.stall_torque=0.3,0.5"],
        ["--vary", "legs.*.x_3=0.07,0.08"],
        ["--plan", "speed=0.1"],
        ["--steps", "2"],
        ["--branch=+-"],
    ],
    "scout-pin size": [
        ["--branch=+-"],
        ["--per", "joint"],
        ["--law", "both"],
        ["--within", "3"],
        ["--curve"],
        ["--rating", "0.4"],
        ["--walk", "100"],
        ["--dpi", "100"],
    ],
    "scout-pin simulate": [
        ["--json", "-", "--html", "-"],
        ["--branch=+-"],
        ["--draws", "3"],
        ["--draws", "20000", "--mass-error", "0.1"],
        ["--mass-error", "0.5"],
        ["--servo-zero-error", "50"],
        ["--floor-tilt", "50", "0"],
        ["--time-step", "0.01"],
        ["--jobs", "1000"],
        ["--armature", "2"],
    ],
    "scout-pin convert": [
        ["--json", "-", "--to", "-"],
        ["--units", "mm,cm"],
        ["--units", "furlong"],
        ["--servos", "examples/squat.toml"],
        ["--branch=+-"],
    ],
    "scout-pin plan": [
        ["--json", "-", "--html", "-"],
        ["--branch=+-"],
        ["--walking-speed", "100", "--step-time", "1"],
        ["--walking-speed", "100", "--fastest"],
        ["--fastest", "--objective", "least-torque"],
        ["--height", "200", "100"],
        ["--margin", "0.01"],
        ["--torque-reserve", "0.1"],
        ["--torque-reserve", "99"],
        ["--samples", "700"],
        ["--knee", "89"],
        ["--steps", "1000"],
    ],
    "scout-pin ik": [["--branch=+-"]],
    "scout-pin info": [["--json", "-", "--html", "-"]],
    "scout-pin new": [["--specification", "examples/lopsided.toml"], ["--example", "none"]],
    "scout-pin from-urdf": [["--json", "-", "--to", "-"], ["--left", "none"]],
    "scout-pin urdf": [],
    "scout-pin audit": [
        ["--every"],
        ["--markdown", "-", "--html", "-"],
        ["--language", "es"],
        ["--errata", "-", "--equation", "4.1"],
    ],
    "pollard-pin trajectory": [
        ["--json", "-", "--html", "-"],
        ["--duration", "3"],
        ["--timing", "constant-rate"],
        ["--branch=+-"],
        ["--figure", "5.2"],
        ["--align", "phase"],
    ],
    "pollard-pin sweep": [
        *SWEEPING,
        ["--vary", "chain_1=0.3,0.5"],
        ["--timed", "fastest"],
        ["--vary", "chain_*.x_43=0.3,0.31"],
        ["--duration", "3"],
        ["--branch=+-"],
        ["--actuators", "three"],
    ],
    "pollard-pin simulate": [
        ["--json", "-", "--html", "-"],
        ["--open-loop"],
        ["--stiffness", "1", "2"],
        ["--damping", "1", "2", "3"],
        ["--time-step", "0.04"],
        ["--mass-error", "0.5"],
        ["--servo-zero-error", "50"],
        ["--draws", "3"],
        ["--duration", "3"],
        ["--actuators", "three"],
        ["--branch=+-"],
    ],
    "pollard-pin view": [
        ["--port", "0"],
        ["--hold", "1"],
        ["--no-browser"],
        ["--meshcat"],
        ["--duration", "3"],
        ["--sliders"],
        ["--align", "phase"],
    ],
    "pollard-pin size": [
        ["--duration", "3"],
        ["--branch=+-"],
        ["--actuators", "three"],
        ["--per", "joint"],
        ["--bound", "line"],
        ["--law", "both"],
        ["--within", "3"],
        ["--power", "3"],
    ],
    "pollard-pin convert": [["--json", "-", "--to", "-"], ["--units", "mm"], ["--duration", "3"]],
    "pollard-pin ik": [["--branch=+-"]],
    "pollard-pin fk": [],
    "pollard-pin time": [
        ["--duration", "3"],
        ["--law", "least-load"],
        ["--law", "least-load", "--duration", "0.01"],
        ["--law", "constant-speed"],
        ["--share", "50"],
        ["--speed-window", "3"],
        ["--torque", "1", "2"],
        ["--speed", "1", "2", "3"],
        ["--motor", "nobody"],
        ["--motors", "examples/servos.csv"],
        ["--to", "path.doc"],
        ["--branch=+-"],
        ["--json", "-", "--html", "-"],
    ],
    "pollard-pin accuracy": [
        ["--workspace"],
        ["--workspace", "--turn", "10"],
        ["--points", "5"],
        ["--x", "0.4"],
        ["--orientation", "0", "0", "0"],
        ["--stiffness", "1", "2"],
        ["--draws", "1000000"],
        ["--samples", "1000000"],
        ["--duration", "3"],
        ["--branch=+-"],
        ["--json", "-", "--html", "-"],
    ],
    "pollard-pin workspace": [["--x", "0.8", "0.1"], ["--z", "0", "1", "2"], ["--branch=+-"]],
    "pollard-pin place": [
        ["--json", "-", "--html", "-"],
        ["--any-branch", "--branch=-++-+++"],
        ["--branch=+-"],
        ["--duration", "3"],
        ["--x", "0.2:0.1"],
        ["--x", "0:0.2:7"],
        ["--z", "0.1,0.1"],
        ["--torque", "1", "2"],
        ["--mirror", "twice"],
    ],
    "pollard-pin info": [["--json", "-", "--html", "-"]],
    "pollard-pin urdf": [],
    "pollard-pin audit": [
        ["--every"],
        ["--markdown", "-", "--html", "-"],
        ["--language", "es"],
        ["--errata", "-", "--equation", "4.1"],
    ],
    "thesis-pin audit": [
        ["--equation", "G_1", "--every"],
        ["--equation", "nowhere"],
        ["--markdown", "-", "--html", "-"],
    ],
    "thesis-pin balance": [
        ["--slope", "95"],
        ["--slope", "5,1,2"],
        ["--friction", "0"],
        ["--floor-height", "nan"],
        ["--sharing", "fairly"],
        ["--feet", "nowhere"],
        ["--feet", "leg_left_6_link=wide"],
        ["--pose", "nowhere"],
        ["--json", "-", "--html", "-"],
    ],
    "thesis-pin check": [],
    "thesis-pin formats": [],
    "thesis-pin torque": [
        ["--json", "-", "--html", "-"],
        ["--frame", "tool_tip"],
        ["--euler", "ZYX"],
    ],
    "thesis-pin size": [
        ["--frame", "tool_tip"],
        ["--external", "nowhere=0,0,1"],
        ["--per", "joint"],
        ["--no-load-speed", "3"],
    ],
    "thesis-pin view": [
        ["--port", "0"],
        ["--hold", "1"],
        ["--no-browser"],
        ["--meshcat"],
        ["--euler", "ZYX"],
    ],
    "thesis-pin workspace": [
        ["--along", "x", "0", "1"],
        ["--along", "z_mm", "3", "-3"],
        ["--along", "nowhere", "0", "1"],
        ["--along", "pitch", "0", "nan"],
        ["--at", "x", "0"],
        ["--at", "y", "0"],
        ["--at", "y", "eleven"],
        ["--frame", "nowhere"],
        ["--pose", "nowhere"],
        ["--json", "-", "--html", "-"],
    ],
}
"""Flags that contradict a verb's example, its outputs, or each other."""


def misuses():
    """(verb, what is wrong, words that stand instead of or behind the example's)."""
    for name in VERBS:
        for words in CONTRADICTIONS[name]:
            yield name, " ".join(words), words
        for action in flags(name):
            flag = action.option_strings[0] if action.option_strings else action.dest
            if action.choices:
                yield name, f"{flag} nonsense", (action, "nonsense")
            if flag in READ:
                for kind in FILES:
                    yield name, f"{flag}: a file {kind}", (action, kind)
            elif callable(action.type):
                for junk in JUNK:
                    if junk not in NUMBERS[flag]:
                        yield name, f"{flag} {junk}", (action, junk)


def misused(name, instead, folder):
    """The command line with one thing wrong."""
    words = example(name)
    if isinstance(instead, list):
        return words, instead
    action, value = instead
    if (action.option_strings or [action.dest])[0] in READ:
        value = written(value, folder)
    if action.option_strings:
        count = action.nargs if isinstance(action.nargs, int) else 1
        return words, [action.option_strings[0], value, *["1"] * (count - 1)]
    before = [act for act in flags(name) if not act.option_strings]
    before = before[: [act.dest for act in before].index(action.dest)]
    place = 1 + sum(act.nargs if isinstance(act.nargs, int) else 1 for act in before)
    return [*words[:place], value, *words[place + 1 :]], []


def written(kind, folder):
    """A file of a kind, by its name."""
    path = folder / "bad.toml"
    content = FILES[kind]
    if kind == "a folder":
        return str(folder)
    if content is not None:
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return str(path)


def test_every_verb_is_in_the_table_of_contradictions():
    assert set(CONTRADICTIONS) == set(VERBS)


@pytest.mark.parametrize(
    ("name", "instead"), [pytest.param(n, i, id=f"{n}: {what}") for n, what, i in misuses()]
)
def test_misuse_is_one_message_exit_2_and_no_file(name, instead, tmp_path, monkeypatch, capfd):
    monkeypatch.chdir(ROOT)
    out, inputs = tmp_path / "out", tmp_path / "in"
    out.mkdir()
    inputs.mkdir()
    words, behind = misused(name, instead, inputs)
    code, said, err = run(name, [*words, *into(name, out), *behind], capfd)
    assert code == 2, (said, err)
    assert said == ""
    assert len(ERROR.findall(err)) == 1, err
    assert "Traceback" not in err
    assert list(out.iterdir()) == []
