"""Plots and tables of a try show what was walked, in the units that they say."""

import math

import numpy as np
import pytest

from scout_pin.study.simulate.curves import figures, loads, torques, ways
from scout_pin.study.simulate.tables import steps_table
from thesis_pin.report.draws import draws_tables


def test_ways_are_those_of_each_sole_beside_its_plan(walked):
    """Of a walk that keeps to its plan: 20 mm ahead, the left foot on the left."""
    curves = {curve.name: curve for curve in ways(walked).curves}
    for side, sign in (("left", -1.0), ("right", 1.0)):
        found, planned = curves[f"{side} sole"], curves[f"{side}, planned"]
        assert (sign * found.x > 20.0).all()
        np.testing.assert_allclose(found.x, planned.x, atol=1.0)
        np.testing.assert_allclose(found.y, planned.y, atol=1.0)
        assert found.y[-1] - found.y[0] == pytest.approx(20.0, abs=0.5)


def test_loads_and_torques_are_those_of_their_side(walked):
    """Where one foot alone is planned to stand, it bears the weight."""
    left, right = (curve.y for curve in loads(walked).curves)
    time, weight = walked.plan.time, walked.report.robot.mass * 9.81
    off = walked.plan.low > 5e-3
    assert (left[off[1]] > 0.8 * weight).all()
    assert (right[off[0]] > 0.8 * weight).all()
    assert off.any(axis=1).all()
    assert len(time) == len(left)
    for leg in (0, 1):
        drawn = [curve.y for curve in torques(walked, leg).curves]
        mine = slice(6 * leg, 6 * leg + 6)
        np.testing.assert_array_equal(drawn[::2], walked.walked.torque[:, mine].T)
        np.testing.assert_array_equal(drawn[1::2], walked.plan.torque[:, mine].T)


def test_tables_are_in_the_units_that_they_name(walked):
    names = ("distance", "sideways", "heading", "slip", "tilt", "saturated", "peak_torque")
    spread = {name: [0.25, 0.25] for name in names}
    (table,) = draws_tables(spread)
    found = {row[0]: row[1] for row in table.rows}
    angle = f"{math.degrees(0.25):.3f}"
    assert found == {
        "distance [mm]": "250.000",
        "sideways [mm]": "250.000",
        "heading [°]": angle,
        "slip [mm]": "250.000",
        "tilt [°]": angle,
        "saturated [%]": "25.000",
        "peak torque [N·m]": "0.250",
    }
    (worst, *_) = sorted(walked.draws[0].slips, key=lambda one: -one.distance)
    slips = [float(row[3]) for row in steps_table(walked).rows]
    assert max(slips) == pytest.approx(1e3 * worst.distance, abs=5e-4)


def test_the_world_that_is_written_is_the_one_it_walked_in(walked):
    import mujoco

    model = mujoco.MjModel.from_xml_string(figures(walked)["world.xml"].decode())
    assert model.opt.timestep == walked.plan.step == 1e-3
    assert model.nu == 12
