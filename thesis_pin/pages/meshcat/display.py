"""A scene in meshcat: its objects under one path, its motion on meshcat's own play bar."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np
from meshcat import Visualizer
from meshcat.animation import Animation
from numpy.typing import NDArray

from thesis_pin.numeric.checks import instance, real
from thesis_pin.pages.meshcat.drawing import Drawing, word
from thesis_pin.pages.meshcat.shown import Shown
from thesis_pin.pages.meshcat.stage import box_of, dress, floor_grid
from thesis_pin.pages.meshcat.tracks import SetMotion, animation, samples
from thesis_pin.pages.meshcat.window import visualizer
from thesis_pin.pages.scene import Item, Scene

Array = NDArray[np.float64]


def show(
    scene: Scene, url: str | None = None, *, speed: float = 1.0, port: int | None = None
) -> SceneViewer:
    """Show a scene in meshcat, and play it there. Nothing is printed and no browser opened.

    Args:
        scene: What to show. Its items stand below ``/meshcat/TITLE/GROUP/ITEM`` in meshcat's tree,
            where meshcat's own controls hide and show them.
        url: Address of a running server, as ``tcp://127.0.0.1:6000``; only its objects below
            ``/meshcat/TITLE`` are touched. None starts a server of our own, on 127.0.0.1
            alone, whose camera looks at the scene.
        speed: Playing speed; 1 is real time.
        port: Port of our own server's page, 0 for any; None takes the first free one from 7000.

    Returns:
        The scene's viewer; our own server ends with it.

    Raises:
        BadInput: No server answers there, the port is taken, or an item can't be drawn.
    """
    instance("scene", scene, Scene, "gait_scene(), path_scene() or Scene()")
    speed = real("speed", speed, low=1e-3, high=1e3)
    drawn = visualizer(url, port)
    try:
        return SceneViewer(scene, drawn, speed)
    except BaseException:
        drawn.close()
        raise


class SceneViewer(Shown):
    """A scene in meshcat; a context manager that ends our own server.

    Args:
        scene: The scene.
        drawn: Where it is shown.
        speed: Playing speed.

    Attributes:
        visualizer: meshcat's own object, for all else that it can do.
    """

    def __init__(self, scene: Scene, drawn: Visualizer, speed: float = 1.0) -> None:
        self.visualizer = drawn
        self._time, self._speed = np.asarray(scene.time, dtype=float), speed
        hidden = {group.name for group in scene.groups if not group.visible}
        box = box_of([item for item in scene.items if item.group not in hidden] or scene.items)
        if drawn.window.own:
            dress(drawn, box, scene.forward, scene.camera)
        self._root = drawn[word(scene.title)]
        self._root.delete()
        self._drawing = Drawing(self._root)
        self._nodes = self._drawing.laid(scene.items)
        if scene.floor is not None:
            self._root["floor"].set_object(floor_grid(scene.floor, box))
        self.play()
        for group in scene.groups:
            if not group.visible:
                self._root[word(group.name)].set_property("visible", False)

    def play(self) -> None:
        """Play the whole motion, again and again, on the page's own play bar."""
        for place, node in self._nodes:
            self._drawing.put(place, node, 0)
        keep = samples(self._time, (node for _, node in self._nodes))
        nodes = [(place.path, node.part(keep)) for place, node in self._nodes]
        self._send(animation(nodes, self._time[keep], self._speed), play=True)

    def display(self, t: float) -> None:
        """Stop, and show one moment.

        Args:
            t: Its time [s]; the first or last sample stands for what lies before or after.
        """
        t = float(np.clip(real("t", t), self._time[0], self._time[-1]))
        k = min(int(np.searchsorted(self._time, t, side="right")) - 1, len(self._time) - 2)
        f = float((t - self._time[k]) / (self._time[k + 1] - self._time[k]))
        self._send(Animation(), play=False)
        for place, node in self._nodes:
            self._drawing.put(place, node, *((k + 1, 0.0) if f == 1.0 else (k, f)))

    def move(self, items: Iterable[Item]) -> None:
        """Bring the scene's items to other places; what each of them looks like stays.

        Args:
            items: The same items in the same order, as they stand at their first sample.
        """
        moved = self._drawing.laid(items)
        for (place, first), (_, now) in zip(self._nodes, moved, strict=True):
            self._drawing.put(place, replace(now, shape=first.shape), 0)

    def _meshcat(self) -> Visualizer:
        return self.visualizer

    def __repr__(self) -> str:
        return f"SceneViewer({self.url})"

    def _send(self, motion: Animation, *, play: bool) -> None:
        kept = self._root["animation"].path
        self.visualizer.window.send(SetMotion(motion, kept, play=play))
