"""Gaits of ``examples/`` that ``scout-pin plan`` made, and the README's picture of one.

Run ``python docs/plans.py`` to plan them anew; each file's head says its command. Searches end
where rounding takes them, so other processors find other walks: what has to hold of them
(margin, torques, rest at both ends) a test holds, not their digits.
"""

from __future__ import annotations

import os
import shlex
import tempfile
from pathlib import Path

import scout_pin
from scout_pin.cli import main
from scout_pin.motion.files import load_gait
from scout_pin.report.drawn import curves
from thesis_pin.report.figures import figure_files, panels

ROOT = Path(__file__).resolve().parents[1]
EXAMPLES = ROOT / "examples"
PLANS = {
    "quasi_static": "--step-time 2 --foot-spacing 60.4 --margin 5 --torque-reserve 19 --pitch 8 "
    "--roll 12 --yaw 8 --steps 4",
    "cruise": "--step-length 36 --step-time 0.4 --foot-spacing 72 --lift 20 --margin 15",
    "fast": "--walking-speed 160 --margin 5",
    "lopsided_plan": "--specification=examples/lopsided.toml --steps 4",
}
"""Name of a gait → how it is asked for."""
PICTURED = "cruise"


def make() -> None:
    """Plan every gait."""
    os.chdir(ROOT)
    for name, words in PLANS.items():
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder) / name
            if main(["plan", *shlex.split(words), "--out", str(out)]):
                raise SystemExit(f"{name} can't be planned any more")
            (EXAMPLES / f"{name}.toml").write_bytes((out / "walk.toml").read_bytes())


def picture() -> None:
    """Draw the README's."""
    from viewer_pictures import lighten  # beside this script, which tests read from elsewhere

    gait = load_gait(EXAMPLES / f"{PICTURED}.toml")
    report = scout_pin.gait_report(scout_pin.load(), gait, samples=801)
    figure = panels([[curves.plan(report), curves.stability_margin(report)]], 11, 5)
    drawn = figure_files(f"{PICTURED}_stability", figure)
    for name, content in drawn.items():
        if name.endswith(".png"):
            file = ROOT / "docs" / "images" / name
            file.write_bytes(content)
            lighten(file)


if __name__ == "__main__":
    make()
    picture()
