"""Headings and units as data sheets and spreadsheets have them."""

import math

import pytest

from thesis_pin.sizing.units import understood


@pytest.mark.parametrize(
    ("heading", "quantity", "value", "si"),
    [
        ("stall_torque", "stall_torque", 0.432, 0.432),
        ("stall_torque_Nm", "stall_torque", 0.432, 0.432),
        ("Stall torque [N·m]", "stall_torque", 0.432, 0.432),
        ("stall_torque_kgcm", "stall_torque", 4.4, 0.4314926),  # 4.4 kg × 9.80665 N/kg × 0.01 m
        ("Torque (kg·cm)", "stall_torque", 4.4, 0.4314926),
        ("torque (kg-cm)", "stall_torque", 4.4, 0.4314926),
        ("torque [kgf.cm]", "stall_torque", 4.4, 0.4314926),
        ("Max torque (oz-in)", "stall_torque", 100, 0.7061552),  # NIST: 1 ozf·in = 7.061552e-3
        ("stall torque, N*cm", "stall_torque", 43.2, 0.432),
        ("stall_torque_mNm", "stall_torque", 432, 0.432),
        ("torque (lb-in)", "stall_torque", 10, 1.129848),  # NIST: 1 lbf·in = 0.1129848
        ("no_load_speed", "no_load_speed", 4.55, 4.55),
        ("no_load_speed_rad_s", "no_load_speed", 4.55, 4.55),
        ("speed (rad/s)", "no_load_speed", 4.55, 4.55),
        ("speed_rpm", "no_load_speed", 60, 2 * math.pi),
        ("No-load speed [1/min]", "no_load_speed", 60, 2 * math.pi),
        ("speed (s/60°)", "no_load_speed", 0.23, 4.553033),  # π/3 rad in 0.23 s
        ("Speed (sec/60deg)", "no_load_speed", 0.23, 4.553033),
        ("no_load_speed_s_per_60deg", "no_load_speed", 0.23, 4.553033),
        ("speed_deg_s", "no_load_speed", 180, math.pi),
        ("rated torque [Nm]", "rated_torque", 0.2, 0.2),
        ("weight (g)", "mass", 45, 0.045),
        ("mass_kg", "mass", 0.045, 0.045),
        ("Weight (oz)", "mass", 1, 0.028349523),
        ("rotor_inertia_gcm2", "rotor_inertia", 1, 1e-7),
        ("rotor inertia [kg·m²]", "rotor_inertia", 1e-7, 1e-7),
        ("Rotor inertia (kg*cm^2)", "rotor_inertia", 1, 1e-4),
        ("gear_ratio", "gear_ratio", 250, 250),
        ("Reduction", "gear_ratio", 250, 250),
        ("Voltage (V)", "voltage", 4.8, 4.8),
        ("length_mm", "length", 38.8, 0.0388),
        ("armature", "armature", 0.01, 0.01),
    ],
)
def test_a_heading_says_quantity_and_unit(heading, quantity, value, si):
    found = understood(heading)
    assert found.quantity == quantity
    assert found.si(value) == pytest.approx(si, rel=1e-6)


@pytest.mark.parametrize(
    ("heading", "voltage", "plain"),
    [
        ("torque 6V (kg·cm)", 6.0, False),
        ("stall_torque_4.8V_kgcm", 4.8, False),
        ("speed @ 7,4 V [s/60°]", 7.4, False),
        ("stall torque at 12V", 12.0, True),
        ("stall_torque", None, True),
        ("gear_ratio", None, False),
        ("voltage_V", None, False),
    ],
)
def test_a_heading_may_say_its_voltage_and_whether_it_says_a_unit(heading, voltage, plain):
    found = understood(heading)
    assert (found.voltage, found.plain) == (voltage, plain)


@pytest.mark.parametrize("heading", ["price", "torque_furlongs", "", "speedy", "bearing", "notes"])
def test_other_headings_are_left_alone(heading):
    assert understood(heading) is None
