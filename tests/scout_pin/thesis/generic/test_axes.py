"""Lines are held where nothing vanishes by the robot's shape, so slips in them are seen."""

import numpy as np
import pytest

from scout_pin.thesis import catalogue
from scout_pin.thesis.audit import states
from scout_pin.thesis.generic import axes
from scout_pin.thesis.references import References
from thesis_pin.audit.judging.residuals import residual
from thesis_pin.audit.judging.verdicts import judge
from thesis_pin.audit.rows import HOLDS
from thesis_pin.equations.evaluation import evaluate
from thesis_pin.equations.formula import Symbol

REFERENCES = References(states())
AXES = axes.references("axes")
Z_11 = r"\mathbf{R}_z(\theta_{11} + \beta_{11})"


def verdict(identity, old="", new="", member=1, free=True):
    """The verdict on a line with a piece of it replaced."""
    equation = catalogue()[identity]
    printed = list(equation.printed)
    assert old in printed[member - 1]
    printed[member - 1] = printed[member - 1].replace(old, new, 1)
    changed = equation.model_copy(update={"printed": tuple(printed)})
    where = axes.free(changed) if free else ()
    return judge(catalogue(), changed, REFERENCES, {}, "", where)


@pytest.mark.parametrize(
    ("identity", "old", "new"),
    [
        ("scout:4.6.1.1:dvarphi_1^1/dq_1", "b1_y", "2 b1_y"),
        ("scout:4.6.1.1:dvarphi_1^1/dq_2", "b1_y", "-b1_y"),
        ("scout:4.6.1.1:dvarphi_1^1/dq_3", "z_B", "y_B"),
        ("scout:4.6.1.1:dvarphi_1^1/dq_13", r"\mathbf{k}_0", r"\mathbf{j}_0"),
        ("scout:4.6.1.3:dvarphi_3^1/dq_4", Z_11, f"2 {Z_11}"),
        ("scout:4.6.1.4:dvarphi_4^1/dq_11", r"\mathbf{j}_0", r"\mathbf{k}_0"),
        ("scout:4.6.2.7:dvarphi_12^2/dq_8", r"\theta_{21}", r"\theta_{31}"),
        ("scout:4.6.1.2:dvarphi_2^1/dq_1", r"\varphi_2^1", r"\varphi_3^1"),
        ("scout:4.6.2.3:dvarphi_8^2/dq_7", "q_8", "q_3"),
        ("scout:4.6.1.2:dvarphi_2^1/dq_13", "q_{14}", "q_{13}"),
        ("scout:4.5:A_51", r"\mathbf{k}_{01}^{0T}", r"2 \mathbf{k}_{01}^{0T}"),
        ("scout:4.5:A_83", r"\mathbf{k}_{41}", r"\mathbf{k}_{61}"),
        ("scout:4.5:A_1712", r"\mathbf{i}_{102}", r"-\mathbf{i}_{102}"),
    ],
)
def test_a_slip_in_a_line_that_is_zero_on_the_biped_is_seen(identity, old, new):
    assert verdict(identity).verdict == "holds"
    slipped = verdict(identity, old, new)
    assert slipped.verdict == "unexplained"
    assert slipped.reason
    assert verdict(identity, old, new, free=False).verdict == "holds"  # 0 = 0


@pytest.mark.parametrize(
    ("identity", "old", "new"),
    [
        ("scout:3.2:u_theta1i", r"\mathbf{r}_{1i}^0", r"2 \mathbf{r}_{1i}^0"),
        ("scout:4.1:e_12i", r"\mathbf{r}_{2i}^0", ""),
    ],
)
def test_so_is_a_slip_in_a_term_that_is(identity, old, new):
    assert verdict(identity).verdict == "holds"
    assert verdict(identity, old, new).verdict == "unexplained"


def zero(equation, references=REFERENCES):
    """Whether both sides of a line vanish at all states."""
    for member in equation.printed:
        sides = catalogue().parse(equation.left), catalogue().parse(member)
        for indices in catalogue().indices(*sides):
            for side in sides:
                if np.abs(evaluate(side, references, indices).array).max() > 1e-12:
                    return False
    return True


def test_every_line_of_45_and_46_that_is_zero_on_the_biped_is_also_held_where_it_is_not():
    found = [
        equation
        for equation in catalogue().equations
        if equation.section.startswith(("4.5", "4.6"))
        and equation.printed
        and not (equation.claim or equation.mending or equation.left_printed or equation.illegible)
        and zero(equation)
    ]
    assert len(found) > 90
    assert [e.id for e in found if not e.free and (e.special or zero(e, AXES))] == []


def test_only_lines_that_rest_on_the_robots_shape_are_said_to():
    said = [equation for equation in catalogue().equations if equation.special]
    assert 30 < len(said) < 60
    for equation in said:
        members = equation.members("corrected")
        found = residual(catalogue(), equation, members, AXES, equation.left)
        assert found.value > 1e-3, equation.id
        on_the_biped = residual(catalogue(), equation, members, REFERENCES, equation.left)
        assert on_the_biped.value < HOLDS


@pytest.mark.parametrize("name", ["ithetaB", "jphiB", "kpsiB", "k01", "j22", "k41", "k82", "i101"])
def test_joints_turn_about_the_vectors_that_are_named_for_it(name):
    """The axis of the rotation between two states, from their rotations alone."""
    state, size = AXES.state, 1e-6
    k = {"ithetaB": 3, "jphiB": 4, "kpsiB": 5}.get(name)
    body = "B"
    if k is None:
        joint = {"k0": 1, "j2": 2, "k4": 3, "k6": 4, "k8": 5, "i10": 6}[name[:-1]]
        k, body = 5 + 6 * (int(name[-1]) - 1) + joint, f"{joint}{name[-1]}"
    ends = [state.step(f"q_{k + 1}", size=sign * size).frame(body).rotation for sign in (1, -1)]
    turn = (ends[0] - ends[1]) / (2 * size) @ np.swapaxes(state.frame(body).rotation, -1, -2)
    turned = np.stack([turn[..., 2, 1], turn[..., 0, 2], turn[..., 1, 0]], axis=-1)
    sub = {"i": r"theta", "j": "phi", "k": "psi"}[name[0]] + "B" if k < 6 else name[1:]
    axis = AXES.lookup(Symbol(name[0], sub, "0", bold=True), {}).array
    np.testing.assert_allclose(turned, axis, atol=1e-8)


def test_no_two_vectors_of_the_open_robot_are_parallel_or_at_right_angles():
    names = ["i0", "j0", "k0", "iB", "ithetaB", "jphiB", "kpsiB", "k01", "k11", "j21", "i31", "k41"]
    drawn = np.array([AXES.state.own(name) for name in names])
    cosines = np.abs(drawn @ drawn.T)[np.triu_indices(len(names), 1)]
    assert cosines.max() < 0.999
    assert cosines.min() > 1e-3
