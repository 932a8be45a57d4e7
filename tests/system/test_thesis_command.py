"""The command thesis-pin: any robot with loops."""

import json
from pathlib import Path

import numpy as np
import pytest
from commands import ROOT, run

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


def test_a_freedom_that_nobody_can_tell_is_answered_by_no_and_hides_nothing(capfd, tmp_path):
    text = (DATA / "four_bar.urdf").read_text()
    leaning = tmp_path / "leaning.urdf"
    leaning.write_text(text.replace('<axis xyz="0 1 0"/>', '<axis xyz="7e-4 1 0"/>', 1))
    code, out, err = check(capfd, leaning, DATA / "four_bar.yaml")
    said = " ".join(out.split())
    assert (code, err) == (1, "")
    assert "four_bar: 4 joints, 1 motor (motor)" in said
    assert "gap m" in said
    assert "nearly dependent" in said
    assert "degrees of freedom: 0 with 0, 1 with 0.0008" in said
    code, out, err = check(capfd, leaning, DATA / "four_bar.yaml", "--json", "-")
    assert (code, err) == (1, "")
    assert [one["freedom"] for one in json.loads(out)["undecided"]["choices"]] == [0, 1]
    assert check(capfd, leaning, DATA / "four_bar.yaml", "--precision", "8e-4")[0] == 0


@pytest.mark.parametrize(
    ("bar", "loops", "says"),
    [
        (BAR, CLOSURES.replace("right_tip", "wrong_tip"), "unknown frame 'wrong_tip'"),
        (BAR, CLOSURES.replace("['3d']", "['3d', '6d']"), "2 entries for 1 loops"),
        ("two parents", CLOSURES, "unknown frame 'right_tip'"),
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


def test_a_robot_that_cannot_close_shows_its_least_gap_and_between_which_frames(capfd, tmp_path):
    # Crank, coupler and rocker of 0.1, 0.3 and 0.25 m leave 2.35 m of 3 m open.
    text = (
        (DATA / "four_bar.urdf").read_text().replace('"-3.0"', '"-3.2"').replace('"3.0"', '"3.2"')
    )
    far = tmp_path / "far.urdf"
    far.write_text(text.replace('<origin xyz="0.3 0 0"/>', '<origin xyz="3 0 0"/>'))
    point = tmp_path / "point.yaml"
    point.write_text((DATA / "four_bar.yaml").read_text().replace("6d", "3d"))
    code, out, _ = check(capfd, far, point)
    assert code == 1
    assert "2.35e+03 mm between weld_a and weld_b" in " ".join(out.split())


def test_motors_that_do_not_hold_the_robot_are_a_no_only_when_asked_strictly(capfd):
    pair = (DATA / "rssr.urdf", DATA / "rssr.yaml")
    for flags, wanted in (((), 0), (("--strict",), 1)):
        code, out, _ = check(capfd, *pair, *flags)
        assert code == wanted
        assert "can move by itself" in " ".join(out.split())


def test_the_pose_asked_for_is_where_the_robot_is_judged(capfd, tmp_path):
    signs = []
    for sign in (1, -1):
        pose = tmp_path / "pose.toml"
        pose.write_text(f"format = 1\n[joints]\nmotor = 1.0\npin_a = {sign}\npivot = {sign}\n")
        code, out, err = check(
            capfd, DATA / "four_bar.urdf", DATA / "four_bar.yaml", "--pose", pose, "--json", "-"
        )
        assert (code, err) == (0, "")
        found = json.loads(out)["assembly"]
        assert found["start"] == f"pose {pose}"
        assert max(max(gap["distance"], gap["angle"]) for gap in found["gaps"]) < 1e-9
        signs.append(found["configuration"][2] > 0)
    assert signs == [True, False]


def test_a_free_root_s_freedoms_are_nobody_s_to_hold(capfd):
    code, out, _ = check(capfd, BAR, LOOPS, "--free-flyer", "--strict")
    assert code == 0
    assert "8 by rank" in " ".join(out.split())
    assert "6 of them the free root's" in " ".join(out.split())


MOTION = ROOT / "examples" / "pollard_motors.csv"
POLLARD = [ROOT / "urdf" / "pollard" / f"pollard.{end}" for end in ("urdf", "closures.yaml")]


def torque(capfd, *words):
    return run("thesis-pin torque", ["torque", *map(str, words)], capfd)


def test_torque_says_what_each_motor_needs_on_80_columns(capfd, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    code, out, err = torque(capfd, *POLLARD, MOTION)
    assert (code, err) == (0, "")
    assert max(map(len, out.splitlines())) <= 80
    assert "chain1_shoulder" in out
    assert "No motor exceeds its limits" in out


def test_torque_writes_its_report_and_the_same_numbers_everywhere(capfd, tmp_path):
    code, out, _ = torque(capfd, *POLLARD, MOTION, "--out", tmp_path / "made", "--json", "-")
    assert code == 0
    document = json.loads(out)
    assert json.loads((tmp_path / "made" / "report.json").read_bytes()) == document
    header, *rows = (tmp_path / "made" / "samples.csv").read_text().splitlines()
    column = header.split(",").index("torque_chain0_shoulder_Nm")
    found = [float(row.split(",")[column]) for row in rows]
    assert found == [torques[0] for torques in document["torque"]]
    names = {path.name for path in (tmp_path / "made").iterdir()}
    assert {"motors.png", "joints.svg", "loops.png", "manifest.sha256"} <= names


def test_wrenches_from_outside_are_given_by_frame(capfd):
    frame = "tool"
    flags = ("--external", f"{frame}=0,0,20")
    code, out, _ = torque(capfd, *POLLARD, MOTION, *flags, "--json", "-")
    assert code == 0
    pushed = json.loads(out)
    assert pushed["parameters"]["external"] == {frame: [0, 0, 20, 0, 0, 0]}
    _, out, _ = torque(capfd, *POLLARD, MOTION, "--json", "-")
    assert np.abs(np.array(pushed["torque"]) - json.loads(out)["torque"]).max() > 0.1
    code, out, err = torque(capfd, *POLLARD, MOTION, "--external", f"{frame}=0,0,-20")
    assert (code, err) == (0, "")
    assert f"From outside (0, 0, -20) N and (0, 0, 0) N·m act on frame {frame}" in " ".join(
        out.split()
    )


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["nowhere=0,0,1"], "unknown frame 'nowhere'"),
        (["0,0,1"], "allowed: FRAME=fx,fy,fz"),
        (["tool=0,0"], "allowed: FRAME=fx,fy,fz"),
        (["tool=0,0,nan"], "allowed: FRAME=fx,fy,fz"),
        (["tool=0,0,1", "tool=0,0,2"], "given twice for 'tool'"),
    ],
)
def test_wrenches_that_can_not_be_used_are_refused(capfd, words, says):
    flags = [word for one in words for word in ("--external", one)]
    code, out, err = torque(capfd, *POLLARD, MOTION, *flags)
    assert (code, out) == (2, "")
    assert says in " ".join(err.split())


def test_a_motion_without_rates_is_answered_and_what_it_leaves_open_is_said(capfd, tmp_path):
    lines = [line.split(",") for line in MOTION.read_text().splitlines()[1:]]
    kept = [k for k, name in enumerate(lines[0]) if not name.endswith(("_rate", "_acceleration"))]
    bare = tmp_path / "bare.csv"
    bare.write_text("\n".join(",".join(line[k] for k in kept) for line in lines) + "\n")
    code, out, err = torque(capfd, *POLLARD, bare)
    assert (code, err) == (0, "")
    assert "come from a cubic spline through the samples" in " ".join(out.split())
    assert "leaves open" not in out
    rows = [",".join(f"{float(line[k]):.4f}" for k in kept) for line in lines[1:]]
    bare.write_text("\n".join([",".join(lines[0][k] for k in kept), *rows]) + "\n")
    code, out, err = torque(capfd, *POLLARD, bare)
    assert (code, err) == (0, "")
    assert "smooth curves within the samples' resolution" in " ".join(out.split())
    assert "The samples' resolution leaves open: peak of motor" in " ".join(out.split())


def test_torque_beyond_a_limit_is_a_no_only_when_asked_strictly(capfd, tmp_path):
    weak = tmp_path / "weak.urdf"
    text = POLLARD[0].read_text()
    assert 'effort="10.0"' in text
    weak.write_text(text.replace('effort="10.0"', 'effort="0.1"'))
    for flags, wanted in (((), 0), (("--strict",), 1)):
        code, out, err = torque(capfd, weak, POLLARD[1], MOTION, *flags)
        assert (code, err) == (wanted, "")
        assert "Motor chain0_shoulder needs" in " ".join(out.split())


@pytest.mark.parametrize(
    ("header", "says"),
    [("t,chain0_sholder\n", "unknown column"), ("t,chain0_shoulder\n0,1\n1,nan\n", "nan")],
)
def test_a_motion_that_is_none_of_the_robot_s_is_refused(header, says, capfd, tmp_path):
    bad = tmp_path / "bad.csv"
    bad.write_text(header)
    code, out, err = torque(capfd, *POLLARD, bad)
    assert (code, out) == (2, "")
    assert says in err


def test_what_check_writes_reads_back_as_the_same_robot(capfd, tmp_path):
    code, _, err = check(capfd, *POLLARD, "--write", tmp_path / "made")
    assert code == 0
    assert "pollard.closures.yaml" in err
    again = [tmp_path / "made" / f"pollard.{end}" for end in ("urdf", "closures.yaml")]
    found = []
    for pair in (POLLARD, again):
        code, out, _ = torque(capfd, *pair, MOTION, "--json", "-")
        assert code == 0
        found.append(json.loads(out)["torque"])
    assert found[0] == found[1]


GRID = ("--frame", "left_tip", "--along", "x", "-0.2", "0.4", "--along", "z_mm", "200", "500")


def workspace(capfd, *words):
    return run("thesis-pin workspace", ["workspace", *map(str, words)], capfd)


def test_a_workspace_is_told_written_and_drawn(capfd, tmp_path, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    code, out, err = workspace(capfd, BAR, LOOPS, *GRID, "--points", 5)
    assert (code, err) == (0, "")
    assert "cells are reachable" in " ".join(out.split())
    assert max(map(len, out.splitlines())) <= 80
    outputs = ("--out", tmp_path / "space", "--html", tmp_path / "page.html", "--json", "-")
    code, out, _ = workspace(capfd, BAR, LOOPS, *GRID, "--points", 5, *outputs)
    assert code == 0
    document = json.loads(out)
    assert document["axes"][1]["values"] == pytest.approx([0.2, 0.275, 0.35, 0.425, 0.5])
    assert (tmp_path / "space" / "workspace.json").read_text() == out
    assert {path.suffix for path in (tmp_path / "space").iterdir()} == {
        ".json",
        ".csv",
        ".png",
        ".svg",
        ".sha256",
    }
    assert (tmp_path / "page.html").stat().st_size > 10_000


def test_a_workspace_without_a_reachable_cell_is_answered_by_no(capfd):
    words = (*GRID[:2], "--along", "x", "2", "3", "--at", "z", "0.3", "--points", 3)
    code, out, _ = workspace(capfd, BAR, LOOPS, *words, "--json", "-")
    assert code == 1
    assert json.loads(out)["summary"]["reachable"] == 0


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (("--along", "x", "0", "200", "--at", "z", "350"), "x, z reach 350 m: if these are mill"),
        (("--along", "x_mm", "0", "200", "--at", "z_cm", "35"), ""),
    ],
)
def test_an_axis_in_metres_that_must_be_millimetres_is_doubted(capfd, words, says):
    code, _, err = workspace(capfd, BAR, LOOPS, "--frame", "left_tip", *words, "--points", 3)
    assert code == (1 if says else 0)
    assert says in " ".join(err.split())
    assert bool(err) == bool(says)


def test_what_is_an_axis_and_stands_still_is_named(capfd):
    words = ("--frame", "left_tip", "--along", "x", "0", "0.2", "--at", "x", "0")
    code, _, err = workspace(capfd, BAR, LOOPS, *words)
    assert code == 2
    assert "x is given twice" in err


def test_motors_without_ranges_have_to_be_named(capfd):
    code, out, err = workspace(capfd, "example:panda")
    assert (code, out) == (2, "")
    assert "no axes are named" in err


def test_a_table_leads_a_frame(capfd, tmp_path):
    time = np.arange(0, 3, 0.05)
    path = np.column_stack([time, 0.1 + 0.05 * np.sin(time), 0.35 + 0.03 * np.cos(time)])
    np.savetxt(tmp_path / "path.csv", path, delimiter=",", header="t,x,z", comments="")
    words = ["torque", str(BAR), str(LOOPS), str(tmp_path / "path.csv"), "--frame", "left_tip"]
    code, out, err = run("thesis-pin torque", [*words, "--json", "-"], capfd)
    assert code == 0, err
    document = json.loads(out)
    assert document["parameters"]["frame"] == "left_tip"
    assert document["parameters"]["frame_given"] == ["x", "z"]
    code, _, err = run("thesis-pin torque", [*words[:-1], "nowhere"], capfd)
    assert code == 2
    assert "nowhere" in err
