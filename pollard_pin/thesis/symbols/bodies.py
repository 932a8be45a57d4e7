"""Frames, centres of gravity and Jacobians of the nine bodies, from products of transforms.

Bodies are called "1" to "5" (chain 0), "11" and "21" (arm and rod of chain 1),
"12" and "22" (chain 2): the thesis's 1i and 2i with i put in.

Source: Pollard thesis, 3.2 and 3.4 (frames and centres of gravity), figures 3-1, 3-2.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from pollard_pin.specification import LINK_NAMES, Specification
from pollard_pin.thesis.state import CONSTANTS_I, LENGTHS_0, Matrices, State
from pollard_pin.thesis.symbols.loops import PATHS, Path, placement
from pollard_pin.thesis.symbols.rates import joint_rates
from thesis_pin.equations import lagrangian
from thesis_pin.equations.dual import Dual, dual
from thesis_pin.model.mechanism.inertia import Reading

BODIES = ("1", "2", "3", "4", "5", "11", "21", "12", "22")
"""In the order of :data:`pollard_pin.specification.LINK_NAMES`."""

_OWN_FRAMES = {"1": "2", "2": "5", "3": "16", "4": "17", "5": "18", "1i": "3i", "2i": "7i"}


def own_frame(body: str) -> tuple[str, str]:
    """Frame of a body and the chain it is on: "3" → ("16", ""), "21" → ("7i", "1")."""
    if len(body) == 1:
        return _OWN_FRAMES[body], ""
    return _OWN_FRAMES[f"{body[0]}i"], body[1]


def origin(state: State, frame: str, i: str = "") -> Matrices:
    """Origin of a frame in the base frame [m], shape ``(..., 3)``."""
    return placement(state, PATHS[frame], i)[..., :3, 3]


def turned(state: State, frame: str, i: str = "") -> Matrices:
    """Rotation of a frame, shape ``(..., 3, 3)``."""
    return placement(state, PATHS[frame], i)[..., :3, :3]


def centre(state: State, body: str) -> Matrices:
    """Centre of gravity of a body in the base frame [m], shape ``(..., 3)``."""

    def made(state: State) -> Matrices:
        local = state.constants[f"centre {body}"]
        local = np.concatenate([local, np.ones_like(local[..., :1])], axis=-1)
        return (placement(state, *_path(body)) @ local[..., None])[..., :3, 0]

    return state.kept(("centre", body), made, rank=1)


def inertia(state: State, body: str) -> np.ndarray:
    """Inertia of a body about its centre of gravity in the base frame's axes [kg·m²]."""
    rotation = turned(state, *own_frame(body))
    return np.asarray(rotation @ state.constants[f"inertia {body}"] @ np.swapaxes(rotation, -1, -2))


def bodies(state: State) -> dict[str, lagrangian.Body]:
    """All bodies with their Jacobians by the pose, on closed states."""
    rates, moved = joint_rates(state), state.by_each()
    found = {}
    for body in BODIES:
        place, frame = centre(moved, body), dual(placement(moved, *_path(body)))
        linear, angular = (_by_pose(slopes, rates) for slopes in (place, frame.axes()))
        mass = state.constants[f"mass {body}"]
        found[body] = lagrangian.Body(mass, inertia(state, body), linear, angular, place.value)
    return found


def _by_pose(slopes: Dual, rates: Mapping[str, np.ndarray]) -> np.ndarray:
    """Jacobian by the pose, shape ``(..., 3, 6)``, of a vector whose slopes are by the joints."""
    joints = [name for name in slopes.directions if name in rates]
    rows = np.stack(np.broadcast_arrays(*(rates[str(name)] for name in joints)), axis=-2)
    return np.asarray(slopes.jacobian(joints) @ rows)


def _path(body: str) -> tuple[Path, str]:
    frame, i = own_frame(body)
    return PATHS[frame], i


def random_constants(generator: np.random.Generator, size: int) -> dict[str, np.ndarray]:
    """Masses [kg], centres of gravity [m] and inertias [kg·m²] of nine unequal bodies."""
    found = {}
    for body in BODIES:
        found[f"mass {body}"] = generator.uniform(0.2, 2.0, size)
        found[f"centre {body}"] = generator.uniform(-0.5, 0.5, (size, 3))
        root = generator.uniform(-0.5, 0.5, (size, 3, 3))
        found[f"inertia {body}"] = root @ np.swapaxes(root, -1, -2) + 0.05 * np.eye(3)
    return found


def constants_of(specification: Specification, reading: Reading) -> dict[str, np.ndarray]:
    """Lengths, angles, masses, centres and inertias of a robot, each with a batch axis of 1."""
    found: dict[str, object] = {name: getattr(specification.chain_0, name) for name in LENGTHS_0}
    signs = specification.assumptions.signs.value
    for i, side, sign in zip("12", specification.side_chains, signs, strict=True):
        found[f"signo{i}"] = sign
        found |= {f"{name}{i}": getattr(side, name) for name in CONSTANTS_I[:6]}
        found[f"beta_54{i}"] = np.radians(side.beta_54_deg)
        found[f"beta_1413{i}"] = np.radians(side.beta_1413_deg)
    for body, name in zip(BODIES, LINK_NAMES, strict=True):
        found[f"mass {body}"] = specification.links[name].mass
        found[f"centre {body}"] = specification.com(name)
        found[f"inertia {body}"] = specification.centroidal(name, reading)
    for i, side in zip("12", specification.side_chains, strict=True):
        # The arm's centre is given from frame 2i, the thesis counts from 3i.
        found[f"centre 1{i}"] = specification.com(f"chain{i}_arm") + np.array([0, 0, side.z_32])
    return {name: np.asarray(value, dtype=float)[None] for name, value in found.items()}
