"""Drawings in points, written as PNG, SVG and PDF by Matplotlib's renderers.

Below Matplotlib's figures, whose general axes, ticks and layout took four fifths of a
report's time: what a sheet holds is placed already.
"""

from __future__ import annotations

import io
import zlib
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

from thesis_pin.report.curves import STROKES, Dash
from thesis_pin.report.plotting.wanted import DOTS

if TYPE_CHECKING:
    from matplotlib.backend_bases import GraphicsContextBase, RendererBase
    from matplotlib.font_manager import FontProperties

Points = NDArray[np.float64]
Colour = tuple[float, float, float, float]
"""Red, green, blue and opacity, each 0 to 1."""

INCH = 72.0
"""Points."""


def colour(code: str, opacity: float = 1.0) -> Colour:
    """``#rrggbb`` as a colour."""
    red, green, blue = (int(code[k : k + 2], 16) / 255 for k in (1, 3, 5))
    return red, green, blue, opacity


@dataclass(frozen=True)
class Box:
    """A rectangle [pt], from the sheet's lower left corner."""

    left: float
    bottom: float
    right: float
    top: float

    @property
    def width(self) -> float:
        """From left to right."""
        return self.right - self.left

    @property
    def height(self) -> float:
        """From bottom to top."""
        return self.top - self.bottom

    def corners(self) -> Points:
        """Counterclockwise, shape ``(4, 2)``."""
        left, bottom, right, top = self.left, self.bottom, self.right, self.top
        return np.array([(left, bottom), (right, bottom), (right, top), (left, top)])


@dataclass(frozen=True)
class Look:
    """How lines, areas and marks look; also in a legend.

    Attributes:
        stroke: Colour of the line or the edge; None for none.
        width: Of the line [pt].
        dash: How it is broken.
        fill: Colour of the inside; None leaves it open.
        marks: What stands at each point instead of a line between them.
        size: Of a mark [pt].
    """

    stroke: Colour | None = None
    width: float = 1.0
    dash: Dash = "solid"
    fill: Colour | None = None
    marks: Literal["dot", "cross"] | None = None
    size: float = 4.0


@dataclass(frozen=True, eq=False)
class Shape:
    """A line through points, or an area if it is closed.

    Attributes:
        points: [pt], shape ``(n, 2)``; NaN leaves a gap.
        look: How they look.
        closed: Whether the last point is joined to the first.
        clip: What lies outside isn't drawn; None for the whole sheet.
        snap: Whether edges are moved onto whole pixels: for what is upright.
        kind: What it is, for whoever reads the SVG.
    """

    points: Points
    look: Look
    closed: bool = False
    clip: Box | None = None
    snap: bool = False
    kind: str = ""


@dataclass(frozen=True)
class Text:
    """A line of text.

    Attributes:
        x, y: Where [pt]: on its base line.
        text: What it says.
        size: Of the font [pt].
        align: Which part of it stands at ``x``: 0 its start, 0.5 its middle, 1 its end.
        upright: Whether it is read from below to above; ``align`` then is about ``y``.
    """

    x: float
    y: float
    text: str
    size: float
    align: float = 0.0
    upright: bool = False


Mark = Shape | Text


@dataclass(frozen=True, eq=False)
class Sheet:
    """Marks on white.

    Attributes:
        width, height: [inch].
        marks: Later ones cover earlier ones.
    """

    width: float
    height: float
    marks: Sequence[Mark]


@lru_cache(maxsize=4096)
def text_width(text: str, size: float) -> float:
    """How long a line of text is [pt]."""
    from matplotlib.textpath import text_to_path

    return float(text_to_path.get_text_width_height_descent(text, _font(size), ismath=False)[0])


def size_within(text: str, size: float, room: float) -> float:
    """The size of a font, smaller if a line of text would be longer than that [pt]."""
    return size * min(1.0, room / max(text_width(text, size), 1.0))


def png(sheet: Sheet, dots: float = DOTS) -> bytes:
    """A sheet as PNG, without its time, with so many pixels an inch."""
    from matplotlib.backends.backend_agg import RendererAgg
    from PIL import Image

    size = round(sheet.width * dots), round(sheet.height * dots)
    renderer = RendererAgg(*size, dots)
    _draw(sheet, renderer, dots / INCH)
    image = Image.frombuffer("RGBA", size, renderer.buffer_rgba(), "raw", "RGBA", 0, 1)
    content = io.BytesIO()
    # Without the opacity, which is 1, and compressing runs only, writing takes half as long.
    image.convert("RGB").save(content, "PNG", dpi=(dots, dots), compress_type=zlib.Z_RLE)
    return content.getvalue()


def svg(sheet: Sheet) -> bytes:
    """A sheet as SVG, its texts as outlines, without its time."""
    from matplotlib.backends.backend_svg import RendererSVG

    content = io.StringIO()
    size = sheet.width * INCH, sheet.height * INCH
    renderer = RendererSVG(*size, content, image_dpi=int(INCH), metadata={"Date": None})
    _draw(sheet, renderer, 1.0)
    renderer.finalize()
    return content.getvalue().encode()


def pdf(sheet: Sheet) -> bytes:
    """A sheet as PDF, its texts as text, without its time."""
    import matplotlib as mpl
    from matplotlib.backends.backend_pdf import PdfFile, RendererPdf

    content = io.BytesIO()
    with mpl.rc_context({"pdf.fonttype": 42}):  # TrueType, which journals ask for
        file = PdfFile(content, metadata={"CreationDate": None})
        file.newPage(sheet.width, sheet.height)
        renderer = RendererPdf(file, INCH, sheet.height, sheet.width)
        _draw(sheet, renderer, 1.0)
        renderer.finalize()
        file.finalize()
    return content.getvalue()


def fitted(sheet: Sheet, width: float, height: float) -> Sheet:
    """A sheet of exactly that size [inch], with all that is on another and beside it."""
    held = _reach(sheet)
    scale = min(width * INCH / held.width, height * INCH / held.height)
    right = (width * INCH - scale * held.width) / 2 - scale * held.left
    up = (height * INCH - scale * held.height) / 2 - scale * held.bottom

    def moved(mark: Mark) -> Mark:
        if isinstance(mark, Text):
            x, y = right + scale * mark.x, up + scale * mark.y
            return replace(mark, x=x, y=y, size=scale * mark.size)
        look, clip = mark.look, mark.clip
        if clip is not None:
            left, bottom = right + scale * clip.left, up + scale * clip.bottom
            clip = Box(left, bottom, left + scale * clip.width, bottom + scale * clip.height)
        return replace(
            mark,
            points=scale * mark.points + (right, up),
            look=replace(look, width=scale * look.width, size=scale * look.size),
            clip=clip,
        )

    return Sheet(width, height, [moved(mark) for mark in sheet.marks])


_BESIDE = 2.0
"""Room for the width of a line along a sheet's border [pt]."""


def _reach(sheet: Sheet) -> Box:
    """What holds a sheet and all that is on it, where its legends are wider than it is."""
    corners = [np.array([(0.0, 0.0), (sheet.width * INCH, sheet.height * INCH)])]
    for mark in sheet.marks:
        if isinstance(mark, Text):
            long = text_width(mark.text, mark.size) if mark.text else 0.0
            along = np.array([-mark.align, 1.0 - mark.align]) * long
            across = np.array([-0.24, 0.76]) * mark.size
            sides = (-across, along) if mark.upright else (along, across)
            corners.append(np.stack(sides, axis=-1) + np.array([mark.x, mark.y]))
        elif mark.clip is None and len(mark.points):
            corners += [mark.points - _BESIDE, mark.points + _BESIDE]
    every = np.concatenate(corners)
    return Box(*np.nanmin(every, axis=0).tolist(), *np.nanmax(every, axis=0).tolist())


@lru_cache(maxsize=32)
def _font(size: float) -> FontProperties:
    from matplotlib.font_manager import FontProperties

    return FontProperties(size=size)


def _draw(sheet: Sheet, renderer: RendererBase, scale: float) -> None:
    page = Box(0.0, 0.0, sheet.width * INCH, sheet.height * INCH)
    _shape(Shape(page.corners(), Look(fill=colour("#ffffff")), closed=True), renderer, scale)
    for mark in sheet.marks:
        if isinstance(mark, Text):
            _text(mark, renderer, scale, page.height)
        else:
            _shape(mark, renderer, scale)


def _shape(shape: Shape, renderer: RendererBase, scale: float) -> None:
    from matplotlib.path import Path
    from matplotlib.transforms import Affine2D, Bbox

    look, points = shape.look, scale * shape.points
    gc = renderer.new_gc()
    _stroke(gc, look)
    gc.set_snap(shape.snap)
    if shape.clip is not None:
        gc.set_clip_rectangle(Bbox(scale * shape.clip.corners()[::2]))
    if shape.kind:
        renderer.open_group(shape.kind)
    if look.marks == "dot":
        round_ = Path.unit_circle(), Affine2D().scale(scale * look.size / 4)
        renderer.draw_markers(gc, *round_, Path(points), Affine2D(), look.stroke)
    elif look.marks == "cross":
        cross = Path([[-0.5, -0.5], [0.5, 0.5], [-0.5, 0.5], [0.5, -0.5]], [1, 2, 1, 2])
        size = Affine2D().scale(scale * look.size)
        renderer.draw_markers(gc, cross, size, Path(points), Affine2D())
    else:
        path = Path(np.concatenate([points, points[:1]]) if shape.closed else points)
        renderer.draw_path(gc, path, Affine2D(), look.fill)
    if shape.kind:
        renderer.close_group(shape.kind)
    gc.restore()


def _stroke(gc: GraphicsContextBase, look: Look) -> None:
    gc.set_linewidth(look.width if look.stroke else 0.0)
    gc.set_foreground(look.stroke or (0.0, 0.0, 0.0, 1.0), isRGBA=True)
    gc.set_joinstyle("round")
    gc.set_capstyle("butt" if look.dash != "solid" or look.marks else "projecting")
    dashes = [look.width * part for part in STROKES[look.dash]]
    gc.set_dashes(0.0, dashes or None)


def _text(text: Text, renderer: RendererBase, scale: float, height: float) -> None:
    if not text.text:
        return
    gc = renderer.new_gc()
    gc.set_foreground((0.0, 0.0, 0.0, 1.0), isRGBA=True)
    back = text.align * text_width(text.text, text.size) if text.align else 0.0
    x, y = (text.x, text.y - back) if text.upright else (text.x - back, text.y)
    angle = 90.0 if text.upright else 0.0
    place = scale * x, scale * (height - y if renderer.flipy() else y)
    renderer.draw_text(gc, *place, text.text, _font(text.size), angle, ismath=False)
    gc.restore()
