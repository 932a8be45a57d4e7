"""A scene's page in a headless browser, held at one moment after the other."""

from __future__ import annotations

import asyncio
import base64
import math
from collections.abc import AsyncIterator, Iterator
from contextlib import asynccontextmanager, contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING

from thesis_pin.errors import BadInput
from thesis_pin.numeric.checks import choice, shown
from thesis_pin.pages.film.chromium import launched
from thesis_pin.pages.player import html, web_file
from thesis_pin.pages.scene import LOOKS, Look, Scene

if TYPE_CHECKING:
    from playwright.async_api import CDPSession, Page, Route

SMALLEST, LARGEST = 64, 4096
"""Pixels of a side: below, nothing is recognised; above, some machines can't draw it."""

PATIENCE = 120.0
"""Seconds within which a page has to show its first frame."""

_ADDRESS = "http://film.invalid/"
"""Where the page seems to stand: a name that no network has."""

_PREPARE = """([style, look]) => {
  document.head.append(Object.assign(document.createElement("style"), { textContent: style }));
  player.pause();
  document.querySelector(".player").classList.add("filmed");
  const side = document.querySelector(".player .side");
  side.open = innerWidth > 560;
  // As large as on a page of 1280 × 720, but wholly on the picture.
  const size = Math.min(innerWidth / 1280, innerHeight / 720);
  const scale = Math.min(Math.max(1, size), (innerHeight - 20) / side.offsetHeight);
  side.style.transform = `scale(${scale})`;
  document.querySelector(".filmed").style.setProperty("--size", `${16 * Math.max(0.6, size)}px`);
  player.stage.resize();
  player.look(look);
}"""

_HOLD = """(time) => new Promise((done) => {
  player.time = time;
  document.querySelector(".filmed").dataset.clock = `${time.toFixed(2)} s`;
  player.stage.draw();
  requestAnimationFrame(() => done());
})"""


@dataclass(frozen=True)
class View:
    """How a scene is looked at.

    Attributes:
        width, height: Of the picture, in pixels.
        look: Where the camera stands.
    """

    width: int = 1280
    height: int = 720
    look: Look = "3d"

    def __post_init__(self) -> None:
        """Refuse what can't be drawn.

        Raises:
            BadInput: Says what.
        """
        for name in ("width", "height"):
            size = getattr(self, name)
            if isinstance(size, bool) or not isinstance(size, int):
                raise BadInput(f"{name} is {shown(size)}", allowed="a whole number of pixels")
            if not SMALLEST <= size <= LARGEST:
                raise BadInput(
                    f"{name} is {size} pixels", allowed=f"{SMALLEST} to {LARGEST} pixels"
                )
        choice("look", self.look, LOOKS)


class Camera:
    """A page that is ready to be photographed; see :func:`camera`."""

    def __init__(self, page: Page, devtools: CDPSession) -> None:
        self._page, self._devtools = page, devtools

    async def shot(self, time: float) -> bytes:
        """The scene at a time since its start [s], as PNG."""
        await self._page.evaluate(_HOLD, time)
        # Straight from the browser's tools, for playwright's own way takes twice as long.
        taken = await self._devtools.send(
            "Page.captureScreenshot", {"format": "png", "optimizeForSpeed": True}
        )
        return base64.b64decode(taken["data"])


@asynccontextmanager
async def camera(scene: Scene, view: View) -> AsyncIterator[Camera]:
    """A scene's own page in a headless browser: legend and values, no controls.

    The page's clock stands still between shots, so that a slow machine takes the same
    pictures as a fast one. No request leaves the browser.

    Args:
        scene: What to show.
        view: How to look at it.

    Raises:
        BadInput: There is no browser, or it can't draw the page.
    """
    content = html(scene, look=view.look)

    async def answer(route: Route) -> None:
        if route.request.url == _ADDRESS:
            await route.fulfill(body=content, content_type="text/html; charset=utf-8")
        else:
            await route.abort()

    async with launched() as browser:
        context = await browser.new_context(
            viewport={"width": view.width, "height": view.height},
            device_scale_factor=1,
            reduced_motion="reduce",
            service_workers="block",
        )
        await context.route("**/*", answer)
        page = await context.new_page()
        with _told():
            await page.goto(_ADDRESS, wait_until="commit")
            await _until_drawn(page)
            await page.evaluate(_PREPARE, [web_file("film.css"), view.look])
            yield Camera(page, await context.new_cdp_session(page))


@contextmanager
def _told() -> Iterator[None]:
    """Say that the browser has gone, which isn't our mistake: too little memory, as a rule."""
    from playwright.async_api import Error

    try:
        yield
    except Error as error:
        if not any(word in error.message.lower() for word in ("crash", "closed")):
            raise
        raise BadInput(
            "the browser ended while it drew", remedy="Ask for a smaller --size, or free memory"
        ) from None


async def _until_drawn(page: Page) -> None:
    """Wait for the page's first frame, or for what it complains of."""
    # Playwright's own waiting evaluates text inside the page, which the page's policy forbids.
    state = "document.querySelector('[role=alert]')?.textContent || window.player?.framesDrawn > 0"
    for _ in range(math.ceil(PATIENCE / 0.05)):
        found = await page.evaluate(state)
        if found is True:
            return
        if isinstance(found, str):
            raise BadInput(f"the browser can't draw the page: {found}")
        await asyncio.sleep(0.05)
    raise BadInput(f"the browser hasn't drawn the page within {PATIENCE:.0f} s")
