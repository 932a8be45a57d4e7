"""Rows of Pollard-like robots, held against what `trajectory` says of the written-out designs."""

import tomllib
from pathlib import Path

import pytest
from designed import asked, row_of

import pollard_pin
import thesis_pin
from pollard_pin.cli import main
from thesis_pin.errors import BadInput, UnknownName

ROOT = Path(__file__).parents[4]
ARCH = str(ROOT / "examples" / "spray_arch.toml")


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({}, []),
        ({"path": ARCH}, ["--path", ARCH]),
        ({"duration": 5.0, "timing": "rest-to-rest"}, []),
        ({"path": ARCH, "placement": (0.02, 0.0, 0.01), "turn_deg": 20.0, "mirrored": True}, None),
    ],
)
def test_a_row_is_to_the_bit_what_trajectory_says_of_the_design(options, words, tmp_path):
    extra = ["joint_force", "joint_moment"]
    study = pollard_pin.path_study(samples=201, extra=extra, **options)
    texts = ("chain_*.x_43=0.33,0.34", "chain_0.links.*.mass=90%,110%")
    row, cells, files = row_of(study, *texts)
    assert row.status == "done"
    if words is None:
        place = ["--placement", "0.02", "0", "0.01", "--turn", "20", "--mirror"]
        words = ["--path", ARCH, *place]
    found = asked(main, "trajectory", tmp_path, files, *words, "--samples", "201")
    assert cells["within_limits"] == found["within_limits"]
    assert cells["base_torque"] == max(found["peak_torque"][:3])
    assert cells["wrist_torque"] == max(found["peak_torque"][3:])
    assert cells["base_rms_torque"] == max(found["rms_torque"][:3])
    assert cells["peak_speed"] == max(found["peak_speed"])
    assert cells["reach_margin"] == found["margin"]["least"]
    assert cells["condition"] == found["condition"]["largest"]
    assert cells["loop_force"] == max(found["peak_loop_force"])
    assert cells["work"] == found["energy"]["exchanged"]
    assert cells["joint_force"] == max(found["peak_joint_force"])
    assert cells["joint_moment"] == max(found["peak_joint_moment"])
    use = found["motor_limits"]
    assert cells["motor_use"] == max(*use["torque_share"], *use["speed_share"])
    assert ("--turn=20" in files["best.toml"].decode()) == ("turn_deg" in options)


def test_a_path_that_varies_is_written_out_and_followed_alike(tmp_path):
    study = pollard_pin.path_study(path=ARCH, samples=201)
    _, cells, files = row_of(study, "path.segments.0.duration=3,2.5")
    assert tomllib.loads(files["best_path.toml"].decode())["segments"][0]["duration"] == 2.5
    words = ("--path", str(tmp_path / "best_path.toml"), "--samples", "201")
    found = asked(main, "trajectory", tmp_path, files, *words)
    assert cells["base_torque"] == max(found["peak_torque"][:3])
    assert cells["duration"] == 4.5


def test_a_place_that_varies_is_where_the_flags_put_the_path(tmp_path):
    study = pollard_pin.path_study(path=ARCH, samples=201)
    texts = ("place.position.0=0,0.02", "place.turn_deg=0,-15", "place.mirrored=false,true")
    _, cells, files = row_of(study, *texts)
    place = ("--placement", "0.02", "0", "0", "--turn=-15", "--mirror")
    found = asked(main, "trajectory", tmp_path, files, "--path", ARCH, *place, "--samples", "201")
    assert cells["base_torque"] == max(found["peak_torque"][:3])
    assert cells["reach_margin"] == found["margin"]["least"]
    assert "--placement 0.02 0.0 0.0 --turn=-15.0 --mirror" in files["best.toml"].decode()
    with pytest.raises(BadInput, match=r"place.mirrored is False and can't be 1.0"):
        thesis_pin.make_designs(study, ["place.mirrored=1"])


def test_a_path_of_samples_is_the_same_for_every_design(tmp_path):
    file = tmp_path / "arch.csv"
    main(["convert", "--path", ARCH, "--to", str(file), "--as", "poses", "--samples", "201"])
    study = pollard_pin.path_study(path=str(file), samples=101, smooth="none")
    _, cells, _ = row_of(study, "chain_*.x_43=0.33,0.34")
    with pytest.raises(UnknownName):
        thesis_pin.make_designs(study, ["path.speed=1,2"])
    (tmp_path / "best.toml").write_bytes(row_of(study, "chain_*.x_43=0.34")[2]["best.toml"])
    robot = pollard_pin.load(tmp_path / "best.toml")
    path = pollard_pin.load_path(str(file), smooth="none")
    report = pollard_pin.trajectory_report(robot, path, samples=101)
    assert cells["base_torque"] == report.actuators.peak_torque[:3].max()


@pytest.mark.parametrize(
    ("text", "status", "reason"),
    [
        ("chain_1.x_43=-1", "invalid", "chain_1.x_43"),
        ("chain_*.x_87=0.1", "impossible", "can't close"),
        ("place.position.0=0.5", "impossible", ""),
    ],
)
def test_a_robot_that_cant_be_is_a_row_with_its_reason(text, status, reason):
    row, cells, _ = row_of(pollard_pin.path_study(samples=41), text)
    assert row.status == status
    assert reason in row.reason
    assert set(cells.values()) == {None}


def test_what_belongs_to_another_kind_of_path_is_refused():
    with pytest.raises(BadInput, match="duration belongs to appendix B"):
        pollard_pin.path_study(path=ARCH, duration=3.0)
    with pytest.raises(BadInput, match="feed belongs to a path from a table"):
        pollard_pin.path_study(feed=0.1)


def test_the_smallest_base_motors_do_the_path_and_a_twentieth_less_doesnt():
    study = pollard_pin.path_study(samples=201, extra=["smallest_base"])
    _, cells, _ = row_of(study, "chain_*.x_43=0.34")
    least = cells["smallest_base"]
    assert least >= cells["base_torque"] * (1 - 1e-9)
    rating = 0.5 * least
    assert cells["base_torque"] > 0.999 * least or cells["base_rms_torque"] > 0.999 * rating
