"""Pictures of the README: the viewer's, drawn in a headless Chromium, and figure 5.3.

Run ``python docs/viewer_pictures.py`` to renew them.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests"))


def main() -> None:
    """Draw every picture into ``docs/images``."""
    from chromium import Chromium

    import pollard_pin
    import scout_pin
    from pollard_pin.report.drawn.sliders import slider_page
    from pollard_pin.report.drawn.view import path_scene
    from scout_pin.report.drawn.figures import stick_figures
    from scout_pin.report.drawn.view import gait_scene
    from thesis_pin.pages import player as viewer
    from thesis_pin.report.figures import figure_files

    gait = scout_pin.load_gait(ROOT / "examples" / "walk.toml")
    report = scout_pin.gait_report(scout_pin.load(), gait)
    thesis = scout_pin.gait_report(scout_pin.load(), scout_pin.load_gait())
    figure = figure_files("scout_stick_figures", stick_figures(thesis))["scout_stick_figures.png"]
    (ROOT / "docs" / "images" / "scout_stick_figures.png").write_bytes(figure)

    robot = pollard_pin.load()
    path = pollard_pin.load_path(ROOT / "examples" / "spray_arch.toml")
    spraying = pollard_pin.trajectory_report(robot, path)
    scenes = {
        "scout_walk": (gait_scene(report), 4.2),
        "pollard_spray": (path_scene(spraying), 0.6 * path.duration),
    }
    with tempfile.TemporaryDirectory() as folder, Chromium() as browser:
        for name, (scene, moment) in scenes.items():
            page = Path(folder, f"{name}.html")
            viewer.write_html(scene, page)
            browser.open(page.as_uri(), 1120, 640)
            browser.until("window.player && player.framesDrawn > 0")
            browser.run(f"player.pause(); player.time = {moment}")
            browser.run("new Promise((done) => setTimeout(done, 500))")
            browser.picture(ROOT / "docs" / "images" / f"{name}.png")
        page = Path(folder, "sliders.html")
        page.write_bytes(slider_page(robot).html(served=True))
        browser.open(page.as_uri(), 1120, 640)
        browser.until("window.live && player.framesDrawn > 0")
        for layer in ("masses", "inertias"):
            browser.run(f"player.toggle('{layer}')")
        browser.still(ROOT / "docs" / "images" / "sliders.png")


if __name__ == "__main__":
    main()
