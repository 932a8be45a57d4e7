"""Path files with a law: what is read is what was written, and mistakes are named."""

import numpy as np
import pytest

import pollard_pin
from pollard_pin.motion.curves import arc, joined, line
from pollard_pin.motion.law_file import law_toml
from pollard_pin.motion.placing import Placement, place_path
from thesis_pin.errors import SpecificationError, TrajectoryError

TORQUE = [2.0, 2.0, 2.0, 0.05, 0.05, 0.05]


def arch():
    first, last = [0.45, -0.15, 0.0, 0.1, 0.0, 0.0], [0.45, 0.15, 0.0, 0.0, 0.26, 0.17]
    there = arc(first, [0.5, 0.0, 0.12], last, 3.0)
    back = line(last, first, 2.0)
    return joined([there, back])


PATHS = {
    "arch": arch,
    "placed": lambda: place_path(arch(), Placement.of((0.02, 0.0, -0.03), 0.3, True)),
    "appendix B": pollard_pin.appendix_b,
}


@pytest.fixture(scope="module", params=PATHS)
def timed(request, pollard):
    limits = pollard_pin.motor_limits(pollard.specification, torque=TORQUE, speed=10.0)
    return pollard_pin.time_path(pollard, PATHS[request.param](), limits)


@pytest.fixture(scope="module")
def written(timed, tmp_path_factory):
    file = tmp_path_factory.mktemp("law") / "path.toml"
    file.write_text(law_toml("fast", timed.course.track.chain, timed.law), encoding="utf-8")
    return file


def test_what_is_read_is_what_was_written(timed, written):
    path = pollard_pin.load_path(written)
    assert path.name == "fast"
    assert path.duration == pytest.approx(timed.duration, rel=1e-11)
    assert written.stat().st_size < 2**20
    own, read = timed.path.sample(20_001), path.sample(20_001)
    np.testing.assert_allclose(read.pose, own.pose, atol=2e-8)
    for name in ("velocity", "omega"):
        one, other = (getattr(motion.tool, name) for motion in (read, own))
        np.testing.assert_allclose(one, other, atol=1e-5 * np.abs(other).max())


def test_the_report_on_the_file_keeps_the_limits(pollard, written):
    report = pollard_pin.trajectory_report(pollard, pollard_pin.load_path(written), samples=40_001)
    share = np.abs(report.torque).max(axis=0) / TORQUE
    assert 0.99 < share.max() <= 1.0
    assert np.abs(report.speed).max() <= 10.0


def test_its_geometry_can_be_timed_anew(pollard, timed, written):
    again = pollard_pin.time_path(pollard, pollard_pin.load_path(written), timed.limits)
    assert again.duration == pytest.approx(timed.duration, rel=5e-3)


PIECES = """
[[pieces]]
way = [0.0, 0.1, 0.2]
position = [[0.45, 0.0, 0.0], [0.45, 0.1, 0.0], [0.45, 0.2, 0.0]]
orientation_deg = [[0, 0, 0], [0, 0, 0], [0, 0, 0]]
"""
LAW = "[law]\ntime = [0.0, 1.0, 2.0]\nrate = [0.0, 0.2, 0.0]\n"


def read(text, tmp_path):
    file = tmp_path / "path.toml"
    file.write_text(f"format = 1\n{text}", encoding="utf-8")
    return pollard_pin.load_path(file)


def test_a_law_by_hand_speeds_up_and_slows_down_evenly(tmp_path):
    motion = read(LAW + PIECES, tmp_path).sample(5)
    np.testing.assert_allclose(motion.pose[:, 1], [0.0, 0.025, 0.1, 0.175, 0.2], atol=1e-12)
    np.testing.assert_allclose(motion.tool.velocity[:, 1], [0, 0.1, 0.2, 0.1, 0], atol=1e-12)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (LAW, "need"),
        (PIECES, "need each other"),
        (LAW.replace("2.0]", "0.5]") + PIECES, "it must increase"),
        (LAW.replace("0.2, 0.0]", "0.2]") + PIECES, "has 2 values for 3 times"),
        (LAW.replace("0.2, 0.0]", "0.0, 0.0]") + PIECES, "zero twice in a row"),
        (LAW.replace("0.2, 0.0]", "-0.2, 0.0]") + PIECES, "rate"),
        (LAW + PIECES.replace("0.1, 0.2]\npos", "0.1, 0.05]\npos"), "it must increase"),
        (LAW + PIECES.replace(", [0, 0, 0]]", "]"), "2 rows for 3 nodes"),
        ('interpolation = "free"\n' + LAW + PIECES, "means nothing beside"),
    ],
)
def test_mistakes_are_named_with_their_place(text, told, tmp_path):
    with pytest.raises(SpecificationError, match=told) as caught:
        read(text, tmp_path)
    assert "path.toml" in str(caught.value)


SECOND = PIECES.replace("0.0, 0.1, 0.2]\npos", "0.2, 0.3, 0.4]\npos").replace(
    "[[0.45, 0.0, 0.0], [0.45, 0.1, 0.0], [0.45, 0.2, 0.0]]",
    "[[0.45, 0.2, 0.0], [0.45, 0.2, 0.1], [0.45, 0.2, 0.2]]",
)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (LAW.replace("0.2, 0.0]", "0.3, 0.0]") + PIECES, "the law goes 0.3 along"),
        (LAW.replace("0.2,", "0.4,") + PIECES + SECOND, "rate jumps"),
        (LAW + PIECES + SECOND.replace("0.2, 0.3", "0.25, 0.3"), "one way"),
    ],
)
def test_laws_and_pieces_that_do_not_fit_are_refused(text, told, tmp_path):
    with pytest.raises(TrajectoryError, match=told) as caught:
        read(text, tmp_path)
    assert "path.toml" in str(caught.value)


def test_a_law_that_rests_at_a_corner_turns_it(tmp_path):
    law = "[law]\ntime = [0, 1, 2, 3, 4]\nrate = [0.0, 0.2, 0.0, 0.2, 0.0]\n"
    motion = read(law + PIECES + SECOND, tmp_path).sample(9)
    np.testing.assert_allclose(motion.pose[4, :3], [0.45, 0.2, 0.0], atol=1e-12)
    np.testing.assert_allclose(motion.pose[-1, :3], [0.45, 0.2, 0.2], atol=1e-12)
