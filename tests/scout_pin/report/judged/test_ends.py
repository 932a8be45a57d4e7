"""A gait's ends: standing, going on, or cut off; the verdict says so."""

import json
from dataclasses import replace

import numpy as np
import pytest

import scout_pin
from scout_pin.cli import main
from scout_pin.motion.cycles import repeat_gait
from scout_pin.motion.files import load_gait
from scout_pin.motion.gait import Phase
from thesis_pin.numeric.interpolation import polynomial

from ...conftest import EXAMPLES


@pytest.fixture(scope="module")
def walk():
    return load_gait(EXAMPLES / "walk.toml")


def cut(gait, start, end):
    phases = tuple(
        Phase(start=max(p.start, start), end=min(p.end, end), support=p.support)
        for p in gait.phases
        if p.start < end and p.end > start
    )
    return replace(gait, phases=phases)


def judged(robot, gait):
    report = scout_pin.gait_report(robot, gait, samples=61)
    return report, " ".join(report.verdict()), report.summary()["ends"]


def test_a_walk_from_rest_to_rest_is_judged_without_reserve(scout, walk):
    report, text, ends = judged(scout, walk)
    assert report.can_walk
    assert "can walk this gait:" in text
    assert (ends["kind"], ends["within_file_only"]) == ("rests", False)


def test_a_walk_cut_in_mid_swing_can_walk_within_its_file_only(scout, walk):
    """At t = 8 the right foot is 10 mm up and moves forward by 23 mm/s."""
    report, text, ends = judged(scout, cut(walk, 0.0, 8.0))
    assert report.can_walk
    assert "can walk this gait within its file:" in text
    speed = report.motion.right_foot.velocity[-1, 1]
    assert f"doesn't end at rest: at its end right foot y moves by {speed * 1e3:.3g} mm/s" in text
    assert (ends["kind"], ends["within_file_only"]) == ("in motion", True)
    assert ends["start"]["rests"]
    assert not ends["end"]["rests"]
    assert ends["end"]["fastest"]["rate"] == pytest.approx(speed, rel=1e-6)
    assert {"body": "right_foot", "coordinate": "z", "what": "position"}.items() <= next(
        gap for gap in ends["gaps"] if gap["coordinate"] == "z"
    ).items()


@pytest.mark.parametrize(("rate", "rests"), [(0.9e-3, True), (1.1e-3, False)])
def test_rest_is_what_a_tenth_of_a_millimetre_stops(scout, walk, rate, rests):
    torso = list(walk.curves["torso"])
    # At rest at the start; this rate at the end, 6 s later.
    torso[2] = polynomial(0, 30, [rate * 0.2 / 60, 0.0, 0.216])
    ends = judged(scout, replace(walk, curves=walk.curves | {"torso": tuple(torso)}))[2]
    assert ends["end"]["rests"] == rests
    assert ends["start"]["rests"]


def test_a_robot_that_is_still_but_would_fall_does_not_rest(scout, walk):
    """At t = 6 the right foot is up; leaning back inwards, it is still and would fall."""
    begun = cut(walk, 6.0, 30.0)
    torso = list(begun.curves["torso"])
    torso[0] = polynomial(0, 30, [0.01])
    feet = {side: begun.curves[side] for side in ("left_foot", "right_foot")}
    still = {name: tuple(polynomial(0, 30, [float(c(6.0))]) for c in f) for name, f in feet.items()}
    phases = (Phase(start=6.0, end=30.0, support="left"),)
    fallen = replace(begun, curves={"torso": tuple(torso)} | still, phases=phases)
    _, text, ends = judged(scout, fallen)
    assert not ends["start"]["rests"]
    assert ends["start"]["fastest"]["rate"] == pytest.approx(0.0, abs=1e-3)
    outside = -1e3 * ends["start"]["com_margin"]
    assert outside > 0
    assert f"the centre of mass is {outside:.1f} mm outside the soles" in text


def test_a_gait_that_could_go_on_is_told_how(scout, walk):
    looped = cut(repeat_gait(walk, 3), 22.0, 52.0)
    _, text, ends = judged(scout, looped)
    assert (ends["kind"], ends["closed"]) == ("in motion", True)
    assert "as a cycle it could go on (cycle = true, or --cycle)" in text
    report, text, ends = judged(scout, replace(looped, cycle=True))
    assert (ends["kind"], ends["within_file_only"]) == ("cycles", False)
    assert "can walk this gait:" in text
    assert "each time it moves on by 0.0 mm in x and 20.0 mm in y" in text
    assert report.can_walk


def test_a_cycle_that_does_not_close_cannot_walk_and_says_why(scout, walk):
    report, text, ends = judged(scout, replace(cut(walk, 0.0, 28.0), cycle=True))
    assert ends["kind"] == "open cycle"
    assert not report.can_walk
    assert "its end doesn't fit its start: torso" in text


def test_the_key_the_flag_and_repeat_reach_the_report(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    text = (EXAMPLES / "walk.toml").read_text()
    (tmp_path / "key.toml").write_text(text.replace("format = 1", "format = 1\ncycle = true", 1))
    (tmp_path / "plain.toml").write_text(text)

    def summary(*words):
        assert main(["gait", "--samples", "41", *words, "--json", "out.json"]) == 0
        document = json.loads((tmp_path / "out.json").read_text())
        return document["summary"], document["time"][-1], document["parameters"]["cycle"]

    for words in (("--gait", "key.toml"), ("--gait", "plain.toml", "--cycle")):
        found, seconds, cycle = summary(*words)
        assert cycle
        assert (found["ends"]["kind"], seconds) == ("cycles", pytest.approx(6.0))
    found, seconds, cycle = summary("--gait", "plain.toml", "--repeat", "2")
    assert seconds == pytest.approx(12.0)
    assert not cycle
    np.testing.assert_allclose(found["ends"]["displacement"], [0.0, 0.04], atol=1e-12)
    with pytest.raises(SystemExit):
        main(["gait", "--gait", "plain.toml", "--repeat", "0"])
