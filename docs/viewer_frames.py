"""How fast our own player and meshcat draw, what a frame costs, and which overlays cost it.

Run ``python docs/viewer_frames.py`` on a machine that does nothing else; what it prints stands in
``docs/viewer.md``. A headless Chromium plays scenes at 1280 × 720 in software WebGL, every group
shown. Frames a second are counted by the page's own clock; the cost of a frame is the processor's
time of all Chromium's processes, which other work on the machine changes less.
"""

from __future__ import annotations

import os
import statistics
import sys
import tempfile
import warnings
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests"))

ROUNDS, FRAMES, SECONDS = 3, 10, 4.0

FRAME = f"""new Promise((done) => {{
  let left = {FRAMES};
  const next = () => (left-- ? requestAnimationFrame(next) : done());
  requestAnimationFrame(next);
}})"""

CLOCKED = """new Promise((done) => {{
  const begin = performance.now(), first = {drawn};
  const next = (now) => (now - begin < 1000 * {seconds} ? requestAnimationFrame(next)
    : done(1000 * ({drawn} - first) / (now - begin)));
  requestAnimationFrame(next);
}})"""
"""Frames a second that are drawn, by the page's clock."""

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

WHOLE = """(() => {
  if (!window.player) return true;
  return player.stage.renderer.shadowMap.enabled && player.stage.renderer.getPixelRatio() === 1;
})()"""
"""Whether a page draws as it did at first: our own leaves shadows out where it is slow."""


@dataclass(frozen=True)
class Costs:
    """What a player's frames cost.

    Attributes:
        rate: Frames a second.
        whole: Whether shadows and every pixel were drawn all along.
        without: Processor's time of a frame [ms] by what was hidden.
    """

    rate: float
    whole: bool
    without: dict[str, float]


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


def costs(browser, player: str, url: str, title: str, names: list[str]) -> Costs:
    """Frames a second with all groups; a frame's cost with all, without each, and without any."""
    ready, drawn, switch = PLAYERS[player]
    browser.open(url, reduced_motion="no-preference")
    browser.until(ready)

    def show(some: list[str], shown: bool) -> None:
        for name in some:
            words = {"title": repr(title), "name": repr(name), "shown": str(shown).lower()}
            browser.run(switch.format(**words))

    browser.run(FRAME)
    rate = browser.run(CLOCKED.format(drawn=drawn, seconds=SECONDS))
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
    medians = {name: statistics.median(values) for name, values in found.items()}
    return Costs(rate, bool(browser.run(WHOLE)), medians)


def scenes() -> Iterator[tuple[str, object]]:
    """Two robots of this package on their motions, and a humanoid of 52 detailed shapes."""
    import numpy as np

    import pollard_pin
    import scout_pin
    import thesis_pin
    from pollard_pin.report.drawn.view import path_scene
    from scout_pin.report.drawn.view import gait_scene
    from thesis_pin.errors import ModelWarning
    from thesis_pin.pages.robot import GROUPS, items_of
    from thesis_pin.pages.scene import Scene

    gait = scout_pin.load_gait(ROOT / "examples" / "walk.toml")
    yield "Scout, `walk.toml`", gait_scene(scout_pin.gait_report(scout_pin.load(), gait))
    path = pollard_pin.load_path(ROOT / "examples" / "spray_arch.toml")
    report = pollard_pin.trajectory_report(pollard_pin.load(), path)
    yield "Pollard, `spray_arch.toml`", path_scene(report)
    warnings.simplefilter("ignore", ModelWarning)
    robot = thesis_pin.load("example:talos_reduced")
    time = np.linspace(0.0, 5.0, 301)
    q = np.tile(robot.q0, (len(time), 1)) + 0.3 * np.sin(2 * np.pi * time / 5)[:, None]
    items, _ = items_of(robot, q)
    groups = tuple(group for group in GROUPS if any(item.group == group.name for item in items))
    yield (
        "`example:talos_reduced`",
        Scene("talos", "Talos swings its joints.", time, groups, items, floor=None),
    )


def main() -> None:
    """Print the tables of docs/viewer.md."""
    from chromium import Chromium

    from thesis_pin.pages import player
    from thesis_pin.pages.meshcat.display import show

    found = []
    for label, drawn in scenes():
        scene = replace(drawn, groups=tuple(replace(one, visible=True) for one in drawn.groups))
        names = [group.name for group in scene.groups]
        with (
            tempfile.TemporaryDirectory() as folder,
            Chromium() as browser,
            show(scene, port=0) as viewer,
        ):
            page = Path(folder, "page.html")
            player.write_html(scene, page)
            own = costs(browser, "own", page.as_uri(), scene.title, names)
            meshcat = costs(browser, "meshcat", viewer.url, scene.title, names)
        shapes = sum(type(item).__name__ == "Shape" for item in scene.items)
        found.append((label, shapes, own, meshcat))
    print("| scene | shapes | player | frames a second | a frame [ms] | every group hidden [ms] |")
    print("| --- | --- | --- | --- | --- | --- |")
    for label, shapes, own, meshcat in found:
        for name, one in (("our own", own), ("meshcat", meshcat)):
            less = "" if one.whole else ", without shadows"
            costs_all, costs_none = one.without["nothing"], one.without["everything"]
            print(
                f"| {label} | {shapes} | {name}{less} | {one.rate:.0f} | {costs_all:.0f} "
                f"| {costs_none:.0f} |"
            )
    for label, _, own, meshcat in found[:2]:
        print(f"\n| {label}, without | our own [ms] | meshcat [ms] |\n| --- | --- | --- |")
        for name, cost in own.without.items():
            print(f"| {name} | {cost:.0f} | {meshcat.without[name]:.0f} |")


if __name__ == "__main__":
    main()
