"""Motions that say whose they are: who writes it, who keeps it, who warns, and who doesn't."""

import json
import re
import tomllib
from dataclasses import replace

import pytest
from commands import ROOT, run

import pollard_pin
import scout_pin
from pollard_pin.specification import POLLARD_PATH
from pollard_pin.study.timing.report import time_report
from scout_pin.motion.exact import exact_toml
from scout_pin.specification import SCOUT_PATH
from thesis_pin.model.made_for import MadeFor

SAID = "was made for the robot"
QUICK = ["--samples", "41"]


def edited(file, folder, pattern, by):
    text, count = re.subn(pattern, by, file.read_text(encoding="utf-8"), flags=re.MULTILINE)
    assert count
    written = folder / f"{file.stem}_other.toml"
    written.write_text(text, encoding="utf-8")
    return written


@pytest.fixture(scope="module")
def biped(tmp_path_factory):
    """A specification of longer thighs, and a gait that says it was made for it."""
    folder = tmp_path_factory.mktemp("biped")
    other = edited(SCOUT_PATH, folder, r"^x_3 = .*", "x_3 = 75.5e-3")
    other = edited(other, folder, '^name = "scout"', 'name = "my_biped"')
    gait = scout_pin.load_gait(ROOT / "examples" / "walk.toml")
    gait = replace(gait, made_for=MadeFor.of(scout_pin.Specification.read(other)))
    file = folder / "walk.toml"
    file.write_text(exact_toml(gait), encoding="utf-8")
    return other, file


@pytest.fixture(scope="module")
def arm(tmp_path_factory):
    """Another Pollard, and a path that was timed for it."""
    folder = tmp_path_factory.mktemp("arm")
    other = edited(POLLARD_PATH, folder, r"^x_32 = .*", "x_32 = 0.34")
    other = edited(other, folder, '^name = "pollard"', 'name = "my_arm"')
    robot = pollard_pin.load(other)
    path = pollard_pin.load_path(ROOT / "examples" / "spray_arch.toml")
    limits = pollard_pin.motor_limits(robot.specification, torque=4.0, speed=10.0)
    found = time_report(pollard_pin.time_path(robot, path, limits), samples=41)
    file = folder / "fast.toml"
    file.write_text(found.path_file, encoding="utf-8")
    return other, file


VERBS = {
    "gait": ("scout-pin gait", "biped", "--gait", QUICK),
    "view": ("scout-pin view", "biped", "--gait", []),
    "trajectory": ("pollard-pin trajectory", "arm", "--path", QUICK),
    "view of a path": ("pollard-pin view", "arm", "--path", []),
    "size": ("scout-pin size", "biped", "--gait", ["--law", "given"]),
    "size of a path": ("pollard-pin size", "arm", "--path", ["--law", "given"]),
    "size with free times": ("pollard-pin size", "arm", "--path", ["--law", "free"]),
    "time": ("pollard-pin time", "arm", "--path", QUICK),
    "accuracy": ("pollard-pin accuracy", "arm", "--path", [*QUICK, "--draws", "2"]),
    "place": ("pollard-pin place", "arm", "--path", [*QUICK, "--x", "0", "--torque", "9"]),
    "place for time": ("pollard-pin place", "arm", "--path", [*QUICK, "--x", "0", "--for", "time"]),
}


@pytest.mark.parametrize("case", VERBS)
def test_every_verb_warns_of_another_robot_and_of_no_other(case, request, capfd, tmp_path):
    name, kind, flag, more = VERBS[case]
    other, file = request.getfixturevalue(kind)
    words = [name.split()[1], flag, str(file), *more]
    if words[0] == "view":
        words += ["--html", str(tmp_path / "page.html")]
    else:
        words += ["--json", str(tmp_path / "found.json")]
    code, _, err = run(name, words, capfd)
    assert code == 0, err
    assert err.count(SAID) == 1, err
    if words[0] != "view":
        found = json.loads((tmp_path / "found.json").read_bytes())
        notes = found.get("summary" if words[0] == "accuracy" else "", found)["notes"]
        assert sum(SAID in note for note in notes) == 1
    for reading in ("physical", "printed"):
        own = [*words, "--specification", str(other), "--inertia", reading]
        code, out, err = run(name, own, capfd)
        assert code == 0, err
        assert SAID not in err + out, err
        if words[0] != "view":
            assert SAID not in (tmp_path / "found.json").read_text(encoding="utf-8")


def test_the_reports_text_and_page_warn(biped, arm, capfd, tmp_path):
    for name, flag, file in (
        ("scout-pin gait", "--gait", biped[1]),
        ("pollard-pin trajectory", "--path", arm[1]),
    ):
        page = tmp_path / "page.html"
        words = [name.split()[1], flag, str(file), *QUICK, "--html", str(page)]
        code, out, _ = run(name, words, capfd)
        assert code == 0
        assert f"Warning: the {flag[2:]}" in out
        assert SAID in " ".join(out.split())
        assert SAID in page.read_text(encoding="utf-8")


def test_a_second_motion_beside_the_first_warns_by_its_own_name(biped, capfd):
    words = ["gait", *QUICK, "--beside", str(biped[1]), "--json", "-"]
    code, out, err = run("scout-pin gait", words, capfd)
    found = json.loads(out)
    assert code == 0
    assert err.count(SAID) == 1
    assert SAID in str(found["beside"]["report"]["notes"])
    assert SAID not in str(found["notes"])
    words = ["gait", *QUICK, "--gait", str(biped[1]), "--specification", str(biped[0])]
    words += ["--beside-robot", str(SCOUT_PATH), "--json", "-"]
    code, out, err = run("scout-pin gait", words, capfd)
    found = json.loads(out)
    assert code == 0
    assert err.count(SAID) == 1
    assert SAID in str(found["beside"]["report"]["notes"])
    assert SAID not in str(found["notes"])


@pytest.mark.parametrize("to", ["toml", "sampled"])
def test_convert_keeps_whose_it_is(biped, arm, to, capfd, tmp_path):
    for name, flag, (_, file) in (("scout-pin", "--gait", biped), ("pollard-pin", "--path", arm)):
        out = tmp_path / f"{name}.toml"
        words = ["convert", flag, str(file), "--to", str(out)]
        words += ["--samples", "41"] if to == "sampled" else []
        code, _, err = run(f"{name} convert", words, capfd)
        assert code == 0, err
        assert toml(out)["made_for"] == toml(file)["made_for"]


def toml(file):
    return tomllib.loads(file.read_text(encoding="utf-8"))


WRONG = {
    '"walk"': "made_for",
    '{ robot = "my_biped" }': "made_for.fingerprint",
    '{ robot = "my_biped", fingerprint = "DFD84FFE" }': "made_for.fingerprint",
    '{ robot = "my_biped", fingerprint = 12345678 }': "made_for.fingerprint",
    '{ robot = "two words", fingerprint = "dfd84ffe" }': "made_for.robot",
    '{ robot = "my_biped", fingerprint = "dfd84ffe", why = "x" }': "made_for.why",
}


@pytest.mark.parametrize("value", WRONG)
def test_a_key_that_was_spoilt_is_named_with_its_line(biped, arm, value, capfd, tmp_path):
    for name, flag, (_, file) in (
        ("scout-pin gait", "--gait", biped),
        ("pollard-pin trajectory", "--path", arm),
    ):
        spoilt = edited(file, tmp_path, "^made_for = .*", f"made_for = {value}")
        code, out, err = run(name, [name.split()[1], flag, str(spoilt)], capfd)
        assert (code, out) == (2, ""), err
        assert WRONG[value] in err, err
        assert "Traceback" not in err, err


def test_the_examples_for_another_biped_say_so():
    own = MadeFor.of(scout_pin.Specification.read(ROOT / "examples" / "lopsided.toml"))
    for name in ("lopsided_walk", "lopsided_plan"):
        assert scout_pin.load_gait(ROOT / "examples" / f"{name}.toml").made_for == own


def test_a_sweep_warns_once_and_writes_whose_its_best_gait_is(biped, capfd, tmp_path):
    words = ["sweep", "--gait", str(biped[1]), *QUICK, "--jobs", "1", "--out", str(tmp_path / "o")]
    words += ["--vary", "gait.time_unit=1.0,1.1", "--vary", "legs.*.x_3=0.0746,0.075"]
    code, _, err = run("scout-pin sweep", words, capfd)
    assert code == 0, err
    assert err.count(SAID) == 1, err
    best = scout_pin.Specification.read(tmp_path / "o" / "best.toml")
    gait = scout_pin.load_gait(tmp_path / "o" / "best_gait.toml")
    assert gait.made_for == MadeFor.of(best)
