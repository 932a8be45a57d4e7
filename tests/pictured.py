"""What reports' figures and pages draw, read from what they are made of."""

import base64
import gzip
import json
import re
from types import SimpleNamespace

import numpy as np

from thesis_pin.pages import plots
from thesis_pin.report import figures
from thesis_pin.report.plotting.sheet import Shape, Text


def page_values(page):
    """Every value of every plot of a page."""
    (packed,) = re.findall(rb'id="figures">(.*?)</script>', page)
    drawn = json.loads(gzip.decompress(base64.b64decode(packed)))
    return [value for one in drawn for curve in one["data"] for value in curve["y"]]


def figure_values(monkeypatch, modules, draw, report):
    """Every value of every line of a report's figures, as its modules hand them to be written.

    Read from where lines stand among the labels, to what labels of few digits can tell: 1e-9 of
    an axis.
    """
    found = []

    def read(name, sheet):
        for one in panels_of(sheet):
            found.extend(values for kind, values, _ in one.things if kind == "curve")
        return {}

    for module in modules:
        monkeypatch.setattr(module, "figure_files", read)
    draw(report)
    return np.round(np.concatenate(found)[:, 1], 6)


def panels_of(sheet):
    """The panels of a sheet: names of their axes, and things in the units that labels say.

    Each thing is its kind, its points ``(n, 2)`` and its look.
    """
    panels, things, marks = [], [], list(sheet.marks)
    for k, mark in enumerate(marks):
        if isinstance(mark, Text):
            continue
        if mark.kind == "frame":
            bare = marks[k + 1].kind != "x_ticks" if isinstance(marks[k + 1], Shape) else True
            things = [] if bare else things
        elif mark.kind == "x_ticks":
            x = _axis(mark, marks[k + 1 :], 0)
        elif mark.kind == "y_ticks" and things:
            y = _axis(mark, marks[k + 1 :], 1)
            panels.append(SimpleNamespace(x=x, y=y, things=[_read(one, x, y) for one in things]))
            things = []
        elif mark.kind in ("area", "band", "curve", "limit"):
            things.append(mark)
    return panels


def _read(shape, x, y):
    values = np.stack([x.read(shape.points[:, 0]), y.read(shape.points[:, 1])], axis=1)
    return shape.kind, values, shape.look


def _axis(ticks, following, along):
    """An axis: its name, its labels, and what turns places on the sheet into values."""
    places = ticks.points[::3, along]
    *labels, factor, name = (mark.text for mark in following[: len(places) + 2])
    values = said(labels, factor)
    slope, start = np.polyfit(places, values, 1)
    near = 1e-9 * np.abs(values).max()
    np.testing.assert_allclose(slope * places + start, values, rtol=0, atol=near)
    return SimpleNamespace(name=name, labels=labels, read=lambda place: slope * place + start)


def said(labels, factor):
    """Values that an axis's labels say: times a power of ten, plus what stands beside it."""
    signs = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹−", "-0123456789-")
    times = re.match("×10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)", factor)
    power = int(times[1].translate(signs)) if times else 0
    added = factor[times.end() :] if times else factor
    base = float(added.strip().translate(signs).replace("×10", "e")) if added else 0.0
    return np.array([float(label.translate(signs)) for label in labels]) * 10.0**power + base


def texts_of(sheet):
    """Every text of a sheet."""
    return [mark.text for mark in sheet.marks if isinstance(mark, Text) and mark.text]


def shapes_of(sheet, kind):
    """Every shape of a kind."""
    return [mark for mark in sheet.marks if isinstance(mark, Shape) and mark.kind == kind]


def coarsely(monkeypatch):
    """Draw with so few stretches that a short report's samples aren't all drawn."""
    monkeypatch.setattr(plots, "STRETCHES", 7)
    monkeypatch.setattr(figures, "STRETCHES", 7)


def spiked(values, sample, spike):
    """A copy with one sample's first value replaced."""
    changed = np.array(values)
    changed[(sample, *([0] * (changed.ndim - 1)))] = spike
    return changed
