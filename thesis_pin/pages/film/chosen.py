"""Which groups of a scene are shown at first."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from thesis_pin.errors import BadInput, UnknownName
from thesis_pin.pages.scene import Scene

ALL = "all"
"""Stands for every group."""


def chosen(scene: Scene, show: Sequence[str] = (), hide: Sequence[str] = ()) -> Scene:
    """The same scene with other groups shown at first; a name among ``show`` outweighs ``all``.

    Args:
        scene: What is shown.
        show: Names of groups to show besides those that are, or ``all``.
        hide: Names of groups to hide, or ``all``.

    Raises:
        UnknownName: The scene has no such group.
        BadInput: A group is to be shown and hidden.
    """
    names = [group.name for group in scene.groups]
    for name in (*show, *hide):
        if name not in (*names, ALL):
            raise UnknownName("group", name, [*names, ALL], where=f"scene {scene.title!r}")
    both = [name for name in show if name in hide]
    if both:
        raise BadInput(f"the group {both[0]!r} is to be shown and hidden")

    def visible(name: str, before: bool) -> bool:
        if name in show or name in hide:
            return name in show
        return ALL in show if ALL in (*show, *hide) else before

    groups = [replace(group, visible=visible(group.name, group.visible)) for group in scene.groups]
    return replace(scene, groups=tuple(groups))
