"""A headless Chromium, driven by playwright: what pages do in a real browser."""

from __future__ import annotations

import io
import json
import subprocess
import time
from pathlib import Path

import numpy as np

from thesis_pin.pages.film.chromium import find as find


def version() -> str:
    """What the Chromium on this machine calls itself."""
    asked = subprocess.run([find() or "", "--version"], capture_output=True, text=True)
    return " ".join(asked.stdout.split()[:2]).rpartition(".")[0] if asked.stdout else "Chromium"


_FLAGS = (
    "--no-sandbox",
    "--disable-gpu",
    "--disable-dev-shm-usage",
    "--enable-unsafe-swiftshader",
)
"""For machines without a graphics card, and for root."""

BACKGROUND = (0xF4, 0xF6, 0xF8)
"""Colour of an empty stage."""

_VERTICES = """(() => {
  const found = [], item = player.items.find((item) => item.name === %s);
  player.stage.world.updateMatrixWorld(true);
  item.object.traverse((part) => {
    const places = part.geometry?.attributes.position;
    for (let i = 0; places && i < places.count; i++) {
      const point = new MeshCat.THREE.Vector3().fromBufferAttribute(places, i);
      found.push(part.localToWorld(point).toArray());
    }
  });
  return found;
})()"""

_CUT = r"""(() => {
  const found = [], walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  const range = document.createRange();
  for (let node = walk.nextNode(); node; node = walk.nextNode()) {
    const parent = node.parentElement;
    if (!parent.checkVisibility() || parent.closest("script, style")) continue;
    for (const match of node.data.matchAll(/[-−+]?\d[\d.,]*\d(e[-+]?\d+)?/g)) {
      range.setStart(node, match.index);
      range.setEnd(node, match.index + match[0].length);
      const places = [...range.getClientRects()];
      const tops = new Set(places.map((one) => Math.round(one.top)));
      let hidden = false;
      for (let box = parent; box && places.length; box = box.parentElement) {
        const style = getComputedStyle(box), inner = box.getBoundingClientRect();
        if (style.overflowX === "auto" || style.overflowX === "scroll") break;
        if (style.overflowX !== "visible" && (places[0].right > inner.right + 1
            || places[0].left < inner.left - 1)) hidden = true;
      }
      if (tops.size > 1 || hidden) found.push(`${match[0]} in ${node.data.trim().slice(0, 60)}`);
    }
  }
  return found;
})()"""


def differing(first: np.ndarray, second: np.ndarray) -> int:
    """Number of pixels that differ clearly between two pictures."""
    return int((np.abs(first - second).max(axis=-1) > 24).sum())


def share_drawn(picture: np.ndarray) -> float:
    """Share of the stage, right of the legend, that is not background or floor."""
    return float((np.abs(picture[40:640, 340:] - BACKGROUND).max(axis=-1) > 110).mean())


class Chromium:
    """One browser with one tab at a time; a context manager."""

    def __enter__(self) -> Chromium:
        from playwright.sync_api import sync_playwright

        self._playwright = sync_playwright().start()
        self._browser = self._playwright.chromium.launch(executable_path=find(), args=_FLAGS)
        self._contexts: dict[tuple[object, ...], object] = {}
        self.page = None
        return self

    def __exit__(self, *_: object) -> None:
        self._browser.close()
        self._playwright.stop()

    def open(
        self, url: str, width: int = 1280, height: int = 720, mobile: bool = False, **wishes: str
    ) -> None:
        """Load a page in a fresh tab, forgetting what the one before asked for and complained of.

        Its reader wants less motion unless told otherwise: an animation is drawn in software,
        which takes a core while nobody looks at it.

        Args:
            url: Its address.
            width: Of the window, in pixels.
            height: Likewise.
            mobile: Whether it is a telephone.
            **wishes: What a reader wants, such as ``reduced_motion="no-preference"``.
        """
        self.leave()
        self._requests: list[str] = []
        self._complaints: list[str] = []
        self.page = self._reader(width, height, mobile, wishes).new_page()
        self.page.on("request", lambda request: self._requests.append(request.url))
        self.page.on("pageerror", lambda error: self._complaints.append(str(error)))
        self.page.on("console", self._heard)
        self.page.goto(url, wait_until="commit")

    def leave(self) -> None:
        """Close the page, if there is one: an animation goes on drawing, which takes a core."""
        if self.page is not None:
            self.page.close()
        self.page = None

    def _reader(self, width: int, height: int, mobile: bool, wishes: dict[str, str]):
        """The window of a kind of reader, in which a page is a tab.

        A blank tab keeps it open: a window of its own costs a page half as much again.
        """
        wishes = {"reduced_motion": "reduce"} | wishes
        kind = (width, height, mobile, *sorted(wishes.items()))
        if kind not in self._contexts:
            self._contexts[kind] = self._browser.new_context(
                viewport={"width": width, "height": height}, is_mobile=mobile, **wishes
            )
            self._contexts[kind].new_page()
        return self._contexts[kind]

    def _heard(self, message) -> None:
        if message.type == "error":
            self._complaints.append(message.text)

    def throttle(self, rate: float) -> None:
        """Make the processor slower by a factor."""
        devtools = self.page.context.new_cdp_session(self.page)
        devtools.send("Emulation.setCPUThrottlingRate", {"rate": rate})

    def run(self, script: str):
        """Value of a JavaScript expression; promises are awaited."""
        return self.page.evaluate(script)

    def until(self, script: str, seconds: float = 60.0):
        """Wait until a JavaScript expression is true, and return its value."""
        # Playwright's own waiting evaluates text inside the page, which the page's policy forbids.
        deadline = time.monotonic() + seconds
        while not (value := self.run(script)):
            assert time.monotonic() < deadline, (script, self.complaints())
            time.sleep(0.02)
        return value

    def press(self, key: str) -> None:
        """Press and release a key."""
        self.page.keyboard.press(key)

    def picture(self, file: Path | None = None) -> np.ndarray:
        """Screenshot as ``(height, width, 3)`` numbers from 0 to 255; kept in a file if named."""
        from PIL import Image

        data = self.page.screenshot(path=file)
        return np.asarray(Image.open(io.BytesIO(data)).convert("RGB")).astype(int)

    def still(self, file: Path | None = None) -> np.ndarray:
        """Screenshot after everything set so far has been drawn."""
        frame = "requestAnimationFrame"
        self.run(f"new Promise((done) => {frame}(() => {frame}(() => done())))")
        return self.picture(file)

    def watch(self, page: Path | str) -> None:
        """Open a page with a player and stop it at its start."""
        self.open(page.as_uri() if isinstance(page, Path) else page)
        self.until("window.player && player.framesDrawn > 0")
        self.run("player.pause(); player.time = 0")

    def vertices(self, item: str) -> np.ndarray:
        """Every vertex of a player's item as it stands in the world [m], shape ``(v, 3)``."""
        return np.array(self.run(_VERTICES % json.dumps(item)))

    def cut_numbers(self) -> list[str]:
        """Numbers of the page's texts that are broken between lines or lie beyond what is seen.

        Those that a box of their own scrolls to aren't cut.
        """
        return self.run(_CUT)

    def shown(self, item: str) -> bool:
        """Whether a player's item is drawn, its group's switch apart."""
        return self.run(f"player.items.find((i) => i.name === {json.dumps(item)}).object.visible")

    def requests(self) -> list[str]:
        """Addresses asked for since the page was opened, data and blob URLs left out."""
        self.run("1")
        return [url for url in self._requests if not url.startswith(("data:", "blob:"))]

    def complaints(self) -> list[str]:
        """Errors and exceptions on the console since the page was opened."""
        self.run("1")
        return self._complaints
