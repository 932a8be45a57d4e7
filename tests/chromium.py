"""A headless Chromium, driven over its DevTools protocol: what pages do in a real browser."""

from __future__ import annotations

import base64
import contextlib
import io
import json
import shutil
import subprocess
import tempfile
import time
import urllib.request
from pathlib import Path

import numpy as np

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")


def find() -> str | None:
    """Path of a Chromium on this machine that runs, None without one."""
    for name in NAMES:
        path = shutil.which(name)
        # Some distributions install a stub that only says where to get the browser.
        if path and subprocess.run([path, "--version"], capture_output=True).returncode == 0:
            return path
    return None


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


def differing(first: np.ndarray, second: np.ndarray) -> int:
    """Number of pixels that differ clearly between two pictures."""
    return int((np.abs(first - second).max(axis=-1) > 24).sum())


def share_drawn(picture: np.ndarray) -> float:
    """Share of the stage, right of the legend, that is not background or floor."""
    return float((np.abs(picture[40:640, 340:] - BACKGROUND).max(axis=-1) > 110).mean())


class Chromium:
    """One browser with one tab at a time; a context manager."""

    def __init__(self, width: int = 1280, height: int = 720) -> None:
        self._size = (width, height)
        self._stack = contextlib.ExitStack()
        self._count = 0
        self.events: list[dict] = []

    def __enter__(self) -> Chromium:
        from websockets.sync.client import connect

        with contextlib.ExitStack() as stack:
            address = self._start(stack)
            self._socket = stack.enter_context(connect(address, max_size=None, ping_interval=None))
            self._stack = stack.pop_all()
        for domain in ("Page", "Runtime", "Network", "Log"):
            self.call(f"{domain}.enable")
        return self

    def __exit__(self, *_: object) -> None:
        self._stack.close()

    def _start(self, stack: contextlib.ExitStack) -> str:
        """Start the browser; address of its first tab's DevTools."""
        path = find()
        assert path, "no Chromium"
        profile = stack.enter_context(
            tempfile.TemporaryDirectory(prefix="chromium_", ignore_cleanup_errors=True)
        )
        width, height = self._size
        process = subprocess.Popen(
            [
                path,
                "--headless=new",
                "--no-sandbox",
                "--disable-gpu",
                "--disable-dev-shm-usage",
                "--enable-unsafe-swiftshader",
                "--hide-scrollbars",
                "--no-first-run",
                f"--window-size={width},{height}",
                f"--user-data-dir={profile}",
                "--remote-debugging-port=0",
                "about:blank",
            ],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        stack.callback(_end, process)
        file = Path(profile, "DevToolsActivePort")
        deadline = time.monotonic() + 60
        while not (file.exists() and "\n" in file.read_text()):
            assert time.monotonic() < deadline, "Chromium doesn't start"
            time.sleep(0.05)
        port = file.read_text().splitlines()[0]
        with urllib.request.urlopen(f"http://127.0.0.1:{port}/json/list") as answer:
            tabs = json.load(answer)
        return next(tab for tab in tabs if tab["type"] == "page")["webSocketDebuggerUrl"]

    def call(self, method: str, **parameters):
        """One DevTools command; events that come meanwhile are kept in ``events``."""
        self._count += 1
        self._socket.send(json.dumps({"id": self._count, "method": method, "params": parameters}))
        while True:
            message = json.loads(self._socket.recv(timeout=120))
            if message.get("id") == self._count:
                assert "error" not in message, message["error"]
                return message["result"]
            self.events.append(message)

    def open(self, url: str, width: int = 1280, height: int = 720, mobile: bool = False) -> None:
        """Load a page, forgetting the events of the one before."""
        self.call(
            "Emulation.setDeviceMetricsOverride",
            width=width,
            height=height,
            deviceScaleFactor=1,
            mobile=mobile,
        )
        self.call("Page.navigate", url="about:blank")
        time.sleep(0.1)
        self.run("1")
        self.events.clear()
        self.call("Page.navigate", url=url)

    def run(self, script: str):
        """Value of a JavaScript expression; promises are awaited."""
        answer = self.call(
            "Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True
        )
        assert "exceptionDetails" not in answer, answer["exceptionDetails"]
        return answer["result"].get("value")

    def until(self, script: str, seconds: float = 60.0):
        """Wait until a JavaScript expression is true, and return its value."""
        deadline = time.monotonic() + seconds
        while not (value := self.run(script)):
            assert time.monotonic() < deadline, (script, self.complaints())
            time.sleep(0.1)
        return value

    def press(self, key: str, code: str = "", text: str = "") -> None:
        """Press and release a key."""
        common = {"key": key, "code": code or key}
        self.call("Input.dispatchKeyEvent", type="keyDown", text=text, **common)
        self.call("Input.dispatchKeyEvent", type="keyUp", **common)

    def picture(self, file: Path | None = None) -> np.ndarray:
        """Screenshot as ``(height, width, 3)`` numbers from 0 to 255; kept in a file if named."""
        from PIL import Image

        data = base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"])
        if file is not None:
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(data)
        return np.asarray(Image.open(io.BytesIO(data)).convert("RGB")).astype(int)

    def still(self, file: Path | None = None) -> np.ndarray:
        """Screenshot after everything set so far has been drawn."""
        frame = "requestAnimationFrame"
        self.run(f"new Promise((done) => {frame}(() => {frame}(done)))")
        return self.picture(file)

    def watch(self, page: Path | str) -> None:
        """Open a page with a player and stop it at its start."""
        self.open(page.as_uri() if isinstance(page, Path) else page)
        self.until("window.player && player.framesDrawn > 0")
        self.run("player.pause(); player.time = 0")

    def vertices(self, item: str) -> np.ndarray:
        """Every vertex of a player's item as it stands in the world [m], shape ``(v, 3)``."""
        return np.array(self.run(_VERTICES % json.dumps(item)))

    def shown(self, item: str) -> bool:
        """Whether a player's item is drawn, its group's switch apart."""
        return self.run(f"player.items.find((i) => i.name === {json.dumps(item)}).object.visible")

    def requests(self) -> list[str]:
        """Addresses asked for since the page was opened, data and blob URLs left out."""
        self.run("1")
        return [
            event["params"]["request"]["url"]
            for event in self.events
            if event["method"] == "Network.requestWillBeSent"
            and not event["params"]["request"]["url"].startswith(("data:", "blob:"))
        ]

    def complaints(self) -> list[str]:
        """Errors and exceptions on the console since the page was opened."""
        found = []
        for event in self.events:
            details = event.get("params", {})
            if event["method"] == "Runtime.exceptionThrown":
                found.append(json.dumps(details["exceptionDetails"])[:2000])
            elif event["method"] == "Runtime.consoleAPICalled" and details["type"] == "error":
                found.append(json.dumps(details["args"])[:2000])
            elif event["method"] == "Log.entryAdded" and details["entry"]["level"] == "error":
                found.append(json.dumps(details["entry"])[:2000])
        return found


def _end(process: subprocess.Popen) -> None:
    process.terminate()
    try:
        process.wait(10)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
