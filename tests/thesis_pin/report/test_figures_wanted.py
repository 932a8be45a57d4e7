"""Figures in other formats, resolutions and sizes: opened again by PDFium, Pillow and as XML."""

import io
import re

import numpy as np
import pytest
from PIL import Image

from thesis_pin.errors import BadInput
from thesis_pin.report.curves import Area, Curve, Limit, Plot
from thesis_pin.report.figures import default_style, figure_files, new_figure, panels
from thesis_pin.report.plotting.wanted import Wanted, written_as

pdfium = pytest.importorskip("pypdfium2", reason="pip install pypdfium2")

MM = 72 / 25.4
TIME = np.linspace(0, 4, 50)
PLOT = Plot(
    "Torques of the left leg",
    "A text.",
    "torque [N·m]",
    [Curve(f"motor {k}", np.sin(TIME + k), "#0072B2") for k in range(6)],
    TIME,
    limits=[Limit("stall torque", 1.5)],
)
SQUARE = np.array([(0.0, 0.0), (100.0, 0.0), (100.0, 100.0), (0.0, 100.0)])
PLANE = Plot(
    "From above",
    "A text.",
    "y, forward [mm]",
    [Curve("zero-moment point outside", SQUARE[:, 1], "#0072B2", x=SQUARE[:, 0])],
    areas=[Area("left support of a very wide sole", SQUARE, "#56B4E9")],
    across="x, to the right [mm]",
)


def matplotlib_figure():
    """A figure that Matplotlib lays out."""
    with default_style():
        figure, axes = new_figure(6, 5)
        axes[0, 0].plot([0, 1e-3], [0, 1e5])
        axes[0, 0].set(xlabel="a long name of an axis [mm]", ylabel="another [N·m]", title="Title")
    return figure


def sheet():
    return panels([[PLOT], [PLOT]], 8, 6, "All motors")


def plane():
    return panels([[PLANE, PLANE]], 11, 5)


FIGURES = {"sheet": sheet, "plane": plane, "Matplotlib's": matplotlib_figure}


def drawn(figure, wanted):
    """Files of a figure as wanted."""
    with written_as(wanted):
        return figure_files("figure", FIGURES[figure]())


def opened(content):
    """A PDF's page: size [pt], text, and its pixels at 100 an inch."""
    document = pdfium.PdfDocument(content)
    assert len(document) == 1
    page = document[0]
    pixels = np.asarray(page.render(scale=100 / 72).to_pil().convert("RGB")).astype(int)
    found = page.get_size(), page.get_textpage().get_text_range(), pixels
    document.close()
    return found


@pytest.mark.parametrize("figure", FIGURES)
def test_only_what_is_wanted_is_written_and_the_usual_stays(figure):
    assert set(figure_files("figure", FIGURES[figure]())) == {"figure.png", "figure.svg"}
    assert set(drawn(figure, Wanted(formats=("pdf",)))) == {"figure.pdf"}
    assert set(drawn(figure, Wanted(formats=("svg", "pdf")))) == {"figure.svg", "figure.pdf"}
    assert set(figure_files("figure", FIGURES[figure]())) == {"figure.png", "figure.svg"}


@pytest.mark.parametrize("figure", FIGURES)
def test_a_pdf_looks_like_the_png_and_its_text_is_text(figure):
    files = drawn(figure, Wanted(formats=("pdf", "png"), dots=100))
    (width, height), text, pixels = opened(files["figure.pdf"])
    words = {"sheet": "Torques of the left leg", "plane": "From above", "Matplotlib's": "another"}
    assert words[figure] in text
    assert b"/Type0" in files["figure.pdf"]  # TrueType, whose letters can be searched for
    png = np.asarray(Image.open(io.BytesIO(files["figure.png"])).convert("RGB")).astype(int)
    assert np.abs(np.array(png.shape[1::-1]) - np.array([width, height]) * 100 / 72).max() <= 1
    rows, columns = np.minimum(png.shape[:2], pixels.shape[:2]) // 10 * 10
    blocks = [
        image[:rows, :columns].reshape(rows // 10, 10, columns // 10, 10, 3).mean(axis=(1, 3))
        for image in (png, pixels)
    ]
    apart = [np.abs(blocks[0] - other).mean() for other in (blocks[1], np.flipud(blocks[1]))]
    assert apart[0] < 0.4 * apart[1]
    assert files == drawn(figure, Wanted(formats=("pdf", "png"), dots=100))


@pytest.mark.parametrize("figure", FIGURES)
@pytest.mark.parametrize("size", [(160, 90), (60, 45), (300, 60)])
def test_a_figure_has_exactly_the_size_and_nothing_is_cut(figure, size):
    inches = (size[0] / 25.4, size[1] / 25.4)
    files = drawn(figure, Wanted(("png", "svg", "pdf"), 200, inches))
    found, text, pixels = opened(files["figure.pdf"])
    np.testing.assert_allclose(found, (size[0] * MM, size[1] * MM), atol=0.01)
    png = Image.open(io.BytesIO(files["figure.png"]))
    assert np.abs(np.array(png.size) - 200 * np.array(inches)).max() <= 1
    assert round(png.info["dpi"][0]) == 200
    svg = re.search(rb'width="([\d.]+)pt" height="([\d.]+)pt"|$', files["figure.svg"])
    np.testing.assert_allclose([float(svg[1]), float(svg[2])], found, atol=0.01)
    # What is cut reaches the border.
    edges = (pixels[:1], pixels[-1:], pixels[:, :1], pixels[:, -1:])
    assert all((edge > 235).all() for edge in edges)
    for words in {"sheet": ("motor 5", "stall torque"), "plane": ("very wide sole",)}.get(
        figure, ("a long name", "another")
    ):
        assert words in text


@pytest.mark.parametrize(
    "wrong",
    [
        {"formats": ()},
        {"formats": ("jpg",)},
        {"formats": ("png", "png")},
        {"dots": 10},
        {"dots": 5000},
        {"size": (0.1, 3.0)},
        {"size": (3.0, 500.0)},
        {"size": (float("nan"), 3.0)},
    ],
)
def test_what_can_t_be_written_is_refused(wrong):
    with pytest.raises(BadInput, match="allowed"):
        Wanted(**wrong)
