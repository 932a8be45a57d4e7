"""Lines of slopes are held where joints turn about axes that point anywhere, so slips are seen."""

import itertools

import numpy as np
import pytest

from pollard_pin.thesis import catalogue
from pollard_pin.thesis.generic.axes import AnyAxes, slopes
from thesis_pin.audit.judging.residuals import residual
from thesis_pin.audit.rows import HOLDS
from thesis_pin.numeric.rotations import rotation

from ..conftest import value, verdict, with_slip

TURN_54 = r"\mathbf{R}_z(\theta_{54})"
STEP = 1e-6


@pytest.fixture(scope="module")
def symbols():
    return AnyAxes.drawn()


@pytest.mark.parametrize(
    ("identity", "old", "new"),
    [
        ("3.3.2:J_51", TURN_54, r"\mathbf{R}_z(2 \theta_{54})"),
        (
            "3.3.2:J_211",
            r"+ (\mathbf{k}_4^0 \times \mathbf{B}_y(\theta_{21}) \mathbf{R}_y(\theta_{43}) "
            r"\mathbf{R}_z(\theta_{54}) \mathbf{r}_{14,5i}^5)",
            "",
        ),
        ("3.3.2:J_211", TURN_54, r"\mathbf{R}_z(\dot{\theta}_{54})"),
        ("3.3.2:J_223", r"\mathbf{R}_x(\theta_{16,15})", r"\mathbf{R}_x(2 \theta_{16,15})"),
        ("3.3.2:Jp_17", r"\mathbf{R}_z(\theta_{17,16})", r"\mathbf{R}_z(2 \theta_{17,16})"),
        ("3.3.2:Jp_23", r"\mathbf{R}_z(\theta_{17,16})", r"\mathbf{R}_z(2 \theta_{17,16})"),
        (
            "3.3.2:dV/dq_j",
            r"+ \frac{\partial V}{\partial y}",
            r"+ 2 \frac{\partial V}{\partial y}",
        ),
        ("3.3.2:dV/dq_j", r"{\partial \theta_{1716}}", r"{\partial \dot{\theta}_{1716}}"),
        (
            "3.5.2:dk_5i/dq_j:2",
            r"\mathbf{B}_y(\theta_{65i})\mathbf{R}_z(\theta_{76i})",
            r"\mathbf{B}_y(\theta_{65i})\mathbf{R}_z(2 \theta_{76i})",
        ),
    ],
)
def test_a_slip_that_right_angles_hide_is_seen(ground, identity, old, new):
    changed = with_slip(identity, old, new)
    assert verdict(ground, catalogue()[changed.id]) == "holds"
    assert verdict(ground, changed) == "unexplained"
    assert verdict(ground, changed, free=()) == "holds"  # the mechanism's right angles hide it


def test_every_line_of_slopes_holds_there_as_it_should_be_printed(symbols):
    held = [equation for equation in catalogue().equations if slopes(catalogue(), equation)]
    assert len(held) > 100
    for equation in held:
        members = equation.members("corrected")
        found = residual(catalogue(), equation, members, symbols, equation.left)
        assert found.value < HOLDS, (equation.id, found.reason)


@pytest.mark.parametrize(
    ("axis", "frame", "angle", "i"),
    [
        (r"\mathbf{j}_1^0", "2", "theta_21", ""),
        (r"\mathbf{j}_3^0", "4", "theta_43", ""),
        (r"\mathbf{k}_4^0", "5", "theta_54", ""),
        (r"\mathbf{i}_{15}^0", "16", "theta_1615", ""),
        (r"\mathbf{k}_{16}^0", "17", "theta_1716", ""),
        (r"\mathbf{i}_{17}^0", "18", "theta_1817", ""),
        (r"\mathbf{k}_{1i}^0", "2i", "theta_212", "2"),
        (r"\mathbf{j}_{5i}^0", "6i", "theta_651", "1"),
        (r"\mathbf{k}_{6i}^0", "7i", "theta_762", "2"),
    ],
)
def test_an_axis_is_what_turning_its_joint_leaves_in_place(symbols, axis, frame, angle, i):
    turned = [
        value(
            rf"\mathbf{{R}}_{{{frame}}}^0",
            AnyAxes(symbols.state.with_(**{angle: at}), symbols.drive),
            i=i,
        )
        for at in (symbols.state.variables[angle] + by for by in (-STEP, STEP))
    ]
    slope = (turned[1] - turned[0]) / (2 * STEP)
    spin = slope @ np.swapaxes(value(rf"\mathbf{{R}}_{{{frame}}}^0", symbols, i=i), -1, -2)
    vector = np.stack([spin[..., 2, 1], spin[..., 0, 2], spin[..., 1, 0]], axis=-1)
    np.testing.assert_allclose(value(axis, symbols, i=i), vector, atol=1e-8)


def test_no_axis_is_at_a_right_angle_to_the_next(symbols):
    names = [r"\mathbf{j}_3^0", r"\mathbf{k}_4^0", r"\mathbf{i}_{15}^0", r"\mathbf{k}_{16}^0"]
    axes = [value(name, symbols) for name in (*names, r"\mathbf{i}_{17}^0")]
    for one, following in itertools.pairwise(axes):
        assert np.abs((one * following).sum(axis=-1)).min() > 1e-2


def test_a_printed_rotation_turns_as_the_mechanism_does(symbols):
    printed = value(r"\mathbf{R}_y(\theta_{21}) \mathbf{R}_y(\theta_{43})", symbols)
    np.testing.assert_allclose(printed, value(r"\mathbf{R}_4^0", symbols), atol=1e-12)
    straight = rotation("y", symbols.state.variables["theta_21"])
    assert np.abs(value(r"\mathbf{R}_y(\theta_{21})", symbols) - straight).max() > 0.1
