"""URDF+: loops and couplings against what the format's authors define them to be."""

import numpy as np
import pinocchio as pin
import pytest

from thesis_pin.errors import ModelError, UnknownName
from thesis_pin.model.formats.urdf.reading import read_urdf
from thesis_pin.model.mechanism.closure_types import word_of
from thesis_pin.model.second_reading import second_reading

BODY = (
    '<inertial><mass value="1"/>'
    '<inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial>'
)


def joint(name, parent, child, more="", x=0.0):
    return (
        f'<link name="{child}">{BODY}</link><joint name="{name}" type="revolute" {more}>'
        f'<parent link="{parent}"/><child link="{child}"/><origin xyz="{x} 0 0"/>'
        '<axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint>'
    )


LOOP = """<loop name="tip" type="{kind}">
<predecessor link="coupler"><origin xyz="0.3 0 0" rpy="0.1 0 0"/></predecessor>
<successor link="rocker"><origin xyz="0.2 0 0"/></successor>{axis}</loop>"""


def four_bar(kind="revolute", axis='<axis xyz="0 0.6 0.8"/>'):
    return (
        '<robot name="r"><link name="ground"/>'
        + joint("crank", "ground", "bar", 'independent="true"')
        + joint("pin", "bar", "coupler", 'independent="False"', 0.1)
        + joint("pivot", "ground", "rocker", 'independent="false"', 0.28)
        + LOOP.format(kind=kind, axis=axis)
        + "</robot>"
    )


@pytest.mark.parametrize(
    ("kind", "word", "rows"),
    [
        ("revolute", "hinge_z", 5),
        ("continuous", "hinge_z", 5),
        ("spherical", "3d", 3),
        ("fixed", "6d", 6),
        ("prismatic", "xy-xyz", 5),
    ],
)
def test_a_loop_closes_two_frames_as_its_type_says(kind, word, rows):
    found = read_urdf(four_bar(kind))
    (closure,) = found.supplement.closures
    assert (closure.name, word_of(closure.rows), sum(closure.rows)) == ("tip", word, rows)
    model = pin.buildModelFromXML(found.text)
    data = model.createData()
    pin.framesForwardKinematics(model, data, pin.neutral(model))
    one, other = (data.oMf[model.getFrameId(name)] for name in closure.frames)
    np.testing.assert_allclose(one.translation, [0.4, 0, 0], atol=1e-15)
    np.testing.assert_allclose(other.translation, [0.48, 0, 0], atol=1e-15)
    if rows == 5:
        np.testing.assert_allclose(other.rotation[:, 2], [0, 0.6, 0.8], atol=1e-15)
        tilt = pin.utils.rotate("x", 0.1)
        np.testing.assert_allclose(one.rotation[:, 2], tilt @ [0, 0.6, 0.8], atol=1e-15)


def test_pinocchio_alone_passes_loops_and_couplings_over_in_silence():
    model = pin.buildModelFromXML(four_bar())
    assert (model.nv, [frame.name for frame in model.frames if "tip" in frame.name]) == (3, [])


def test_the_text_of_the_tree_keeps_what_was_written_and_reads_back_alike():
    text = four_bar().replace("</robot>", "<material name='m'/><transmission name='t'/></robot>")
    found = read_urdf(text)
    assert second_reading(found) == []
    again = read_urdf(found.text)
    assert again.supplement.closures == ()
    assert list(again.links) == list(found.links)
    assert list(again.joints) == list(found.joints)
    assert "<material" in found.text
    assert "<transmission" in found.text
    assert "<loop" not in found.text
    assert [motor.joint for motor in found.supplement.motors] == ["crank"]


def test_a_coupling_ties_the_joints_between_its_links_and_their_common_ancestor():
    """ratio · Σ towards the predecessor = Σ towards the successor."""
    text = (
        '<robot name="r"><link name="base"/>'
        + joint("trunk", "base", "torso")
        + joint("hip", "torso", "thigh")
        + joint("knee", "thigh", "shank")
        + joint("spin", "torso", "rotor")
        + '<coupling name="belt"><predecessor link="shank"/><successor link="rotor"/>'
        '<ratio value="9"/></coupling></robot>'
    )
    (coupling,) = read_urdf(text).supplement.couplings
    assert coupling.name == "belt"
    assert coupling.coefficients == {"knee": 9.0, "hip": 9.0, "spin": -1.0}
    assert coupling.constant == 0.0


def test_a_mimicking_joint_is_a_coupling_and_no_motor():
    tied = joint("k", "base", "c").replace(
        "</joint>", '<mimic joint="j" multiplier="-2" offset="0.5"/></joint>'
    )
    text = f'<robot name="r"><link name="base"/>{joint("j", "base", "b")}{tied}</robot>'
    found = read_urdf(text, where="r.urdf")
    (coupling,) = found.supplement.couplings
    assert (coupling.coefficients, coupling.constant) == ({"k": 1.0, "j": 2.0}, 0.5)
    assert [motor.joint for motor in found.supplement.motors] == ["j"]
    plain = read_urdf(text.replace(' multiplier="-2" offset="0.5"', "")).supplement.couplings[0]
    assert (plain.coefficients, plain.constant) == ({"k": 1.0, "j": -1.0}, 0.0)
    alone = read_urdf(text.replace('mimic joint="j"', 'mimic joint="x"'), where="r.urdf")
    assert alone.supplement.couplings == ()
    assert alone.warnings == (
        "r.urdf:1: joint 'k': <mimic> names joint 'x', which isn't there; it moves freely",
    )
    with pytest.raises(ModelError, match="mimics itself"):
        read_urdf(text.replace('mimic joint="j"', 'mimic joint="k"'))


@pytest.mark.parametrize(
    ("old", "new", "error", "says"),
    [
        ('type="revolute">\n<pre', 'type="helical">\n<pre', UnknownName, "type of loop 'helical'"),
        ('predecessor link="coupler"', 'predecessor link="x"', UnknownName, "unknown link 'x'"),
        (
            '<axis xyz="0 0.6 0.8"/></loop>',
            '<axis xyz="0 0 0"/></loop>',
            ModelError,
            "axis is zero",
        ),
        ('successor link="rocker"', 'successor link="coupler"', ModelError, "both its ends"),
        ('xyz="0.2 0 0"', 'xyz="0.2 0"', ModelError, "isn't 3 finite numbers"),
        ('<loop name="tip"', "<loop", ModelError, "a <loop> has no name"),
        ('<loop name="tip"', '<loop name="tip"/><loop name="tip"', ModelError, "2 loops"),
    ],
)
def test_a_loop_that_says_nothing_sound_is_refused_with_its_place(old, new, error, says):
    assert old in four_bar()
    with pytest.raises(error, match=says) as caught:
        read_urdf(four_bar().replace(old, new, 1), where="r.urdf")
    assert "r.urdf:" in str(caught.value)


@pytest.mark.parametrize(
    ("coupling", "says"),
    [
        ('<predecessor link="b"/><successor link="base"/>', "no <ratio>"),
        ('<predecessor link="b"/><ratio value="2"/>', "no <successor>"),
        ('<predecessor link="b"/><successor link="b"/><ratio value="2"/>', "no joint moves"),
        ('<predecessor link="b"/><successor link="base"/><ratio value="0"/>', "its ratio is 0"),
    ],
)
def test_a_coupling_that_ties_nothing_is_refused(coupling, says):
    text = f'<robot name="r"><link name="base"/>{joint("j", "base", "b")}'
    with pytest.raises(ModelError, match=says):
        read_urdf(f'{text}<coupling name="c">{coupling}</coupling></robot>')


@pytest.mark.parametrize("kept", ["motor", "mark", "mimic"])
def test_a_loop_is_cut_at_a_joint_that_nothing_drives_or_ties(kept):
    """The last of equal joints is cut, unless it is needed."""
    last = '<joint name="d" type="continuous"><parent link="b"/><child link="c"/>{}</joint>'
    text = (
        '<robot name="r"><link name="base"/>'
        + joint("j", "base", "b")
        + joint("k", "base", "c")
        + last.format('<mimic joint="j"/>' if kept == "mimic" else "")
        + "</robot>"
    )
    if kept == "mark":
        text = text.replace('name="d"', 'name="d" independent="true"')
    found = read_urdf(text, motors=["d"] if kept == "motor" else [])
    assert "d" in found.joints
    assert [one.name for one in found.supplement.closures] == (["k"])
    plain = read_urdf(text.replace('<mimic joint="j"/>', "").replace('independent="true"', ""))
    assert [one.name for one in plain.supplement.closures] == ["d"]


def test_more_loops_than_a_closure_file_may_have_are_refused():
    loops = "".join(
        LOOP.format(kind="spherical", axis="").replace('"tip"', f'"tip{k}"') for k in range(1001)
    )
    with pytest.raises(ModelError, match=r"r\.urdf: there are 1,001 loops; allowed: 1,000"):
        read_urdf(
            four_bar("fixed")
            .replace("<loop", loops + "<loop", 1)
            .replace(LOOP.format(kind="fixed", axis='<axis xyz="0 0.6 0.8"/>'), ""),
            where="r.urdf",
        )


def test_what_is_passed_over_is_named():
    text = four_bar().replace(
        "</robot>",
        '<transmission name="t1"/><transmission name="t2"/><gazebo reference="bar"/>\n'
        '<constraint name="c"/></robot>',
    )
    assert read_urdf(text, where="r.urdf").passed_over == (
        "r.urdf:3: <transmission> (2 times) isn't used: t1, t2",
        "r.urdf:3: <gazebo> isn't used: bar",
        "r.urdf:4: <constraint> isn't used: c",
    )
