"""A trajectory's plots show what the report says, in the units they name."""

import numpy as np
import pytest
from plotted import assert_arrives

import pollard_pin
from pollard_pin.motion.curves import appendix_b
from pollard_pin.report.drawn import curves
from pollard_pin.report.drawn.figures import NUMBERS, figures
from pollard_pin.specification import ACTUATOR_SYMBOLS, JOINT_SYMBOLS


@pytest.fixture(scope="module")
def report():
    return pollard_pin.trajectory_report(pollard_pin.load(), appendix_b(duration=10.0), samples=101)


def drawn(plots):
    """Curves by name, each once."""
    found = {}
    for plot in plots:
        for curve in plot.curves:
            assert curve.name not in found
            found[curve.name] = curve.y
    return found


def test_plotly_holds_every_curve_by_its_name_with_its_numbers(report):
    for plot in curves.plots(report):
        assert_arrives(plot)


def test_each_row_of_motors_has_every_motor_once(report):
    rows = curves.motors(report)
    assert [row[0].label for row in rows] == [
        "torque [N·m]",
        "speed [rad/s]",
        "power [W]",
        "work [J]",
    ]
    torque, speed, power, work = map(drawn, rows)
    assert list(torque) == list(ACTUATOR_SYMBOLS)
    for name in ACTUATOR_SYMBOLS:
        np.testing.assert_allclose(power[name], torque[name] * speed[name], atol=1e-15)
        assert work[name][0] == 0.0
    given = sum(values[-1] for values in work.values())
    assert given == pytest.approx(report.actuators.net_work.sum(), abs=1e-12)


@pytest.mark.parametrize("order", [1, 2])
def test_rates_and_accelerations_are_the_slopes_of_what_is_drawn_before(pollard, order):
    report = pollard_pin.trajectory_report(pollard, appendix_b(duration=10.0), samples=1501)
    below, above = (drawn(curves.joints(report, k)) for k in (order - 1, order))
    assert sorted(above) == sorted(JOINT_SYMBOLS)
    for name in JOINT_SYMBOLS:
        slope = np.gradient(below[name], report.joints.time)[1:-1]
        size = np.abs(above[name]).max()
        np.testing.assert_allclose(slope, above[name][1:-1], atol=0.02 * size + 1e-6)


def test_the_path_is_the_spray_tips_in_millimetres(report):
    ahead, above = curves.path_from_ahead(report).curves
    tip = report.motion.pose[:, :3] * 1e3
    np.testing.assert_array_equal([ahead.x, ahead.y], tip[:, 1:].T)
    np.testing.assert_array_equal([above.x, above.y], tip[:, [1, 0]].T)


def test_every_figure_comes_as_png_and_svg(report):
    names = ("positions", "velocities", "accelerations", "actuators", "margins", "tool")
    files = figures(report)
    assert {name[:-4] for name in files if name.endswith(".png")} == set(NUMBERS)
    drawn = {name: content for name, content in files.items() if name.endswith(("png", "svg"))}
    assert set(drawn) == {f"{name}.{kind}" for name in names for kind in ("png", "svg")}
    for name, content in drawn.items():
        assert content.startswith(b"\x89PNG" if name.endswith("png") else b"<?xml")


def test_the_tool_s_speed_is_drawn_in_metres_a_second(report):
    (plot,) = [plot for plot in curves.plots(report) if plot.label == "speed [m/s]"]
    (curve,) = plot.curves
    np.testing.assert_array_equal(curve.y, report.tool_speed)
