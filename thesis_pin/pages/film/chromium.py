"""A headless Chromium: the one that is on the machine, or the one that playwright brings."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from thesis_pin.errors import BadInput

if TYPE_CHECKING:
    from playwright.async_api import Browser

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
"""What a Chromium is called, in the order they are tried."""

FLAGS = (
    "--disable-gpu",
    "--disable-dev-shm-usage",
    "--enable-unsafe-swiftshader",
    "--force-color-profile=srgb",
    "--hide-scrollbars",
)
"""Drawn without a graphics card, so that every machine's picture is the same."""

_REMEDY = "Install Chromium or Chrome, or run: python -m playwright install chromium"


def find() -> str | None:
    """Path of a Chromium on this machine that runs; None without one."""
    for name in NAMES:
        path = shutil.which(name)
        # Some distributions install a stub that only says where to get the browser.
        if path and subprocess.run([path, "--version"], capture_output=True).returncode == 0:
            return path
    return None


@asynccontextmanager
async def launched() -> AsyncIterator[Browser]:
    """A browser without a window, closed at the end.

    Raises:
        BadInput: Playwright isn't installed, or there is no Chromium that starts.
    """
    try:
        from playwright.async_api import Error, async_playwright
    except ImportError as error:
        raise BadInput(
            f"films and pictures need playwright, which can't be imported ({error})",
            remedy="pip install 'thesis-pin[film]'",
        ) from None
    async with async_playwright() as playwright:
        path = find() or playwright.chromium.executable_path
        if not Path(path).is_file():
            raise BadInput("films and pictures need a Chromium, and none is here", remedy=_REMEDY)
        try:
            # Signals are for this process: it closes the browser when it ends.
            browser = await playwright.chromium.launch(
                executable_path=path,
                args=[*FLAGS, "--no-sandbox"],
                handle_sigint=False,
                handle_sigterm=False,
                handle_sighup=False,
            )
        except Error as error:
            raise BadInput(
                f"the browser doesn't start: {_reason(error.message)}", where=path, remedy=_REMEDY
            ) from None
        try:
            yield browser
        finally:
            await browser.close()


def _reason(log: str) -> str:
    """The line of a browser's log that says why it ended; its first one if none does."""
    lines = log.splitlines() or ["no reason given"]
    return next((line.partition(":FATAL:")[2] for line in lines if ":FATAL:" in line), lines[0])
