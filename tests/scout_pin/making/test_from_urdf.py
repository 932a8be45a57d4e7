"""URDFs of the kind, wherever their frames are, become specifications of the same robot."""

import re

import numpy as np
import pinocchio as pin
import pytest

import scout_pin
from scout_pin.implausible import implausible
from scout_pin.making.from_urdf import from_urdf
from scout_pin.making.text import toml
from scout_pin.specification import JOINT_NAMES, SIDES, Specification
from scout_pin.urdf import write
from thesis_pin.model.specification import parse_toml

from .another import SOLE, Another, random_rotation, ros_biped, specification, written


@pytest.mark.parametrize("name", [None, "lopsided"])
def test_our_own_urdf_gives_the_same_robot(name, tmp_path, rng):
    spec = specification(name)
    write(spec, tmp_path)
    found = from_urdf(tmp_path / f"{spec.name}.urdf")
    assert (found.signs == 1).all()
    np.testing.assert_array_equal(found.torso, np.eye(4))
    assert found.joints == JOINT_NAMES
    text = parse_toml("specification", Specification, toml(found.specification, found.notes))
    assert text == found.specification
    one, other = scout_pin.load(spec), scout_pin.load(text)
    np.testing.assert_allclose(other.lower, one.lower, atol=1e-14)
    np.testing.assert_array_equal(other.stall_torque, one.stall_torque)
    np.testing.assert_array_equal(other.no_load_speed, one.no_load_speed)
    for _ in range(10):
        q = pin.integrate(one.model, pin.neutral(one.model), rng.uniform(-1, 1, 18))
        v, a = rng.normal(size=(2, 18))
        np.testing.assert_allclose(
            pin.rnea(other.model, other.data, q, v, a),
            pin.rnea(one.model, one.data, q, v, a),
            atol=1e-12,
        )
        feet = [robot.forward_kinematics(q[7:]) for robot in (one, other)]
        for side in SIDES:
            np.testing.assert_allclose(feet[1][side], feet[0][side], atol=1e-12)
    for side in SIDES:  # what a mesh holds, in single precision
        outlines = [np.array(sorted(s.leg(side).sole)) for s in (spec, text)]
        np.testing.assert_allclose(outlines[1], outlines[0], atol=1e-7)


def test_a_biped_written_for_ros_has_the_lengths_its_file_says(tmp_path):
    found = from_urdf(written(tmp_path / "ros.urdf", ros_biped()))
    spec = found.specification
    for side in SIDES:
        leg = spec.leg(side)
        lengths = [leg.x_0, leg.z_1, leg.x_2, leg.x_3, leg.x_4, leg.x_5, leg.y_6]
        np.testing.assert_allclose(lengths, [0.1, 0.05, 0, 0.25, 0.3, 0, 0.05], atol=1e-15)
        box = [(-0.04, -0.05), (-0.04, 0.11), (0.04, -0.05), (0.04, 0.11)]
        np.testing.assert_allclose(sorted(leg.sole), box, atol=1e-15)
    np.testing.assert_allclose(found.torso[:3, 1], [1, 0, 0], atol=1e-15)  # its x is forward
    assert spec.name == "ros_biped"
    assert spec.mass == pytest.approx(2.0 + 12 * 0.4)
    assert implausible(spec) == []
    feet = scout_pin.load(spec).neutral_feet()
    np.testing.assert_allclose(feet["left"][:3, 3], [-0.1, 0, -0.65], atol=1e-15)
    # A yaw axis that points down counts the other way.
    other = from_urdf(written(tmp_path / "down.urdf", ros_biped(yaw="0 0 -1")))
    assert [int(x) for x in other.signs] == [-1, 1, 1, 1, 1, 1] * 2
    lower, upper = other.specification.assumptions.joint_range.radians()
    np.testing.assert_allclose([lower[0], upper[0]], [-1.2, 1.5], atol=1e-12)


FLIPS = [
    (),
    ("left_hip_yaw", "right_hip_yaw"),
    ("left_knee_pitch", "right_ankle_pitch"),
    ("left_hip_roll", "left_hip_pitch", "right_ankle_roll"),
    JOINT_NAMES,
]


@pytest.mark.parametrize("name", [None, "lopsided"])
@pytest.mark.parametrize("flips", FLIPS)
def test_a_urdf_with_other_frames_and_axes_is_the_same_robot_by_pinocchio(
    flips, name, tmp_path, rng
):
    another = Another(specification(name), rng, flips)
    found = from_urdf(written(tmp_path / "another.urdf", another.text()))
    assert found.joints == tuple(f"{name}_servo" for name in JOINT_NAMES)
    file = pin.buildModelFromUrdf(str(tmp_path / "another.urdf"), pin.JointModelFreeFlyer())
    data = file.createData()
    mine = scout_pin.load(found.specification)
    torso = pin.SE3(found.torso)
    places = [file.joints[file.getJointId(joint)].idx_v for joint in found.joints]
    for _ in range(10):
        theta = rng.uniform(-1.0, 1.0, 12)
        rate, acceleration = rng.normal(size=(2, 12))
        base = pin.SE3(random_rotation(rng), rng.normal(size=3))
        q, v, a = (np.zeros(n) for n in (19, 18, 18))
        q[:7] = pin.SE3ToXYZQUAT(base)
        for k, place in enumerate(places):
            q[place + 1] = found.signs[k] * theta[k]
            v[place], a[place] = found.signs[k] * rate[k], found.signs[k] * acceleration[k]
        theirs = pin.rnea(file, data, q, v, a)
        own = np.concatenate([pin.SE3ToXYZQUAT(base * torso), theta])
        ours = pin.rnea(
            mine.model,
            mine.data,
            own,
            np.concatenate([np.zeros(6), rate]),
            np.concatenate([np.zeros(6), acceleration]),
        )
        np.testing.assert_allclose(ours[6:], found.signs * theirs[places], atol=1e-10)
        np.testing.assert_allclose(torso.actInv(pin.Force(theirs[:6])).vector, ours[:6], atol=1e-10)
        pin.framesForwardKinematics(file, data, q)
        feet = mine.forward_kinematics(theta, (base * torso).homogeneous)
        for side in SIDES:
            plate = data.oMf[file.getFrameId(f"{side}_sole_plate")].homogeneous
            corners = np.array(specification(name).leg(side).sole)
            low, high = corners.min(axis=0), corners.max(axis=0)
            box = [(x, y, 0.0, 1.0) for x in (low[0], high[0]) for y in (low[1], high[1])]
            there = (np.array(box) @ plate.T)[:, :3]
            here = mine.sole_vertices(side, feet[side])
            order = lambda points: points[np.lexsort(points.round(5).T)]  # noqa: E731
            np.testing.assert_allclose(order(here), order(there), atol=1e-6)
    for k in range(12):
        lo, hi = file.lowerPositionLimit[places[k] + 1], file.upperPositionLimit[places[k] + 1]
        limits = sorted((found.signs[k] * lo, found.signs[k] * hi))
        np.testing.assert_allclose([mine.lower[k], mine.upper[k]], limits, atol=1e-12)


@pytest.mark.parametrize("name", [None, "lopsided"])
def test_frames_of_sole_links_may_be_turned_at_will(name, tmp_path, rng):
    for _ in range(5):
        another = Another(specification(name), rng)
        path = written(tmp_path / "turned.urdf", another.text(turn=random_rotation(rng)))
        plain = written(tmp_path / "plain.urdf", another.text())
        found = [scout_pin.load(from_urdf(file).specification) for file in (plain, path)]
        for side in SIDES:
            feet = [robot.neutral_feet()[side] for robot in found]
            soles = [
                robot.sole_vertices(side, foot) for robot, foot in zip(found, feet, strict=True)
            ]
            for end in (np.min, np.max):
                np.testing.assert_allclose(end(soles[1], axis=0), end(soles[0], axis=0), atol=1e-6)
            assert abs(feet[1][2, 2] - 1.0) < 1e-12


def test_what_is_said_of_soles_counts_from_below_the_ankle_whatever_links_are_called(tmp_path, rng):
    another = Another(Specification.read(), rng)
    path = written(tmp_path / "named.urdf", another.text())
    found = [
        scout_pin.load(from_urdf(path, sole=(*SOLE[:4], h)).specification) for h in (0.02, 0.05)
    ]
    for side in SIDES:
        low, lower = (robot.neutral_feet()[side] for robot in found)
        np.testing.assert_allclose(low[:3, 3] - lower[:3, 3], [0.0, 0.0, 0.03], atol=1e-12)


def test_axes_rounded_to_four_digits_are_taken_and_said(tmp_path, rng):
    another = Another(Specification.read(), rng)
    number = re.compile(r"-?\d+\.\d+(e-\d+)?")
    text = "\n".join(
        number.sub(lambda match: f"{float(match[0]):.4f}", line) if "<joint" in line else line
        for line in another.text()
    )
    path = tmp_path / "rounded.urdf"
    path.write_text(text)
    found = from_urdf(path)
    assert sum("isn't exactly of the kind and was made so" in note for note in found.notes) == 2
    one, other = scout_pin.load(), scout_pin.load(found.specification)
    for side in SIDES:
        feet = [robot.sole_vertices(side, robot.neutral_feet()[side]) for robot in (one, other)]
        hips = [robot.legs[side].z_1 for robot in (one, other)]  # the torso's frame is elsewhere
        low = [points[:, 2].min() + z for points, z in zip(feet, hips, strict=True)]
        np.testing.assert_allclose(low[1], low[0], atol=1e-3)
