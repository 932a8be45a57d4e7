"""What a sheet holds is in its PNG and in its SVG, at the same places."""

import io
import re

import numpy as np
import pytest
from PIL import Image

from thesis_pin.report.figures import default_style, figure_files
from thesis_pin.report.plotting.sheet import Box, Look, Shape, Sheet, Text, colour, text_width

RED = Look(colour("#ff0000"), 2.0)


def files(*marks):
    drawn = figure_files("sheet", Sheet(4.0, 3.0, marks))
    image = Image.open(io.BytesIO(drawn["sheet.png"]))
    return image, drawn["sheet.svg"].decode()


def covered(image, far=60):
    """Bounds [pt] of what isn't white: left, bottom, right, top."""
    rows, columns = np.nonzero((255 - np.asarray(image)).max(axis=-1) > far)
    scale = 72 / 150
    return (
        columns.min() * scale,
        216 - (rows.max() + 1) * scale,
        (columns.max() + 1) * scale,
        216 - rows.min() * scale,
    )


def test_a_sheet_is_as_large_as_it_says_and_white():
    image, text = files()
    assert image.size == (600, 450)
    assert image.info["dpi"] == pytest.approx((150, 150), abs=0.02)
    assert image.getcolors() == [(600 * 450, (255, 255, 255))]
    assert 'width="288pt" height="216pt"' in text
    assert "<dc:date>" not in text


def test_a_line_stands_where_its_points_say():
    points = np.array([[50.0, 40.0], [250.0, 40.0]])
    image, text = files(Shape(points, RED, kind="curve"))
    # Two points wide, and as much longer at either end.
    assert covered(image) == pytest.approx((49.0, 39.0, 251.0, 41.0), abs=0.5)
    (path,) = re.findall(r'<g id="curve_1">\s*<path d="M 50 176\s*L 250 176\s*"', text)
    assert path


def test_a_gap_splits_a_line_and_what_lies_outside_its_box_is_left_out():
    points = np.array([[10.0, 100.0], [90.0, 100.0], [np.nan, np.nan], [150.0, 100.0], [280, 100]])
    image, text = files(Shape(points, RED, clip=Box(40.0, 20.0, 240.0, 180.0)))
    pixels = np.asarray(image)[450 - round(100 * 150 / 72)]
    red = np.flatnonzero((255 - pixels[:, 1]) > 128) * 72 / 150
    assert red.min() == pytest.approx(40.0, abs=0.5)
    assert red.max() == pytest.approx(240.0, abs=0.7)
    assert not ((red > 92.0) & (red < 148.0)).any()
    assert '<rect x="40" y="36" width="200" height="160"' in text


def test_an_area_is_tinted_and_edged():
    box = Box(60.0, 50.0, 120.0, 90.0)
    image, _ = files(Shape(box.corners(), Look(fill=colour("#0000ff", 0.5)), closed=True))
    assert covered(image) == pytest.approx((60.0, 50.0, 120.0, 90.0), abs=0.6)
    inside = image.getpixel((round(90 * 150 / 72), 450 - round(70 * 150 / 72)))
    assert inside == pytest.approx((127, 127, 255), abs=2)


@pytest.mark.parametrize(("kind", "half"), [("dot", 1.5), ("cross", 2.5)])
def test_marks_stand_at_every_point(kind, half):
    look = Look(colour("#000000"), marks=kind)
    points = np.array([[40.0, 40.0], [200.0, 160.0]])
    left, bottom, right, top = covered(files(Shape(points, look))[0])
    assert (left, bottom) == pytest.approx((40 - half, 40 - half), abs=0.8)
    assert (right, top) == pytest.approx((200 + half, 160 + half), abs=0.8)


@pytest.mark.parametrize("align", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("upright", [False, True])
def test_texts_are_aligned_by_their_own_length(align, upright):
    image, text = files(Text(140.0, 100.0, "HMMMH", 14.0, align, upright=upright))
    with default_style():
        length = text_width("HMMMH", 14.0)
    assert 50 < length < 80
    left, bottom, right, top = covered(image)
    start, end, base = (bottom, top, right) if upright else (left, right, bottom)
    at = 100.0 if upright else 140.0
    # Letters on whole pixels are a little narrower or wider, and moved.
    assert start == pytest.approx(at - align * length, abs=4.0)
    assert end == pytest.approx(at + (1 - align) * length, abs=4.0)
    assert base == pytest.approx(140.0 if upright else 100.0, abs=1.5)
    assert "<!-- HMMMH -->" in text


def test_dollars_and_brackets_are_said_as_they_are():
    image, text = files(Text(20.0, 100.0, "$x$ <b> & \\alpha_3", 12.0))
    assert covered(image)[2] > 120
    assert "$x$" in text
