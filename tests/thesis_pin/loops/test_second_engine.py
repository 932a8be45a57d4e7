"""Inverse dynamics of mechanisms built in code against MuJoCo, which gets its own text of them.

MuJoCo says the load of the open tree (``mj_inverse`` without constraints: inertia, rotors,
gravity, springs, damping) and the Jacobian of its equalities; the motors' torques
are what does that load's work in every motion that this Jacobian allows.
"""

from xml.etree import ElementTree

import mechanisms as m
import mujoco
import numpy as np
import pytest
from mujoco_twin import Twin, equality_jacobian

from thesis_pin.loops import kinematics as loops
from thesis_pin.loops.dynamics import inverse_dynamics

HINGES = {"revolute": "hinge", "continuous": "hinge", "prismatic": "slide"}


def mjcf(tree, joints, gears):
    """MJCF of a tree: a body and a site for each link, what else is known of its joints."""
    robot = ElementTree.fromstring(tree.urdf)
    links = {link.get("name"): link for link in robot.iter("link")}
    below = {}
    for joint in robot.iter("joint"):
        below.setdefault(joint.find("parent").get("link"), []).append(joint)

    def inside(name):
        """What a body is made of."""
        text = f'<site name="{name}"/>'
        if (inertial := links[name].find("inertial")) is not None:
            mass, tensor = inertial.find("mass").get("value"), inertial.find("inertia")
            tensor = [tensor.get(key) for key in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")]
            text += (
                f'<inertial pos="{inertial.find("origin").get("xyz")}" mass="{mass}" '
                f'fullinertia="{" ".join(tensor)}"/>'
            )
        return text + "".join(map(body, below.get(name, ())))

    def body(joint):
        """A link, placed and moved by its joint."""
        name, child = joint.get("name"), joint.find("child").get("link")
        place, kind = joint.find("origin"), joint.get("type")
        moves = ""
        if name in tree.types:
            moves = f'<joint name="{name}" type="ball" {joints.get(name, "")}/>'
        elif kind != "fixed":
            axis = joint.find("axis").get("xyz")
            moves = (
                f'<joint name="{name}" type="{HINGES[kind]}" axis="{axis}" {joints.get(name, "")}/>'
            )
        where = f'pos="{place.get("xyz")}" euler="{place.get("rpy")}"'
        return f'<body name="{child}" {where}>{moves}{inside(child)}</body>'

    ties = ""
    for kind, (one, other) in zip(tree.kinds, tree.loops, strict=True):
        ties += f'<{ {"3d": "connect", "6d": "weld"}[kind] } site1="{one}" site2="{other}"/>'
    for one, other, shift, factor in gears:
        ties += f'<joint joint1="{one}" joint2="{other}" polycoef="{shift} {factor} 0 0 0"/>'
    return (
        '<mujoco><compiler angle="radian" eulerseq="XYZ"/><option gravity="0 0 -9.81"/>'
        f"<worldbody>{inside('ground')}</worldbody><equality>{ties}</equality></mujoco>"
    )


def four_bar():
    """A rotor on the crank, a spring and a damper in the pins."""
    tree, guess = m.four_bar()
    return tree, guess, 2


def five_bar():
    return *m.five_bar(), 2


def geared_five_bar():
    """One motor; a gear turns the other arm against it."""
    tree, guess = m.five_bar()
    tree.motors.remove("right_joint")
    return tree, guess, 3


def slider_crank():
    """A crank turned by a rod on a sliding motor: metres beside radians."""
    tree = m.Tree()
    tree.link("slide", "ground", (1, 0, 0), bar=(0.05,) * 3, type="prismatic", motor=True)
    tree.link("rod", "slide", (0, 1, 0), bar=(0.3, 0, 0))
    tree.link("crank", "ground", (0, 1, 0), (0.5, 0, 0), bar=(0.2, 0, 0))
    tree.frame("rod_tip", "rod", (0.3, 0, 0))
    tree.frame("crank_tip", "crank", (0.2, 0, 0))
    tree.loop("rod_tip", "crank_tip")
    return tree, [0.15, -0.5, -2.4], 2


def bennett():
    return *m.bennett(), 3


def sarrus():
    return *m.sarrus(), 5


def three_rrs():
    """A plate on three legs with ball joints, one of them in the tree."""
    return *m.three_rrs(), 6


MAKERS = (four_bar, five_bar, geared_five_bar, slider_crank, bennett, sarrus, three_rrs)
FORCES = {  # joint → stiffness, rest, damping, armature
    "four_bar": {
        "crank_joint": (0.0, 0.0, 0.02, 0.03),
        "coupler_joint": (1.3, -0.6, 0.05, 0.0),
        "rocker_joint": (0.7, 0.4, 0.0, 0.01),
    },
    "five_bar": {"left_rod_joint": (2.0, 0.3, 0.1, 0.0), "right_joint": (0.0, 0.0, 0.0, 0.05)},
    "geared_five_bar": {
        "left_joint": (0.0, 0.0, 0.1, 0.02),
        "right_joint": (0.9, 0.2, 0.2, 0.04),
    },
    "slider_crank": {"slide_joint": (40.0, 0.1, 3.0, 0.7), "crank_joint": (0.0, 0.0, 0.1, 0.02)},
    "bennett": {"bar_0_joint": (0.0, 0.0, 0.0, 0.01), "bar_2_joint": (0.4, -1.0, 0.03, 0.02)},
    "sarrus": {"high_a_joint": (3.0, -0.5, 0.1, 0.0), "low_b_joint": (0.0, 0.0, 0.2, 0.03)},
    "three_rrs": {
        "crank_1_joint": (0.0, 0.0, 0.1, 0.02),
        "rod_2_joint": (1.5, 0.1, 0.1, 0.01),
        "top_joint": (0.0, 0.0, 0.04, 0.005),
    },
}
GEARS = {"geared_five_bar": [("right_joint", "left_joint", 3.1, -1.0)]}


def supplement(forces, gears):
    """The same joints' forces and gears as text of a closure file."""
    springs = [
        {"joint": name, "stiffness": spring, "rest": rest}
        for name, (spring, rest, _, _) in forces.items()
        if spring
    ]
    couplings = [
        {"name": "gear", "coefficients": {one: 1.0, other: -factor}, "constant": shift}
        for one, other, shift, factor in gears
    ]
    damping = {name: values[2] for name, values in forces.items()}
    armature = {name: values[3] for name, values in forces.items()}
    return (
        f"thesis_pin: {{format: 1, springs: {springs}, couplings: {couplings}, "
        f"damping: {damping}, armature: {armature}}}\n"
    )


def pair_of(name, with_forces=True):
    """A mechanism as we and as MuJoCo know it, a guess, and how many equations count."""
    tree, guess, rank = {make.__name__: make for make in MAKERS}[name]()
    forces, gears = FORCES[name] if with_forces else {}, GEARS.get(name, [])
    robot = tree.robot(supplement(forces, gears))
    said = {
        joint: f'stiffness="{k}" springref="{rest}" damping="{d}" armature="{rotor}"'
        for joint, (k, rest, d, rotor) in forces.items()
    }
    model = mujoco.MjModel.from_xml_string(mjcf(tree, said, gears))
    numbers = {model.joint(number).name: number for number in range(model.njnt)}
    return Twin(robot, model, mujoco.MjData(model), numbers), guess, rank


def torque_of_mujoco(pair, rank, q, v, a):
    """What does the open tree's work in every motion that MuJoCo's equalities allow."""
    model, data = pair.model, pair.data
    data.qpos, data.qvel, data.qacc = pair.to_qpos(q), pair.to_mujoco(q, v), pair.to_mujoco(q, a)
    rows = equality_jacobian(model, data.qpos)
    values, turned = np.linalg.svd(rows)[1:]
    assert values[rank - 1] > 1e-3 * values[0]
    assert np.abs(values[rank:]).max(initial=0.0) < 1e-10 * values[0]
    motions = turned[rank:]
    model.opt.disableflags = int(mujoco.mjtDisableBit.mjDSBL_CONSTRAINT)
    mujoco.mj_inverse(model, data)
    model.opt.disableflags = 0
    motors = [int(model.jnt_dofadr[pair.names[name]]) for name in pair.robot.actuators]
    assert len(motors) == len(motions)
    return np.linalg.solve(motions[:, motors], motions @ data.qfrc_inverse)


def moved(robot, guess):
    """A motion of all motors near a guess, in three samples."""
    start = loops.close(robot, guess)
    home, time = start[robot.actuated_q], np.linspace(0.0, 1.0, 3)
    phase = np.arange(len(home)) + 2 * time[:, None]
    swing = home + 0.1 * (np.sin(phase) - np.sin(phase[0]))
    rates, accelerations = 1.5 * np.cos(phase), -4.0 * np.sin(phase) - 1.0
    return loops.follow(robot, time, swing, rates, accelerations, start)


@pytest.mark.parametrize("name", [make.__name__ for make in MAKERS])
def test_torques_of_a_closed_mechanism_are_mujocos(name):
    pair, guess, rank = pair_of(name)
    motion = moved(pair.robot, guess)
    found = inverse_dynamics(pair.robot, motion.q, motion.v, motion.a)
    samples = list(zip(motion.q, motion.v, motion.a, strict=True))
    expected = np.array([torque_of_mujoco(pair, rank, *sample) for sample in samples])
    size = np.abs(expected).max()
    np.testing.assert_allclose(found.torque, expected, rtol=0, atol=1e-11 * size)
    # Teeth: without springs, dampers and rotors it would be another torque.
    plain, _, _ = pair_of(name, with_forces=False)
    other = np.array([torque_of_mujoco(plain, rank, *sample) for sample in samples])
    assert np.abs(other - expected).max() > 1e-2 * size
