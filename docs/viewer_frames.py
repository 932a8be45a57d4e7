"""What a frame costs in our own player and in meshcat, and which group of overlays costs it.

Run ``python docs/viewer_frames.py``. Measured is the processor's time of a headless Chromium, all
its processes together, for each frame drawn at 1280 × 720 in software WebGL, and not frames a
second, which depend on what else the machine does. Two cores draw at most 2000 ms / cost frames a
second.
"""

from __future__ import annotations

import os
import statistics
import sys
import tempfile
from dataclasses import replace
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests"))

ROUNDS, FRAMES = 3, 10

FRAME = f"""new Promise((done) => {{
  let left = {FRAMES};
  const next = () => (left-- ? requestAnimationFrame(next) : done());
  requestAnimationFrame(next);
}})"""

PLAYERS = {
    "own": (
        "window.player && player.framesDrawn > 0",
        "player.framesDrawn",
        "player.groups.get({name}).object.visible = {shown}",
    ),
    "meshcat": (
        "window.viewer && viewer.animator.duration > 0",
        "viewer.renderer.info.render.frame",
        "viewer.scene_tree.children.meshcat.children[{title}].children[{name}].object.visible"
        " = {shown}",
    ),
}
"""When a page is ready, how many frames it has drawn, and what shows or hides a group."""


def used(process: int) -> float:
    """Processor's time of the processes below one so far [s]."""
    children: dict[int, list[tuple[int, float]]] = {}
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            words = (entry / "stat").read_text().rsplit(")", 1)[1].split()
        except OSError:  # no process, or one that has ended
            continue
        ticks = (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK")
        children.setdefault(int(words[1]), []).append((int(entry.name), ticks))
    total, todo = 0.0, [process]
    while todo:
        for child, seconds in children.get(todo.pop(), []):
            total += seconds
            todo.append(child)
    return total


def costs(browser, player: str, url: str, title: str, names: list[str]) -> dict[str, float]:
    """Processor's time of a frame [ms] with all groups, without each, and without any."""
    ready, drawn, switch = PLAYERS[player]
    browser.open(url, reduced_motion="no-preference")
    browser.until(ready)

    def show(some: list[str], shown: bool) -> None:
        for name in some:
            words = {"title": repr(title), "name": repr(name), "shown": str(shown).lower()}
            browser.run(switch.format(**words))

    found: dict[str, list[float]] = {}
    for _ in range(ROUNDS):
        for without in ("nothing", *names, "everything"):
            hidden = {"nothing": [], "everything": names}.get(without, [without])
            show(hidden, False)
            before, start = browser.run(drawn), used(os.getpid())
            browser.run(FRAME)
            spent, frames = used(os.getpid()) - start, browser.run(drawn) - before
            show(hidden, True)
            found.setdefault(without, []).append(1e3 * spent / max(frames, 1))
    return {name: statistics.median(values) for name, values in found.items()}


def main() -> None:
    """Print a table for each robot."""
    from chromium import Chromium

    import pollard_pin
    import scout_pin
    from pollard_pin.report.drawn.view import path_scene
    from scout_pin.report.drawn.view import gait_scene
    from thesis_pin.pages import player
    from thesis_pin.pages.meshcat.display import show

    gait = scout_pin.load_gait(ROOT / "examples" / "walk.toml")
    path = pollard_pin.load_path(ROOT / "examples" / "spray_arch.toml")
    for drawn in (
        gait_scene(scout_pin.gait_report(scout_pin.load(), gait)),
        path_scene(pollard_pin.trajectory_report(pollard_pin.load(), path)),
    ):
        scene = replace(drawn, groups=tuple(replace(one, visible=True) for one in drawn.groups))
        names = [group.name for group in scene.groups]
        with tempfile.TemporaryDirectory() as folder, Chromium() as browser, show(scene) as viewer:
            page = Path(folder, "page.html")
            player.write_html(scene, page)
            tables = [
                costs(browser, "own", page.as_uri(), scene.title, names),
                costs(browser, "meshcat", viewer.url, scene.title, names),
            ]
        print(f"{scene.title}\n| without | own player [ms] | meshcat [ms] |\n| --- | --- | --- |")
        for name in tables[0]:
            print(f"| {name} | {tables[0][name]:.0f} | {tables[1][name]:.0f} |")


if __name__ == "__main__":
    main()
