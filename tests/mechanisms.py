"""Small mechanisms built in code, exact or with axes and origins that are off a little."""

from dataclasses import dataclass, field

import numpy as np
import pinocchio as pin

from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.model.formats.closure_file import ClosureFile


@dataclass
class Tree:
    """A URDF and closure file in the making."""

    noise: float = 0.0
    origin_noise: float = 0.0
    seed: int = 0
    links: list = field(default_factory=lambda: ['<link name="ground"/>'])
    joints: list = field(default_factory=list)
    loops: list = field(default_factory=list)
    kinds: list = field(default_factory=list)
    motors: list = field(default_factory=list)
    types: dict = field(default_factory=dict)

    def __post_init__(self):
        self.random = np.random.default_rng(self.seed)

    def link(self, name, parent, axis, xyz=(0, 0, 0), turn=None, bar=(0.1, 0, 0), mass=0.3, **more):
        """A slender bar on a joint; ``type`` revolute, prismatic, continuous, fixed, SPHERICAL."""
        kind = more.pop("type", "revolute")
        self.frame(name, parent, xyz, turn, kind, axis)
        centre = np.asarray(bar, float) / 2
        length = max(float(np.linalg.norm(bar)), 0.02)
        along = np.asarray(bar, float) / max(np.linalg.norm(bar), 1e-12)
        tensor = mass * length**2 / 12 * (np.eye(3) - 0.98 * np.outer(along, along))
        inertia = (
            " ".join(
                f'{key}="{tensor[i, j]!r}"'
                for key, i, j in (
                    ("ixx", 0, 0),
                    ("ixy", 0, 1),
                    ("ixz", 0, 2),
                    ("iyy", 1, 1),
                    ("iyz", 1, 2),
                    ("izz", 2, 2),
                )
            )
            .replace("np.float64(", "")
            .replace(")", "")
        )
        self.links[-1] = (
            f'<link name="{name}"><inertial><origin xyz="{words(centre)}"/><mass value="{mass}"/>'
            f"<inertia {inertia}/></inertial></link>"
        )
        if more.pop("motor", False):
            self.motors.append(f"{name}_joint")
        return name

    def frame(self, name, parent, xyz=(0, 0, 0), turn=None, kind="fixed", axis=None):
        """A massless link."""
        self.links.append(f'<link name="{name}"/>')
        xyz = np.asarray(xyz, float) + self.origin_noise * self.random.normal(size=3)
        rpy = pin.rpy.matrixToRpy(np.eye(3) if turn is None else np.asarray(turn))
        more = ""
        if kind == "SPHERICAL":
            self.types[f"{name}_joint"] = kind
            kind, axis = "revolute", (1, 0, 0)
        elif axis is not None:
            axis = np.asarray(axis, float) / np.linalg.norm(axis)
            axis = axis + self.noise * self.random.normal(size=3)
        if axis is not None:
            more = f'<axis xyz="{words(axis)}"/>'
        if kind in ("revolute", "prismatic"):
            more += '<limit lower="-6" upper="6" effort="50" velocity="20"/>'
        self.joints.append(
            f'<joint name="{name}_joint" type="{kind}"><parent link="{parent}"/>'
            f'<child link="{name}"/><origin xyz="{words(xyz)}" rpy="{words(rpy)}"/>{more}</joint>'
        )
        return name

    def loop(self, one, two, kind="3d"):
        """A closure of two frames."""
        self.loops.append([one, two])
        self.kinds.append(kind)

    @property
    def urdf(self):
        return f'<robot name="r">{"".join(self.links)}{"".join(self.joints)}</robot>'

    @property
    def yaml(self):
        text = f"closed_loop: {self.loops}\ntype: {self.kinds}\nname_mot: {self.motors}\n"
        if self.types:
            text += f"joint_name: {list(self.types)}\njoint_type: {list(self.types.values())}\n"
        return text

    def robot(self, extra="", root_joint=None):
        return ClosedRobot(self.urdf, ClosureFile.parse(self.yaml + extra), root_joint)


def words(vector):
    return " ".join(repr(float(x)) for x in vector)


def turned(axis, angle):
    return pin.exp3(angle * np.asarray(axis, float) / np.linalg.norm(axis))


UPRIGHT = turned((1, 0, 0), np.pi / 2)


def four_bar(motor_type="revolute", size=1.0, **noise):
    t = Tree(**noise)
    s = size
    t.link(
        "crank", "ground", (0, 0, 1), turn=UPRIGHT, bar=(0.1 * s, 0, 0), motor=True, type=motor_type
    )
    t.link("coupler", "crank", (0, 0, 1), (0.1 * s, 0, 0), bar=(0.3 * s, 0, 0))
    t.link("rocker", "ground", (0, 0, 1), (0.28 * s, 0, 0), UPRIGHT, bar=(0.22 * s, 0, 0))
    t.frame("coupler_tip", "coupler", (0.3 * s, 0, 0))
    t.frame("rocker_tip", "rocker", (0.22 * s, 0, 0))
    t.loop("coupler_tip", "rocker_tip")
    return t, [0.8, -0.3, 1.4]


def five_bar(**noise):
    t = Tree(**noise)
    t.link("left", "ground", (0, 0, 1), turn=UPRIGHT, bar=(0.2, 0, 0), motor=True)
    t.link("left_rod", "left", (0, 0, 1), (0.2, 0, 0), bar=(0.3, 0, 0))
    t.link("right", "ground", (0, 0, 1), (0.2, 0, 0), UPRIGHT, bar=(0.2, 0, 0), motor=True)
    t.link("right_rod", "right", (0, 0, 1), (0.2, 0, 0), bar=(0.3, 0, 0))
    t.frame("left_tip", "left_rod", (0.3, 0, 0))
    t.frame("right_tip", "right_rod", (0.3, 0, 0))
    t.loop("left_tip", "right_tip")
    return t, [2.2, -1.3, 0.9, 1.2]


def parallelogram(**noise):
    """Three parallel legs of which two would do."""
    t = Tree(**noise)
    t.link("leg_0", "ground", (0, 0, 1), turn=UPRIGHT, bar=(0.2, 0, 0), motor=True)
    t.link("platform", "leg_0", (0, 0, 1), (0.2, 0, 0), bar=(0.4, 0, 0), mass=0.8)
    for k, place in ((1, 0.15), (2, 0.4)):
        t.link(f"leg_{k}", "ground", (0, 0, 1), (place, 0, 0), UPRIGHT, bar=(0.2, 0, 0))
        t.frame(f"tip_{k}", f"leg_{k}", (0.2, 0, 0))
        t.frame(f"seat_{k}", "platform", (place, 0, 0))
        t.loop(f"tip_{k}", f"seat_{k}")
    return t, [1.1, -1.1, 1.1, 1.1]


def bennett(wrong=0.0, **noise):
    """Four skew axes that move by a law of their link lengths and twists."""
    t = Tree(**noise)
    twists, lengths = (0.6, 1.1), (0.2, 0.2 * np.sin(1.1) / np.sin(0.6))
    xyz, turn = (0, 0, 0), turned((0, 1, 0), 0.4)
    parent = "ground"
    for k in range(4):
        a, alpha = lengths[k % 2], twists[k % 2] + (wrong if k == 2 else 0.0)
        name = t.link(f"bar_{k}", parent, (0, 0, 1), xyz, turn, (a, 0, 0), motor=k == 0)
        xyz, turn, parent = (a, 0, 0), turned((1, 0, 0), alpha), name
    t.frame("end", parent, xyz, turn)
    t.frame("start", "ground", turn=turned((0, 1, 0), 0.4))
    t.loop("start", "end", "6d")
    theta = 1.0
    half = np.sin((twists[0] + twists[1]) / 2) / np.sin((twists[0] - twists[1]) / 2)
    other = 2 * np.arctan(half / np.tan(theta / 2))
    return t, [theta, other, -theta, -other]


def sarrus(**noise):
    """Two legs of three parallel axes in planes at right angles: straight-line motion."""
    t = Tree(**noise)
    t.link("low_a", "ground", (0, 1, 0), (0.1, 0, 0), bar=(0.15, 0, 0.13), motor=True)
    t.link("high_a", "low_a", (0, 1, 0), (0.15, 0, 0.13), bar=(-0.15, 0, 0.13))
    t.link("top", "high_a", (0, 1, 0), (-0.15, 0, 0.13), bar=(-0.2, 0, 0), mass=1.0)
    t.link("low_b", "ground", (1, 0, 0), (0, 0.1, 0), bar=(0, 0.15, 0.13))
    t.link("high_b", "low_b", (1, 0, 0), (0, 0.15, 0.13), bar=(0, -0.15, 0.13))
    t.link("lid", "high_b", (1, 0, 0), (0, -0.15, 0.13), bar=(0, -0.1, 0), mass=0.1)
    t.frame("seat", "top", (-0.1, 0, 0))
    t.frame("plug", "lid", (0, -0.1, 0))
    t.loop("seat", "plug", "6d")
    return t, [0.1, -0.2, 0.1, -0.1, 0.2, -0.1]


def three_rrs(**noise):
    t = Tree(**noise)
    for k in range(3):
        turn = turned((0, 0, 1), 2 * np.pi * k / 3)
        t.link(
            f"crank_{k}", "ground", (0, 1, 0), turn @ (0.2, 0, 0), turn, (0.08, 0, 0.1), motor=True
        )
        t.link(f"rod_{k}", f"crank_{k}", (0, 1, 0), (0.08, 0, 0.1), bar=(-0.1, 0, 0.2))
        if k == 0:
            t.link(
                "top", "rod_0", None, (-0.1, 0, 0.2), bar=(-0.36, 0, 0), mass=1.0, type="SPHERICAL"
            )
        else:
            t.frame(f"tip_{k}", f"rod_{k}", (-0.1, 0, 0.2))
            corner = turn @ (0.18, 0, 0) - np.array([0.18, 0, 0])
            t.frame(f"corner_{k}", "top", corner)
            t.loop(f"tip_{k}", f"corner_{k}")
    return t, [0.1, -0.2, 0.0, 0.0, 0.0, 1.0, 0.0, -0.1, 0.05, 0.2]


def delta(**noise):
    """Three arms and six rods between ball joints; every rod spins about itself."""
    t = Tree(**noise)
    for k in range(3):
        turn = turned((0, 0, 1), 2 * np.pi * k / 3)
        t.link(f"arm_{k}", "ground", (0, 1, 0), turn @ (0.1, 0, 0), turn, (0.2, 0, 0), motor=True)
        for side in (-1, 1):
            rod, y = f"rod_{k}_{side}", 0.05 * side
            bar = np.array([-0.21, 0, -0.35])
            t.link(rod, f"arm_{k}", None, (0.2, y, 0), bar=bar, mass=0.05, type="SPHERICAL")
            seat = turn @ (0.09, y, 0)
            if (k, side) == (0, -1):
                t.link("tool", rod, None, bar, bar=(0.02, 0, 0.02), mass=0.5, type="SPHERICAL")
                first = seat
            else:
                t.frame(f"tip_{k}_{side}", rod, bar)
                t.frame(f"seat_{k}_{side}", "tool", seat - first)
                t.loop(f"tip_{k}_{side}", f"seat_{k}_{side}")
    return t, None


def triangle(**noise):
    """A structure: three bars, three pins."""
    t = Tree(**noise)
    t.link("one", "ground", (0, 0, 1), turn=UPRIGHT, bar=(0.3, 0, 0), motor=True)
    t.link("two", "ground", (0, 0, 1), (0.4, 0, 0), UPRIGHT, bar=(0.3, 0, 0))
    t.frame("tip_one", "one", (0.3, 0, 0))
    t.frame("tip_two", "two", (0.3, 0, 0))
    t.loop("tip_one", "tip_two")
    return t, [0.84, 2.3]


def flat_two_bar(**noise):
    """Two bars in one line between two pins: it moves infinitesimally only."""
    t = Tree(**noise)
    t.link("one", "ground", (0, 0, 1), turn=UPRIGHT, bar=(0.3, 0, 0), motor=True)
    t.link("two", "ground", (0, 0, 1), (0.6, 0, 0), UPRIGHT, bar=(0.3, 0, 0))
    t.frame("tip_one", "one", (0.3, 0, 0))
    t.frame("tip_two", "two", (0.3, 0, 0))
    t.loop("tip_one", "tip_two")
    return t, [0.0, np.pi]


PLANAR = {"four_bar": four_bar, "five_bar": five_bar, "parallelogram": parallelogram}
SPATIAL = {"bennett": bennett, "sarrus": sarrus, "three_rrs": three_rrs, "delta": delta}
EVERY = {**PLANAR, **SPATIAL}
RANKS = {
    "four_bar": (3, 2),
    "five_bar": (3, 2),
    "parallelogram": (6, 3),
    "bennett": (6, 3),
    "sarrus": (6, 5),
    "three_rrs": (6, 6),
    "delta": (15, 15),
}


def built(name, **noise):
    """A robot and a configuration near a closed one."""
    tree, guess = EVERY[name](**noise)
    robot = tree.robot()
    return robot, robot.q0 if guess is None else np.array(guess, float)


def projected_torque(robot, rank, q, v, a):
    """Motor torques by null-space projection of Pinocchio's frame Jacobians, rank given."""
    model, data = robot.model, robot.model.createData()
    rows = []
    pin.computeJointJacobians(model, data, q)
    pin.updateFramePlacements(model, data)
    axes = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
    for loop in robot.loops:
        one, two = (pin.getFrameJacobian(model, data, k, axes) for k in loop.ids)
        rows.append((two - one)[: 3 if loop.kind == "3d" else 6])
    matrix = np.concatenate(rows)
    motions = np.linalg.svd(matrix)[2][rank:]
    load = motions @ pin.rnea(model, data, q, v, a)
    return np.linalg.lstsq(motions[:, robot.actuated], load, rcond=None)[0]
