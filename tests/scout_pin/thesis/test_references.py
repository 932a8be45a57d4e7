"""The audit's references are Pinocchio's numbers, and their derivatives are exact."""

import numpy as np
import pinocchio as pin
import pytest

from scout_pin.specification import Specification
from scout_pin.thesis.references import References
from scout_pin.thesis.state import BODIES, COORDINATES, Parameters, State, coordinate_index
from scout_pin.thesis.symbols.vectors import e_column
from thesis_pin.equations.evaluation import evaluate
from thesis_pin.equations.formula import FormulaError, Symbol

COUNT = 6


@pytest.fixture
def references(rng):
    q, v, a, virtual = (rng.uniform(-1.5, 1.5, (COUNT, 1, 18)) for _ in range(4))
    tau, multipliers = (rng.uniform(-1, 1, (COUNT, 1, 12)) for _ in range(2))
    parameters = Parameters.of(Specification.read())
    return References(State(parameters, q, v, a, virtual, tau, multipliers))


def value(references, *symbol, **indices):
    found = evaluate(Symbol(*symbol, bold=True), references, indices)
    return np.broadcast_to(found.array, (COUNT, *found.array.shape[1:]))


def test_centres_of_mass_and_soles_are_where_pinocchio_has_them(references, scout_thesis):
    model, data = scout_thesis.model, scout_thesis.model.createData()
    for k in range(COUNT):
        q, v = references.state.q[k, 0], references.state.v[k, 0]
        com = pin.centerOfMass(model, data, q, v)
        pin.framesForwardKinematics(model, data, q)
        np.testing.assert_allclose(value(references, "b", "T", "0")[k, 0], com, atol=1e-15)
        rate = value(references, "b", "T", "0", 1)[k, 0]
        np.testing.assert_allclose(rate, data.vcom[0], atol=1e-14)
        for i, side in ((1, "left"), (2, "right")):
            sole = data.oMf[scout_thesis.sole_frames[side]]
            np.testing.assert_allclose(
                value(references, "r", str(i), "0")[k, 0], sole.translation, atol=1e-15
            )
            turned = value(references, "R", f"14{i}", "0")[k, 0]
            np.testing.assert_allclose(turned, sole.rotation, atol=1e-15)


def test_momentum_rate_is_pinocchios(references, scout_thesis):
    model, data = scout_thesis.model, scout_thesis.model.createData()
    linear = value(references, "cal:P", "", "", 1)
    angular = value(references, "cal:L", "", "", 1)
    for k in range(COUNT):
        state = references.state
        pin.computeCentroidalMomentumTimeVariation(
            model, data, state.q[k, 0], state.v[k, 0], state.a[k, 0]
        )
        np.testing.assert_allclose(linear[k, 0], data.dhg.linear, atol=1e-12)
        about_origin = data.dhg.angular + np.cross(data.com[0], data.dhg.linear)
        np.testing.assert_allclose(angular[k, 0], about_origin, atol=1e-12)


@pytest.mark.parametrize("name", ["b_42^0", "e_172^0", "omega_31^0", "k_81^0", "u_theta32^0"])
def test_time_derivatives_agree_with_finite_differences(references, name):
    base, rest = name.split("_")
    sub, sup = rest.split("^")
    exact = value(references, base, sub, sup, 1)
    h, state = 1e-6, references.state
    ends = []
    for sign in (1, -1):
        moved = State(
            state.parameters,
            state.q + sign * h * state.v + 0.5 * h * h * state.a,
            state.v + sign * h * state.a,
            *(state.a, state.virtual, state.tau, state.multipliers),
        )
        ends.append(value(References(moved), base, sub, sup))
    np.testing.assert_allclose(exact, (ends[0] - ends[1]) / (2 * h), atol=2e-8)


def test_jacobians_have_the_vectors_e_as_columns():
    assert e_column(1) == (1, 0)
    assert e_column(4) == (1, 3)
    assert e_column(39) == (6, 8)
    with pytest.raises(FormulaError):
        e_column(40)


def test_foot_euler_angles_rebuild_the_rotation(references):
    from thesis_pin.numeric.rotations import rotation

    for i in "12":
        angles = [value(references, name, i)[:, 0] for name in ("theta", "phi", "psi")]
        rebuilt = rotation("x", angles[0]) @ rotation("y", angles[1]) @ rotation("z", angles[2])
        np.testing.assert_allclose(rebuilt, value(references, "R", i, "0")[:, 0], atol=1e-14)
        rates = [value(references, name, i, "", 1)[:, 0] for name in ("theta", "phi", "psi")]
        axes = [
            value(references, *a)[:, 0]
            for a in (("i", f"theta{i}", "0"), ("j", f"phi{i}", "0"), ("k", f"psi{i}", "0"))
        ]
        omega = sum(r[:, None] * axis for r, axis in zip(rates, axes, strict=True))
        np.testing.assert_allclose(omega, value(references, "omega", i, "0")[:, 0], atol=1e-12)


@pytest.mark.parametrize("symbol", [("x", "11"), ("r", "C61", "0"), ("beta", "01"), ("A", "999")])
def test_symbols_the_thesis_never_defines_are_undefined(references, symbol):
    with pytest.raises(FormulaError, match="isn't defined anywhere"):
        value(references, *symbol)


def test_coordinates_are_known_by_both_names():
    assert coordinate_index("theta_12") == coordinate_index("q_13") == 12
    assert len(COORDINATES) == 18
    assert len(BODIES) == 13
    with pytest.raises(FormulaError):
        coordinate_index("theta_14")


@pytest.mark.parametrize(
    ("digits", "entry"),
    [
        ("41", (3, 0)),
        ("410", (3, 9)),
        ("104", (9, 3)),
        ("115", (10, 4)),
        ("1310", (12, 9)),
        ("1812", (17, 11)),
        ("99", (8, 8)),
        ("11", None),
        ("1813", None),
        ("4", None),
        ("tau", None),
    ],
)
def test_entries_of_the_actuation_matrix_are_told_apart(digits, entry):
    from scout_pin.thesis.symbols.forces import matrix_entry

    assert matrix_entry(digits) == entry


@pytest.mark.parametrize(("base", "sub"), [("u", "theta71"), ("u", "x9"), ("t", "theta71")])
def test_a_vector_of_no_coordinate_is_not_defined(references, base, sub):
    assert value(references, "u", "theta31", "0").shape[-1] == 3
    with pytest.raises(FormulaError, match="defined"):
        value(references, base, sub, "0")


def test_a_velocity_is_the_rate_of_its_vector_and_seen_from_the_world(references):
    point = value(references, "r", "31", "0", 1)
    np.testing.assert_array_equal(value(references, "v", "31", "0"), point)
    np.testing.assert_array_equal(
        value(references, "v", "31", "0", 1), value(references, "a", "31", "0")
    )
    for sup in ("", "1"):
        with pytest.raises(FormulaError, match="defined"):
            value(references, "v", "31", sup)
