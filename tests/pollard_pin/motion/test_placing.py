"""Paths put elsewhere: a rigid body with its tool, held against SciPy and differences."""

import copy
import pickle

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import pollard_pin
from pollard_pin.coordinates import pose_rotation
from pollard_pin.motion.curves import line
from pollard_pin.motion.placing import Placement, middle, place_path
from pollard_pin.report.document import trajectory_report
from thesis_pin.errors import BadInput

PLACED = [
    Placement((0.1, -0.2, 0.3)),
    Placement((0.0, 0.0, 0.0), 0.7),
    Placement((0.02, 0.03, -0.1), -2.5, True),
    Placement(mirrored=True),
]


def nodding():
    """A path that moves and turns about every axis, its tool along no symmetry."""
    return line([0.4, -0.1, 0.0, 0.3, -0.2, 0.5], [0.5, 0.15, 0.1, -0.4, 0.6, -0.3], 2.0)


@pytest.mark.parametrize("placement", PLACED)
def test_every_point_of_part_and_tool_goes_where_a_rigid_body_does(placement):
    path = nodding()
    placed, about = place_path(path, placement), middle(path)
    time = np.linspace(0.0, 2.0, 41)
    one, other = path.at(time).tool, placed.at(time).tool
    image = np.diag([1.0, -1.0 if placement.mirrored else 1.0, 1.0])
    turn = Rotation.from_euler("z", placement.turn).as_matrix() @ image
    for axis in range(4):  # the tip, and the ends of the tool's axes
        local = np.eye(4)[axis, :3]
        before = one.position + one.rotation @ local
        after = other.position + other.rotation @ (image @ local)
        want = (before - about) @ turn.T + about + placement.position
        np.testing.assert_allclose(after, want, atol=1e-14)
    np.testing.assert_allclose(np.linalg.det(other.rotation), 1.0, atol=1e-14)


@pytest.mark.parametrize("placement", PLACED)
def test_rates_and_accelerations_are_the_derivatives_of_what_is_placed(placement):
    placed, step = place_path(nodding(), placement), 1e-5
    time = np.linspace(0.1, 1.9, 19)
    before, here, after = (placed.at(time + k * step).tool for k in (-1, 0, 1))
    np.testing.assert_allclose(
        here.velocity, (after.position - before.position) / (2 * step), atol=1e-9
    )
    np.testing.assert_allclose(
        here.acceleration, (after.velocity - before.velocity) / (2 * step), atol=1e-8
    )
    turned = Rotation.from_matrix(after.rotation @ before.rotation.swapaxes(1, 2)).as_rotvec()
    np.testing.assert_allclose(here.omega, turned / (2 * step), atol=1e-8)
    np.testing.assert_allclose(here.alpha, (after.omega - before.omega) / (2 * step), atol=1e-8)


@pytest.mark.parametrize("placement", PLACED)
def test_angles_name_the_orientation_without_jumps(placement):
    motion = place_path(nodding(), placement).sample(301)
    np.testing.assert_allclose(pose_rotation(motion.pose), motion.tool.rotation, atol=1e-14)
    assert np.abs(np.diff(motion.pose[:, 3:], axis=0)).max() < 0.1


def test_a_placement_of_appendix_b_is_the_one_of_the_curve_itself():
    own = pollard_pin.appendix_b(placement=[0.5, 0.01, 0.1]).sample(201)
    moved = place_path(
        pollard_pin.appendix_b(placement=[0.0, 0.0, 0.0]), Placement((0.5, 0.01, 0.1))
    )
    np.testing.assert_array_equal(moved.sample(201).pose, own.pose)


def test_nothing_done_is_the_path_itself_and_twice_mirrored_too():
    path = nodding()
    assert place_path(path, Placement()) is path
    once = place_path(path, Placement(mirrored=True))
    twice = place_path(once, Placement(mirrored=True))
    np.testing.assert_allclose(twice.sample(21).pose, path.sample(21).pose, atol=1e-14)
    assert len(twice.parameters["placed"]) == 2


def test_what_is_done_stands_in_parameters_and_notes():
    path = nodding()
    placed = place_path(path, Placement((0.1, 0.0, 0.0), np.pi / 6, True))
    (told,) = placed.parameters["placed"]
    assert told["turn"] == pytest.approx(np.pi / 6)
    assert told["mirrored"]
    np.testing.assert_allclose(told["middle"], [0.45, 0.025, 0.05], atol=1e-15)
    assert placed.notes[-1] == (
        "the path is mirrored in the plane y = 0.025 m through its middle, turned by 30° about the "
        "vertical at (0.45, 0.025) m, its middle, moved by (0.1, 0, 0) m"
    )


def test_what_samples_leave_open_goes_with_the_path(pollard, tmp_path):
    """Samples written elsewhere, and samples put there."""
    time = np.linspace(0.0, 2.0, 101)
    y = np.round(0.1 * np.sin(np.pi * time), 4)
    files = []
    for name, x in (("here", 0.45), ("there", 0.5)):
        rows = [
            f"{t:.2f},{x:.4f},{value:.4f},0.0500,0,0,0" for t, value in zip(time, y, strict=True)
        ]
        files.append(tmp_path / f"{name}.csv")
        files[-1].write_text("\n".join(["t,x,y,z,psi,theta,phi", *rows]) + "\n")
    here, there = map(pollard_pin.load_path, files)
    placed = place_path(here, Placement((0.05, 0.0, 0.0)))
    want, found = (
        trajectory_report(pollard, one, samples=101).headlines for one in (there, placed)
    )
    for one, other in zip(want.torque_use, found.torque_use, strict=True):
        np.testing.assert_allclose(
            [other.low, other.value, other.high],
            [one.low, one.value, one.high],
            rtol=1e-6,
            atol=1e-15,
        )
    assert want.torque_use[0].high > 1.001 * want.torque_use[0].low


def test_a_turned_path_of_samples_has_its_variants_turned(pollard, tmp_path):
    time = np.linspace(0.0, 2.0, 51)
    rows = [
        f"{t:.2f},{0.45 + 0.02 * np.sin(3 * t):.4f},{0.05 * np.cos(t):.4f},0,0,0,0" for t in time
    ]
    (tmp_path / "path.csv").write_text("\n".join(["t,x,y,z,psi,theta,phi", *rows]) + "\n")
    path = pollard_pin.load_path(tmp_path / "path.csv")
    placement = Placement((0.0, 0.0, 0.1), 0.3)
    at = np.linspace(0.0, 2.0, 7)
    before = path.variants.others(at)
    turned = place_path(path, placement)
    about, turn = middle(path), Rotation.from_euler("z", 0.3)
    np.testing.assert_allclose(
        turned.variants.others(at).position,
        turn.apply(before.position - about) + about + [0.0, 0.0, 0.1],
        atol=1e-14,
    )
    again = place_path(turned, Placement((0.1, 0.0, 0.0))).variants.others(at)
    np.testing.assert_allclose(
        again.position[:, 0], turned.variants.others(at).position[:, 0] + 0.1, atol=1e-14
    )


def test_placed_paths_travel():
    placed = place_path(nodding(), PLACED[2])
    for other in (pickle.loads(pickle.dumps(placed)), copy.deepcopy(placed)):
        np.testing.assert_array_equal(other.sample(11).pose, placed.sample(11).pose)


@pytest.mark.parametrize(
    "wrong",
    [{"position": [0, 0]}, {"position": [0, 0, np.nan]}, {"turn": np.inf}, {"mirrored": "yes"}],
)
def test_placements_that_are_none_are_refused(wrong):
    with pytest.raises(BadInput):
        Placement.of(**wrong)
