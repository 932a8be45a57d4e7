"""The robot's numbers in the thesis: counted, compared, judged; each check has teeth."""

import numpy as np
import pytest

from pollard_pin.dynamics.inverse import inverse_dynamics_at
from pollard_pin.model import load
from pollard_pin.motion.curves import appendix_b
from pollard_pin.thesis import catalogue
from pollard_pin.thesis.audit import audit
from pollard_pin.thesis.claims.general import moving_coefficients
from pollard_pin.thesis.claims.given import Given, thesis_robot, value_of
from pollard_pin.thesis.claims.inertia import impossibility, link_of, spread
from pollard_pin.thesis.claims.path import best_margins, path_points
from pollard_pin.thesis.claims.robot import counts, freedoms
from pollard_pin.thesis.state import CHAIN_0
from thesis_pin.audit.judging.verdicts import judge

pollard = thesis_robot()
SECTIONS = ("2.1", "2.2", "4.1", "4.4", "B")


@pytest.fixture(scope="module")
def rows():
    wanted = [e.id for e in catalogue().equations if e.claim or e.section in SECTIONS]
    return {row.id: row for row in audit(only=wanted).rows}


@pytest.fixture
def judged(ground):
    """The row of an equation with another text."""

    def row(identity, printed=None, **changed):
        changed |= {} if printed is None else {"printed": printed}
        equation = catalogue()[identity].model_copy(update=changed)
        environment = ground.references(equation)
        return judge(catalogue(), equation, environment, ground.claims, "thesis")

    return row


@pytest.mark.parametrize(
    ("identity", "verdict"),
    [
        ("2.1:names", "wrong"),
        ("2.1:T_z2", "holds"),
        ("2.1:T_z5", "misprint"),
        ("2.2:L", "holds"),
        ("2.2:f", "holds"),
        ("2.2:L#2", "holds"),
        ("2.1:T_B^A", "holds"),
        ("3.1:L", "holds"),
        ("3.3.2:V", "holds"),
        ("3.6:deltaQ", "holds"),
        ("3.7:D_jddot_q+V_jdot_q+C_j", "holds"),
        ("3.7:inverted", "wrong"),
        ("3.7:C_j:2", "wrong"),
        ("4.1:chain_2", "not checkable"),
        ("4.4:J_1", "holds"),
        ("4.4:J_2", "wrong"),
        ("4.4:J_4", "holds"),
        ("4.4:J_2i", "wrong"),
        ("4.4:m", "not checkable"),
        ("B:path", "wrong"),
        ("2.5.4:rates_named", "misprint"),
        ("2.8.4:names_put_in", "misprint"),
    ],
)
def test_known_findings_come_out(rows, identity, verdict):
    assert rows[f"pollard:{identity}"].verdict == verdict


@pytest.mark.parametrize(
    ("identity", "old", "new"),
    [
        ("2.1:T_B^A", "(3x3)", "(2x3)"),
        (
            "2.1:T_B^A",
            r"\boldsymbol{\gamma}(1x3) & \rho(1x1)",
            r"\rho(1x1) & \boldsymbol{\gamma}(1x3)",
        ),
        ("2.1:T_B^A", r"\mathbf{q}", r"\boldsymbol{\gamma}"),
        ("2.1:T_B^A", r"\rho(", r"- \rho("),
        ("2.1:T_B^A", r"\boldsymbol{\gamma}", r"2 \boldsymbol{\gamma}"),
        ("2.1:T_B^A", r"\mathbf{q}", r"\dot{\mathbf{q}}"),
        ("2.1:T_B^A", r"\begin", r"2 \begin"),
        ("2.2:L", "- 1", "+ 1"),
        ("2.2:L", "+ ", "- "),
        ("2.2:L", "g", "b"),
        ("2.2:b", "8", "9"),
        ("2.2:f", "18", "17"),
        ("2.2:L#2", "18", "81"),
        ("2.4.1:2.10", r"\pm", "-"),
        ("2.4.1:2.10", "A_{10} - C", "A_{10} + C"),
        ("2.4.1:2.10", "2 ", "3 "),
        ("2.7.1:2.97", "- C_{1i}^2", "+ C_{1i}^2"),
        ("3.1:L", "-", "+"),
        ("3.1:L", "U", "K"),
        ("3.3.2:V", ", x", ""),
        ("3.3.2:V", r"\theta_{54}", r"\theta_{65}"),
        ("3.6:deltaQ", r"\boldsymbol{\omega}", r"\dot{\boldsymbol{\omega}}"),
        ("3.3.2:V", r", z,", r", \dot{z},"),
        ("3.6:deltaQ", r"\delta \theta", r"\theta"),
        ("3.6:deltaQ", r"\delta \theta", r"\delta \dot{\theta}"),
        ("4.4:J_1", "3027", "3072"),
        ("4.4:J_5", "1.681", "1.618"),
    ],
)
def test_a_slip_in_a_checked_statement_is_seen(rows, identity, old, new, judged):
    equation = catalogue()[f"pollard:{identity}"]
    assert rows[equation.id].verdict == "holds"
    assert any(old in text for text in equation.printed)
    slipped = tuple(text.replace(old, new, 1) for text in equation.printed)
    row = judged(equation.id, slipped)
    assert row.verdict == "unexplained", row.reason


@pytest.mark.parametrize(
    ("identity", "names"),
    [
        ("2.5.4:rates_named", r"\dot{x}, \dot{y}, \dot{\theta}_{21}"),
        ("2.5.4:rates_named", r"\dot{x}, \dot{y}, \dot{x}"),
        ("2.5.4:rates_named", r"\dot{x}, \dot{y}, z"),
        ("2.8.4:names_put_in", r"d_{31}, d_{32}, \dot{d}_{31}, \dot{d}_{31}"),
    ],
)
def test_a_sentence_names_what_its_line_has_and_once(judged, identity, names):
    identity = f"pollard:{identity}"
    (right,) = catalogue()[identity].members("corrected")
    assert judged(identity, (right,), corrected={}).verdict == "holds"
    for slipped in ((names,), (right, names), (names, right)):
        assert judged(identity, slipped, corrected={}).verdict == "unexplained"


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("+ C_j", "- C_j"),
        ("+ V_j", "- V_j"),
        (r"\ddot", r"\dot"),
        ("V_j", "D_j"),
        ("V_j", "2 V_j"),
        ("C_j", "C_1"),
        ("D_j", "D_j^T"),
        (r"+ V_j \dot{\mathbf{q}} ", ""),
    ],
)
def test_a_slip_in_the_law_of_motion_is_seen(old, new, judged):
    """(3.153) says it on its left side."""
    identity = "pollard:3.7:D_jddot_q+V_jdot_q+C_j"
    left = catalogue()[identity].left
    assert old in left
    assert judged(identity, left=left.replace(old, new, 1)).verdict == "unexplained"


@pytest.mark.parametrize(
    ("identity", "left"),
    [
        ("2.2:b", "g"),
        ("2.2:L", "b"),
        ("3.1:L", "K"),
        ("3.3.2:V", "E"),
        ("2.1:T_B^A", r"-\mathbf{T}_B^A"),
        ("2.1:T_B^A", r"\dot{\mathbf{T}}_B^A"),
        ("3.6:deltaQ", r"\delta \dot{\mathbf{Q}}"),
        ("4.4:J_1", r"\dot{\mathbf{J}}_1^2"),
        ("4.4:J_1i", r"\mathbf{J}_1^{3i}"),
        ("4.4:J_1", r"\mathbf{J}_1^5"),
        ("4.4:J_3", r"\mathbf{J}_2^{16}"),
    ],
)
def test_a_slip_on_the_left_side_of_a_checked_statement_is_seen(rows, identity, left, judged):
    assert rows[f"pollard:{identity}"].verdict == "holds"
    assert judged(f"pollard:{identity}", left=left).verdict == "unexplained"


@pytest.mark.parametrize("name", ["inverted", "3.154", "D_jT", "V_jT:2", "C_j:2"])
def test_what_six_motors_need_in_place_of_three_is_evaluated_too(rows, name, judged):
    """Lines of 3.7 that invert J_τ are wrong; a slip in what is right leaves them unexplained."""
    identity = f"pollard:3.7:{name}"
    equation = catalogue()[identity]
    assert rows[identity].verdict == "wrong"
    assert "3×6 matrix" in rows[identity].reason
    (text,) = equation.right.values()
    assert judged(identity, right={1: f"- {text}"}).verdict == "unexplained"
    assert judged(identity, right={1: equation.printed[0]}).verdict == "unexplained"


def test_numbers_that_stand_nowhere_else_say_so_and_are_those_in_use(rows):
    """4.1 and 4.4 against the specification, which is typed from the same page."""
    chain = pollard.specification.chain_0
    used = {
        "4.1:chain_0": [chain.z_10, chain.x_32, chain.x_65],
        "4.4:m": [link.mass for link in chain.links],
    }
    names = ("y_10", "z_32", "x_43", "beta_54_deg", "x_87", "x_1211", "z_1312", "beta_1413_deg")
    for k, side in enumerate(pollard.specification.side_chains, start=1):
        own = [float(getattr(side, name)) for name in names]
        used[f"4.1:chain_{k}"] = [*own, chain.x_1514, chain.x_1918]
        used["4.4:m_i"] = [link.mass for link in side.links]
    for name, numbers in used.items():
        row = rows[f"pollard:{name}"]
        assert row.reason.startswith("stated, not checkable: "), name
        (text,) = row.printed
        assert [float(x) for x in text.strip("()").split(",")] == numbers
    first, second = pollard.specification.side_chains
    assert [link.mass for link in first.links] == [link.mass for link in second.links]


def test_the_branch_of_an_angle_is_its_own_sign(rows, judged):
    """What stands for a plain arctan gives the angle itself, by one of two signs if it has any."""
    for identity, sign in (("2.4.2:2.19", r"\pm"), ("2.7.6:2.131", r"+")):
        equation = catalogue()[f"pollard:{identity}"]
        assert rows[equation.id].residual_corrected < 1e-12
        (text,) = equation.right.values()
        for old, new in ((sign, "-"), ("2 ", ""), (r"\frac{", r"\frac{2 ")):
            slipped = text.replace(old, new, 1)
            assert judged(equation.id, right={1: slipped}).verdict == "unexplained"


def test_the_arms_inertia_is_named_by_its_body_and_its_own_frame():
    named = {
        r"\mathbf{J}_1^2": "upper_arm",
        r"\mathbf{J}_2^5": "forearm",
        r"\mathbf{J}_5^{18}": "tool",
        r"\mathbf{J}_1^{2i}": "chain1_arm",
        r"\mathbf{J}_2^{7i}": "chain1_rod",
        r"\mathbf{J}_2^{2i}": "",
        r"\mathbf{N}_1^2": "",
    }
    assert {left: link_of(catalogue(), left) for left in named} == named


def test_the_coefficients_of_chain_0_depend_on_its_angles_and_the_pose(ground):
    found = moving_coefficients(ground.references(catalogue()["pollard:3.1:L"]))
    assert found == {"x", "y", "z", "psi", "theta", "phi", *CHAIN_0}


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
