"""The command thesis-pin: any robot with loops."""

import json
from pathlib import Path

import pytest
from commands import run

DATA = Path(__file__).parents[1] / "thesis_pin" / "loops" / "data"
BAR, LOOPS = DATA / "five_bar.urdf", DATA / "five_bar.yaml"
CLOSURES = "closed_loop: [[left_tip, right_tip]]\ntype: ['3d']\nname_mot: [motor_left]\n"


def check(capfd, *words):
    return run("thesis-pin check", ["check", *map(str, words)], capfd)


def test_a_sound_robot_is_described_on_80_columns(capfd, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    code, out, err = check(capfd, BAR, LOOPS)
    assert (code, err) == (0, "")
    assert "2 by rank" in " ".join(out.split())
    assert "The motors hold all of them" in " ".join(out.split())
    assert max(map(len, out.splitlines())) <= 80


def test_a_robot_that_cannot_close_is_answered_by_no_and_the_reason(capfd, tmp_path):
    text = (DATA / "four_bar.urdf").read_text()
    far = tmp_path / "far.urdf"
    far.write_text(text.replace('<origin xyz="0.3 0 0"/>', '<origin xyz="3 0 0"/>'))
    code, out, err = check(capfd, far, DATA / "four_bar.yaml")
    assert (code, err) == (1, "")
    assert "No closed configuration was found" in " ".join(out.split())
    code, out, err = check(capfd, far, DATA / "four_bar.yaml", "--json", "-")
    assert (code, err) == (1, "")
    document = json.loads(out)
    assert not document["sound"]
    assert "No closed configuration was found" in document["explanation"]


@pytest.mark.parametrize(
    ("bar", "loops", "says"),
    [
        (BAR, CLOSURES.replace("right_tip", "wrong_tip"), "unknown frame 'wrong_tip'"),
        (BAR, CLOSURES.replace("['3d']", "['3d', '6d']"), "2 entries for 1 loops"),
        ("two parents", CLOSURES, "has two parents"),
    ],
)
def test_a_description_that_contradicts_itself_is_refused(bar, loops, says, tmp_path, capfd):
    if bar == "two parents":
        text = BAR.read_text().replace('<child link="right_tip"/>', '<child link="left_tip"/>')
        bar = tmp_path / "bar.urdf"
        bar.write_text(text.replace('  <link name="right_tip"/>\n', ""))
    (tmp_path / "loops.yaml").write_text(loops)
    answer = tmp_path / "answer.json"
    code, out, err = check(capfd, bar, tmp_path / "loops.yaml", "--json", answer)
    assert (code, out) == (2, "")
    assert says in " ".join(err.split())
    assert err.startswith("thesis-pin: error: ")
    assert not answer.exists()
