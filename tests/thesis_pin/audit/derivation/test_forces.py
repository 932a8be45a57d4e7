"""Forces that a derivation gives: passive joints and friction, held against Pinocchio."""

import numpy as np
import pinocchio as pin
import pytest

from thesis_pin.audit.derivation.moving import coordinates
from thesis_pin.audit.derivation.moving.driven import driven, unforced
from thesis_pin.audit.derivation.moving.states import Frames, States
from thesis_pin.audit.derivation.moving.tree import Tree
from thesis_pin.errors import BadInput
from thesis_pin.loops.loading import load

FREE = r"(J + m \ell^2) \ddot\theta - m \ell \ddot x \cos\theta - m g \ell \sin\theta"
SOLVED = r"\frac{m \ell (\ddot x \cos\theta + g \sin\theta)}{J + m \ell^2}"
SOLVED_TWICE = (
    r"\frac{F \cdot D - m \ell \dot\theta^2 \sin\theta D + (m \ell)^2 g \sin\theta \cos\theta}"
    r"{(M + m) D - (m \ell \cos\theta)^2}"
)


def test_lines_of_a_passive_joint_hold_where_the_file_says_so(rows):
    lines = [
        ("0", FREE),
        (r"\ddot\theta", SOLVED),
        ("D", r"J + m \ell^2"),
        (r"\ddot x", SOLVED_TWICE),
        (r"\tau_\theta", "0"),
        (r"\frac{d}{dt}\left(\ddot\theta\right)", rf"\frac{{d}}{{dt}}\left({SOLVED}\right)"),
    ]
    found = rows(lines, "[forces]\n'\\theta' = 0")
    assert [row.verdict for row in found] == [
        *("holds", "holds", "not checkable", "holds", "holds", "holds")
    ]


def test_a_slip_in_such_a_line_is_found(rows):
    lines = [
        ("0", FREE.replace("- m g", "+ m g")),
        (r"\ddot\theta", SOLVED.replace(r"\sin\theta", r"\cos\theta")),
    ]
    found = rows(lines, "[forces]\n'\\theta' = '0'")
    assert {row.verdict for row in found} == {"unexplained"}


def test_without_it_the_lines_fail_and_say_what_is_missing(rows):
    found = rows([("0", FREE), (r"\ddot\theta", SOLVED)])
    assert {row.verdict for row in found} == {"unexplained"}
    for row in found:
        assert r"no generalized force on \theta" in row.note
        assert "[forces]" in row.note


def test_friction_is_a_force(rows):
    forces = "[forces]\n'\\theta' = '-b \\dot\\theta'"
    lines = [("0", rf"{FREE} + b \dot\theta"), ("b", r"0.03"), ("0", FREE)]
    found = rows(lines, forces)
    assert [row.verdict for row in found] == ["holds", "not checkable", "unexplained"]


@pytest.mark.parametrize(
    ("forces", "says"),
    [
        (r"'\phi' = 0", [r"forces.\phi", "unknown coordinate", r"\theta"]),
        (r"'\theta' = '-b \dot\theta'", [r"forces.\theta", "the symbol b isn't defined"]),
        (r"'\theta' = '-m \ddot x'", ["depends on accelerations"]),
        (r"'\theta' = 'F'", ["depends on accelerations, or on forces that do"]),
        (r"'\theta' = '\mathcal{D}'", ["a 2×2 matrix", "a number"]),
        (r"'\theta' = '- ('", ["can't be read"]),
        (r"'x + \theta' = 0", ["unknown coordinate"]),
    ],
)
def test_a_force_that_makes_no_sense_is_refused(rows, forces, says):
    with pytest.raises(BadInput) as error:
        rows([("0", FREE)], f"[forces]\n{forces}")
    for part in says:
        assert part in str(error.value)


def test_accelerations_and_jerks_are_pinocchios():
    model = load("example:ur5_robot").model
    tree = Tree.of(model)
    said = {rf"\theta_{k + 1}": name for k, name in enumerate(tree.names)}
    given = coordinates.read(said, tree.names, "file")
    states = States.random(tree, Frames.of(model), given, model.gravity.linear)
    found = driven(states, (1, 3), unforced(2))
    data, step = model.createData(), 1e-5
    kept = [0, 2, 4, 5]
    assert np.array_equal(found.a[:, kept], states.a[:, kept])
    assert np.array_equal(found.jerk[:, kept], states.jerk[:, kept])
    for k in range(len(found.x)):
        force = pin.rnea(model, data, found.x[k], found.v[k], found.a[k])
        assert np.abs(force[[1, 3]]).max() < 1e-9 * np.abs(force).max()
        x, v, a, jerk = found.x[k], found.v[k], found.a[k], found.jerk[k]
        ends = [
            pin.rnea(model, data, x + h * v, v + h * a, a + h * jerk)[[1, 3]] for h in (step, -step)
        ]
        rate = (ends[0] - ends[1]) / (2 * step)
        assert np.abs(rate).max() < 1e-5 * max(1.0, np.abs(jerk).max() * np.abs(force).max())
