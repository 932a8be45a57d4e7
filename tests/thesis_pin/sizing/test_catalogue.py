"""Lists of servos as people have them."""

import math

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
        ("name,torque_Nm,max_torque_Nm,speed_rpm\nA,1,1,5\n", "both say the stall torque"),
        (
            "name,torque_Nm,torque_ozin,speed_rpm\nA,1,1416,5\n",
            r"list\.csv:2: torque_ozin: it says a stall torque of 9\.999 N·m, and another.* 1 N·m",
        ),
        ("name,torque_Nm,speed_rpm,rated_Nm\nTotal,,,\n", r"list\.csv:2: Total: it has no stall"),
        ("name,torque_Nm,speed_rpm\nA,1,5\nA,2,5\n", "'A' is listed 2 times"),
        ("name,torque_Nm,speed_rpm,mass_6V_g\nA,1,5,3\n", "can't depend on the voltage"),
        ("name,torque_Nm,torque_Nm,speed_rpm\nA,1,2,5\n", "columns 2 and 3 are both called"),
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


def test_a_shop_s_list_is_read_with_its_prices_brands_gears_and_gaps(listed):
    found = listed(
        "Brand,Model,Type,Gear,Torque (kg-cm),Torque (oz-in),Speed (sec/60º),Weight (g),Voltage,"
        "Rated torque (kg-cm),Dimensions (LxWxH mm),Price\n"
        'H,HS-1,digital,Metal,4.4,61,0.23,44,4.8-6V,n/a,40.7x20.5x39.5,"1,299.00"\n'
        'H,HS-2,analog,Nylon,8.8,122.2,0.2,50,6,2,"40,7 x 20,5 x 39,5","$19.90"\n'
        "H,HS-3,analog,Nylon,,,0.2,50,6,,,\n"
    )
    one, two = found.actuators
    assert (one.name, two.name) == ("HS-1", "HS-2")
    assert one.stall_torque == pytest.approx(4.4 * 0.0980665)
    assert one.no_load_speed == pytest.approx(math.pi / 3 / 0.23)
    assert (one.voltage, one.rated_torque, two.voltage) == (None, None, 6.0)
    assert one.size == two.size == pytest.approx((0.0407, 0.0205, 0.0395))
    assert one.extra == {
        "Brand": "H",
        "Type": "digital",
        "Gear": "Metal",
        "Voltage": "4.8-6V",
        "Price": "1,299.00",
    }
    assert one.notes == ("nothing says at which voltage of 4.8-6V its torque and speed hold",)
    said = " ".join(found.notes)
    assert "says the stall torque twice: Torque (kg-cm) is used, Torque (oz-in) agrees" in said
    assert "list.csv:4: HS-3: it has no stall torque, and is left out" in said


@pytest.mark.parametrize(
    ("cell", "edges"),
    [
        ("40 x 20 x 38", (0.04, 0.02, 0.038)),
        ("40×20×38 mm", (0.04, 0.02, 0.038)),
        ("40mm x 20mm x 38mm", (0.04, 0.02, 0.038)),
        ("4 x 2 x 3,8 cm", (0.04, 0.02, 0.038)),
        ('1.6" x 0.8" x 1.4"', (1.6 * 0.0254, 0.8 * 0.0254, 1.4 * 0.0254)),
        ("0.04 x 0.02 x 0.038", (0.04, 0.02, 0.038)),
    ],
)
def test_sizes_are_read_as_sheets_write_them(listed, cell, edges):
    quoted = '"' + cell.replace('"', '""') + '"'
    (one,) = listed(f"name,torque_Nm,speed_rpm,size\nA,1,50,{quoted}\n").actuators
    assert one.size == pytest.approx(edges)


@pytest.mark.parametrize("cell", ["40 mm x 20 cm x 38", "40x20x38 in", "40x20x0"])
def test_a_size_that_contradicts_itself_or_its_heading_is_refused(listed, cell):
    with pytest.raises(BadInput, match="isn't a size"):
        listed(f"name,torque_Nm,speed_rpm,size_mm\nA,1,50,{cell}\n")


def test_edges_and_inertias_without_a_unit_are_said(listed):
    found = listed(
        "name,torque_Nm,speed_rpm,length,width,height,rotor inertia\nA,1,50,40,20,38,1e-8\n"
    )
    assert found.actuators[0].size == pytest.approx((0.04, 0.02, 0.038))
    said = " ".join(found.notes)
    assert "no unit of rotor inertia (kg·m²)" in said
    assert "no unit of length, width, height: taken as mm" in said


def test_a_refused_voltage_is_answered_with_those_there_are(listed):
    with pytest.raises(BadInput, match=r"no servo for 5 V; allowed: one of 6 V, 7\.4 V"):
        listed("name,torque_Nm,speed_rpm,voltage\nA,1,50,7.4\nB,1,50,6\n", voltage=5.0)
