"""URDFs of the kind, wherever their frames are, become specifications of the same robot."""

import re
from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest

import scout_pin
from scout_pin.implausible import implausible
from scout_pin.making.from_urdf import from_urdf
from scout_pin.making.text import toml
from scout_pin.specification import JOINT_NAMES, SIDES, Specification
from scout_pin.urdf import write
from thesis_pin.errors import ModelError, ThesisPinError, UnknownName
from thesis_pin.model.loading import joint_id
from thesis_pin.model.specification import parse_toml

EXAMPLES = Path(__file__).parents[3] / "examples"
SOLE = (0.04, 0.03, 0.05, 0.08, 0.05)


def specification(name):
    return Specification.read(EXAMPLES / f"{name}.toml" if name else None)


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


def ros_biped(left="left", right="right", yaw="0 0 1"):
    """As such robots are written for ROS: x forward, all frames alike, legs straight, boxes."""
    yield '<robot name="ros biped">'
    yield from ros_link("base_link", 2.0)
    for side, y in ((left, 0.1), (right, -0.1)):
        above = "base_link"
        for name, axis, xyz in (
            ("hip_yaw", yaw, f"0 {y} -0.05"),
            ("hip_roll", "1 0 0", "0 0 0"),
            ("hip_pitch", "0 1 0", "0 0 0"),
            ("knee", "0 1 0", "0 0 -0.25"),
            ("ankle_pitch", "0 1 0", "0 0 -0.3"),
            ("ankle_roll", "1 0 0", "0 0 0"),
        ):
            foot = '<collision><origin xyz="0.03 0 -0.04"/><geometry><box size="0.16 0.08 0.02"/>'
            shape = f"{foot}</geometry></collision>" if name == "ankle_roll" else ""
            yield from ros_link(f"{side}_{name}_link", 0.4, shape)
            yield (
                f'<joint name="{side}_{name}" type="revolute"><parent link="{above}"/>'
                f'<child link="{side}_{name}_link"/><origin xyz="{xyz}"/><axis xyz="{axis}"/>'
                '<limit lower="-1.5" upper="1.2" effort="40" velocity="8"/></joint>'
            )
            above = f"{side}_{name}_link"
    yield "</robot>"


def ros_link(name, mass, more=""):
    yield (
        f'<link name="{name}"><inertial><origin xyz="0 0 -0.02"/><mass value="{mass}"/>'
        '<inertia ixx="0.002" iyy="0.002" izz="0.002" ixy="0" ixz="0" iyz="0"/></inertial>'
        f"{more}</link>"
    )


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


def random_rotation(rng):
    return pin.Quaternion(rng.normal(size=4)).normalized().toRotationMatrix()


class Another:
    """The same robot with other frames: a URDF written from Pinocchio's model of it.

    Child frames are moved along their axes and turned at will, axes may point the other way,
    the root's frame stands elsewhere, and each body is two links fixed to each other.
    """

    def __init__(self, spec, rng, flips=()):
        self.robot = scout_pin.load(spec)
        model = self.robot.model
        self.root = pin.SE3(random_rotation(rng), rng.normal(size=3))
        self.parts = []
        frames = {1: self.root}
        for name in JOINT_NAMES:
            number = joint_id(model, name)
            axis = {"RX": 0, "RY": 1, "RZ": 2}[model.joints[number].shortname()[-2:]]
            own = np.eye(3)[axis]
            turn = random_rotation(rng)
            frames[number] = pin.SE3(turn, float(rng.uniform(-0.1, 0.1)) * own)
            place = frames[model.parents[number]].inverse() * model.jointPlacements[number]
            place = place * frames[number]
            sign = -1.0 if name in flips else 1.0
            self.parts.append((name, number, place, sign * turn.T @ own, sign))
        self.frames = frames

    def text(self, sole="box", turn=None):
        """Its URDF; ``turn`` turns the frames of the links that are called soles."""
        turned = pin.SE3.Identity() if turn is None else pin.SE3(turn, np.zeros(3))
        model, spec = self.robot.model, self.robot.specification
        yield '<robot name="another">'
        yield from self.body(1, "base")
        for k, (name, number, place, axis, sign) in enumerate(self.parts):
            yield from self.body(number, f"link_{name}")
            parent = model.parents[number]
            above = "base" if parent == 1 else f"link_{model.names[parent]}"
            limits = (self.robot.lower[k], self.robot.upper[k])
            low, high = sorted(float(sign * limit) for limit in limits)
            yield (
                f'<joint name="{name}_servo" type="revolute"><parent link="{above}"/>'
                f'<child link="link_{name}"/>{origin(place)}<axis xyz="{words(axis)}"/>'
                f'<limit lower="{low!r}" upper="{high!r}" '
                f'effort="{float(self.robot.stall_torque[k])!r}" '
                f'velocity="{float(self.robot.no_load_speed[k])!r}"/></joint>'
            )
        for side in SIDES:
            frame = model.frames[self.robot.sole_frames[side]]
            place = self.frames[frame.parentJoint].inverse() * frame.placement
            corners = np.array(spec.leg(side).sole)
            low, high = corners.min(axis=0), corners.max(axis=0)
            middle = pin.SE3(np.eye(3), np.array([*(low + high) / 2, 0.002]))
            place, middle = place * turned, turned.inverse() * middle
            size = words([*(high - low), 0.004])
            box = f'<geometry><box size="{size}"/></geometry>'
            shape = f"<collision>{origin(middle)}{box}</collision>" if sole == "box" else ""
            yield f'<link name="{side}_sole_plate">{shape}</link>'
            yield (
                f'<joint name="{side}_fixed" type="fixed"><parent link="link_{side}_ankle_roll"/>'
                f'<child link="{side}_sole_plate"/>{origin(place)}</joint>'
            )
        yield "</robot>"

    def body(self, number, name):
        """Two links: one with two thirds of the mass, the rest fixed to it."""
        inertia = self.frames[number].actInv(self.robot.model.inertias[number])
        for part, link in ((2 / 3, name), (1 / 3, f"{name}_rest")):
            i = inertia.inertia * part
            yield (
                f'<link name="{link}"><inertial><origin xyz="{words(inertia.lever)}"/>'
                f'<mass value="{inertia.mass * part!r}"/><inertia ixx="{float(i[0, 0])!r}" '
                f'ixy="{float(i[0, 1])!r}" ixz="{float(i[0, 2])!r}" iyy="{float(i[1, 1])!r}" '
                f'iyz="{float(i[1, 2])!r}" izz="{float(i[2, 2])!r}"/></inertial></link>'
            )
        yield (
            f'<joint name="{name}_weld" type="fixed"><parent link="{name}"/>'
            f'<child link="{name}_rest"/></joint>'
        )


def words(values):
    return " ".join(repr(float(value)) for value in values)


def origin(place):
    rpy = pin.rpy.matrixToRpy(place.rotation)
    return f'<origin xyz="{words(place.translation)}" rpy="{words(rpy)}"/>'


def written(path, lines):
    path.write_text("\n".join(lines))
    return path


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


@pytest.fixture
def plain(tmp_path):
    """Our own URDF's text, to be changed, and where to write it."""
    spec = Specification.read()
    write(spec, tmp_path)
    text = (tmp_path / "scout.urdf").read_text()

    def change(*replacements):
        changed = text
        for old, new in replacements:
            assert old in changed
            changed = changed.replace(old, new, 1)
        path = tmp_path / "changed.urdf"
        path.write_text(changed)
        return path

    return change


def knee(text="left_knee_pitch"):
    return f'<joint name="{text}" type="revolute">'


def test_an_axis_that_isn_t_of_the_kind_is_named_with_its_angle(plain, tmp_path):
    text = (tmp_path / "scout.urdf").read_text()
    start = text.index('<joint name="left_knee_pitch"')
    end = text.index("<axis", start)
    axis = text[end : text.index("/>", end) + 2]
    bad = plain(
        (text[start : end + len(axis)], text[start:end] + '<axis xyz="0.0871557 0 0.9961947"/>')
    )
    with pytest.raises(ModelError, match=r"'left_knee_pitch': its axis is 5° off parallel"):
        from_urdf(bad)


@pytest.mark.parametrize(
    ("joint", "shift", "says"),
    [
        (
            "left_hip_roll",
            "0.01 0.0 ",
            "'left_hip_roll': its axis passes that of",
        ),
        ("right_hip_pitch", "0.02908 0.005 ", "'right_hip_pitch': its axis passes the plane"),
        (
            "right_ankle_roll",
            "0.05497 0.0 0.004",
            "'right_ankle_roll': its axis passes the",
        ),
    ],
)
def test_an_axis_that_misses_where_it_should_meet_is_named_with_the_gap(
    plain, tmp_path, joint, shift, says
):
    text = (tmp_path / "scout.urdf").read_text()
    start = text.index('xyz="', text.index(f'<joint name="{joint}"')) + 5
    end = text.index('"', start)
    old = text[start:end].split()
    new = shift.split()
    new += old[len(new) :]
    with pytest.raises(ModelError, match=says):
        from_urdf(plain((text[:start] + " ".join(old), text[:start] + " ".join(new))))


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ((knee(), knee().replace("revolute", "prismatic")), "'left_knee_pitch' is prismatic"),
        ((knee(), knee().replace("revolute", "fixed")), "11 joints move"),
    ],
)
def test_joints_of_another_kind_or_number_are_named(plain, change, says):
    with pytest.raises(ModelError, match=says):
        from_urdf(plain(change))


@pytest.mark.parametrize("name", ["talos_full_v2", "solo12", "panda", "cassie", "g1_29dof"])
def test_robots_of_other_kinds_are_refused_as_such(name):
    with pytest.raises(ThesisPinError) as caught:
        from_urdf(f"example:{name}")
    if isinstance(caught.value, ModelError):
        assert "no biped of this kind" in str(caught.value)


def test_legs_whose_names_have_no_side_are_asked_for(tmp_path, rng):
    another = Another(Specification.read(), rng)
    text = "\n".join(another.text()).replace("left_", "a_").replace("right_", "b_")
    path = tmp_path / "nameless.urdf"
    path.write_text(text)
    with pytest.raises(ModelError, match=r"--left [ab]_hip_yaw_servo"):
        from_urdf(path)
    with pytest.raises(UnknownName, match="c_knee"):
        from_urdf(path, left="c_knee")
    found = from_urdf(path, left="a_ankle_roll_servo")
    assert found.joints[0] == "a_hip_yaw_servo"


def test_feet_without_shapes_and_joints_without_servos_are_asked_for(tmp_path, rng):
    another = Another(Specification.read(), rng)
    path = written(tmp_path / "bare.urdf", another.text(sole="none"))
    with pytest.raises(ModelError, match="no shape that says where the sole is"):
        from_urdf(path)
    found = from_urdf(path, sole=SOLE)
    for side in SIDES:
        corners = np.array(found.specification.leg(side).sole)
        np.testing.assert_allclose(np.ptp(corners, axis=0), [0.07, 0.13], atol=1e-12)
    weak = path.read_text().replace(f'effort="{0.432!r}"', 'effort="0"')
    path.write_text(weak)
    with pytest.raises(ModelError, match="effort 0 N·m"):
        from_urdf(path, sole=SOLE)
    found = from_urdf(path, sole=SOLE, servo=(2.5, 6.0))
    assert found.specification.servos["servo_1"].stall_torque == 2.5


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
