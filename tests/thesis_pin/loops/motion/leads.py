"""Frames that lead robots: their motions by Pinocchio, and tables of them."""

import mechanisms
import numpy as np
import pinocchio as pin
from scipy.spatial.transform import Rotation

from thesis_pin.loops.configurations.closing import motor_positions
from thesis_pin.loops.configurations.following import follow
from thesis_pin.loops.motion.told import JointMotion, Tool

TIME = np.linspace(0, 1, 41)
WORLD = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED


def product(w, q):
    """Quaternion product of vectors (w, 0) and q as x, y, z, w."""
    vector = q[:, 3:] * w + np.cross(w, q[:, :3])
    return np.column_stack([vector, -(w * q[:, :3]).sum(axis=1)])


def seen(robot, frame, joints):
    """What a frame does by Pinocchio: columns x … qw and their first two derivatives."""
    model, data, k = robot.model, robot.model.createData(), robot.model.getFrameId(frame)
    rows = []
    for q, v, a in zip(joints.q, joints.v, joints.a, strict=True):
        pin.forwardKinematics(model, data, q, v, a)
        place = pin.updateFramePlacement(model, data, k)
        speed = pin.getFrameVelocity(model, data, k, WORLD)
        push = pin.getFrameClassicalAcceleration(model, data, k, WORLD)
        turn = pin.Quaternion(place.rotation).coeffs()
        rows.append([*place.translation, *turn, *speed.vector, *push.vector])
    rows = np.array(rows)
    sign = np.cumprod([1, *np.where((rows[1:, 3:7] * rows[:-1, 3:7]).sum(1) < 0, -1, 1)])
    turn = rows[:, 3:7] * sign[:, None]
    rate = product(rows[:, 10:13], turn) / 2
    second = product(rows[:, 16:19], turn) / 2 + product(rows[:, 10:13], rate) / 2
    return (
        np.column_stack([rows[:, :3], turn]),
        np.column_stack([rows[:, 7:10], rate]),
        np.column_stack([rows[:, 13:16], second]),
    )


def led(frame, told, course, time=TIME, joints=(), moved=None):
    """A motion led by a frame."""
    none = np.zeros((len(time), 0))
    moved = (none, none, none) if moved is None else moved
    return JointMotion(
        "led", time, joints, *moved, course[0], base_change=course[1:], tool=Tool(frame, told)
    )


def swung(robot, start, size=0.3):
    """Every motor swings about where it stands, and all joints with it."""
    here = motor_positions(robot, start)
    phase = np.arange(len(here))
    wave = 2 * np.pi * TIME[:, None] + phase
    moved = (
        here + size * (np.sin(wave) - np.sin(phase)),
        size * 2 * np.pi * np.cos(wave),
        -size * 4 * np.pi**2 * np.sin(wave),
    )
    return follow(robot, TIME, *moved, start)


def scara(down=False):
    """Two parallel turns, a slide and a turn of the tool, which may point down."""
    t = mechanisms.Tree()
    t.link("upper", "ground", (0, 0, 1), bar=(0.3, 0, 0), motor=True)
    t.link("fore", "upper", (0, 0, 1), (0.3, 0, 0), bar=(0.25, 0, 0), motor=True)
    t.link("quill", "fore", (0, 0, 1), (0.25, 0, 0), motor=True, type="prismatic")
    t.link("wrist", "quill", (0, 0, 1), bar=(0.02, 0, 0), motor=True)
    turn = mechanisms.turned((1, 0, 0), np.pi) if down else None
    t.frame("tip", "wrist", (0.02, 0.01, -0.1), turn)
    return t.robot(), [0.3, 0.7, 0.05, -0.4]


def table(tmp_path, columns):
    rows = zip(*([repr(float(v)) for v in c] for c in columns.values()), strict=True)
    path = tmp_path / "led.csv"
    path.write_text("\n".join([",".join(columns), *map(",".join, rows)]) + "\n")
    return path


def one_angle(course, told):
    """The placement turned by the told angle alone, as a file with one column makes it."""
    axis = 2 if "yaw" in told else 1
    turn = Rotation.from_quat(course[0][:, 3:]).as_matrix()
    omega, alpha = spins(course)
    angle = (
        np.arctan2(turn[:, 1, 0], turn[:, 0, 0])
        if axis == 2
        else np.arctan2(turn[:, 0, 2], turn[:, 0, 0])
    )
    angle, rate, push = np.unwrap(angle), omega[:, axis], alpha[:, axis]
    half = np.zeros((3, len(angle), 4))
    half[0][:, axis], half[0][:, 3] = np.sin(angle / 2), np.cos(angle / 2)
    half[1][:, axis] = rate / 2 * np.cos(angle / 2)
    half[1][:, 3] = -rate / 2 * np.sin(angle / 2)
    half[2][:, axis] = push / 2 * np.cos(angle / 2) - (rate / 2) ** 2 * np.sin(angle / 2)
    half[2][:, 3] = -push / 2 * np.sin(angle / 2) - (rate / 2) ** 2 * np.cos(angle / 2)
    return tuple(np.column_stack([c[:, :3], h]) for c, h in zip(course, half, strict=True))


def spins(course):
    """ω and α of a course, from ω = 2 q̇ q*."""
    q, rate, push = (part[:, 3:] for part in course)
    back = q * [-1, -1, -1, 1]

    def vector(one, other):
        return (
            other[:, 3:] * one[:, :3]
            + one[:, 3:] * other[:, :3]
            + np.cross(one[:, :3], other[:, :3])
        )

    return 2 * vector(rate, back), 2 * vector(push, back)
