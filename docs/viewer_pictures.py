"""Pictures of the README: the viewer's, drawn in a headless Chromium, and the theses' figures.

Run ``python docs/viewer_pictures.py`` to renew them.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]

DOTS = 100
"""An inch of Pollard's figures: their many curves take twice as many bytes at 150."""

sys.path.insert(0, str(ROOT / "tests"))


def main() -> None:
    """Draw every picture into ``docs/images``."""
    from chromium import Chromium

    import pollard_pin
    import scout_pin
    from pollard_pin.report.drawn.sliders import slider_page
    from pollard_pin.report.drawn.view import path_scene
    from scout_pin.report.drawn.view import gait_scene
    from thesis_pin.pages import player as viewer

    gait = scout_pin.load_gait(ROOT / "examples" / "walk.toml")
    report = scout_pin.gait_report(scout_pin.load(), gait)
    thesis_figures()

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
            lighten(ROOT / "docs" / "images" / f"{name}.png")
        page = Path(folder, "sliders.html")
        page.write_bytes(slider_page(robot).html(served=True))
        browser.open(page.as_uri(), 1120, 640)
        browser.until("window.live && player.framesDrawn > 0")
        for layer in ("masses", "inertias"):
            browser.run(f"player.toggle('{layer}')")
        browser.still(ROOT / "docs" / "images" / "sliders.png")
        lighten(ROOT / "docs" / "images" / "sliders.png")


def lighten(file: Path) -> None:
    """Keep a picture in 256 colours, the fewest bytes in which those that mean something stay."""
    from PIL import Image

    with Image.open(file) as picture:
        few = picture.convert("RGB").quantize(256, kmeans=1, dither=Image.Dither.NONE)
    few.save(file, optimize=True)


def thesis_figures() -> None:
    """Figures 5.1 to 5.3 of Scout and 4.1 to 4.4 of Pollard."""
    import pollard_pin
    import scout_pin
    from pollard_pin.report.drawn import figures as pollard
    from scout_pin.report.drawn import figures as scout
    from thesis_pin.report.plotting.wanted import Wanted, written_as

    walk = scout_pin.gait_report(scout_pin.load(), scout_pin.load_gait())
    spray = pollard_pin.trajectory_report(pollard_pin.load(), pollard_pin.appendix_b())
    with written_as(Wanted(("png",), DOTS)):
        many = pollard.figures(spray)
    drawn = ((scout.figures(walk), scout.NUMBERS), (many, pollard.NUMBERS))
    for files, numbers in drawn:
        for name, number in numbers.items():
            file = f"thesis_figure_{number.replace('.', '_')}.png"
            target = (
                ROOT / "docs" / "images" / ("scout_stick_figures.png" if number == "5.3" else file)
            )
            if number:
                target.write_bytes(files[f"{name}.png"])
                lighten(target)


if __name__ == "__main__":
    main()
