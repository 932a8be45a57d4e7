"""Figures show the data they are given, and are the same whatever the user's settings."""

import hashlib
import os
import subprocess
import sys

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.colors import to_hex

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
    axis = panels([[OVER_TIME]], 4, 3).axes[0]
    for line, curve, dash in zip(axis.lines, OVER_TIME.curves, ("-", "--"), strict=False):
        np.testing.assert_array_equal(line.get_xdata(), TIME)
        np.testing.assert_array_equal(line.get_ydata(), curve.y)
        assert (to_hex(line.get_color()), line.get_linestyle()) == (curve.colour, dash)
    assert [line.get_ydata()[0] for line in axis.lines[2:]] == [3.0, -3.0]
    assert (axis.get_xlabel(), axis.get_ylabel()) == ("time [s]", "torque [N·m]")
    assert axis.get_title() == "Torques"
    low, high = axis.get_ylim()
    assert low < -3
    assert high > 4


def test_a_legend_names_each_thing_once():
    axis = panels([[OVER_TIME]], 4, 3).axes[0]
    named = [text.get_text() for text in axis.get_legend().get_texts()]
    assert named == ["stands", "first", "second", "stall"]
    alone = curves.Plot("One", "", "y", [curves.Curve("only", TIME, "#000000")], TIME)
    assert panels([[alone]], 4, 3).axes[0].get_legend() is None


def test_a_plane_has_one_scale_and_its_areas():
    axis = panels([[PLANE]], 4, 3).axes[0]
    assert axis.get_aspect() == 1.0
    sole, hull = axis.patches
    np.testing.assert_array_equal(sole.get_xy()[:4], SQUARE)
    assert to_hex(sole.get_facecolor()) == "#e69f00"
    assert hull.get_facecolor()[3] == 0
    (point,) = axis.lines
    np.testing.assert_array_equal(point.get_xdata(), 2 * TIME)
    assert (point.get_linestyle(), point.get_marker()) == ("None", "x")


def test_panels_stand_where_their_rows_say():
    figure = panels([[OVER_TIME, PLANE], [PLANE, OVER_TIME]], 9, 6, "All")
    assert [axis.get_title() for axis in figure.axes] == [
        "Torques",
        "From above",
        "From above",
        "Torques",
    ]
    assert figure.get_suptitle() == "All"


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
