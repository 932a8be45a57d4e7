"""``thesis-pin balance``: words, exit codes, JSON."""

import json

import numpy as np
import pytest
from commands import ROOT, run

TROT = ROOT / "examples" / "anymal_trot.csv"
ANYMAL = "example:anymal_c_simple_description/anymal"


def balance(words, capfd):
    return run("thesis-pin balance", ["balance", *map(str, words)], capfd)


def test_a_robot_that_slips_is_told_so_and_strict_ends_with_one(capfd):
    words = ["example:solo12", "--slope", "20", "--friction", "0.3"]
    code, out, _ = balance(words, capfd)
    said = " ".join(out.split())
    assert code == 0
    assert "it slips; it needs a friction of 0.364, and has 0.3." in said
    assert "Feet, which nobody named: FL_FOOT, FR_FOOT, HL_FOOT, HR_FOOT." in said
    assert balance([*words, "--strict"], capfd)[0] == 1
    assert balance(["example:solo12", "--slope", "20", "--strict"], capfd)[0] == 0


def test_one_foot_of_talos_tips_with_the_amount_in_the_json(capfd):
    words = ["example:talos_reduced_box", "--feet", "leg_left_6_link", "--json", "-"]
    code, out, _ = balance(words, capfd)
    assert code == 0
    document = json.loads(out)
    cause = document["summary"]["cause"]
    assert cause["outside"] == pytest.approx(-document["margin"][0])
    assert cause["tip"] > 10
    assert document["summary"]["balanced"] is False
    assert document["held"] is True


def test_a_table_beside_the_robot_is_its_motion_and_coarse_ones_carry_no_verdict(capfd, tmp_path):
    code, _, _ = balance([ANYMAL, TROT, "--json", tmp_path / "a.json"], capfd)
    assert code == 0
    document = json.loads((tmp_path / "a.json").read_bytes())
    assert document["summary"]["balanced"] is True
    assert document["held"] is False
    assert np.array(document["support"]).mean() == pytest.approx(0.65)
    force = np.array(document["contact_force"])
    assert not force[~np.array(document["support"])].any()
    header, *rows = TROT.read_text().splitlines()
    rounded = [",".join(f"{float(cell):.5g}" for cell in row.split(",")) for row in rows]
    coarse = tmp_path / "coarse.csv"
    coarse.write_text("\n".join([header, *rounded]))
    code, _, err = balance([ANYMAL, coarse], capfd)
    assert code == 2
    assert "The samples can't carry a verdict" in err


def test_a_file_s_root_stays_where_it_is_put_and_the_floor_below_it_is_told(capfd, tmp_path):
    legs = "".join(
        f"{leg}_HFE = {0.8 * sign}\n{leg}_KFE = {-1.6 * sign}\n"
        for leg, sign in (("FL", 1), ("FR", 1), ("HL", -1), ("HR", -1))
    )
    pose = tmp_path / "pose.toml"
    pose.write_text(f"format = 1\n[joints]\nroot_joint = [0, 0, 0.3, 0, 0, 0, 1]\n{legs}")
    code, out, _ = balance(["example:solo12", "--pose", pose], capfd)
    assert code == 0
    assert "The floor is taken at 0.06" in out
    code, out, _ = balance(["example:solo12", "--pose", pose, "--floor-height", "0"], capfd)
    assert "mm off the floor while it bears load" in " ".join(out.split())


def test_a_pose_beyond_a_joint_s_range_is_held_as_it_is_and_that_is_said(capfd, tmp_path):
    pose = tmp_path / "pose.toml"
    pose.write_text("format = 1\n[joints]\nleg_left_4_joint = 3.0\n")  # of 2.618 at most
    code, out, _ = balance(["example:talos_reduced_box", "--pose", pose, "--json", "-"], capfd)
    document = json.loads(out)
    q = dict(zip(document["joints"][1:], document["q"][0][7:], strict=True))
    assert (code, q["leg_left_4_joint"]) == (0, 3.0)
    assert {name for name, value in q.items() if value} == {"leg_left_4_joint"}
    said = "Joint leg_left_4_joint leaves its range by 0.382 rad."
    assert said in document["summary"]["verdict"]


def test_an_unknown_pose_is_answered_with_those_of_the_srdf_too(capfd):
    code, _, err = balance(["example:solo12", "--pose", "stading"], capfd)
    assert code == 2
    assert "unknown pose 'stading'; allowed: standing, " in " ".join(err.split())


def test_what_has_no_feet_says_what_to_name(capfd):
    code, _, err = balance(["example:panda"], capfd)
    assert code == 2
    assert "--feet" in err
