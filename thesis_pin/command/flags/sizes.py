"""``--size``: width and height of what is drawn, each kind in its own unit."""

from __future__ import annotations

import argparse
import math
import re
from typing import NamedTuple

from thesis_pin.command.registry import Words
from thesis_pin.errors import BadInput
from thesis_pin.numeric.checks import shown

MILLIMETRES = 25.4
"""Of an inch."""

_FORM = r"(\d+(?:\.\d+)?)\s*[x×]\s*(\d+(?:\.\d+)?)\s*(mm|in|px|)"  # compiled if it is asked for
_ALLOWED = "such as 1280x720 in pixels, 160x90mm, 6.3x3.5in"


class Size(NamedTuple):
    """A width and a height.

    Attributes:
        width, height: In the unit.
        unit: ``px``, ``mm`` or ``in``.
    """

    width: float
    height: float
    unit: str

    def pixels(self) -> tuple[int, int]:
        """Of a film or a picture.

        Raises:
            BadInput: It is in another unit, or in no whole pixels.
        """
        if self.unit != "px" or self.width % 1 or self.height % 1:
            raise BadInput(
                f"--size is {self.width:g}x{self.height:g}{self.unit}",
                allowed="whole pixels of films and pictures, such as 1280x720",
            )
        return int(self.width), int(self.height)

    def inches(self) -> tuple[float, float]:
        """Of a figure.

        Raises:
            BadInput: It is in pixels.
        """
        if self.unit == "px":
            raise BadInput(
                f"--size is {self.width:g}x{self.height:g} without a unit",
                allowed="of figures with one: 160x90mm, 6.3x3.5in",
            )
        factor = MILLIMETRES if self.unit == "mm" else 1.0
        return self.width / factor, self.height / factor


def add_size(words: Words) -> None:
    """How large films and pictures, or figures, are."""
    words.add_argument(
        "--size",
        type=size,
        metavar="WxH",
        help="width and height: of films and pictures in pixels, 1280x720; of figures with their "
        "unit, 160x90mm or 6.3x3.5in",
    )


def size(text: str) -> Size:
    """An argparse type: ``WxH`` with a unit, or none for pixels."""
    found = re.fullmatch(_FORM, text.strip(), re.IGNORECASE)
    values = [float(found[1]), float(found[2])] if found else [math.nan]
    if found is None or not all(math.isfinite(value) and value > 0 for value in values):
        raise argparse.ArgumentTypeError(f"--size is {shown(text)}; allowed: {_ALLOWED}")
    return Size(values[0], values[1], found[3].lower() or "px")
