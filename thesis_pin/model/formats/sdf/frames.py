"""Where the links, joints and frames of an SDF model stand."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from thesis_pin.errors import ModelError, UnknownName
from thesis_pin.model.formats.sdf.elements import pose_of, text_of
from thesis_pin.model.formats.xml import Element
from thesis_pin.model.mechanism.description import Array
from thesis_pin.numeric.rotations import invert

MODEL, WORLD = "__model__", "world"


@dataclass(eq=False)
class Frames:
    """Frames of a model by name, placed in the model's own.

    A link's pose is in the model's frame, a joint's in its child's, a frame's in what
    it is attached to, if they don't say otherwise.

    Attributes:
        model: The ``<model>``.
        elements: Its links, joints and frames by name.
        where: File name for messages.
    """

    model: Element
    elements: dict[str, Element]
    where: str
    _placed: dict[str, Array] = field(default_factory=lambda: {MODEL: np.eye(4)})

    def __post_init__(self) -> None:
        self._placed[WORLD] = invert(self.model_in_world())

    def model_in_world(self) -> Array:
        """Placement of the model's frame in the world [m], shape ``(4, 4)``."""
        here = f"{self.where}:{self.model.line}: model {self.model.get('name', '')!r}"
        place, relative = pose_of(self.model, here)
        if relative not in ("", WORLD):
            raise UnknownName("frame", relative, [WORLD], where=here)
        held = self.model.get("placement_frame", "")
        return place @ invert(self.placement(held)) if held else place

    def placement(self, name: str) -> Array:
        """Placement of a frame in the model's [m], shape ``(4, 4)``.

        Raises:
            UnknownName: There is no such frame.
            ModelError: It is placed in a frame that is placed in it.
        """
        path: dict[str, Element] = {}
        at = name
        while at not in self._placed:
            if at in path:
                raise ModelError(
                    f"the pose of {at!r} goes round in a circle",
                    where=f"{self.where}:{path[at].line}",
                )
            path[at] = self._element(at)
            at = self._base(path[at])
        place = self._placed[at]
        for frame, element in reversed(path.items()):
            place = place @ pose_of(element, self._here(element))[0]
            self._placed[frame] = place
        return place

    def carrier(self, name: str, here: str) -> str:
        """The link, or the world, on which a joint's end stands.

        Args:
            name: A link, or a frame that is attached to one.
            here: Place for messages.
        """
        seen = {name}
        while name != WORLD:
            if name not in self.elements:
                raise UnknownName("link", name, list(self.elements), where=here)
            element = self.elements[name]
            if element.tag == "link":
                break
            name = self._child(element) if element.tag == "joint" else _attached(element)
            if name in seen or name == MODEL:
                raise ModelError(f"frame {name!r} is attached to no link", where=here)
            seen.add(name)
        return name

    def _element(self, name: str) -> Element:
        if name not in self.elements:
            raise UnknownName("link, joint or frame", name, list(self.elements), where=self.where)
        return self.elements[name]

    def _here(self, element: Element) -> str:
        return f"{self.where}:{element.line}: {element.tag} {element.get('name', '')!r}"

    def _base(self, element: Element) -> str:
        here = self._here(element)
        _, relative = pose_of(element, here)
        if relative:
            return relative
        if element.tag == "frame":
            return _attached(element)
        return self._child(element) if element.tag == "joint" else MODEL

    def _child(self, joint: Element) -> str:
        return text_of(joint, "child", self._here(joint)) or MODEL


def _attached(frame: Element) -> str:
    return frame.get("attached_to", "") or MODEL
