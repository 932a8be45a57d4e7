"""The benchmark compares answers before it times anything, and its page is what it measured."""

import json
import os
import runpy
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
USUAL = ("scout", "pollard", "loading", "commands", "streams", "threads")
SLOW = ("planning", "simulation", "fastest")
SUITES = (*USUAL, *SLOW)
STORED = json.loads((ROOT / "docs" / "speed.json").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def bytecode(tmp_path_factory):
    """What the processes of one run have compiled serves those of the others."""
    folder = str(tmp_path_factory.mktemp("bytecode"))
    return f"import os\nos.environ['PYTHONPYCACHEPREFIX'] = {folder!r}"


def run(*words, before=""):
    """The benchmark in a process of its own, after some Python."""
    script = str(ROOT / "benchmarks" / "run.py")
    code = f"""
import runpy, sys
{before}
sys.argv = {[script, *words]!r}
sys.path.insert(0, {str(Path(script).parent)!r})
runpy.run_path({script!r}, run_name="__main__")
"""
    return subprocess.run(
        [sys.executable, "-c", code],
        env=os.environ | {"PYTHONPATH": str(ROOT), "COLUMNS": "200"},
        capture_output=True,
        text=True,
        check=False,
    )


def measured(suite, path, **more):
    done = run(suite, "--quick", "--json", str(path), **more)
    assert done.returncode == 0, done.stderr
    return done, json.loads(path.read_text(encoding="utf-8"))


@pytest.mark.parametrize("suite", [*USUAL, "simulation", "fastest"])
def test_a_smoke_run_finds_equal_answers_and_judges_every_goal(suite, tmp_path, bytecode):
    if suite == "threads" and len(getattr(os, "sched_getaffinity", lambda _: [])(0)) < 2:
        pytest.skip("one core")
    done, found = measured(suite, tmp_path / "run.json", before=bytecode)
    assert found["quick"]
    assert {"processor", "cores", "simd"} <= set(found["machine"])
    assert found["versions"]["numpy"]
    assert found["rows"]
    for row in found["rows"]:
        assert row["suite"] == suite
        assert f" {row['work']} " in done.stdout
        assert row["ours"]["cpu"]["median"] >= 0
        assert row["ours"]["wall"]["low"] > 0
        if row["equal"]:
            assert row["equal"]["difference"] <= row["equal"]["tolerance"]
        if not row["peer"].get("missing"):
            assert row["ratio"]["low"] <= row["ratio"]["median"] <= row["ratio"]["high"]
            assert all(goal["met"] is not None for goal in row["goals"])
    assert suite in ("simulation",) or any(row["goals"] for row in found["rows"])
    assert suite in ("threads",) or any(row["equal"] for row in found["rows"])


def test_a_peer_that_is_missing_is_said_and_the_rest_is_measured(tmp_path):
    done, found = measured("scout", tmp_path / "run.json", before="sys.modules['eaik'] = None")
    assert "eaik isn't installed" in done.stderr
    assert found["missing"] == ["eaik"]
    rows = [row for row in found["rows"] if row["peer"].get("missing")]
    assert rows
    for row in rows:
        assert row["peer"]["name"].startswith("EAIK")
        assert (row["ratio"], row["equal"]) == (None, None)
        assert row["ours"]["cpu"]["median"] > 0
    assert "not installed" in done.stdout
    assert len(found["rows"]) > len(rows)


def test_without_the_second_engine_its_suite_is_left_out(tmp_path):
    done, found = measured("simulation", tmp_path / "a.json", before="sys.modules['mujoco'] = None")
    assert "simulation: mujoco isn't installed" in done.stderr
    assert found["rows"] == []


def test_a_plan_that_is_not_as_known_stops_the_run(tmp_path):
    refused = """
import types, scout_pin
scout_pin.plan_gait = lambda *given, **more: types.SimpleNamespace(met=False)
"""
    done = run("planning", "--quick", before=refused)
    assert done.returncode == 1
    assert "run.py: error: 30 mm in 0.8 s, the default: met is False" in done.stderr
    assert "Traceback" not in done.stderr


def test_a_wrong_answer_stops_the_run(tmp_path):
    wrong = """
import scout_pin.kinematics.rates as rates
right = rates.leg_rates
rates.leg_rates = lambda *given: (right(*given)[0] + 1e-6, right(*given)[1])
"""
    done = run("scout", "--quick", "--json", str(tmp_path / "run.json"), before=wrong)
    assert done.returncode == 1
    assert "leg's rates and accelerations, 60: ours and Pinocchio's Jacobian" in done.stderr
    assert "differ by" in done.stderr
    assert "Traceback" not in done.stderr
    assert not (tmp_path / "run.json").exists()


def test_misuse_is_said():
    for words, said in (
        (["nonsense"], "no suite 'nonsense'"),
        (["--json", "no/no"], "no folder"),
        (["scout", "--all"], "--all and 'scout'"),
    ):
        done = run(*words)
        assert done.returncode == 2
        assert said in done.stderr
        assert "Traceback" not in done.stderr


# -- how it measures --------------------------------------------------------------------


@pytest.fixture(scope="module")
def measuring():
    return runpy.run_path(str(ROOT / "benchmarks" / "measuring.py"))


def row(measuring, ours, theirs, *, difference=0.0, goals=(), clock="cpu"):
    """Four items of ours against two of a peer; what they take is given."""
    times = [iter(ours), iter(theirs or ())]
    peer = measuring["Peer"]("peer", 2, None if theirs is None else lambda: next(times[1]))
    equal = measuring["Equal"]("answers [m]", lambda: difference, 1e-9)
    goals = tuple(measuring["Goal"](*one) for one in goals)
    return measuring["Row"]("work", 4, lambda: next(times[0]), peer, equal, goals, clock)


def turns(measuring, *pairs):
    return [measuring["Spent"](*pair) for pair in pairs]


def test_answers_that_differ_are_not_timed(measuring):
    with pytest.raises(measuring["Unequal"], match=r"work, 4: ours and peer differ by 1e-08"):
        row(measuring, [], [], difference=1e-8).measure(measuring["QUICK"])
    with pytest.raises(measuring["Unequal"], match="nan"):
        row(measuring, [], [], difference=float("nan")).measure(measuring["QUICK"])


@pytest.mark.parametrize(("clock", "ratio"), [("cpu", 0.5), ("wall", 0.25)])
def test_ratios_are_medians_over_turns_of_times_an_item(measuring, clock, ratio):
    ours = turns(measuring, (4, 40, 100), (2, 20, 300), (40, 400, 200))
    theirs = turns(measuring, (4, 80), (1, 20), (10, 400))
    goals = [(0.3,), (1e6, "µs"), (3.9, "s"), (0.0, "s more"), (299.0, "MB")]
    scale = measuring["Scale"](rounds=3, turn=0.0)
    found = row(measuring, ours, theirs, goals=goals, clock=clock).measure(scale)
    # An item of ours takes 1, 1/2, 10 s of processor time; one of the peer's 2, 1/2, 5 s.
    assert found["ratio"]["median"] == {"cpu": 1.0, "wall": 0.5}[clock]
    assert found["ours"]["cpu"]["median"] == 1.0
    assert found["peer"]["wall"]["median"] == 40.0
    scale = {"cpu": 1, "wall": 10}[clock]
    told = [(goal["found"], goal["met"]) for goal in found["goals"]]
    assert told == [
        ({"cpu": 1.0, "wall": 0.5}[clock], False),
        (1e6 * scale, scale == 1),
        (4.0 * scale, False),
        ({"cpu": 1.0, "wall": 0.0}[clock], clock == "wall"),
        (300.0, False),
    ]


def test_without_a_peer_only_absolute_goals_are_judged(measuring):
    goals = [(0.3,), (1.0, "ms"), (2.0, "s")]
    found = row(measuring, turns(measuring, (1, 1)), None, goals=goals).measure(measuring["QUICK"])
    assert [goal["met"] for goal in found["goals"]] == [None, False, True]
    assert found["peer"] == {"name": "peer", "size": 2, "missing": True}


def test_time_by_the_clock_is_judged_beside_the_processor_s(measuring):
    goals = [(3.0, "s"), (3.0, "s by the clock")]
    for clock in ("cpu", "wall"):
        made = row(measuring, turns(measuring, (2, 5)), None, goals=goals, clock=clock)
        found = made.measure(measuring["QUICK"])["goals"]
        assert [goal["found"] for goal in found] == [2.0 if clock == "cpu" else 5.0, 5.0]
        assert [goal["met"] for goal in found] == [clock == "cpu", False]


def test_work_that_was_done_before_is_not_tried_again(measuring):
    calls = []
    peer = measuring["Peer"]("peer", 1, lambda: calls.append("theirs"))
    work = measuring["Row"]("work", 1, lambda: calls.append("ours"), peer, rounds=3, warm=False)
    found = work.measure(measuring["FULL"])
    assert calls == ["ours", "theirs", "theirs", "ours", "ours", "theirs"]
    assert found["rounds"] == 3


def test_short_work_is_repeated_until_a_turn_is_long_enough(measuring):
    calls = []
    peer = measuring["Peer"]("peer", 1, None)
    work = measuring["Row"]("work", 1, lambda: calls.append(1), peer)
    work.measure(measuring["Scale"](rounds=2, turn=1e-3))
    assert len(calls) > 100


# -- the page -----------------------------------------------------------------------------


def test_the_page_is_written_from_the_stored_run():
    page = runpy.run_path(str(ROOT / "docs" / "speed.py"))["page"]
    text = (ROOT / "docs" / "speed.md").read_text(encoding="utf-8")
    assert page(STORED) == text, "run: python docs/speed.py"


def test_the_stored_run_is_a_whole_one_with_equal_answers():
    assert not STORED["quick"]
    assert set(USUAL) <= {row["suite"] for row in STORED["rows"]} <= set(SUITES)
    for row in STORED["rows"]:
        assert row["rounds"] >= (1 if row["suite"] in SLOW else 7)
        if row["equal"]:
            assert row["equal"]["difference"] <= row["equal"]["tolerance"]


def test_the_page_says_what_was_left_out_and_how_often_a_plan_was_made():
    page = runpy.run_path(str(ROOT / "docs" / "speed.py"))["page"]
    usual = [row for row in STORED["rows"] if row["suite"] in USUAL]
    one = usual[0]
    goals = [{"of": "s by the clock", "most": 2.0, "found": 2.5, "met": False}]
    plans = [one | {"suite": "planning", "rounds": rounds, "goals": goals} for rounds in (3, 1)]
    text = page(STORED | {"rows": usual + plans})
    assert "Not run: `simulation`, `fastest`." in text
    assert "## Planning a walk" in text
    assert "A plan takes 1 or 3 turns." in text
    assert "| ≤ 2 s by the clock | **no, 2.5 s by the clock** |" in text
    assert "ratios medians of 7 turns or more" in text
    assert "## The second engine" not in text


@pytest.mark.parametrize("change", [{"quick": True}, {"rows": STORED["rows"][:3]}])
def test_no_page_is_written_of_half_a_run(change):
    page = runpy.run_path(str(ROOT / "docs" / "speed.py"))["page"]
    with pytest.raises(SystemExit, match="not a whole run"):
        page(STORED | change)
