"""Lists of servos as people have them."""

import pytest

from thesis_pin.errors import BadInput, SpecificationError
from thesis_pin.model.limits import LIMITS
from thesis_pin.sizing.catalogue import read_catalogue

KGCM = 0.0980665


@pytest.fixture
def listed(tmp_path):
    def read(text, name="list.csv", **options):
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return read_catalogue(path, **options)

    return read


def test_a_data_sheet_s_units_become_si_and_other_columns_are_carried_along(listed):
    text = (
        "Servo,Torque (kg-cm),Speed (sec/60°),Weight (g),Voltage,Rated torque [Nm],Size (mm),"
        "Rotor inertia (g·cm²),Gear ratio,Price\n"
        "A,4.4,0.23,45,4.8,0.1,38.8 x 19.8 x 36,0.4,250:1,19.90\n"
        "B,10,0.1,,6,,,,,\n"
    )
    one, two = listed(text).actuators
    assert one.name == "A"
    assert one.stall_torque == pytest.approx(4.4 * KGCM)
    assert one.no_load_speed == pytest.approx(4.553033, rel=1e-6)
    assert (one.mass, one.voltage, one.rated_torque) == (0.045, 4.8, 0.1)
    assert one.size == pytest.approx((0.0388, 0.0198, 0.036))
    assert one.armature == pytest.approx(0.4e-7 * 250**2)
    assert one.extra == {"Price": "19.90"}
    assert (two.mass, two.rated_torque, two.size, two.armature) == (None, None, None, 0.0)


def test_semicolons_and_decimal_commas_are_read_and_said(listed):
    found = listed("Servo;Torque (kg-cm);Speed_rpm\nA;4,4;43,5\nB;5,5;50\n")
    assert found.actuators[0].stall_torque == pytest.approx(4.4 * KGCM)
    assert "decimal commas" in found.notes[0]


def test_columns_for_several_voltages_make_a_servo_each(listed):
    text = (
        "servo,torque 4.8V (kg·cm),speed 4.8V (s/60°),torque 6V (kg·cm),speed 6V (s/60°)\n"
        "A,4.4,0.23,5.5,0.18\nB,,,9,0.2\n"
    )
    names = [one.name for one in listed(text).actuators]
    assert names == ["A at 4.8 V", "A at 6 V", "B"]
    only = listed(text, voltage=6.0)
    assert [(one.name, one.voltage) for one in only.actuators] == [("A", 6.0), ("B", 6.0)]
    assert only.actuators[0].stall_torque == pytest.approx(5.5 * KGCM)
    assert "1 are left out" in only.notes[-1]


def test_a_toml_list_says_the_same(listed):
    text = """
format = 1
[servos.A]
stall_torque_kgcm = 4.4
no_load_speed_s_per_60deg = 0.23
mass_g = 45
size_mm = [38.8, 19.8, 36]
price = "19.90"
"""
    (one,) = listed(text, "list.toml").actuators
    assert one.stall_torque == pytest.approx(4.4 * KGCM)
    assert one.no_load_speed == pytest.approx(4.553033, rel=1e-6)
    assert one.size == pytest.approx((0.0388, 0.0198, 0.036))
    assert one.extra == {"price": "19.90"}


def test_what_has_no_unit_is_si_and_said(listed):
    found = listed("name,torque,speed,mass\nA,0.4,4.5,0.05\n")
    assert found.actuators[0].stall_torque == 0.4
    assert "no unit of torque (N·m), speed (rad/s), mass (kg): taken so" in found.notes[0]


def test_units_may_stand_in_the_cells(listed):
    text = "servo\tTorque\tSpeed\tWeight\nA\t4.4 kg·cm\t0.23 s/60°\t45 g\nB\t1 N·m\t50rpm\t2 oz\n"
    found = listed(text)
    one, two = found.actuators
    assert one.stall_torque == pytest.approx(4.4 * KGCM)
    assert one.no_load_speed == pytest.approx(4.553033, rel=1e-6)
    assert (one.mass, two.stall_torque) == (0.045, 1.0)
    assert two.no_load_speed == pytest.approx(5.235988, rel=1e-6)
    assert not any("no unit" in note for note in found.notes)
    commas = listed("servo;Torque;Speed\nA;4,4 kg·cm;0,23 s/60°\n")
    assert commas.actuators[0].stall_torque == pytest.approx(4.4 * KGCM)


def test_thousands_are_not_taken_for_decimals(listed):
    with pytest.raises(BadInput, match="'1,250 g' isn't a number"):
        listed("name;torque_Nm;speed_rpm;mass\nA;1;50;1,250 g\n")


def test_a_cell_s_unit_may_not_contradict_its_heading(listed):
    with pytest.raises(BadInput, match=r"'4\.4 kg·cm' isn't a number"):
        listed("name,torque_Nm,speed_rpm\nA,4.4 kg·cm,50\n")


def test_a_servo_and_a_motor_of_one_name_are_two(listed):
    one = "stall_torque_Nm = 1\nno_load_speed_rpm = 50\n"
    with pytest.raises(BadInput, match="'A' is listed 2 times"):
        listed(f"[servos.A]\n{one}[motors.A]\n{one}", "list.toml")


def test_large_edges_without_a_unit_are_millimetres(listed):
    (one,) = listed("name,torque_Nm,speed_rpm,size\nA,1,50,40x20x38\n").actuators
    assert one.size == pytest.approx((0.04, 0.02, 0.038))


def test_several_files_make_one_list(tmp_path):
    for name in "ab":
        (tmp_path / f"{name}.csv").write_text(f"name,torque_Nm,speed_rpm\n{name},1,50\n")
    found = read_catalogue([tmp_path / "a.csv", tmp_path / "b.csv"])
    assert [one.name for one in found.actuators] == ["a", "b"]


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("name,torque_Nm\nA,1\n", "no column says the no-load speed; allowed: no_load_speed_rad_s"),
        ("servo,speed_rpm\nA,1\n", "no column says the stall torque.*'servo', 'speed_rpm'"),
        ("torque_Nm,speed_rpm\n1,2\n", "no column says the name"),
        ("name,torque_Nm,speed_rpm\nA,1,\n", r"list\.csv:2: A: it has no no-load speed"),
        ("name,torque_Nm,speed_rpm\nA,1,fast\n", r"list\.csv:2: speed_rpm: 'fast' isn't a number"),
        ("name,torque_Nm,speed_rpm\nA,-1,5\n", r"list\.csv:2: torque_Nm: it is -1; allowed"),
        ("name,torque_Nm,speed_rpm\nA,0,5\n", "it is 0; allowed: at least"),
        ("name,torque_Nm,speed_rpm\nA,inf,5\n", "'inf' isn't a number"),
        ("name,torque_Nm,speed_rpm,gear\nA,1,5,0\n", "gear: it is 0"),
        ("name,torque_Nm,speed_rpm,size_mm\nA,1,5,40x20\n", "'40x20' isn't a size"),
        ("name,torque_Nm,torque_kgcm,speed_rpm\nA,1,10,5\n", "both say the stall torque"),
        ("name,torque_Nm,speed_rpm\nA,1,5\nA,2,5\n", "'A' is listed 2 times"),
        ("name,torque_Nm,speed_rpm,mass_6V_g\nA,1,5,3\n", "can't depend on the voltage"),
        ("name,torque_Nm,speed_rpm\n,1,5\n", "it has no name"),
        ("name,torque_Nm,speed_rpm\n", "there is no servo"),
    ],
)
def test_what_can_t_be_read_is_told_with_its_place(listed, text, says):
    with pytest.raises(BadInput, match=says):
        listed(text)


def test_a_voltage_that_no_servo_is_for_is_refused(listed):
    with pytest.raises(BadInput, match="no servo for 5 V"):
        listed("name,torque_Nm,speed_rpm,voltage\nA,1,50,6\n", voltage=5.0)


def test_an_unknown_table_of_a_toml_list_is_refused(listed):
    with pytest.raises(SpecificationError, match="unknown key"):
        listed("[server.A]\nstall_torque = 1\n", "list.toml")


def test_more_servos_than_anybody_sells_are_refused(listed):
    rows = "".join(f"A{k},1,50\n" for k in range(LIMITS.entries + 1))
    with pytest.raises(BadInput, match="servos; allowed: at most"):
        listed("name,torque_Nm,speed_rpm\n" + rows)
