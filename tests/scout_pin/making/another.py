"""Bipeds of the kind written by other hands: with other frames, axes and links."""

from pathlib import Path

import numpy as np
import pinocchio as pin

import scout_pin
from scout_pin.specification import JOINT_NAMES, SIDES, Specification
from thesis_pin.model.loading import joint_id

EXAMPLES = Path(__file__).parents[3] / "examples"
SOLE = (0.04, 0.03, 0.05, 0.08, 0.05)
"""Edges of a sole from below the ankle, and its height under it [m]."""


def specification(name):
    return Specification.read(EXAMPLES / f"{name}.toml" if name else None)


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
