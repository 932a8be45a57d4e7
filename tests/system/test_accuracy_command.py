"""The verb ``accuracy``: answers, exit codes, files, refusals, a page."""

import csv
import json
import re

import pytest
from commands import ROOT, run

PATH = ["--path", str(ROOT / "examples" / "spray_arch.toml"), "--samples", "31"]
LENGTHS = "parameter;tolerance [mm]\nlengths;0,1\n"


@pytest.fixture
def accuracy(tmp_path, capfd):
    def call(*words, text=LENGTHS):
        file = tmp_path / "tolerances.csv"
        file.write_text(text, encoding="utf-8")
        words = ["accuracy", "--tolerances", str(file), *map(str, words)]
        return run("pollard-pin accuracy", words, capfd)

    return call


def test_it_says_how_far_what_matters_most_and_how_it_was_read(accuracy):
    code, out, err = accuracy(*PATH, "--draws", 20)
    said = " ".join(out.split())
    assert (code, err) == (0, "")
    assert re.search(r"At worst the spray tip is 1\.\d+ mm off \(t = ", said)
    assert "What moves it most: chain_" in said
    assert "Of 20 drawn robots" in said
    assert "17 of 56 numbers of the robot have a tolerance" in said
    assert "semicolons between cells, with decimal commas" in said
    assert max(map(len, out.splitlines())) <= 80


def test_strict_says_no_by_the_exit_code_and_needs_a_limit(accuracy):
    assert accuracy(*PATH, "--within", "1mm")[0] == 0
    code, out, _ = accuracy(*PATH, "--within", "1mm", "--strict")
    assert code == 1
    assert "FAIL: the spray tip may be more than 1 mm off its place" in out
    assert "Equal tolerances that keep the tip within 1 mm" in out
    code, out, _ = accuracy(*PATH, "--within", "0.002 m", "--strict")
    assert code == 0
    assert "PASS: the spray tip stays within 2 mm of its place at worst." in out
    code, _, err = accuracy(*PATH, "--strict")
    assert code == 2
    assert "Add --within 1mm" in err


@pytest.mark.parametrize("limit", ["1", "mm", "-1mm", "0mm", "1inch", "nanmm", "1e999mm", "1 kmm"])
def test_a_limit_without_a_unit_is_refused(accuracy, limit):
    code, out, err = accuracy(*PATH, f"--within={limit}")
    assert (code, out) == (2, "")
    assert "a positive length with its unit" in err


def test_files_have_every_sample_and_every_tolerance(accuracy, tmp_path):
    out = tmp_path / "out"
    words = ["--out", out, "--json", "-", "--stiffness", 500, "--within", "1mm", "--draws", 5]
    code, said, _ = accuracy(*PATH, *words)
    document = json.loads(said)
    assert code == 0
    assert document["schema"] == "pollard-pin/accuracy"
    assert document["summary"]["keeping"]["equal"][0]["of"] == "lengths"
    assert {path.name for path in out.iterdir()} == {
        *("report.json", "samples.csv", "sensitivities.csv", "manifest.sha256"),
        *("errors.png", "errors.svg", "contributions.png", "contributions.svg"),
    }
    assert json.loads((out / "report.json").read_text()) == document
    samples = list(csv.DictReader((out / "samples.csv").read_text().splitlines()))
    assert [float(row["worst_m"]) for row in samples] == document["worst"]
    rows = list(csv.DictReader((out / "sensitivities.csv").read_text().splitlines()))
    assert len(rows) == len(document["tolerances"]) == 17
    assert sum(float(row["share_of_variance"]) for row in rows) == pytest.approx(1.0)
    assert float(rows[0]["mm"]) == pytest.approx(document["tolerances"][0]["distance"] * 1e3)


def test_a_workspace_has_a_map_and_its_doubts(accuracy, tmp_path):
    out, page = tmp_path / "out", tmp_path / "page.html"
    words = ["--workspace", "--points", 13, "--draws", 5, "--within", "2mm"]
    code, said, err = accuracy(*words, "--json", "-", "--out", out, "--html", page)
    document = json.loads(said)
    assert code == 0
    assert document["parameters"]["grid"]["x"] == {"from": 0.1, "to": 0.8, "points": 13}
    assert document["summary"]["drawn"]["robots"] == 5
    assert 0 < document["summary"]["share_within"] < 1
    assert None in document["exact"] or document["summary"]["nonlinear"]["samples"]
    assert (out / "map.png").exists()
    assert "warning: at " in err
    assert "data:image/png" in page.read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("words", "count"),
    [
        (["--x", 0.4, 0.6, "--y", 0.1, "--z", 0.1], 5),
        (["--x", 0.4, "--y", -0.1, 0.1, "--z", 0.0, 0.1], 25),
        (["--x", 0.4, 0.6, "--y", -0.1, 0.1, "--z", 0.0, 0.1], 125),
        (["--x", 0.4, "--z", 0.1], 1),
    ],
)
def test_points_lines_slices_and_volumes_are_studied(accuracy, tmp_path, words, count):
    out, page = tmp_path / "out", tmp_path / "page.html"
    words = ["--workspace", "--points", 5, *words, "--json", "-", "--out", out, "--html", page]
    code, said, _ = accuracy(*words)
    assert code == 0
    assert len(json.loads(said)["pose"]) == count
    assert (out / "map.svg").exists() == (count > 1)
    if count > 1:  # something is drawn: Matplotlib's meshes are images, curves are paths
        assert len((out / "map.png").read_bytes()) > 8000


def test_the_same_seed_gives_the_same_bytes(accuracy):
    words = [*PATH, "--draws", 7, "--seed", 3, "--json", "-"]
    assert accuracy(*words)[1] == accuracy(*words)[1]
    assert accuracy(*words)[1] != accuracy(*PATH, "--draws", 7, "--seed", 4, "--json", "-")[1]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("parameter,tolerance_mm\nx_78,0.1\n", "unknown parameter 'x_78'"),
        ("parameter,tolerance_mm\nmotors,0.1\n", "allowed: deg"),
        ("parameter,tolerance\nx_87,0.1\n", "says no unit"),
        ("0.1,0.2\n", "without a header"),
        ("", "empty"),
    ],
)
def test_a_bad_list_is_one_message(accuracy, text, said):
    code, out, err = accuracy(*PATH, text=text)
    assert (code, out) == (2, "")
    assert err.startswith("pollard-pin: error: ")
    assert "tolerances.csv" in err
    assert said in err


def test_metres_in_a_column_of_millimetres_are_asked_about(accuracy):
    code, _, err = accuracy(*PATH, text="parameter,tolerance_mm\nlengths,0.0001\n")
    assert code == 0
    assert "the widest tolerance of a length is 0.1 µm" in err
    code, _, err = accuracy(*PATH, text="parameter,tolerance,unit\nlengths,0.1,m\n")
    assert code == 2
    assert "tolerances.csv:2: a tolerance is 100.0; allowed: a finite number" in err


def test_a_list_isn_t_replaced_by_an_answer(accuracy, tmp_path):
    code, _, err = accuracy(*PATH, "--json", tmp_path / "tolerances.csv")
    assert code == 2
    assert "would replace" in err


def test_out_of_reach_and_across_a_singularity_are_answered_with_the_place(accuracy):
    code, _, err = accuracy("--placement", 2, 0, 0)
    assert code == 2
    assert "too far from the shoulder" in err
    code, _, err = accuracy("--workspace", "--x", 3)
    assert code == 2
    assert "no position of the grid can be reached" in err


@pytest.mark.browser
def test_the_page_plays_the_robot_among_its_ellipsoids(accuracy, tmp_path, browser):
    page = tmp_path / "page.html"
    code, _, _ = accuracy(*PATH, "--html", page, "--within", "1mm")
    assert code == 0
    for width, height, mobile in ((1280, 900, False), (390, 844, True)):
        browser.open(page.as_uri(), width, height, mobile)
        browser.until("window.ready && player.framesDrawn > 0")
        assert browser.complaints() == []
        assert browser.requests() == [page.as_uri()]
        assert browser.run("document.documentElement.scrollWidth") <= width
    names = browser.run("player.items.map((item) => item.name).join()").split(",")
    assert sum(name.startswith("error ") for name in names) == 25
    assert browser.run("document.querySelectorAll('.drawing svg').length") == 1
