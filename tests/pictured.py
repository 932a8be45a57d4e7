"""What reports' figures and pages draw, read from what they are made of."""

import base64
import gzip
import json
import re

import numpy as np

from thesis_pin.pages import plots
from thesis_pin.report import figures


def page_values(page):
    """Every value of every plot of a page."""
    (packed,) = re.findall(rb'id="figures">(.*?)</script>', page)
    drawn = json.loads(gzip.decompress(base64.b64decode(packed)))
    return [value for one in drawn for curve in one["data"] for value in curve["y"]]


def figure_values(monkeypatch, modules, draw, report):
    """Every value of every line of a report's figures, as its modules hand them to be written."""
    lines = []

    def read(name, figure):
        lines.extend(line for axis in figure.axes for line in axis.lines)
        return {}

    for module in modules:
        monkeypatch.setattr(module, "figure_files", read)
    draw(report)
    return np.concatenate([np.asarray(line.get_ydata(), dtype=float) for line in lines])


def coarsely(monkeypatch):
    """Draw with so few stretches that a short report's samples aren't all drawn."""
    monkeypatch.setattr(plots, "STRETCHES", 7)
    monkeypatch.setattr(figures, "STRETCHES", 7)


def spiked(values, sample, spike):
    """A copy with one sample's first value replaced."""
    changed = np.array(values)
    changed[(sample, *([0] * (changed.ndim - 1)))] = spike
    return changed
