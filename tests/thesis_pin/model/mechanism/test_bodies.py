"""Which bodies are refused, which are odd, and which are neither."""

import pinocchio as pin
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from thesis_pin.errors import NonPhysicalInertia
from thesis_pin.model.formats.urdf.reading import read_urdf
from thesis_pin.model.loading import checked, load_model
from thesis_pin.model.mechanism.bodies import check_bodies, odd_bodies


def link(name, mass=1.0, moments=(0.01, 0.01, 0.01), com="0 0 0"):
    if mass is None:
        return f'<link name="{name}"/>'
    inertia = " ".join(f'i{a}{a}="{m!r}"' for a, m in zip("xyz", moments, strict=True))
    return (
        f'<link name="{name}"><inertial><origin xyz="{com}"/><mass value="{mass!r}"/>'
        f'<inertia {inertia} ixy="0" ixz="0" iyz="0"/></inertial></link>'
    )


def joint(name, parent, child, kind="revolute", xyz="0.1 0 0", axis="0 0 1"):
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
        f'<origin xyz="{xyz}"/><axis xyz="{axis}"/>'
        '<limit lower="-1" upper="1" effort="1" velocity="1"/></joint>'
    )


def robot(*parts):
    return f'<robot name="r">{"".join(parts)}</robot>'


def arm(body, *more):
    return read_urdf(robot(link("base", None), body, joint("j", "base", "arm"), *more), where="r")


def odd(*parts):
    return list(odd_bodies(arm(*parts)))


FLAT = (0.01, 0.01, 0.03)
"""Moments that no body has."""


def test_a_link_that_no_body_is_may_stand_on_one_that_makes_up_for_it():
    sensor = link("sensor", 1e-6, (0.0, 0.0, 3e-6))
    found = arm(link("arm"), sensor, joint("f", "arm", "sensor", "fixed", axis="0 0 0"))
    check_bodies(found)
    (line,) = odd_bodies(found)
    assert line.startswith("r:1: link 'sensor': no body has its inertia")
    assert load_model(found).nv == 1
    with pytest.raises(NonPhysicalInertia, match="link 'sensor'"):
        check_bodies(arm(link("arm", 1e-6, (0.0, 0.0, 0.0)), sensor, joint("f", "arm", "sensor")))


def test_the_link_that_is_at_fault_is_named_where_bodies_are_merged():
    found = arm(link("arm"), link("bad", 1.0, (0.1, 0.1, 0.9)), joint("f", "arm", "bad", "fixed"))
    with pytest.raises(NonPhysicalInertia, match=r"r:1: link 'bad'.*exceeds the sum"):
        check_bodies(found)


@pytest.mark.parametrize(
    "moments",
    [
        (0.0, 0.0, 0.0),  # a point
        (0.0, 0.00012, 0.00012),  # a rod
        (0.01, 0.02, 0.03),  # a plate
        (-5.4e-20, -5.4e-20, 0.0),  # a point, as a program subtracted it
        (-2e-22, 1e-4, 1e-4),
    ],
)
def test_points_rods_plates_and_rounding_are_no_fault(moments):
    assert not [line for line in odd(link("arm", 1.0, moments, "0.05 0 0")) if "link 'arm'" in line
                and "triangle" in line]  # fmt: skip
    check_bodies(arm(link("arm", 1.0, moments, "0.05 0 0")))


def test_moments_off_by_their_last_digit_are_odd_and_by_more_are_refused():
    (first, second) = odd(link("arm", 1.0, (0.0100, 0.0200, 0.03001), "0.3 0 0"))
    assert "no body has its inertia" in first
    assert "moves with it; it is off by 0.0003" in second
    with pytest.raises(NonPhysicalInertia):
        check_bodies(arm(link("arm", 1.0, FLAT)))
    with pytest.raises(NonPhysicalInertia, match="isn't positive"):
        check_bodies(arm(link("arm", 1.0, (-0.001, 0.01, 0.01))))


def test_a_body_too_small_to_matter_is_only_odd():
    """A frame of a gram that somebody gave an inertia, as Cassie's foot references."""

    def with_reference(mass, moments):
        big = link("arm", 1.0, (0.1, 0.1, 0.1))
        return arm(big, link("ref", mass, moments), joint("k", "arm", "ref"))

    found = with_reference(1e-4, (1e-6, 1e-6, 9e-6))
    check_bodies(found)
    assert any("'ref': no body has the inertia that moves" in one for one in odd_bodies(found))
    for heavy in (with_reference(0.1, (1e-6, 1e-6, 9e-6)), with_reference(1e-4, FLAT)):
        with pytest.raises(NonPhysicalInertia, match="link 'ref'"):
            check_bodies(heavy)


def test_bodies_without_mass_are_odd_at_the_end_of_a_chain_only():
    (line,) = odd(link("arm", None))
    assert line == "r:1: link 'arm': it moves and has no mass"
    found = odd(link("arm", None), link("hand"), joint("k", "arm", "hand"))
    assert found == []
    (line,) = odd(link("arm", 0.0, (1e-4, 1e-4, 1e-4)))
    assert line == "r:1: link 'arm': it has inertia and no mass"
    with pytest.raises(NonPhysicalInertia, match="mass isn't positive"):
        check_bodies(arm(link("arm", -1.0)))


def test_a_radius_of_gyration_beyond_the_robots_reach_is_odd():
    """g·mm² taken for kg·m²: 333.3 g·mm² are 3.3e-7 kg·m²."""
    wrong = odd(link("arm", 0.4, (26.7, 333.3, 333.3), "0.05 0 0"))
    (line,) = wrong
    assert "link 'arm': its radius of gyration is 28.9 m in a robot that reaches 0.2 m" in line
    assert odd(link("arm", 0.4, (2.7e-5, 3.3e-4, 3.3e-4), "0.05 0 0")) == []


def test_the_root_is_judged_when_it_moves():
    text = robot(link("base", 1.0, FLAT), link("arm"), joint("j", "base", "arm"))
    assert load_model(text).nv == 1
    with pytest.raises(NonPhysicalInertia, match="link 'base'"):
        load_model(text, pin.JointModelFreeFlyer())


def test_everything_odd_is_told_at_once():
    found = checked(
        arm(
            link("arm", 0.4, (26.7, 333.3, 333.3)),
            link("tip", None),
            joint("k", "arm", "tip"),
            link("hook", 0.0, (1e-4, 1e-4, 1e-4)),
            joint("l", "arm", "hook"),
        )
    )
    assert {line.split("'")[1] for line in found.warnings} == {"arm", "hook", "tip"}


@settings(deadline=None)
@given(st.lists(st.tuples(*[st.floats(-0.2, 0.2)] * 3), min_size=1, max_size=6))
def test_no_body_of_point_masses_is_refused(points):
    parts = [link("arm", None)]
    for number, point in enumerate(points):
        name = f"p{number}"
        parts += [link(name, 0.3, (0.0, 0.0, 0.0), "0 0 0")]
        parts += [joint(f"f{number}", "arm", name, "fixed", " ".join(map(repr, point)))]
    check_bodies(arm(*parts))
