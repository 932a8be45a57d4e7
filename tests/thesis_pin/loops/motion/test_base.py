"""A free root's rates: against Pinocchio's differences of the poses themselves."""

import numpy as np
import pinocchio as pin
import pytest
from scipy.spatial.transform import Rotation

from thesis_pin.errors import BadInput, ModelWarning, TrajectoryError, UnknownName
from thesis_pin.loops.motion.files import read_motion
from thesis_pin.loops.motion.near import near_motions
from thesis_pin.loops.motion.smoothing import itself
from thesis_pin.loops.motion.whole import whole_motion

from .test_files import chain, flying, written

TIME = np.linspace(0.0, 1.0, 101)
WAVES = {  # size, rate, phase of each column
    "base_x": (0.1, 3.0, 0.2),
    "base_y": (0.05, 5.0, 1.0),
    "base_z": (0.2, 2.0, 2.0),
    "base_roll": (0.4, 3.0, 0.5),
    "base_pitch": (0.3, 4.0, 1.5),
    "base_yaw": (2.0, 2.0, -0.5),
}


def wave(part, time, order=0):
    size, rate, phase = WAVES[part]
    return size * rate**order * np.sin(rate * time + phase + order * np.pi / 2)


def components(time):
    """The root's seven numbers."""
    place = [wave(f"base_{axis}", time) for axis in "xyz"]
    turn = [wave(f"base_{name}", time) for name in ("roll", "pitch", "yaw")]
    return np.column_stack([*place, Rotation.from_euler("xyz", np.transpose(turn)).as_quat()])


def columns(form, orders):
    zero = 0.0 * TIME
    found = {"t": TIME, "turn": zero, "turn_rate": zero, "turn_acceleration": zero}
    for order in range(orders + 1):
        word = ("", "_rate", "_acceleration")[order]
        if form == "angles":
            found |= {f"{part}{word}": wave(part, TIME, order) for part in WAVES}
            continue
        h = 1e-4  # the quaternion's derivatives by central differences
        low, middle, high = (components(TIME + shift) for shift in (-h, 0.0, h))
        value = (middle, (high - low) / (2 * h), (high - 2 * middle + low) / h**2)[order]
        names = [*list(WAVES)[:3], *(f"base_q{axis}" for axis in "xyzw")]
        found |= {f"{name}{word}": value[:, k] for k, name in enumerate(names)}
    return found


def by_differences(model, time):
    """Rates and accelerations of the root as Pinocchio counts them, from poses h apart."""
    h = 1e-4
    q = [pin.neutral(model) for _ in range(3)]
    for one, at in zip(q, (time - h, time, time + h), strict=True):
        one[:7] = components(np.array([at]))[0]
    back, ahead = pin.difference(model, q[1], q[0]), pin.difference(model, q[1], q[2])
    # The third order of a screw's logarithm is odd, and the second one's that of the rate.
    return ((ahead - back) / (2 * h))[:6], ((ahead + back) / h**2)[:6]


@pytest.mark.parametrize("form", ["angles", "quaternion"])
@pytest.mark.parametrize("orders", [1, 2])
def test_rates_of_the_base_are_those_of_its_poses(tmp_path, form, orders):
    robot = flying()
    motion = read_motion(robot, written(tmp_path, columns(form, orders)), smooth="none")
    assert motion.warnings == ()
    assert ("base" in motion.interpolated) == (orders == 1)
    found = whole_motion(robot, motion, pin.neutral(robot.model)).joints
    for k in (5, 30, 60, 95):
        rate, acceleration = by_differences(robot.model, TIME[k])
        np.testing.assert_allclose(found.v[k, :6], rate, atol=1e-5)
        np.testing.assert_allclose(found.a[k, :6], acceleration, atol=1e-3)


@pytest.mark.parametrize("form", ["angles", "quaternion"])
def test_rounded_rates_of_the_base_are_smoothed_for_its_accelerations_only(tmp_path, form):
    robot = flying()
    exact = read_motion(robot, written(tmp_path, columns(form, 2)))
    assert exact.variants is None
    rough = {
        name: np.round(values, 3) if "rate" in name else values
        for name, values in columns(form, 1).items()
        if name != "turn_acceleration"
    }
    rough |= {"turn_acceleration": 0.0 * TIME}
    motion = read_motion(robot, written(tmp_path, rough))
    assert motion.variants is not None
    names = {one.name for one in motion.variants.columns}
    assert names
    assert all(name.startswith("base_") and name.endswith("_rate") for name in names)
    np.testing.assert_allclose(np.abs(motion.base), np.abs(exact.base), atol=1e-12)
    neutral = pin.neutral(robot.model)
    own, true = (whole_motion(robot, one, neutral) for one in (motion, exact))
    inner = slice(10, -10)
    np.testing.assert_allclose(own.joints.v[inner, :6], true.joints.v[inner, :6], atol=2e-3)
    error = np.abs(own.joints.a - true.joints.a)[inner, :6]
    assert error.max() < 0.2
    rows = np.arange(101)
    others = motion.variants.moved(itself(motion), TIME, motion.variants.others())
    _, _, a, good = near_motions(robot, own, rows, others)
    assert good.all()
    spread = 3 * a[1:, inner, :6].std(axis=0, ddof=1)
    spread += np.abs(a[0] - own.joints.a)[inner, :6]
    assert np.mean(error <= spread + 1e-4) > 0.95


@pytest.mark.parametrize("orders", [0, 1, 2])
def test_a_quaternion_that_goes_on_as_its_negative_is_the_same_motion(tmp_path, orders):
    given = columns("quaternion", orders)
    sign = np.where(TIME > 0.4, -1.0, 1.0)
    turned = {name: sign * values if "base_q" in name else values for name, values in given.items()}
    one, other = (
        read_motion(flying(), written(tmp_path, some), smooth="none") for some in (given, turned)
    )
    assert other.warnings == one.warnings == ()
    for a, b in zip(*(whole(motion) for motion in (one, other)), strict=True):
        np.testing.assert_allclose(a, b, atol=1e-9)


def whole(motion):
    robot = flying()
    found = whole_motion(robot, motion, pin.neutral(robot.model)).joints
    return found.v, found.a


def test_rates_beside_rounded_poses_are_not_doubted_unless_they_are_others(tmp_path):
    given = columns("angles", 2)
    rounded = {
        name: values if name == "t" else np.round(values, 3) for name, values in given.items()
    }
    assert read_motion(flying(), written(tmp_path, rounded)).warnings == ()
    twice = rounded | {"base_y_rate": 2.0 * rounded["base_y_rate"]}
    (first, second) = read_motion(flying(), written(tmp_path, twice)).warnings
    assert first.startswith("base_y_rate isn't the derivative")
    assert second.startswith("base_y_acceleration isn't the derivative")


def test_degrees_and_millimetres_of_the_base_are_asked_about(tmp_path):
    given = columns("angles", 0)
    large = {"base_x": 1e3 * given["base_x"], "base_yaw": np.degrees(given["base_yaw"])}
    with pytest.warns(ModelWarning) as said:
        read_motion(flying(), written(tmp_path, given | large))
    place, turn = (str(one.message) for one in said)
    assert "base_x reach" in place
    assert "base_yaw reach" in turn


def test_the_base_of_a_robot_that_stands_fixed_is_refused_with_what_frees_it(tmp_path):
    tied = chain(("turn", "revolute"))
    with pytest.raises(UnknownName, match=r"unknown column 'base_x'.*--free-flyer lets it fly"):
        read_motion(tied, written(tmp_path, columns("angles", 1)))


def test_three_samples_of_the_base_need_its_accelerations(tmp_path):
    for orders, enough in ((1, False), (2, True)):
        few = {name: values[:3] for name, values in columns("angles", orders).items()}
        if enough:
            assert len(read_motion(flying(), written(tmp_path, few)).base) == 3
            continue
        with pytest.raises(TrajectoryError, match="3 samples of the base without"):
            read_motion(flying(), written(tmp_path, few))


def test_rates_of_half_a_base_are_refused_and_odd_ones_doubted(tmp_path):
    given = columns("angles", 1)
    odd = given | {"base_yaw_rate": 2.0 * given["base_yaw_rate"]}
    motion = read_motion(flying(), written(tmp_path, odd), smooth="none")
    assert any("base_yaw_rate isn't the derivative" in one for one in motion.warnings)
    del given["base_pitch_rate"]
    with pytest.raises(BadInput, match="columns of the base are missing: base_pitch_rate"):
        read_motion(flying(), written(tmp_path, given))
    with pytest.raises(BadInput, match="'base_x_acceleration' stands without base_x_rate"):
        read_motion(
            flying(), written(tmp_path, columns("angles", 0) | {"base_x_acceleration": TIME})
        )
