"""Figures show the data they are given, and are the same whatever the user's settings."""

import hashlib
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.colors import to_hex
from pictured import panels_of, shapes_of, texts_of

from thesis_pin.errors import BadInput
from thesis_pin.report import curves
from thesis_pin.report.figures import figure_files, new_figure, panels

TIME = np.linspace(0.0, 2.0, 5)
OVER_TIME = curves.Plot(
    "Torques",
    "Two joints.",
    "torque [N·m]",
    [
        curves.Curve("first", TIME**2, "#0072b2"),
        curves.Curve("second", np.where(TIME == 1, np.nan, -TIME), "#d55e00", "dash"),
    ],
    TIME,
    limits=curves.both_signs("stall", np.array([3.0, 3.0])),
    bands=[curves.Band("stands", 0.0, 0.5, "#56b4e9"), curves.Band("stands", 1.0, 2.0, "#56b4e9")],
)
SQUARE = np.array([[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [0.0, 1.0]])
PLANE = curves.Plot(
    "From above",
    "A point in a square.",
    "y [mm]",
    [curves.Curve("point", TIME, "#009e73", marks="cross", x=2 * TIME)],
    across="x [mm]",
    areas=[
        curves.Area("sole", SQUARE, "#e69f00"),
        curves.Area("hull", SQUARE + 1, "#777777", filled=False),
    ],
)


def test_curves_are_drawn_as_they_are_given():
    (panel,) = panels_of(panels([[OVER_TIME]], 4, 3))
    lines = [thing for thing in panel.things if thing[0] == "curve"]
    for (_, values, look), curve in zip(lines, OVER_TIME.curves, strict=True):
        np.testing.assert_allclose(values, np.stack([TIME, curve.y], axis=1), atol=1e-9)
        assert (to_hex(look.stroke), look.dash) == (curve.colour, curve.dash)
    limits = [values for kind, values, _ in panel.things if kind == "limit"]
    np.testing.assert_allclose([ends[:, 1] for ends in limits], [[3, 3], [-3, -3]], atol=1e-9)
    assert limits[0][0, 0] < TIME[0]
    assert limits[0][1, 0] > TIME[-1]
    bands = [values[:, 0] for kind, values, _ in panel.things if kind == "band"]
    np.testing.assert_allclose([band[:2] for band in bands], [[0, 0.5], [1, 2]], atol=1e-9)
    assert (panel.x.name, panel.y.name) == ("time [s]", "torque [N·m]")


def test_every_sample_of_a_long_curve_that_peaks_is_drawn():
    time = np.linspace(0.0, 1.0, 100_001)
    y = np.sin(40 * time)
    y[77_777] = 9.0
    plot = curves.Plot("Long", "", "y", [curves.Curve("only", y, "#000000")], time)
    (panel,) = panels_of(panels([[plot]], 8, 3))
    values = panel.things[0][1]
    assert len(values) < 10_000
    assert np.abs(values - [time[77_777], 9.0]).sum(axis=1).min() < 1e-9


def test_a_plane_has_one_scale_and_its_areas():
    sheet = panels([[PLANE]], 4, 3)
    (panel,) = panels_of(sheet)
    sole, hull = (thing for thing in panel.things if thing[0] == "area")
    np.testing.assert_allclose(sole[1], SQUARE, atol=1e-9)
    np.testing.assert_allclose(hull[1], SQUARE + 1, atol=1e-9)
    assert to_hex(sole[2].fill) == "#e69f00"
    assert hull[2].fill is None
    width, height = np.ptp(shapes_of(sheet, "area")[0].points, axis=0)
    assert width == pytest.approx(3 * height)
    (point,) = (thing for thing in panel.things if thing[0] == "curve")
    np.testing.assert_allclose(point[1], np.stack([2 * TIME, TIME], axis=1), atol=1e-9)
    assert point[2].marks == "cross"


@pytest.mark.parametrize("ranges", [(1.0, 10.0), (10.0, 1.0)])
def test_a_plane_stays_on_its_sheet_whichever_way_it_is_longer(ranges):
    corners = SQUARE / np.ptp(SQUARE, axis=0) * ranges
    sheet = panels(
        [[replace(PLANE, areas=[curves.Area("long", corners, "#0072b2")], curves=[])]], 4, 3
    )
    (frame,) = shapes_of(sheet, "frame")
    assert (frame.points > 0).all()
    assert (frame.points < [72 * sheet.width, 72 * sheet.height]).all()
    across, up = np.ptp(frame.points, axis=0)
    assert across / up == pytest.approx(ranges[0] / ranges[1])


def test_limits_are_dashed_over_the_whole_axis():
    limited = replace(OVER_TIME, limits=[curves.Limit("most", 3.0)])
    sheet = panels([[limited]], 8, 3)
    (frame,), (limit,) = shapes_of(sheet, "frame"), shapes_of(sheet, "limit")
    assert limit.look.dash == "dash"
    assert np.ptp(limit.points[:, 0]) == pytest.approx(np.ptp(frame.points[:, 0]))
    assert limit.points[0, 1] == limit.points[1, 1]


def test_panels_stand_where_their_rows_say():
    sheet = panels([[OVER_TIME, PLANE], [PLANE, OVER_TIME]], 9, 6, "All")
    middles = [frame.points.mean(axis=0) for frame in shapes_of(sheet, "frame")]
    left, right = 0.25 * 9 * 72, 0.75 * 9 * 72
    for (x, y), (across, up) in zip(
        middles, [(left, 1), (right, 1), (left, 0), (right, 0)], strict=True
    ):
        assert x == pytest.approx(across, abs=60)
        assert (y > 3 * 72) == up
    titles = [text for text in texts_of(sheet) if text in ("All", "Torques", "From above")]
    assert titles == ["All", "Torques", "From above", "From above", "Torques"]


SETTINGS = {
    "text.usetex": True,
    "font.family": "serif",
    "lines.linewidth": 9.0,
    "axes.facecolor": "black",
    "savefig.facecolor": "red",
    "figure.dpi": 20.0,
    "legend.frameon": False,
    "svg.fonttype": "none",
    "axes.unicode_minus": False,
}


def drawn():
    return figure_files("all", panels([[OVER_TIME, PLANE]], 9, 4, "All"))


def test_settings_of_the_program_around_change_no_byte_and_stay():
    plain = drawn()
    with mpl.rc_context(SETTINGS):
        assert drawn() == plain
        assert {key: mpl.rcParams[key] for key in ("text.usetex", "lines.linewidth")} == {
            "text.usetex": True,
            "lines.linewidth": 9.0,
        }


def elsewhere(folder, **environment):
    """What a fresh interpreter draws, working in a folder."""
    code = "import importlib.util, hashlib, os, sys\n"
    code += f"sys.path.append({str(Path(__file__).parents[2])!r})\n"
    code += f"spec = importlib.util.spec_from_file_location('here', {__file__!r})\n"
    code += "here = importlib.util.module_from_spec(spec)\n"
    code += "from thesis_pin.report.figures import default_style\n"
    code += "with default_style(): pass\n"
    code += "spec.loader.exec_module(here)\n"
    code += "print(*map(here.digest, here.drawn().values()), os.environ.get('MPLBACKEND'))\n"
    code += "assert 'matplotlib.pyplot' not in sys.modules\n"
    return subprocess.run(
        [sys.executable, "-c", code],
        env=os.environ | environment,
        cwd=folder,
        capture_output=True,
        text=True,
    )


def digest(content):
    return hashlib.sha256(content).hexdigest()


@pytest.mark.parametrize("backend", ["nonsense", "module://nowhere", "TkAgg", "agg"])
def test_a_users_backend_style_and_settings_change_no_byte(tmp_path, backend):
    settings = "\n".join(f"{key}: {value}" for key, value in SETTINGS.items())
    (tmp_path / "matplotlibrc").write_text(settings + "\nno such line\nbackend: nonsense\n")
    done = elsewhere(tmp_path, MPLBACKEND=backend)
    assert done.returncode == 0, done.stderr
    assert done.stdout.split() == [*map(digest, drawn().values()), backend]


def test_settings_that_cannot_even_be_read_are_named(tmp_path):
    (tmp_path / "matplotlibrc").write_bytes(b"font.family: \xff\xfe\n")
    done = elsewhere(tmp_path)
    assert done.returncode == 1
    assert BadInput.__name__ in done.stderr
    assert "matplotlibrc" in done.stderr.splitlines()[-1]


def test_a_figure_gives_the_same_bytes_twice():
    def draw():
        figure, axes = new_figure(3, 2)
        axes[0, 0].plot([0, 1], [0, 1], label="line")
        return figure_files("line", figure)

    first, second = draw(), draw()
    assert set(first) == {"line.png", "line.svg"}
    assert first == second
    assert first["line.png"].startswith(b"\x89PNG")


def test_a_figure_is_drawn_as_large_as_it_was_laid_out_and_once_a_format(monkeypatch):
    from matplotlib.figure import Figure

    drawn = []
    draw = Figure.draw
    monkeypatch.setattr(Figure, "draw", lambda *a, **k: (drawn.append(1), draw(*a, **k))[1])
    figure, axes = new_figure(4, 3)
    axes[0, 0].plot([0, 1], [0, 1])
    files = figure_files("figure", figure)
    assert len(drawn) == 2
    width, height = (int.from_bytes(files["figure.png"][k : k + 4], "big") for k in (16, 20))
    assert (width, height) == (600, 450)
    assert b'width="288pt" height="216pt"' in files["figure.svg"]
