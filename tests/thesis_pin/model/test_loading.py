"""What the loader refuses, and that Pinocchio alone would have let it through."""

import pinocchio as pin
import pytest

from thesis_pin.errors import ModelError, NonPhysicalInertia, UnknownName
from thesis_pin.model.loading import check_urdf, frame_id, joint_id, load_model

INERTIAL = (
    '<inertial><mass value="1"/>'
    '<inertia ixx="{}" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial>'
)


def link(name, ixx="0.01", body=None):
    return f'<link name="{name}">{INERTIAL.format(ixx) if body is None else body}</link>'


def joint(name, parent, child, kind="revolute", limit="-1 1", axis="0 0 1"):
    lower, upper = limit.split()
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
        f'<axis xyz="{axis}"/><limit lower="{lower}" upper="{upper}" effort="1" velocity="1"/>'
        "</joint>"
    )


def robot(*elements):
    return f'<robot name="r">{"".join(elements)}</robot>'


GOOD = robot(link("a"), link("b"), joint("j", "a", "b"))

SILENT = {
    "loop": (
        robot(
            link("a"), link("b"), link("c"),
            joint("j", "a", "b"), joint("k", "a", "c"), joint("l", "b", "c"),
        ),
        ModelError,
        "it has loops or tied joints, which a tree can't hold: '[jkl]'",
    ),
    "impossible inertia": (
        robot(link("a"), link("b", ixx="0.05"), joint("j", "a", "b")),
        NonPhysicalInertia,
        "link 'b'.*exceeds",
    ),
    "NaN inertia": (
        robot(link("a"), link("b", ixx="nan"), joint("j", "a", "b")),
        ModelError,
        "ixx='nan'",
    ),
    "reversed limits": (
        robot(link("a"), link("b"), joint("j", "a", "b", limit="1 -1")),
        ModelError,
        "limits are reversed",
    ),
    "a joint that follows another": (
        robot(
            link("a"), link("b"), link("c"), joint("j", "a", "b"),
            joint("k", "a", "c").replace("</joint>", '<mimic joint="j"/></joint>'),
        ),
        ModelError,
        "'k follows j'",
    ),
    "a planar joint across x": (
        robot(link("a"), link("b"), joint("j", "a", "b", kind="planar", axis="1 0 0")),
        ModelError,
        "joint 'j': it is planar about",
    ),
    "negative mass": (
        robot(link("a"), link("b").replace('value="1"', 'value="-1"'), joint("j", "a", "b")),
        NonPhysicalInertia,
        "link 'b'.*mass isn't positive",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", SILENT)
def test_models_pinocchio_reads_silently_are_refused_with_the_place(name):
    text, error, says = SILENT[name]
    assert pin.buildModelFromXML(text).nv >= 1  # Pinocchio has no objection
    with pytest.raises(error, match=says):
        load_model(text)


@pytest.mark.parametrize(
    ("text", "error", "says"),
    [
        ("<robot", ModelError, "well-formed"),
        ("<sdf/>", ModelError, "<sdf>"),
        (robot(), ModelError, "no <link>"),
        (robot(link("a"), link("a")), ModelError, "2 links are called 'a'"),
        (robot(link("a"), link("b"), joint("j", "a", "c")), UnknownName, "'c'"),
        (robot(link("a"), link("b"), joint("j", "a", "b", kind="hinge")), UnknownName, "revolute"),
        (robot(link("a"), link("b")), ModelError, "2 links have no parent"),
        (robot(link("a"), link("b"), joint("j", "a", "b", axis="0 0 0")), ModelError, "axis"),
        (
            robot(link("r"), link("a"), link("b"), joint("j", "a", "b"), joint("k", "b", "a")),
            ModelError,
            "2 links aren't joined to 'r': a, b",
        ),
    ],
)
def test_broken_urdfs_are_refused_with_the_reason(text, error, says):
    with pytest.raises(error, match=says):
        check_urdf(text)


def test_a_good_urdf_loads():
    assert load_model(GOOD).nv == 1


def test_unknown_frames_and_joints_raise_where_pinocchio_returns_a_number():
    model = load_model(GOOD)
    assert model.getFrameId("nowhere") == model.nframes  # Pinocchio's answer
    with pytest.raises(UnknownName, match=r"allowed: .*b"):
        frame_id(model, "nowhere")
    with pytest.raises(UnknownName, match="allowed: j"):
        joint_id(model, "nothing")
    assert frame_id(model, "b") < model.nframes
    assert joint_id(model, "j") == 1
