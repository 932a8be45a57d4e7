"""The same robot with other numbers, where a derivation reads its numbers from the robot."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from thesis_pin.audit.derivation.moving.states import Frames
from thesis_pin.audit.derivation.moving.tree import Tree

_LEAST, _MOST, _SEED = 0.6, 1.7, 4711
KINDS = ("masses", "inertias", "lengths")
"""What can be varied."""


def varied(tree: Tree, frames: Frames, kinds: Iterable[str], count: int) -> tuple[Tree, Frames]:
    """So many robots with the directions of one, and other sizes.

    Args:
        tree: The robot.
        frames: Its frames.
        kinds: What changes, of :data:`KINDS`.
        count: How many there are to be.
    """
    generator = np.random.default_rng(_SEED)
    wanted = set(kinds)

    def factors(*shape: int) -> np.ndarray:
        return generator.uniform(_LEAST, _MOST, (count, *shape))

    joints = len(tree.names)
    mass, inertia, centre, placements = (
        np.broadcast_to(one, (count, *one.shape)).copy()
        for one in (tree.mass, tree.inertia, tree.centre, tree.placements)
    )
    placed = {
        name: np.broadcast_to(one, (count, *one.shape)).copy()
        for name, one in frames.placement.items()
    }
    if "masses" in wanted:
        mass *= factors(joints)
    if "inertias" in wanted:
        inertia *= factors(joints)[..., None, None]
    if "lengths" in wanted:
        centre *= factors(joints)[..., None]
        placements[..., :3, 3] *= factors(joints)[..., None]
        for one in placed.values():
            one[..., :3, 3] *= factors()[:, None]
    changed = replace(tree, mass=mass, inertia=inertia, centre=centre, placements=placements)
    return changed, replace(frames, placement=placed)
