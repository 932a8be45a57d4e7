"""Whole commands against a Python that imports Pinocchio and does nothing."""

from __future__ import annotations

import csv
import json
import tempfile
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

import numpy as np
import pinocchio as pin
from measuring import Equal, Goal, Peer, Row, Scale
from processes import run
from tables import spaced

import pollard_pin
import scout_pin
from scout_pin.coordinates import free_flyer_state
from suites.pollard_dynamics import unexplained as pollard_unexplained
from suites.scout_dynamics import EXAMPLES
from suites.scout_dynamics import unexplained as scout_unexplained

Words = tuple[str, ...]
IMPORT = Peer("import pinocchio", 1, partial(run, "-c", "import pinocchio"))
SCOUT_IK = ("ik", "left", "--position", "-0.0445", "-0.02", "-0.22")
POLLARD_IK = ("ik", "0.45", "0", "0.05", "0", "10", "0")
CSV_ROWS = 2000


def rows(scale: Scale) -> Iterator[Row]:
    """Every row."""
    with tempfile.TemporaryDirectory() as folder:
        yield from _rows(Path(folder), scale)


def _rows(folder: Path, scale: Scale) -> Iterator[Row]:
    count = "50" if scale.quick else "10001"
    many, out = ("--samples", count), ("--out", str(folder / "out"))
    said = f", {spaced(int(count))} samples"
    biped = ("--specification", str(EXAMPLES / "lopsided.toml"))
    own = folder / "pollard.toml"
    own.write_text(_specification("pollard"), encoding="utf-8")
    arm, written = ("--specification", str(own)), ("--json", str(folder / "report.json"))
    users = ("--gait", str(EXAMPLES / "walk.toml"))
    table = rounded_table(folder, 60 if scale.quick else CSV_ROWS)
    gait, trajectory = ("gait", *many), ("trajectory", *many)
    explained = Equal(
        "RNEA's forces from the JSON's torques and wrenches [N, N·m]", partial(_gait, gait), 1e-9
    )
    closed = Equal(
        "RNEA's torques from the JSON's motors and ball joints [N·m]",
        partial(_trajectory, trajectory),
        1e-9,
    )
    reached = Equal("pose that Pinocchio says the angles reach [m], [-]", _scout_ik, 1e-9)
    touched = Equal("pose that Pinocchio says the angles reach [m], [-]", _pollard_ik, 1e-9)
    masses = [Equal("mass [kg]", partial(_mass, name), 1e-12) for name in ("scout", "pollard")]
    yield _row("scout-pin --help", "scout", ("--help",))
    yield _row("pollard-pin ik", "pollard", POLLARD_IK, touched, 1.5)
    yield _row(f"scout-pin gait{said}", "scout", gait, explained, 2.0)
    yield _row(f"pollard-pin trajectory{said}", "pollard", trajectory, closed, 2.0)
    if scale.quick:
        return
    yield _row(f"pollard-pin trajectory{said}, --out", "pollard", (*trajectory, *out), None, 5.0)
    yield _row("scout-pin info", "scout", ("info",), masses[0], 1.5)
    yield _row("pollard-pin info", "pollard", ("info",), masses[1], 1.5)
    yield _row("scout-pin ik", "scout", SCOUT_IK, reached, 1.5)
    yield _row(f"scout-pin gait{said}, --json", "scout", (*gait, *written), None, 2.5)
    yield _row(f"scout-pin gait{said}, --out", "scout", (*gait, *out), None, None)
    yield _row(f"scout-pin gait{said}, a user's TOML", "scout", (*gait, *users), None, 3.0)
    for name, verb, words in (
        ("scout", "info", ("info", *biped)),
        ("scout", "ik", (*SCOUT_IK, *biped)),
        ("pollard", "info", ("info", *arm)),
        ("pollard", "ik", (*POLLARD_IK, *arm)),
    ):
        yield _row(f"{name}-pin {verb}, a user's TOML", name, words, None, 2.3)
    shipped = Peer("that of the shipped gait", 1, partial(_command, "scout", *gait))
    yield Row(
        f"scout-pin gait{said}, a rounded CSV of {CSV_ROWS} rows",
        1,
        partial(_command, "scout", *gait, "--gait", str(table)),
        shipped,
        None,
        (Goal(1.0, "s more"),),
    )


def _row(
    shown: str, robot: str, words: Words, equal: Equal | None = None,
    most: float | None = None,
) -> Row:  # fmt: skip
    goals = () if most is None else (Goal(most),)
    return Row(shown, 1, partial(_command, robot, *words), IMPORT, equal, goals)


def _command(robot: str, *words: str) -> str:
    code = f"import sys; from {robot}_pin.cli import main; sys.exit(main())"
    return run("-c", code, *words)


def _specification(robot: str) -> str:
    """The shipped specification under another name, as a user's would be."""
    folder = Path(__file__).parents[2] / f"{robot}_pin" / "specifications"
    text = (folder / f"{robot}.toml").read_text(encoding="utf-8")
    return text.replace(f'name = "{robot}"', 'name = "mine"', 1)


def rounded_table(folder: Path, count: int) -> Path:
    """A walk as a table of poses, rounded to 0.01 mm and 0.01°, whose curves have to be found."""
    exact, path = folder / "exact.csv", folder / "rounded.csv"
    words = ("--gait", str(EXAMPLES / "walk.toml"), "--samples", str(count), "--units", "mm,deg")
    _command("scout", "convert", *words, "--as", "poses", "--to", str(exact))
    with exact.open(encoding="utf-8", newline="") as source:
        heading, *lines = csv.reader(source)
    timed = [name == "t" or name.startswith("t_") for name in heading]
    with path.open("w", encoding="utf-8", newline="") as target:
        table = csv.writer(target)
        table.writerow(heading)
        for line in lines:
            table.writerow([_shorter(*pair) for pair in zip(line, timed, strict=True)])
    return path


def _shorter(cell: str, timed: bool) -> str:
    try:
        return f"{float(cell):.4f}" if timed else f"{float(cell):.2f}"
    except ValueError:
        return cell


# -- answers --------------------------------------------------------------------------


def _answer(robot: str, words: Words) -> dict:
    return json.loads(_command(robot, *words, "--json", "-"))


def _arrays(found: dict, names: Words) -> Callable[[np.ndarray], list[np.ndarray]]:
    arrays = [np.array(found[name]) for name in names]
    return lambda few: [one[few] for one in arrays]


def _gait(words: Words) -> float:
    found, robot = _answer("scout", words), scout_pin.load()
    few = np.linspace(0, len(found["time"]) - 1, 20).astype(int)
    names = ("theta", "theta_rate", "theta_acceleration", "torque", "left_wrench", "right_wrench")
    q, v, a, torque, left, right = _arrays(found, names)(few)
    gait = scout_pin.load_gait("thesis")
    motion = gait.sample(gait.sample_times(int(words[2])))
    torso = motion.torso.part(few)
    joints = scout_pin.joint_trajectory(robot, motion).part(few)
    state = list(free_flyer_state(torso, joints))
    for whole, told in zip(state, (q, v, a), strict=True):
        whole[:, -12:] = told
    return scout_unexplained(robot, state, torque, np.stack([left, right], axis=1))


def _trajectory(words: Words) -> float:
    found, robot = _answer("pollard", words), pollard_pin.load()
    few = np.linspace(0, len(found["time"]) - 1, 20).astype(int)
    names = ("theta", "theta_rate", "theta_acceleration", "torque", "loop_force")
    q, v, a, torque, force = _arrays(found, names)(few)
    return pollard_unexplained(robot, (q, v, a), torque, force.reshape(-1, 2, 3))


def _scout_ik() -> float:
    robot = scout_pin.load()
    found = _answer("scout", SCOUT_IK)
    goal = pin.SE3(np.eye(3), np.array([float(word) for word in SCOUT_IK[3:]]))
    return _missed(robot, "left_sole", found, goal, first=7)


def _pollard_ik() -> float:
    robot = pollard_pin.load()
    found = _answer("pollard", POLLARD_IK)
    x, y, z, psi, theta, phi = (float(word) for word in POLLARD_IK[1:])
    turn = [np.radians(angle) for angle in (theta, psi, phi)]
    rotation = pin.utils.rotate("x", turn[0]) @ pin.utils.rotate("y", turn[1])
    goal = pin.SE3(rotation @ pin.utils.rotate("z", turn[2]), np.array([x, y, z]))
    return _missed(robot, "tool_tip", found, goal, first=0)


def _missed(robot: pin.RobotWrapper, frame: str, found: dict, goal: pin.SE3, first: int) -> float:
    """How far the valid branches of an answer are from a pose."""
    worst, q, number = np.inf, pin.neutral(robot.model), robot.model.getFrameId(frame)
    valid = [one["angles"] for one in found["branches"] if one["valid"]]
    for angles in valid:
        q[first : first + len(angles)] = angles
        pin.framesForwardKinematics(robot.model, robot.data, q)
        gap = float(np.abs(robot.data.oMf[number].homogeneous - goal.homogeneous).max())
        worst = gap if worst == np.inf else max(worst, gap)
    return worst


def _mass(name: str) -> float:
    robot = {"scout": scout_pin, "pollard": pollard_pin}[name].load()
    moving = sum(one.mass for one in robot.model.inertias)
    return abs(float(_answer(name, ("info",))["mass"]) - moving)
