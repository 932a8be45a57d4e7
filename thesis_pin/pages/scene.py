"""What there is to see: a robot and its overlays over time, free of any robot's details.

A scene is data. :mod:`thesis_pin.pages.drawing` makes items from Pinocchio models,
:mod:`thesis_pin.pages.player` turns scenes into pages; nothing here knows of either.
In a notebook a scene plays in its cell.
Every array's first axis is the scene's time; a NaN in an item's sample hides
the item there. Lengths in metres, world frame.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal, get_args

import numpy as np

from thesis_pin.display.brief import Brief
from thesis_pin.errors import BadInput, NotFinite, UnknownName, WrongShape
from thesis_pin.numeric.arrays import thinned as thinned
from thesis_pin.pages import notebook
from thesis_pin.pages.items import AXES as AXES
from thesis_pin.pages.items import GREY as GREY
from thesis_pin.pages.items import Arc as Arc
from thesis_pin.pages.items import Arrow as Arrow
from thesis_pin.pages.items import Ball as Ball
from thesis_pin.pages.items import Bars as Bars
from thesis_pin.pages.items import Item as Item
from thesis_pin.pages.items import Polygon as Polygon
from thesis_pin.pages.items import Shape as Shape
from thesis_pin.pages.items import Trace as Trace
from thesis_pin.pages.items import Triad as Triad

Look = Literal["3d", "front", "side", "top"]
"""From where a scene is seen."""
LOOKS: tuple[Look, ...] = get_args(Look)


@dataclass(frozen=True)
class Group:
    """Items that are shown or hidden together, and their line in the legend.

    Attributes:
        name: What the items' ``group`` says.
        label: Text of the legend.
        colours: Colours of the legend with what each one means; a meaning may be empty.
        visible: Whether it is shown at first.
        key: Letter that shows or hides it besides its number in the legend; empty for none.
    """

    name: str
    label: str
    colours: tuple[tuple[str, str], ...] = ()
    visible: bool = True
    key: str = ""


@dataclass(frozen=True)
class Readout(Brief):
    """A value shown as text beside the picture.

    Attributes:
        label: What it is.
        values: Numbers ``(n,)``, or one of ``texts`` by index ``(n,)``.
        unit: Unit of the numbers.
        digits: Digits after the point.
        texts: What indices stand for; empty for numbers.
    """

    label: str
    values: np.ndarray
    unit: str = ""
    digits: int = 1
    texts: tuple[str, ...] = ()


@dataclass(frozen=True)
class Scene(Brief):
    """Everything a page has to know.

    Attributes:
        title: Headline.
        description: What a reader who can't see the picture should know of it.
        time: Sample times [s], strictly increasing, shape ``(n,)``.
        groups: Groups in the order of the legend.
        items: What is drawn.
        readouts: Values shown as text.
        floor: Height of the floor [m], None for no floor.
        forward: The way ahead on the floor, for the views from front and side.
        camera: Camera position and the point it looks at, shape ``(2, 3)``; None
            looks at the items from the right, ahead and above.
        notes: What there is to say of it, as what can't be drawn, in sentences.
    """

    title: str
    description: str
    time: np.ndarray
    groups: tuple[Group, ...]
    items: tuple[Item, ...]
    readouts: tuple[Readout, ...] = ()
    floor: float | None = 0.0
    forward: tuple[float, float] = (0.0, 1.0)
    camera: np.ndarray | None = None
    notes: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        """Refuse what no page could show.

        Raises:
            WrongShape, NotFinite, UnknownName, BadInput: Says which item and array.
        """
        time = np.asarray(self.time, dtype=float)
        if time.ndim != 1 or len(time) < 2:
            raise WrongShape("time", time.shape, "(n,) with n at least 2")
        if not np.isfinite(time).all() or (np.diff(time) <= 0).any():
            raise BadInput("time must be finite and increase strictly", where="scene")
        known = [group.name for group in self.groups]
        seen: set[str] = set()
        for item in self.items:
            if item.group not in known:
                raise UnknownName("group", item.group, known, where=f"item {item.name!r}")
            if item.name in seen:
                raise BadInput(f"two items are called {item.name!r}", where="scene")
            seen.add(item.name)
            for name, values in item.arrays().items():
                wanted = tuple(len(time) if size == -1 else size for size in item.sampled[name])
                if np.shape(values) != wanted:
                    raise WrongShape(f"{name} of item {item.name!r}", np.shape(values), str(wanted))
                if np.isinf(values).any():
                    where = np.argwhere(np.isinf(values))[0]
                    raise NotFinite(f"{name} of item {item.name!r}", tuple(where.tolist()))
        for readout in self.readouts:
            if np.shape(readout.values) != time.shape:
                raise WrongShape(
                    f"values of readout {readout.label!r}",
                    np.shape(readout.values),
                    str(time.shape),
                )

    def document(self) -> dict[str, object]:
        """The scene as nested dictionaries and arrays, as the player takes it."""
        return {
            "title": self.title,
            "description": self.description,
            "start": float(self.time[0]),
            # From the start on: 32 bits can't tell samples apart by seconds since 1970.
            "time": np.asarray(self.time) - self.time[0],
            "floor": self.floor,
            "forward": self.forward,
            "camera": None if self.camera is None else np.asarray(self.camera).tolist(),
            "notes": self.notes,
            "groups": [vars(group) for group in self.groups],
            "items": [item.document() for item in self.items],
            "readouts": [vars(readout) for readout in self.readouts],
        }

    def every(self, step: int) -> Scene:
        """The same with each ``step``-th of its samples, and the last."""
        keep = np.unique(np.append(np.arange(0, len(self.time), step), len(self.time) - 1))
        items = (
            replace(item, **{name: values[keep] for name, values in item.arrays().items()})
            for item in self.items
        )
        readouts = (replace(one, values=np.asarray(one.values)[keep]) for one in self.readouts)
        time = np.asarray(self.time)[keep]
        return replace(self, time=time, items=tuple(items), readouts=tuple(readouts))

    def _repr_html_(self) -> str:
        """The scene, playing in a notebook's cell; of a large one fewer samples, which is said."""
        sampled = {id(x): x.size for item in self.items for x in item.arrays().values()}
        step = max(1, min(-(-sum(sampled.values()) // notebook.MOST), len(self.time) - 1))
        fewer = f"One of {step} samples is shown, of {len(self.time)} in all." if step > 1 else ""
        return notebook.playing(self.every(step).document(), fewer)


def frames(duration: float) -> int:
    """Number of samples that shows a motion of some seconds smoothly: 60 a second, in bounds."""
    return int(np.clip(round(60 * duration) + 1, 241, 1201))


def levels(values: np.ndarray, bounds: Sequence[float]) -> np.ndarray:
    """Index of the band each value lies in: 0 below the first bound, and so on up."""
    return np.asarray(np.digitize(values, bounds).astype(float))
