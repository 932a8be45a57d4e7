"""Rows of bipeds, held against the reports that `gait` makes of the written-out designs."""

import tomllib
from pathlib import Path

import numpy as np
import pytest
from designed import asked, row_of

import scout_pin
import thesis_pin
from scout_pin.cli import main
from scout_pin.study.sweeping.gaits import MEASURES
from thesis_pin.errors import BadInput, UnknownName

ROOT = Path(__file__).parents[4]
WALK = str(ROOT / "examples" / "walk.toml")


def test_a_row_is_to_the_bit_what_gait_says_of_the_design_that_is_written_out(tmp_path):
    study = scout_pin.gait_study(gait=WALK, samples=101, extra=["fastest_time_unit"])
    texts = ("legs.*.x_3=0.06,0.07", "servos.*.stall_torque=90%,70%", "torso.mass=0.2")
    row, cells, files = row_of(study, *texts)
    found = asked(main, "gait", tmp_path, files, "--gait", WALK, "--samples", "101")
    assert row.status == "done"
    assert cells["within_limits"] == found["within_limits"]
    assert cells["can_walk"] == found["can_walk"]
    assert cells["servos_carry"] == found["servos_carry"]
    assert cells["servo_use"] == max(found["servo_use"])
    assert cells["peak_torque"] == max(found["peak_torque"])
    assert cells["rms_torque"] == max(found["rms_torque"])
    assert cells["peak_speed"] == max(found["peak_speed"])
    assert cells["margin"] == found["worst_margin"]
    assert cells["friction_used"] == found["peak_friction_used"]
    assert cells["clearance"] == found["swing_clearance"]
    assert cells["fastest_time_unit"] == found["fastest_time_unit"]["line"]
    written = tomllib.loads(files["best.toml"].decode())
    assert written["legs"]["left"]["x_3"] == written["legs"]["right"]["x_3"] == 0.07
    assert written["servos"]["HS-5475HB"]["stall_torque"] == pytest.approx(0.7 * 0.432)
    assert set(files) == {"best.toml"}


def test_a_gait_that_varies_is_written_out_and_walked_alike(tmp_path):
    study = scout_pin.gait_study(gait=WALK, samples=101, repeat=2, branch="forward")
    _, cells, files = row_of(study, "gait.time_unit=0.05,0.04")
    assert tomllib.loads(files["best_gait.toml"].decode())["time_unit"] == 0.04
    gait = str(tmp_path / "best_gait.toml")
    more = ("--gait", gait, "--samples", "101", "--repeat", "2", "--branch", "forward")
    found = asked(main, "gait", tmp_path, files, *more)
    assert cells["servo_use"] == max(found["servo_use"])
    assert cells["margin"] == found["worst_margin"]


def test_what_is_said_of_the_gait_is_said_of_every_design(tmp_path):
    study = scout_pin.gait_study(gait=WALK, samples=101, time_unit=0.06, inertia="printed")
    _, cells, files = row_of(study, "torso.mass=0.2")
    words = ("--gait", WALK, "--samples", "101", "--time-unit", "0.06", "--inertia", "printed")
    found = asked(main, "gait", tmp_path, files, *words)
    assert cells["servo_use"] == max(found["servo_use"])
    assert cells["margin"] == found["worst_margin"]


def test_a_gait_of_samples_is_the_same_for_every_design(tmp_path):
    file = tmp_path / "walk.csv"
    words = ["--to", str(file), "--as", "poses", "--samples", "101"]
    assert main(["convert", "--gait", WALK, *words]) == 0
    study = scout_pin.gait_study(gait=str(file), samples=101, smooth="none")
    row, cells, _ = row_of(study, "torso.mass=0.2")
    robot = scout_pin.load()
    assert row.status == "done"
    changed = robot.specification.model_copy(
        update={"torso": robot.specification.torso.model_copy(update={"mass": 0.2})}
    )
    gait = scout_pin.load_gait(str(file), smooth="none")
    report = scout_pin.gait_report(scout_pin.load(changed), gait, samples=101)
    assert cells["peak_torque"] == report.actuators.peak_torque.max()
    with pytest.raises(UnknownName, match=r"unknown key 'gait.time_unit'"):
        thesis_pin.make_designs(study, ["gait.time_unit=1,2"])


def test_a_table_of_joint_angles_belongs_to_one_robot(tmp_path):
    file = tmp_path / "angles.csv"
    main(["convert", "--gait", WALK, "--to", str(file), "--as", "joints"])
    with pytest.raises(BadInput, match="belongs to one robot"):
        scout_pin.gait_study(gait=str(file))


@pytest.mark.parametrize(
    ("text", "status", "reason"),
    [
        ("torso.mass=-1", "invalid", "torso.mass"),
        ("legs.*.x_3=0.01", "impossible", "unreachable"),
        ("legs.*.servo=nonsense", "invalid", "unknown servo"),
    ],
)
def test_a_biped_that_cant_be_is_a_row_with_its_reason(text, status, reason):
    row, cells, _ = row_of(scout_pin.gait_study(gait=WALK, samples=41), text)
    assert row.status == status
    assert reason in row.reason
    assert "\n" not in row.reason
    assert set(cells.values()) == {None}


def test_what_nobody_builds_is_warned_of_in_its_row():
    study = scout_pin.gait_study(gait=WALK, samples=41)
    row, _, _ = row_of(study, "servos.*.stall_torque=432")
    assert row.status == "done"
    assert "HS-5475HB" in row.warnings


def test_a_motion_so_slow_that_its_time_must_be_doubted_is_warned_of_in_its_row():
    study = scout_pin.gait_study(gait=WALK, samples=41, time_unit=50.0)
    row, _, _ = row_of(study, "torso.mass=0.16")
    assert "so slow that inertia plays no part" in row.warnings


def test_the_smallest_servo_carries_the_gait_and_a_twentieth_less_doesnt():
    study = scout_pin.gait_study(gait=WALK, samples=201, extra=["smallest_servo"])
    _, cells, _ = row_of(study, "torso.mass=0.16")
    least = cells["smallest_servo"]
    for share, carried in ((1.001, True), (0.95, False)):
        _, now, _ = row_of(study, "torso.mass=0.16", f"servos.*.stall_torque={share * least}")
        rating_bound = now["rms_torque"] > 0.5 * share * least
        assert now["servos_carry"] == carried or rating_bound


def test_every_measure_has_a_name_of_its_own_and_says_what_it_is():
    names = [one.column.name for one in MEASURES]
    assert len(set(names)) == len(names)
    assert all(one.column.what for one in MEASURES)
    with pytest.raises(UnknownName, match="unknown measure 'nonsense'"):
        scout_pin.gait_study(extra=["nonsense"])


def test_numbers_of_the_columns_are_those_of_the_sweep():
    study = scout_pin.gait_study(gait=WALK, samples=41)
    designs = thesis_pin.make_designs(study, ["legs.*.x_3=0.06:0.08:3"])
    sweep = thesis_pin.sweep_designs(study, designs, jobs=1)
    np.testing.assert_array_equal(sweep.numbers("legs.*.x_3"), [0.06, 0.07, 0.08])
    rows = [row_of(study, "legs.*.x_3=0.06:0.08:3", design=k)[1] for k in range(3)]
    assert sweep.numbers("margin").tolist() == [row["margin"] for row in rows]
