"""What of any joint can be turned by one number, and what that does to Pinocchio's q."""

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from thesis_pin.loops.moving.coordinates import coordinates
from thesis_pin.loops.moving.moving import ways


def zoo():
    """A model with a joint of each kind, in series."""
    model = pin.Model()
    kinds = {
        "free": pin.JointModelFreeFlyer(),
        "turn": pin.JointModelRY(),
        "skew": pin.JointModelRevoluteUnaligned(np.array([0.6, 0.0, 0.8])),
        "wheel": pin.JointModelRUBZ(),
        "slide": pin.JointModelPX(),
        "ball": pin.JointModelSpherical(),
        "zyx": pin.JointModelSphericalZYX(),
        "flat": pin.JointModelPlanar(),
        "shift": pin.JointModelTranslation(),
    }
    parent = 0
    for name, joint in kinds.items():
        parent = model.addJoint(parent, joint, pin.SE3.Random(), name)
    return model


MODEL = zoo()


def test_every_freedom_of_every_kind_of_joint_has_a_coordinate():
    names = [one.name for one in coordinates(MODEL)]
    assert len(names) == MODEL.nv
    turns, axes = ("roll", "pitch", "yaw"), ("x", "y", "z")
    assert names[:6] == [f"free {part}" for part in (*axes, *turns)]
    assert names[6:10] == ["turn", "skew", "wheel", "slide"]
    assert [name for name in names if name.startswith("ball")] == [f"ball {turn}" for turn in turns]


@settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(seed=st.integers(0, 10_000), number=st.integers(0, MODEL.nv - 1), value=st.floats(-1.4, 1.4))
def test_a_coordinate_reads_back_and_leaves_all_others_alone(seed, number, value):
    q = pin.integrate(
        MODEL, pin.neutral(MODEL), np.random.default_rng(seed).uniform(-0.8, 0.8, MODEL.nv)
    )
    every = coordinates(MODEL)
    moved = every[number].placed(q, value)
    assert every[number].value(moved) == pytest.approx(value, abs=1e-9)
    assert pin.isNormalized(MODEL, moved, 1e-12)
    for k, other in enumerate(every):
        if k != number:
            assert other.value(moved) == pytest.approx(other.value(q), abs=1e-9)


def test_angles_turn_about_the_fixed_axes_x_then_y_then_z():
    every = {one.name: one for one in coordinates(MODEL)}
    q = pin.neutral(MODEL)
    for name, value in (("free roll", 0.3), ("free pitch", -0.4), ("free yaw", 0.5)):
        q = every[name].placed(q, value)
    from scipy.spatial.transform import Rotation

    expected = Rotation.from_euler("xyz", [0.3, -0.4, 0.5]).as_matrix()
    turn = pin.Quaternion(q[3:7]).toRotationMatrix()
    np.testing.assert_allclose(turn, expected, atol=1e-12)


@pytest.mark.parametrize("pitch", [np.pi / 2, -np.pi / 2])
def test_where_pitch_is_a_right_angle_the_orientation_stays(pitch):
    every = {one.name: one for one in coordinates(MODEL)}
    q = pin.neutral(MODEL)
    for name, value in (("ball yaw", 0.7), ("ball pitch", pitch)):
        q = every[name].placed(q, value)
    same = every["ball pitch"].placed(q, every["ball pitch"].value(q))
    np.testing.assert_allclose(same, q, atol=1e-7)


def test_a_wheel_takes_the_shorter_way_and_others_go_as_told():
    every = {one.name: one for one in coordinates(MODEL)}
    wheel = every["wheel"].placed(pin.neutral(MODEL), 3.0)
    assert every["wheel"].way(wheel, -3.0) == pytest.approx(2 * np.pi - 6)
    turn = every["turn"].placed(pin.neutral(MODEL), 3.0)
    assert every["turn"].way(turn, -3.0) == pytest.approx(-6)


def test_ends_are_the_ranges_or_half_a_turn_or_the_robots_size():
    model = pin.Model()
    limits = (np.array([value]) for value in (9.0, 9.0, -0.3, 1.2))
    first = model.addJoint(0, pin.JointModelRX(), pin.SE3.Identity(), "knee", *limits)
    for name, joint in (("wheel", pin.JointModelRUBX()), ("slide", pin.JointModelPZ())):
        first = model.addJoint(first, joint, pin.SE3.Identity(), name)
    low_high = list(ways(coordinates(model), 100.0))
    assert low_high[0] == (-0.3, 1.2)
    assert low_high[1] == (-np.pi, np.pi)
    assert low_high[2] == (-100.0, 100.0)


def test_an_end_that_is_missing_is_as_far_from_the_other_as_is_usual():
    model, first = pin.Model(), 0
    for k, (low, high) in enumerate(((4.0, np.inf), (-np.inf, -4.0), (-np.inf, 1.0))):
        limits = (np.array([value]) for value in (9.0, 9.0, low, high))
        place = pin.SE3.Identity()
        first = model.addJoint(first, pin.JointModelPX(), place, f"slide {k}", *limits)
    model.addJoint(first, pin.JointModelSpherical(), place, "ball")
    found = list(ways(coordinates(model), 0.5))
    assert found[:3] == [(4.0, 4.5), (-4.5, -4.0), (-0.5, 1.0)]
    assert found[3:] == [(-np.pi, np.pi), (-np.pi / 2, np.pi / 2), (-np.pi, np.pi)]


def test_a_coordinate_below_its_range_is_as_far_outside_as_one_above():
    limits = (np.array([value]) for value in (9.0, 9.0, -0.3, 1.2))
    model = pin.Model()
    model.addJoint(0, pin.JointModelRX(), pin.SE3.Identity(), "knee", *limits)
    (knee,) = coordinates(model)
    found = [knee.excess(np.array([value])) for value in (-0.5, 0.4, 1.4)]
    assert found == pytest.approx([0.2, 0.0, 0.2])
