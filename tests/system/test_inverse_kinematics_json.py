"""Both commands write inverse kinematics in one schema."""

import json

import numpy as np
import pytest

import pollard_pin
import scout_pin
from pollard_pin.cli import main as pollard
from scout_pin.cli import main as scout

COMMANDS = {
    "scout": (scout, ["ik", "left", "--position", "-0.0445", "-0.02", "-0.22"], 8),
    "scout out of reach on two": (
        scout,
        ["ik", "right", "--position", "0.03", "0.02", "-0.2", "--rotation", "5", "-5", "20"],
        8,
    ),
    "scout, one branch": (
        scout,
        ["ik", "right", "--position", "0.03", "0.02", "-0.2", "--branch=+++,-+-"],
        1,
    ),
    "pollard": (pollard, ["ik", "0.45", "0.03", "0.1", "5", "10", "-20"], 16),
    "pollard, one branch": (
        pollard,
        ["ik", "0.45", "0", "0.1", "0", "0", "0", "--branch=-++-+++"],
        1,
    ),
}
KEYS = ["schema", "version", "robot", "joints", "coordinates", "pose", "branches", "explanation"]
BRANCH_KEYS = ["branch", "reachable", "valid", "angles", "position_residual", "rotation_residual"]
OWN_KEYS = {
    "scout": ["reach_excess", "explanation", "knee"],
    "pollard": ["margin", "loop_residual", "rod_angles", "explanation"],
}


def document(name, capsysbinary):
    main, words, _ = COMMANDS[name]
    assert main([*words, "--json", "-"]) == 0
    return json.loads(capsysbinary.readouterr().out)


@pytest.mark.parametrize("name", COMMANDS)
def test_both_robots_have_the_same_keys_in_the_same_order(name, capsysbinary):
    found, robot = document(name, capsysbinary), name.split()[0].strip(",")
    assert list(found) == KEYS
    assert found["schema"] == f"{robot}-pin/inverse-kinematics"
    assert found["version"] == 2
    assert found["robot"] == robot
    assert len(found["coordinates"]) == len(found["pose"]) == 6
    assert len(found["branches"]) == COMMANDS[name][2]
    for branch in found["branches"]:
        assert list(branch) == BRANCH_KEYS + OWN_KEYS[robot]
        assert set(branch["branch"]) <= {"+", "-"}
        assert (branch["angles"] is None) == (not branch["reachable"])
        if branch["reachable"]:
            assert len(branch["angles"]) == len(found["joints"])
            assert branch["position_residual"] < 1e-12
            assert branch["rotation_residual"] < 1e-12


def test_the_labels_name_the_branches_they_stand_beside(capsysbinary):
    robot = scout_pin.load()
    found = document("scout", capsysbinary)
    foot = np.eye(4)
    foot[:3, 3] = found["pose"][:3]
    solutions = robot.leg_inverse_kinematics("left", foot)
    for branch, signs, angles in zip(
        found["branches"], scout_pin.BRANCHES, solutions.angles, strict=True
    ):
        assert [int(sign + "1") for sign in branch["branch"]] == list(signs)
        assert branch["reachable"] == np.isfinite(angles).all()
        if branch["reachable"]:
            np.testing.assert_array_equal(branch["angles"], angles)
    found = document("pollard", capsysbinary)
    for branch in found["branches"]:
        label = pollard_pin.Branch.parse(branch["branch"])
        expected = pollard_pin.load().inverse_kinematics(found["pose"], label)
        if branch["reachable"]:
            np.testing.assert_allclose(branch["angles"], expected.angles, atol=1e-14)
        else:
            assert not expected.reachable


def test_one_branch_is_the_row_that_all_of_them_have(capsysbinary):
    main, words, _ = COMMANDS["scout, one branch"]
    asked = document("scout, one branch", capsysbinary)["branches"]
    assert main([*words[:-1], "--json", "-"]) == 0
    every = {one["branch"]: one for one in json.loads(capsysbinary.readouterr().out)["branches"]}
    assert asked == [every["-+-"]]
