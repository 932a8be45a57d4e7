"""The verb place: what it writes can be used, what it says is what other verbs find."""

import csv
import json
import re
import shlex

import numpy as np
import pytest
from commands import ROOT, run

ARCH = str(ROOT / "examples" / "spray_arch.toml")
SMALL = ["--path", ARCH, "--x", "-0.05:0.05:0.05", "--z", "0:0.1:0.05", "--samples", "101"]


def place(capfd, *words):
    return run("pollard-pin place", ["place", *map(str, words)], capfd)


def told(capfd, *words):
    """A trajectory report as JSON."""
    code, out, err = run("pollard-pin trajectory", ["trajectory", *words, "--json", "-"], capfd)
    assert code == 0, err
    return json.loads(out)


def test_flags_and_file_of_the_best_give_the_report_that_was_told(capfd, tmp_path):
    out = tmp_path / "places"
    code, text, err = place(capfd, *SMALL, "--turn", "-10:10:10", "--out", out)
    assert code == 0, err
    assert {path.name for path in out.iterdir()} == {
        *("placements.csv", "placements.json", "path.toml", "manifest.sha256"),
        *("placements.png", "placements.svg"),
    }
    document = json.loads((out / "placements.json").read_text())
    best = document["best"][0]
    assert best["flags"] in " ".join(text.split())
    peak = max(best["peak_torque"])
    by_flags = told(capfd, "--path", ARCH, *shlex.split(best["flags"]))
    assert max(by_flags["summary"]["peak_torque"]) == pytest.approx(peak, rel=1e-9)
    by_file = told(capfd, "--path", str(out / "path.toml"))
    assert max(by_file["summary"]["peak_torque"]) == pytest.approx(peak, rel=2e-3)
    np.testing.assert_allclose(by_file["pose"], by_flags["pose"], atol=1e-6)
    with open(out / "placements.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == document["summary"]["placements"] == 27
    shares = [float(row["torque_share"]) for row in rows if row["outcome"] == "can be followed"]
    np.testing.assert_array_equal(shares, document["torque_share"])
    now = told(capfd, "--path", ARCH)
    assert max(now["summary"]["peak_torque"]) == pytest.approx(
        max(document["start"]["peak_torque"])
    )


def test_appendix_b_is_placed_from_the_print_and_its_law_is_written(capfd, tmp_path):
    words = ["--for", "time", "--z", "0,0.1", "--samples", "101", "--torque", 2, "--speed", 5]
    code, out, err = place(capfd, *words, "--json", "-", "--out", tmp_path, "--grid-only")
    assert code == 0, err
    document = json.loads(out)
    assert document["start"]["position"] == [0.45, 0.0, 0.0]
    best = document["best"][0]
    assert best["fastest_by_law"] < best["fastest"]
    assert best["fastest_by_law"] < document["start"]["fastest_by_law"]
    report = told(capfd, "--path", str(tmp_path / "path.toml"))
    assert report["parameters"]["duration"] == pytest.approx(best["fastest_by_law"])
    assert max(report["summary"]["peak_torque"]) == pytest.approx(2.0, rel=1e-2)
    assert document["report"]["motor_limits"]["within"]


@pytest.mark.parametrize(
    ("words", "shape"),
    [
        ([], (7, 5, 7, 1, 1, 1)),
        (["--z", "-0.1:0.1:0.1"], (1, 1, 3, 1, 1, 1)),
        (["--x", "0.4:0.5", "--points", "4"], (4, 1, 1, 1, 1, 1)),
        (["--y", "-0.05,0,0.1", "--turn", "5"], (1, 3, 1, 1, 1, 1)),
        (["--z", "0.1", "--mirror", "both", "--any-branch"], (1, 1, 1, 1, 2, 16)),
        (["--z", "0.1", "--mirror"], (1, 1, 1, 1, 1, 1)),
    ],
)
def test_ranges_are_those_that_were_asked_for(words, shape, capfd):
    code, out, err = place(capfd, *words, "--samples", "11", "--grid-only", "--json", "-")
    assert code == 0, err
    axes = json.loads(out)["axes"]
    assert (
        tuple(len(axes[name]) for name in ("x", "y", "z", "turn", "mirrored", "branches")) == shape
    )
    if not words:
        assert axes["x"] == [0.3, 0.35, 0.4, 0.45, 0.5, 0.55, 0.6]
    if "-0.1:0.1:0.1" in words:
        assert (axes["x"], axes["y"], axes["z"]) == ([0.45], [0.0], [-0.1, 0.0, 0.1])


def test_no_placement_at_all_is_answered_by_no_with_reasons(capfd, tmp_path):
    page = tmp_path / "no.html"
    code, out, _ = place(
        capfd, "--path", ARCH, "--x", "1:1.2:0.1", "--samples", "11", "--html", page
    )
    assert code == 1
    said = " ".join(out.split())
    assert "can't be followed from any placement that was tried" in said
    assert "out of reach: 3" in said
    assert page.read_bytes().startswith(b"<!doctype html>")
    code, out, _ = place(capfd, "--path", ARCH, "--x", "1", "--samples", "11", "--json", "-")
    assert code == 1
    assert json.loads(out)["best"] == []


def test_tables_fit_a_terminal_with_every_column_there_can_be(capfd, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    words = [*SMALL, "--turn", "-100:100:100", "--mirror", "both", "--any-branch", "--grid-only"]
    code, out, err = place(capfd, *words, "--for", "time")
    assert code == 0, err
    assert max(map(len, out.splitlines())) <= 80
    assert re.search(r"^ ?10 ", out, flags=re.MULTILINE), out


def test_a_page_has_robot_map_and_table(capfd, tmp_path):
    page = tmp_path / "places.html"
    code, _, err = place(capfd, *SMALL, "--grid-only", "--html", page)
    assert code == 0, err
    text = page.read_text(encoding="utf-8")
    assert "where arch should stand" in text
    assert "data:image/svg+xml;base64," in text
    assert "The motion" in text
