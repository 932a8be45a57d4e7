"""Drawn robots weigh what they say, and are the same however the work is shared."""

import math

import numpy as np
import pinocchio as pin
import pytest

import pollard_pin
from pollard_pin.specification import LINK_NAMES
from pollard_pin.study.simulate.draws import simulate_path, weighed
from thesis_pin.report.draws import draws_tables

pytest.importorskip("mujoco", reason="MuJoCo isn't installed: pip install 'thesis-pin[simulate]'")


@pytest.mark.parametrize("inertia", ["physical", "printed"])
def test_a_robot_twice_as_heavy_needs_twice_the_torques(inertia, rng):
    plain = pollard_pin.load(inertia=inertia)
    heavy = pollard_pin.Pollard(weighed(plain.specification, np.full(9, 2.0)), inertia)
    for q, v, a in rng.uniform(-1, 1, (5, 3, 12)):
        one = pin.rnea(plain.model, plain.model.createData(), q, v, a)
        two = pin.rnea(heavy.model, heavy.model.createData(), q, v, a)
        np.testing.assert_allclose(two, 2 * one, atol=1e-12)


def test_each_body_takes_its_own_factor(pollard):
    scale = 1 + 0.05 * np.arange(9.0)
    heavy = weighed(pollard.specification, scale)
    for name, factor in zip(LINK_NAMES, scale, strict=True):
        old, new = pollard.specification.links[name], heavy.links[name]
        assert new.mass == pytest.approx(factor * old.mass, rel=1e-15)
        assert heavy.com(name) == pytest.approx(pollard.specification.com(name))
        np.testing.assert_allclose(
            heavy.centroidal(name), factor * pollard.specification.centroidal(name), rtol=1e-12
        )


def test_draws_are_the_same_for_any_number_of_processes(short_report, held):
    given = {"mass_error": 0.05, "servo_zero_error": 1e-3, "draws": 3, "time_step": 1e-3}
    alone = simulate_path(short_report, held(jobs=1, **given))
    shared = simulate_path(short_report, held(jobs=2, **given))
    assert len({one.deviation[0] for one in alone.draws}) == 3
    for one, other in zip(alone.draws, shared.draws, strict=True):
        np.testing.assert_array_equal(one.mass_scale, other.mass_scale)
        np.testing.assert_array_equal(one.servo_zero, other.servo_zero)
        assert one.deviation == other.deviation
        assert one.ended == other.ended


def test_a_draw_of_a_seed_is_the_same_however_many_there_are(short_report, held):
    one, two = (
        simulate_path(
            short_report, held(mass_error=0.05, draws=n, jobs=1, seed=7, time_step=1e-3)
        ).draws[0]
        for n in (1, 2)
    )
    np.testing.assert_array_equal(one.mass_scale, two.mass_scale)
    assert one.deviation == two.deviation


def test_a_servo_that_reads_too_much_stands_so_much_too_low(short_report, held):
    """Against gravity it gives way by nothing: the plan's torque carries the load."""
    done = simulate_path(short_report, held(servo_zero_error=2e-4, seed=1))
    motors = list(short_report.robot.actuated)
    off = (done.replay.q - done.replay.planned)[-1, motors]
    # The load's change over the error is some percent of the servo's stiffness.
    np.testing.assert_allclose(off, -done.draws[0].servo_zero, atol=0.2 * 2e-4)


def test_draws_that_fail_are_counted_and_the_worst_is_told(short_report, held):
    done = simulate_path(short_report, held(servo_zero_error=3e-3, draws=4, jobs=1, time_step=1e-3))
    lost = [one.deviation[0] > 1e-3 for one in done.draws]
    assert any(lost)
    assert not done.passed
    said = done.verdict()
    assert said[0].startswith("FAIL")
    assert said[0].endswith(f" in {sum(lost)} of 4 draws.")
    assert f"{4 - sum(lost)} of 4 draws keep all that is asked." in said
    assert f"{sum(lost)} of 4 fail by how far the tool is off its path." in said
    worst = int(np.argmax([one.deviation[0] for one in done.draws]))
    assert any(one.startswith(f"Draw {worst}: The spray tip leaves its path") for one in said)
    assert done.summary()["draws_passed"] == 4 - sum(lost)
    _, second, third, most = sorted(1e3 * one.deviation[0] for one in done.draws)
    median = f"{(second + third) / 2:.3g} mm in the median, by {most:.3g} mm at most"
    assert any(median in one for one in said)


def test_draws_stand_in_the_units_that_their_table_names():
    names = ("deviation", "turn", "saturated", "peak_torque")
    spread = {name: [0.25, 0.25] for name in names}
    (table,) = draws_tables(spread)
    found = {row[0]: row[1] for row in table.rows}
    assert found == {
        "deviation [mm]": "250.000",
        "turn [°]": f"{math.degrees(0.25):.3f}",
        "saturated [%]": "25.000",
        "peak torque [N·m]": "0.250",
    }
