"""What stands in meshcat, a scene or a robot: its page, and the end of a server of our own."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Self

from meshcat import Visualizer

from thesis_pin.pages.meshcat.page import static


class Shown(ABC):
    """What the viewers of scenes and of robots have in common; a context manager."""

    @abstractmethod
    def _meshcat(self) -> Visualizer:
        """meshcat's own object."""

    @property
    def url(self) -> str:
        """Address of the page."""
        return str(self._meshcat().url())

    def static_html(self) -> str:
        """The page as one that works alone: everything in it, and no request to the network."""
        return static(str(self._meshcat().static_html()))

    def jupyter_cell(self, height: int = 400) -> object:
        """The page in a cell of a notebook on this machine: IPython's HTML.

        Args:
            height: Of the cell, in pixels.
        """
        cell: object = self._meshcat().jupyter_cell(height)
        return cell

    def close(self) -> None:
        """Let go of the server; our own ends."""
        self._meshcat().close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
