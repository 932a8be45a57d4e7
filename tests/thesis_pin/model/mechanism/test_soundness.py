"""Pinocchio's models against our own sums: none differs, and every difference is seen."""

import numpy as np
import pinocchio as pin
import pytest
from example_robots import urdf_files

from thesis_pin.errors import ModelError, ThesisPinError
from thesis_pin.model.formats.urdf.reading import read_urdf
from thesis_pin.model.loading import load_model
from thesis_pin.model.mechanism.soundness import agreement, check_agreement

INERTIAL = """<inertial><origin xyz="{x} 0.02 0" rpy="0.3 0 0.1"/><mass value="{m}"/>
<inertia ixx="0.01" iyy="{i}" izz="0.015" ixy="0.001" ixz="0" iyz="0"/></inertial>"""


def body(name, m=2.0, x=0.1, i=0.02):
    return f'<link name="{name}">{INERTIAL.format(m=m, x=x, i=i)}</link>'


def robot(**changes):
    """A base, something fixed to it, and an arm of two joints with a fixed tool."""
    parts = {
        "base": body("base"),
        "cover": body("cover"),
        "arm": body("arm"),
        "slide": body("slide"),
        "tool": body("tool"),
        "lid": '<joint name="lid" type="fixed"><parent link="base"/><child link="cover"/>'
        '<origin xyz="0 0 0.3" rpy="0.2 0 0"/></joint>',
        "turn": '<joint name="turn" type="revolute"><parent link="cover"/><child link="arm"/>'
        '<origin xyz="0 0.1 0" rpy="0 0.4 0"/><axis xyz="0 1 1"/>'
        '<limit lower="-1" upper="2" effort="3" velocity="4"/>'
        '<dynamics damping="0.1" friction="0.2"/></joint>',
        "push": '<joint name="push" type="prismatic"><parent link="arm"/><child link="slide"/>'
        '<axis xyz="1 0 0"/><limit lower="0" upper="1" effort="5" velocity="6"/></joint>',
        "grip": '<joint name="grip" type="fixed"><parent link="slide"/><child link="tool"/>'
        '<origin xyz="0.2 0 0"/></joint>',
    } | changes
    return f'<robot name="r">{"".join(parts.values())}</robot>'


@pytest.mark.parametrize("file", urdf_files(), ids=lambda file: file.name)
@pytest.mark.parametrize("floating", [False, True])
def test_pinocchio_reads_every_example_as_our_own_sums_do(file, floating):
    try:
        description = read_urdf(file.read_bytes())
    except ThesisPinError as error:
        pytest.skip(str(error))
    root = [pin.JointModelFreeFlyer()] if floating else []
    model = pin.buildModelFromXML(description.text, *root)
    assert list(agreement(description, model, roots=len(root))) == []


@pytest.mark.parametrize(
    ("part", "old", "new", "says"),
    [
        ("tool", "", body("tool", m=2.1), "the mass of the body that 'push' moves"),
        ("tool", "", body("tool", x=0.11), "the centre of mass of the body that 'push' moves"),
        ("tool", "", body("tool", i=0.021), "the inertia of the body that 'push' moves"),
        ("cover", "", body("cover", m=2.1), "the mass of the root"),
        ("arm", "", '<link name="arm"/>', "the mass of the body that 'turn' moves"),
        ("grip", "0.2 0 0", "0.2 0 1e-6", "the centre of mass"),
        ("lid", "0 0 0.3", "0 0 0.30001", "the centre of mass of the root|the placement of"),
        ("turn", 'rpy="0 0.4 0"', 'rpy="0 0.4001 0"', "the placement of joint 'turn'"),
        ("turn", "0 1 1", "0 1 -1", "the axis of joint 'turn'"),
        ("turn", 'lower="-1"', 'lower="-1.1"', "the lower limit of joint 'turn'"),
        ("turn", 'upper="2"', 'upper="2.1"', "the upper limit of joint 'turn'"),
        ("turn", 'effort="3"', 'effort="3.1"', "the effort of joint 'turn'"),
        ("turn", 'velocity="4"', 'velocity="5"', "the velocity of joint 'turn'"),
        ("turn", 'damping="0.1"', 'damping="0"', "the damping of joint 'turn'"),
        ("turn", 'friction="0.2"', 'friction="0.3"', "the friction of joint 'turn'"),
        ("turn", '"revolute"', '"floating"', "6 degrees of freedom, being revolute"),
        ("push", '"prismatic"', '"revolute"', "the axis of joint 'push'"),
        ("push", 'parent link="arm"', 'parent link="base"', "joint 'push' hangs on 'universe'"),
        ("push", 'name="push"', 'name="pull"', "joints pull, push"),
        ("grip", '"fixed"', '"floating"', "joints grip"),
    ],
)
def test_every_kind_of_difference_is_seen(part, old, new, says):
    import re

    description = read_urdf(robot())
    plain = pin.buildModelFromXML(robot())
    assert list(agreement(description, plain)) == []
    text = re.search(rf'<(?:joint|link) name="{part}".*?</(?:joint|link)>', robot(), re.DOTALL)[0]
    assert old in text
    changed = pin.buildModelFromXML(robot(**{part: text.replace(old, new, 1) if old else new}))
    assert any(re.search(says, one) for one in agreement(description, changed))
    with pytest.raises(ModelError, match=r"r\.urdf: Pinocchio reads it otherwise"):
        check_agreement(description, changed, where="r.urdf")


def test_loading_compares_also_below_a_root_of_several_joints(monkeypatch):
    chain = [("x", pin.JointModelPX()), ("spin", pin.JointModelRZ())]
    assert load_model(robot(), chain).nv == 4
    build = pin.buildModelFromXML
    monkeypatch.setattr(
        pin, "buildModelFromXML", lambda text, *root: build(robot(tool=body("tool", m=9.0)), *root)
    )
    for root in (None, pin.JointModelFreeFlyer(), chain):
        with pytest.raises(ModelError, match="is 11 kg instead of 4 kg"):
            load_model(robot(), root)


def test_merged_bodies_have_the_mass_that_pinocchio_counts():
    model = load_model(robot(), pin.JointModelFreeFlyer())
    assert pin.computeTotalMass(model) == pytest.approx(10.0)
    np.testing.assert_allclose([body.mass for body in model.inertias], [0, 4, 2, 4])
