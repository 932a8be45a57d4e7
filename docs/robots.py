"""Robots no one here made: what this package finds, and how far from another way of computing.

Run ``python docs/robots.py`` to renew the rows of example-robot-data in docs/robots.json, and
``python docs/robots.py SOURCE=FOLDER ...`` those of other sources, checked out at the commit
that :data:`SOURCES` names; then ``python docs/readme_tables.py``.

Torques of trees are held against MuJoCo's ``mj_inverse``. Those of robots with loops are held
against null-space projection: the loops' Jacobian by central differences of Pinocchio's frame
placements, its null space by SVD, Pinocchio's ``rnea``; none of this package's equations.
"""

from __future__ import annotations

import json
import re
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

import thesis_pin
from thesis_pin.loops.checking.assembly import assembly
from thesis_pin.loops.configurations.closing import motor_positions
from thesis_pin.loops.configurations.following import follow
from thesis_pin.loops.kinematics import mobility
from thesis_pin.model.mechanism.closure_types import rows_of

Array = NDArray[np.float64]

STORE = Path(__file__).parent / "robots.json"
SAMPLES = 200
STEP = 1e-5

SOURCES = {
    "example-robot-data": ("https://github.com/Gepetto/example-robot-data", "6.0.0", ""),
    "example-parallel-robots": (
        "https://github.com/Gepetto/example-parallel-robots",
        "52e64b3",
        "2026-08-01",
    ),
    "cassie-mujoco-sim": (
        "https://github.com/osudrl/cassie-mujoco-sim",
        "188d3d7",
        "2023-04-13",
    ),
}
"""Source → address, version or commit, date of a commit."""

EXAMPLES = {
    "cassie_description/cassie_v2": ["-op", "knee-shin"],
    "panda": [],
    "solo12": [],
    "talos_full_v2": [],
    "ur5_robot": [],
}
"""Of example-robot-data: name → parts of the motors' names, where its SDF says none.

Cassie's shins are held as if by motors instead of by their springs.
"""


def row(source: str, name: str, file: str, closures: str | None = None) -> dict[str, object]:
    """What is found of one robot."""
    robot = thesis_pin.load(file, closures)
    found = assembly(robot)
    if not found.closed:
        return {"source": source, "robot": name, "open": str(found.widest)}
    moves = mobility(robot, found.q)
    q, v, a = state(robot, found.q)
    stack = [np.repeat(x, SAMPLES, axis=0) for x in (q, v, a)]
    torque = thesis_pin.inverse_dynamics(robot, *stack).torque[0]
    best = np.inf
    for _ in range(3):
        begun = time.perf_counter()
        thesis_pin.inverse_dynamics(robot, *stack)
        best = min(best, time.perf_counter() - begun)
    tree = not robot.loops and not robot.couplings
    other = by_mujoco(robot, q[0], v[0], a[0]) if tree else by_null_space(robot, q[0], v[0], a[0])
    return {
        "source": source,
        "robot": name,
        "loops": len(robot.loops),
        "equations": robot.equations,
        "freedom": moves.freedom,
        "idle": sum(group.freedoms for group in moves.idle),
        "motors": len(robot.actuators),
        "against": "MuJoCo" if tree else "null space",
        "difference": float(np.abs(torque - other).max() / max(np.abs(other).max(), 1e-12)),
        "microseconds": float(best / SAMPLES * 1e6),
    }


def state(robot: thesis_pin.ClosedRobot, q: Array) -> tuple[Array, Array, Array]:
    """A state with moving motors at a closed configuration, each ``(1, …)``."""
    generator = np.random.default_rng(0)
    rates, accelerations = generator.uniform(-1, 1, (2, 1, len(robot.actuators)))
    motors = motor_positions(robot, q)[None]
    motion = follow(robot, [0.0], motors, rates, accelerations, q)
    return motion.q, motion.v, motion.a


def tree_load(robot: thesis_pin.ClosedRobot, q: Array, v: Array, a: Array) -> Array:
    """Generalized forces of the open tree: rnea, dampers, friction, springs."""
    model = robot.model
    load = pin.rnea(model, model.createData(), q, v, a)
    load = load + model.damping * v + model.upperDryFrictionLimit * np.sign(v)
    for spring in robot.springs:
        joint = model.joints[model.getJointId(spring.joint)]
        load[joint.idx_v] += spring.stiffness * (q[joint.idx_q] - spring.rest)
    return np.asarray(load)


def by_null_space(robot: thesis_pin.ClosedRobot, q: Array, v: Array, a: Array) -> Array:
    """Motor torques by projection onto the null space of differences."""
    model, data = robot.model, robot.model.createData()

    def relative(q: Array) -> list[pin.SE3]:
        pin.framesForwardKinematics(model, data, q)
        return [data.oMf[one].actInv(data.oMf[two]) for one, two in (x.ids for x in robot.loops)]

    here = relative(q)
    columns = []
    for step in STEP * np.eye(model.nv):
        ahead, behind = (
            relative(pin.integrate(model, q, step)),
            relative(pin.integrate(model, q, -step)),
        )
        parts = []
        for loop, now, after, before in zip(robot.loops, here, ahead, behind, strict=True):
            change = (after.rotation - before.rotation) / (2 * STEP) @ now.rotation.T
            turn = np.array([change[2, 1], change[0, 2], change[1, 0]])
            shift = (after.translation - before.translation) / (2 * STEP)
            mask = rows_of(loop.kind)
            if mask is None or sum(mask[3:]) == 1 or not any(mask):
                raise SystemExit(f"{loop.name}: {loop.kind} isn't written out here")
            parts.append(np.concatenate([shift, turn])[list(mask)])
        columns.append(np.concatenate([np.empty(0), *parts]))
    matrix = np.column_stack(columns)
    ties = np.zeros((len(robot.couplings), model.nv))
    for k, coupling in enumerate(robot.couplings):
        for name, factor in coupling.coefficients.items():
            ties[k, model.joints[model.getJointId(name)].idx_v] = factor
    matrix = np.concatenate([matrix, ties])
    _, values, basis = np.linalg.svd(matrix)
    motions = basis[int((values > 1e-6 * values[0]).sum()) :]
    held = np.concatenate([robot.actuated, robot.base])
    load = motions @ tree_load(robot, q, v, a)
    return np.linalg.lstsq(motions[:, held], load, rcond=1e-9)[0][: len(robot.actuators)]


def by_mujoco(robot: thesis_pin.ClosedRobot, q: Array, v: Array, a: Array) -> Array:
    """Motor torques of a tree by MuJoCo's inverse dynamics of the same URDF."""
    import mujoco

    text = re.sub(r"<(visual|collision)\b.*?</\1>", "", robot.urdf, flags=re.DOTALL)
    compiler = r'\1<mujoco><compiler fusestatic="false"/></mujoco>'
    text = re.sub(r"(<robot[^>]*>)", compiler, text, count=1)
    model = mujoco.MjModel.from_xml_string(text)
    model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_CONSTRAINT)
    model.opt.gravity[:] = robot.model.gravity.linear
    data = mujoco.MjData(model)
    places = []
    for name in list(robot.model.names)[1:]:
        joint = robot.model.joints[robot.model.getJointId(name)]
        theirs = model.joint(name)
        position = q[joint.idx_q]
        if joint.nq == 2:
            position = np.arctan2(q[joint.idx_q + 1], q[joint.idx_q])
        data.qpos[theirs.qposadr[0]] = position
        data.qvel[theirs.dofadr[0]], data.qacc[theirs.dofadr[0]] = v[joint.idx_v], a[joint.idx_v]
        places.append(theirs.dofadr[0])
    mujoco.mj_inverse(model, data)
    force = data.qfrc_inverse + model.dof_frictionloss * np.sign(data.qvel)
    by_joint = dict(zip(list(robot.model.names)[1:], force[places], strict=True))
    return np.array([by_joint[name] for name in robot.actuators])


def examples() -> Iterator[dict[str, object]]:
    """Rows of what example-robot-data carries."""
    for name, motors in EXAMPLES.items():
        with tempfile.TemporaryDirectory() as folder:
            beside = Path(folder, "motors.yaml")
            beside.write_text(f"closed_loop: []\ntype: []\nname_mot: {motors}\n")
            closures = str(beside) if motors else None
            yield row("example-robot-data", name.rpartition("/")[2], f"example:{name}", closures)


def of_folder(source: str, folder: Path) -> Iterator[dict[str, object]]:
    """Rows of a checked-out source: pairs of URDF and YAML, or MJCF files."""
    for file in sorted(folder.rglob("*.urdf")):
        closures = file.with_suffix(".yaml")
        if closures.is_file() and "old" not in str(file):
            yield from _tried(source, file.parent.name, str(file), str(closures))
    for file in sorted(folder.rglob("*.xml")):
        yield from _tried(source, file.name, str(file), None)


def _tried(source: str, name: str, file: str, closures: str | None) -> Iterator[dict[str, object]]:
    try:
        yield row(source, name, file, closures)
    except thesis_pin.ThesisPinError as error:
        said = str(error).replace(str(Path(file).parent) + "/", "").partition(";")[0]
        yield {"source": source, "robot": name, "refused": said[:120]}


if __name__ == "__main__":
    stored = json.loads(STORE.read_text(encoding="utf-8")) if STORE.is_file() else []
    asked = dict(word.split("=", 1) for word in sys.argv[1:])
    renewed: list[dict[str, object]] = []
    for source in SOURCES:
        if source == "example-robot-data" and not asked:
            renewed += examples()
        elif source in asked:
            renewed += of_folder(source, Path(asked[source]))
        else:
            renewed += [one for one in stored if one["source"] == source]
    STORE.write_text(json.dumps(renewed, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
