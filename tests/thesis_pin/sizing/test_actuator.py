"""An actuator's line, its rotor, and what no actuator is."""

import pytest

from thesis_pin.sizing.actuator import Actuator

BOX = (38.8e-3, 19.8e-3, 36.0e-3)  # 27.66 cm³


def test_power_is_a_quarter_of_stall_torque_times_speed():
    # τ(ω) = τ0 (1 − ω/ω0): the power ω τ0 (1 − ω/ω0) is largest at ω0/2, where it is τ0 ω0/4.
    assert Actuator("a", 0.432, 4.55).power == pytest.approx(0.4914)


def test_a_rotor_is_felt_with_the_square_of_its_gear_ratio():
    assert Actuator("a", 1, 1, rotor_inertia=1e-8, gear_ratio=250).armature == pytest.approx(
        6.25e-4
    )
    assert Actuator("a", 1, 1, reflected=0.01, rotor_inertia=1e-6, gear_ratio=-100).armature == (
        pytest.approx(0.02)
    )


def test_the_rating_is_half_of_stall_where_nobody_says_another():
    assert Actuator("a", 0.8, 1).rating == 0.4
    assert Actuator("a", 0.8, 1, rated_torque=0.1).rating == 0.1


def test_kilogram_centimetres_typed_as_newton_metres_are_seen_and_the_right_number_named():
    (said,) = Actuator("HS-5475HB", 4.4, 43.5, size=BOX).odd()
    assert "4.4 N·m and 43.5 rad/s make 48 W from 27.7 cm³" in said
    assert "in kg·cm it is 0.431 N·m" in said
    assert "in rpm it is 4.56 rad/s" in said


@pytest.mark.parametrize(
    "real",
    [
        Actuator("hobby servo", 0.432, 4.55, size=BOX, mass=0.045),
        Actuator("fast brushless servo", 4.4, 15.0, size=(0.04, 0.02, 0.04), mass=0.08),
        Actuator("smart servo", 8.4, 4.7, size=(40.2e-3, 65.1e-3, 46e-3), mass=0.153),
        Actuator("quadruped's drive", 17.0, 40.0, size=(0.096, 0.096, 0.04), mass=0.48),
        Actuator("nothing known", 1e6, 1e6),
    ],
)
def test_what_can_be_bought_is_not_odd(real):
    assert list(real.odd()) == []


def test_mass_tells_as_size_does():
    (said,) = Actuator("a", 4.4, 43.5, mass=0.045).odd()
    assert "48 W from 45 g" in said


def test_a_rating_above_stall_is_odd():
    (said,) = Actuator("a", 1.0, 5.0, rated_torque=1.2).odd()
    assert "rated torque of 1.2 N·m is above its stall torque of 1 N·m" in said


@pytest.mark.parametrize(("speed", "odd"), [(0.23, 1), (0.29, 1), (0.31, 0), (4.5, 0)])
def test_a_servo_so_slow_that_its_speed_must_be_in_another_unit_is_warned_of(speed, odd):
    said = list(Actuator("A", 0.4, speed).odd())
    assert len(said) == odd
    assert all("rpm or seconds in 60°" in one for one in said)


@pytest.mark.parametrize(
    ("ratio", "inertia", "odd"), [(0.005, 1e-8, 1), (0.005, 0.0, 0), (200, 1e-8, 0), (1, 1e-8, 0)]
)
def test_a_gear_that_speeds_a_rotor_up_is_asked_about(ratio, inertia, odd):
    said = list(Actuator("A", 0.4, 4.5, gear_ratio=ratio, rotor_inertia=inertia).odd())
    assert len(said) == odd
    assert all("the other way round, write 200" in one for one in said)
