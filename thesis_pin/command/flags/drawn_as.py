"""``--formats``, ``--dpi``, ``--size``: how the figures of ``--out`` are written."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from thesis_pin.command.flags.numbers import add_count
from thesis_pin.command.flags.sizes import Size, add_size
from thesis_pin.command.registry import Words
from thesis_pin.errors import BadInput
from thesis_pin.numeric.checks import shown

if TYPE_CHECKING:  # help has to be quick
    from thesis_pin.report.plotting.wanted import Wanted

FORMATS = ("png", "svg", "pdf")


def add_figures(words: Words) -> None:
    """The options of figures."""
    words.add_argument(
        "--formats",
        type=_formats,
        metavar="FORMATS",
        help="of the figures of --out: any of png,svg,pdf (default: png,svg)",
    )
    add_count(words, "--dpi", "pixels an inch of .png figures (default: 150)", least=30, most=1200)
    add_size(words)


def _formats(text: str) -> tuple[str, ...]:
    names = tuple(name.strip().lower() for name in text.split(","))
    if not set(names) <= set(FORMATS) or len(set(names)) < len(names):
        raise argparse.ArgumentTypeError(
            f"--formats is {shown(text)}; allowed: any of {','.join(FORMATS)}, each once"
        )
    return names


def figure_style(arguments: argparse.Namespace) -> Wanted:
    """How the arguments want figures; they are refused where none is drawn.

    Raises:
        BadInput: There is no ``--out``, or the size is none of figures.
    """
    from thesis_pin.report.plotting.wanted import Wanted

    given: dict[str, object] = {
        name: getattr(arguments, name, None) for name in ("formats", "dpi", "size")
    }
    for name, value in given.items():
        if value is not None and not arguments.out:
            raise BadInput(f"--{name} belongs to the figures of --out", remedy="Add --out DIR")
    usual = Wanted()
    size: Size | None = getattr(arguments, "size", None)
    return Wanted(
        formats=getattr(arguments, "formats", None) or usual.formats,
        dots=getattr(arguments, "dpi", None) or usual.dots,
        size=None if size is None else size.inches(),
    )
