"""The verb ``size`` of both commands: answers, exit codes, files, refusals."""

import csv
import json

import pytest
from commands import ROOT, run

LIST = "name,torque_Nm,speed_rpm,mass_g,price\nweak,0.1,50,10,3\nstrong,9,60,90,40\n"
MOTIONS = {
    "scout-pin": ["--gait", str(ROOT / "examples" / "walk.toml"), "--samples", "41"],
    "pollard-pin": ["--path", str(ROOT / "examples" / "spray_arch.toml"), "--samples", "41"],
}


@pytest.fixture(params=MOTIONS)
def size(request, tmp_path, capfd):
    def call(*words, text=LIST):
        servos = tmp_path / "servos.csv"
        servos.write_text(text, encoding="utf-8")
        name = request.param
        return run(f"{name} size", ["size", str(servos), *MOTIONS[name], *words], capfd)

    call.command = request.param
    return call


def test_the_smallest_that_carries_it_is_named(size):
    code, out, err = size()
    assert (code, err) == (0, "")
    assert "strong is the smallest of 2 (by mass) that carries every joint for" in out
    assert "Not counted: masses" in " ".join(out.split())


def test_where_none_carries_it_strict_says_no(size):
    text = LIST.replace("strong,9", "strong,0.11")
    code, out, _ = size(text=text)
    assert code == 0
    assert "No servo of 2 carries every joint for long." in out
    assert size("--strict", text=text)[0] == 1
    assert size("--strict")[0] == 0
    assert size("--strict", "--factor", "1000")[0] == 1


def test_files_have_every_servo_at_every_joint(size, tmp_path):
    code, out, err = size("--json", "-", "--out", str(tmp_path / "out"))
    document = json.loads(out)
    assert code == 0
    assert document["schema"] == f"{size.command}/size"
    joints = len(document["joints"])
    assert [len(row) for row in document["fits"]["factor"]] == [joints] * 2
    assert document["servos"][1]["extra"] == {"price": "40"}
    text = (tmp_path / "out" / "sizes.csv").read_text(encoding="utf-8")
    rows = list(csv.DictReader(text.splitlines()))
    assert len(rows) == 2 * joints
    assert f"wrote {tmp_path / 'out'}: report.json, sizes.csv" in err


def test_a_bad_list_is_one_error_with_its_line(size):
    code, out, err = size(text=LIST.replace("60", "fast"))
    assert (code, out) == (2, "")
    assert "servos.csv:3: speed_rpm: 'fast' isn't a number" in err


def test_a_list_isn_t_replaced_by_an_answer(size, tmp_path):
    code, _, err = size("--json", str(tmp_path / "servos.csv"))
    assert code == 2
    assert "would replace" in err
    assert (tmp_path / "servos.csv").read_text(encoding="utf-8") == LIST


WITHOUT = {
    "scout-pin": MOTIONS["scout-pin"],
    "pollard-pin": [*MOTIONS["pollard-pin"], "--law", "given"],
}


@pytest.fixture(params=WITHOUT)
def least(request, capfd):
    def call(*words):
        name = request.param
        return run(f"{name} size", ["size", *WITHOUT[name], *words], capfd)

    call.command = request.param
    return call


def test_without_a_list_the_smallest_motors_are_said(least, tmp_path):
    code, out, err = least("--json", "-", "--out", str(tmp_path / "out"))
    document = json.loads(out)
    assert code == 0
    assert document["schema"] == f"{least.command}/smallest-motors"
    once = document["cases"][0]["once"]
    assert len(once) == len(document["joints"])
    assert f"wrote {tmp_path / 'out'}: report.json, sizes.csv" in err
    rows = list(csv.DictReader((tmp_path / "out" / "sizes.csv").read_text("utf-8").splitlines()))
    assert [float(row["once_Nm"]) for row in rows[: len(once)]] == once


def test_less_than_the_smallest_is_told_by_the_list_s_own_judgement(least, tmp_path, capfd):
    words = ["--bound", "line"] if least.command == "pollard-pin" else []
    document = json.loads(least("--json", "-", "--per", "robot", *words)[1])
    once, speed = document["cases"][0]["once"][0], document["motors"]["speed"][0]
    for share, carried in ((1.0001, True), (0.95, False)):
        servos = tmp_path / "one.csv"
        servos.write_text(f"name,torque_Nm,speed_rad_s\none,{once * share},{speed}\n")
        name = least.command
        words = ["size", str(servos), *MOTIONS[name], "--json", "-"]
        answer = json.loads(run(f"{name} size", words, capfd)[1])
        assert all(answer["fits"]["carries"][0]) == carried


def test_time_against_motor_is_drawn_and_written(tmp_path, capfd):
    words = ["size", *MOTIONS["pollard-pin"], "--law", "free", "--within", "2", "--curve"]
    out = tmp_path / "out"
    code, said, _ = run("pollard-pin size", [*words, "--out", str(out), "--formats", "svg"], capfd)
    assert code == 0
    assert "With the law of least torque, 2 s: base motors need" in " ".join(said.split())
    assert {one.name for one in out.iterdir()} - {"manifest.sha256"} == {
        *("report.json", "sizes.csv", "curve.csv", "curve.svg"),
        *("path-least-torque.toml", "path-least-heat.toml"),
    }
    once = json.loads((out / "report.json").read_text("utf-8"))["cases"][0]["once"]
    written = ["--path", str(out / "path-least-torque.toml"), "--samples", "2001", "--json", "-"]
    report = json.loads(run("pollard-pin trajectory", ["trajectory", *written], capfd)[1])
    peak = report["summary"]["peak_torque"]
    assert 0.97 <= max(peak[:3]) / once[0] <= 1.01
    assert report["time"][-1] == pytest.approx(2.0, abs=1e-4)
    rows = list(csv.DictReader((out / "curve.csv").read_text("utf-8").splitlines()))
    assert float(rows[0]["fastest_s"]) == pytest.approx(2.0, rel=0.02)


def test_the_smallest_of_a_list_in_time_is_named(tmp_path, capfd):
    servos = tmp_path / "servos.csv"
    servos.write_text(
        LIST.replace("strong,9,60,", "strong,9,600,90,40\nstronger,9,600,"), encoding="utf-8"
    )
    words = ["size", str(servos), *MOTIONS["pollard-pin"], "--law", "free"]
    code, out, _ = run("pollard-pin size", [*words, "--within", "3", "--strict"], capfd)
    assert code == 0
    assert "strong is the smallest of 3" in out
    code, out, _ = run("pollard-pin size", [*words, "--within", "0.01", "--strict"], capfd)
    assert code == 1
    assert "With no motor of 3 it can be done in 0.01 s." in " ".join(out.split())


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--voltage", "5"], "--voltage means nothing without a list"),
        (["--power", "5", "--no-load-speed", "3"], "--no-load-speed means nothing beside --power"),
        (["--armature", "x"], "--armature is 'x'"),
        (["--armature", "1,-2"], "neither below zero"),
        (["--rating", "50"], "--rating is '50'"),
        (["--law", "given", "--within", "3"], "where the time is given"),
    ],
)
def test_flags_that_mean_nothing_are_refused(least, words, said):
    code, out, err = least(*words)
    assert (code, out) == (2, "")
    assert said in err
