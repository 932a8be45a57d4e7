"""The robot's numbers in the thesis: counted, compared, judged; each check has teeth."""

import numpy as np
import pytest

from pollard_pin.dynamics.inverse import inverse_dynamics_at
from pollard_pin.model import load
from pollard_pin.motion.curves import appendix_b
from pollard_pin.thesis import catalogue
from pollard_pin.thesis.audit import audit
from pollard_pin.thesis.claims.path import best_margins, path_points
from pollard_pin.thesis.claims.robot import (
    Given,
    counts,
    freedoms,
    impossibility,
    spread,
    thesis_robot,
    value_of,
)

pollard = thesis_robot()
SECTIONS = ("2.1", "2.2", "4.1", "4.4", "B")


@pytest.fixture(scope="module")
def rows():
    wanted = [e.id for e in catalogue().equations if e.section in SECTIONS]
    return {row.id: row for row in audit(only=wanted).rows}


def judged(identity, printed):
    equation = catalogue()[identity].model_copy(update={"printed": printed})
    return audit(catalogue().with_equation(equation), only=[identity]).rows[0]


@pytest.mark.parametrize(
    ("identity", "verdict"),
    [
        ("2.1:names", "wrong"),
        ("2.1:T_z2", "holds"),
        ("2.1:T_z5", "misprint"),
        ("2.2:L", "holds"),
        ("2.2:f", "holds"),
        ("2.2:L#2", "holds"),
        ("4.1:chain_2", "holds"),
        ("4.4:J_1", "holds"),
        ("4.4:J_2", "wrong"),
        ("4.4:J_4", "holds"),
        ("4.4:J_2i", "wrong"),
        ("4.4:m", "holds"),
        ("B:path", "wrong"),
    ],
)
def test_known_findings_come_out(rows, identity, verdict):
    assert rows[f"pollard:{identity}"].verdict == verdict


@pytest.mark.parametrize(
    ("identity", "printed"),
    [
        ("pollard:2.2:L", (r"6(b - g) + \sum_k f_k",)),
        ("pollard:2.2:b", ("9",)),
        ("pollard:2.2:f", ("17",)),
        ("pollard:2.2:L#2", ("6(8 - 9 - 1) + 18", "5")),
        ("pollard:2.1:T_z3", (catalogue()["pollard:2.1:T_z2"].printed[0].replace("y", "z"),)),
        ("pollard:4.1:chain_0", ("(.05, .33, .36)",)),
        ("pollard:4.4:m_i", ("(0.166, 0.063)",)),
    ],
)
def test_another_number_or_formula_fails(rows, identity, printed):
    assert rows[identity].verdict == "holds"
    assert judged(identity, printed).verdict == "unexplained"


def test_the_model_has_the_links_and_joints_of_gruebler_and_they_leave_six_freedoms():
    assert counts(pollard) == {"links": 8, "joints": 9, "freedoms": 18}
    assert freedoms() == {"pollard": {6}, "skewed": {6}}


def test_a_tensor_is_impossible_if_not_positive_not_a_bodys_or_too_wide():
    rod = np.diag([0.0, 1.0, 1.0]) / 12  # a uniform bar of 1 kg and 1 m
    assert impossibility(rod, 1.0, 1.0) == 0
    assert spread(rod, 1.0) == pytest.approx(1 / np.sqrt(12))
    assert impossibility(rod, 1.0, 0.5) > 0.1
    assert impossibility(4 * rod, 1.0, 1.0) > 0.1  # the same bar about its end
    assert impossibility(np.diag([1.0, 1.0, 2.5]), 1.0, None) > 0.1
    assert impossibility(np.diag([1.0, 1.0, -0.1]), 1.0, None) > 0


def test_every_printed_tensor_is_that_of_some_body_and_two_of_no_body_of_their_link(rows):
    for row in rows.values():
        if row.check.startswith("inertia:"):
            name = row.check.split(":")[1]
            link = name if name in pollard.specification.links else f"chain1_{name}"
            text = row.printed[0]
            tensor = value_of(catalogue(), text, Given()) * 1e-6
            mass = pollard.specification.links[link].mass
            assert impossibility(tensor, mass, None) < 1e-12, row.id
            np.testing.assert_allclose(
                tensor, pollard.specification.links[link].inertia, atol=1e-15
            )
            assert "the same to the digit" in row.reason or name not in ("wrist_roll_link", "tool")
    impossible = [row.id for row in rows.values() if row.section == "4.4" and row.failed]
    assert impossible == ["pollard:4.4:J_2", "pollard:4.4:J_2i"]


@pytest.mark.parametrize(
    ("identity", "about"),
    [
        ("J_1", "meant about its centre of gravity"),
        ("J_1i", "meant about its centre of gravity"),
        ("J_2", "meant about no point"),
        ("J_2i", "meant about its joint"),
    ],
)
def test_each_links_tensor_says_about_which_point_it_can_be_meant(rows, identity, about):
    reason = rows[f"pollard:4.4:{identity}"].reason
    assert about in reason
    assert " or " not in reason


def test_following_an_impossible_inertia_changes_the_torques_of_the_default_path(rows):
    """Between both readings of all inertias lies at least what one of them makes."""
    motion = appendix_b(pollard.specification).sample(101)
    torques = []
    for robot in (pollard, load(inertia="printed")):
        q, v, a = robot.joint_motion(motion.pose, motion.rate, motion.acceleration)
        torques.append(inverse_dynamics_at(robot, q, v, a).torque)
    both = np.abs(torques[1] - torques[0]).max()
    effects = [rows[f"pollard:4.4:{name}"].effect["path torque [N·m]"] for name in ("J_2", "J_2i")]
    assert both <= sum(effects) + 1e-12
    assert both >= max(effects) - min(effects) - 1e-12
    assert 0.05 < effects[0] < 0.5
    assert rows["pollard:4.4:J_1"].effect == {}


def test_no_decimal_saves_the_forearms_product():
    """With the diagonal a forearm can have, 1381.8 is more than any body allows."""
    text = catalogue()["pollard:4.4:J_2"].right[1]
    tensor = value_of(catalogue(), text, Given()) * 1e-6
    assert impossibility(tensor, 0.188, 0.47) == 0
    tensor[0, 2] = tensor[2, 0] = 1381.812e-6
    assert impossibility(tensor, 0.188, 0.47) > 0.01


def test_the_replacement_is_the_one_that_the_package_uses():
    text = catalogue()["pollard:4.4:J_2"].right[1]
    tensor = value_of(catalogue(), text, Given()) * 1e-6
    np.testing.assert_allclose(tensor, pollard.specification.centroidal("forearm"), atol=1e-15)


def test_the_printed_path_is_the_packages_and_mending_moves_it_where_the_default_does():
    equation = catalogue()["pollard:B:path"]
    for members, place in (
        (equation.printed, (0, 0, 0)),
        (equation.members("corrected"), (0.45, 0, 0)),
    ):
        points = path_points(catalogue(), members)
        motion = appendix_b(placement=place, timing="constant-rate").sample(len(points))
        np.testing.assert_allclose(points, motion.pose[:, :3], atol=1e-12)


def test_near_the_shoulder_no_tool_direction_brings_the_wrist_far_enough():
    """Within 60 mm of the tip, the wrist can't be the 140 mm away that chain 0 needs."""
    chain = pollard.specification.chain_0
    needed = abs(chain.x_32 - chain.forearm)
    assert needed == pytest.approx(0.14)
    generator = np.random.default_rng(3)
    points = generator.normal(size=(50, 3))
    points *= generator.uniform(0, needed - chain.x_1918, (50, 1)) / np.linalg.norm(
        points, axis=1, keepdims=True
    )
    assert best_margins(pollard, points + np.array([0, 0, chain.z_10])).max() < 0


def test_the_reach_over_all_directions_is_not_less_than_with_any_one():
    generator = np.random.default_rng(5)
    poses = np.zeros((40, 6))
    poses[:, :3] = generator.uniform((0.2, -0.2, -0.2), (0.6, 0.2, 0.2), (40, 3))
    poses[:, 3:] = generator.uniform(-1, 1, (40, 3))
    one = pollard.inverse_kinematics(poses, "useful").margin.max(axis=1)
    assert np.all(best_margins(pollard, poses[:, :3]) > one - 0.1)
