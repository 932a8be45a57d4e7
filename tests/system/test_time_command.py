"""The verb ``time``: answers, exit codes, files, refusals, and what it writes read back."""

import json

import numpy as np
import pytest
from commands import ROOT, run

ARCH = ["--path", str(ROOT / "examples" / "spray_arch.toml")]
LIMITS = ["--torque", "2", "2", "2", "0.05", "0.05", "0.05", "--speed", "10"]


@pytest.fixture
def timed(capfd):
    def call(*words):
        return run("pollard-pin time", ["time", *map(str, words)], capfd)

    return call


def test_it_says_how_long_what_binds_and_how_it_was_judged(timed):
    code, out, err = timed(*ARCH, *LIMITS)
    said = " ".join(out.split())
    assert (code, err) == (0, "")
    assert "0.5577 s from rest to rest is the fastest within these limits" in said
    assert "At 20 points between any two of 803 places it uses at most 99.9" in said
    assert "What binds, by shares of the time: torque of chain" in said
    assert "the path has 1 corner, where the tool stops" in said
    assert max(map(len, out.splitlines())) <= 80


def test_limits_of_the_specification_are_said_to_be_assumptions(timed):
    _, out, _ = timed(*ARCH)
    assert "are the specification's, which are assumptions" in " ".join(out.split())


def test_the_path_that_it_writes_is_reported_on_with_the_same_duration(timed, tmp_path, capfd):
    file, answer = tmp_path / "fast.toml", tmp_path / "report.json"
    assert timed(*ARCH, *LIMITS, "--to", file, "--json", tmp_path / "time.json")[0] == 0
    words = ["trajectory", "--path", str(file), "--samples", "8001", "--json", str(answer)]
    assert run("pollard-pin trajectory", words, capfd)[0] == 0
    time, report = (json.loads(one.read_bytes()) for one in (tmp_path / "time.json", answer))
    assert report["time"][-1] == pytest.approx(time["duration"], rel=1e-9)
    torque = np.abs(report["torque"]).max(axis=0) / time["limits"]["torque"]
    assert 0.99 < torque.max() <= 1.0
    assert time["within_limits"] is True
    assert max(one["share"] for one in time["use"]) <= 1.0
    assert sum(time["binding"].values()) == pytest.approx(1.0)
    assert time["stretches"][0]["start"] == 0.0
    assert time["stretches"][-1]["end"] == pytest.approx(time["duration"])


def test_a_folder_gets_report_samples_figures_and_the_path(timed, tmp_path):
    out = tmp_path / "made"
    code, _, _ = timed(*ARCH, *LIMITS, "--out", out, "--samples", "201")
    assert code == 0
    names = {path.name for path in out.iterdir()}
    assert {"report.json", "samples.csv", "profile.svg", "actuators.png", "path.toml"} <= names
    head, *rows = (out / "samples.csv").read_text().splitlines()
    use = [float(row.rsplit(",", 1)[1]) for row in rows]
    assert head.endswith(",largest_use")
    assert 0.99 < max(use) <= 1.0


def test_a_page_has_the_answer_and_the_profile(timed, tmp_path):
    page = tmp_path / "page.html"
    assert timed(*ARCH, *LIMITS, "--samples", "201", "--html", page)[0] == 0
    text = page.read_text(encoding="utf-8")
    for words in ("is the fastest within these limits", "Use of torque limits", "What binds when"):
        assert words in text


def test_motors_that_hold_nothing_are_answered_with_no(timed, tmp_path):
    answer = tmp_path / "no.json"
    code, out, _ = timed(*ARCH, "--torque", "0.3", "--json", answer)
    assert code == 1
    assert "holding the robot still takes" in " ".join(out.split())
    assert "spray tip at (" in out
    document = json.loads(answer.read_bytes())
    assert (document["possible"], document["duration"]) == (False, None)


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--law", "constant-speed", "--path", "{line}"], "largest constant tool speed"),
        (["--law", "window", "--speed-window", "5%"], "kept within 5% of itself on 90%"),
        (["--law", "least-load", "--duration", "1.5"], "in 1.5 s from rest to rest no motor needs"),
    ],
)
def test_other_laws_say_what_they_are(timed, words, told, tmp_path):
    file = tmp_path / "line.toml"
    file.write_text(
        "format = 1\n[start]\nposition = [0.45, -0.1, 0.0]\n[[segments]]\nkind = 'line'\n"
        "position = [0.45, 0.1, 0.05]\nduration = 1.0\n"
    )
    words = [word.format(line=file) for word in words]
    code, out, _ = timed(*ARCH, *LIMITS, *words)
    assert code == 0
    assert told in " ".join(out.split())


def test_a_servo_of_a_list_limits_by_its_line(timed):
    code, out, _ = timed(*ARCH, "--motors", ROOT / "examples" / "servos.csv", "--motor", "large")
    assert code == 0
    assert "torque–speed line of chain" in " ".join(out.split())


def test_a_table_without_times_or_speeds_is_enough(timed, tmp_path):
    table = tmp_path / "points.csv"
    y = np.linspace(-100, 100, 41)
    rows = np.stack([450 + 0 * y, y, 40 * np.cos(y / 80), 0 * y, 0 * y, 0 * y], axis=1)
    head = "x_mm,y_mm,z_mm,psi_deg,theta_deg,phi_deg"
    np.savetxt(table, rows, delimiter=",", header=head, comments="", fmt="%.9g")
    code, out, _ = timed("--path", table, *LIMITS)
    assert code == 0
    assert "tool speed of" not in out


def test_points_that_are_there_twice_count_once_and_it_is_said(timed, tmp_path):
    """As exports have them where two moves meet; what turns on the spot is refused all the same."""
    y = np.linspace(-100, 100, 41)
    rows = np.stack([450 + 0 * y, y, 40 * np.cos(y / 80), 0 * y, 0 * y, 0 * y], axis=1)
    head, times = "x_mm,y_mm,z_mm,psi_deg,theta_deg,phi_deg", []
    twice = np.insert(rows, 20, rows[20], axis=0)
    turned = twice.copy()
    turned[20, 4] = 5.0
    for name, table in (
        ("once", rows),
        ("twice", twice),
        ("turned", turned),
        ("still", rows[[0, 0]]),
    ):
        file = tmp_path / f"{name}.csv"
        np.savetxt(file, table, delimiter=",", header=head, comments="", fmt="%.9g")
        code, out, err = timed("--path", file, *LIMITS, "--json", tmp_path / f"{name}.json")
        if name in ("turned", "still"):
            assert code == 2
            assert f"{name}.csv:{23 if name == 'turned' else 3}" in err
            continue
        assert code == 0
        times.append(json.loads((tmp_path / f"{name}.json").read_bytes())["duration"])
        assert ("1 row repeats the row before" in " ".join(out.split())) == (name == "twice")
    assert times[0] == times[1]


def test_a_table_of_poses_comes_with_a_warning(timed, tmp_path):
    code, _, err = timed(*ARCH, *LIMITS, "--to", tmp_path / "fast.csv")
    assert code == 0
    assert "overshoots" in err
    assert (tmp_path / "fast.csv").read_text().startswith("t")
