"""Films and pictures of scenes, as bytes and as files."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Callable, Coroutine
from dataclasses import replace
from pathlib import Path
from typing import TypeVar

import numpy as np

from thesis_pin.errors import BadInput
from thesis_pin.files import write_file
from thesis_pin.numeric.checks import instance, real, shown
from thesis_pin.numeric.workers import silent
from thesis_pin.pages.film.camera import View, camera
from thesis_pin.pages.film.encoding import KINDS, Encoder, ffmpeg, palette
from thesis_pin.pages.scene import Scene

Made = TypeVar("Made")

RATES = {"mp4": 30.0, "webm": 30.0, "gif": 15.0}
"""Frames a second where none are asked for; a GIF of more gets large."""

FASTEST = {"mp4": 120.0, "webm": 120.0, "gif": 50.0}
"""Frames a second at most; a GIF counts in hundredths, and viewers slow one of 1 down."""

_COLOURS_FROM = 5
"""Moments from which a GIF's colours are taken."""


def kind_of(target: str | Path) -> str:
    """The kind of film that a file's ending names.

    Raises:
        BadInput: It names none.
    """
    kind = Path(target).suffix.lower().removeprefix(".") if isinstance(target, str | Path) else ""
    if kind not in KINDS:
        raise BadInput(
            f"a film is to be {shown(target)}", allowed="a file that ends in .mp4, .webm or .gif"
        )
    return kind


def even(view: View) -> View:
    """The view whose width and height are even, as films need them: at most a pixel more."""
    return replace(view, width=view.width + view.width % 2, height=view.height + view.height % 2)


def moments(scene: Scene, rate: float, speed: float = 1.0) -> np.ndarray:
    """Times since the scene's start [s] at which a film's frames are taken, shape ``(n,)``.

    Args:
        scene: What is shown.
        rate: Frames a second.
        speed: Playing speed; 1 is real time.
    """
    duration = float(scene.time[-1] - scene.time[0])
    steps = round(duration / speed * rate, 6)  # 2.9999999999999996 steps are three
    found = np.arange(int(steps) + 1) * (speed / rate)
    return np.asarray(np.minimum(found, duration))


def film(
    scene: Scene,
    kind: str,
    *,
    view: View | None = None,
    rate: float | None = None,
    speed: float = 1.0,
    progress: Callable[[int, int], None] = silent,
) -> bytes:
    """A scene as a film of every frame, however long one takes to draw.

    The same scene gives the same frames; films other than GIFs are :func:`even`.

    Args:
        scene: What to show.
        kind: ``mp4``, ``webm`` or ``gif``.
        view: How to look at it; None for the usual one.
        rate: Frames a second; None for the kind's usual one, see :data:`RATES`.
        speed: Playing speed; 1 is real time.
        progress: Told the frames done and their number.

    Raises:
        BadInput: Something is out of bounds, or the browser or the encoder is missing or fails.
    """
    instance("scene", scene, Scene, "gait_scene(), path_scene() or Scene()")
    if kind not in KINDS:
        raise BadInput(f"kind is {shown(kind)}", allowed=", ".join(KINDS))
    rate = real("rate", RATES[kind] if rate is None else rate, low=1.0, high=FASTEST[kind])
    speed = real("speed", speed, low=1e-3, high=1e3)
    view = View() if view is None else view
    times = moments(scene, rate, speed)
    ffmpeg()  # before the browser: it may be missing
    return _wait_for(
        _filmed(scene, view if kind == "gif" else even(view), kind, rate, times, progress)
    )


async def _filmed(
    scene: Scene,
    view: View,
    kind: str,
    rate: float,
    times: np.ndarray,
    progress: Callable[[int, int], None],
) -> bytes:
    async with camera(scene, view) as held:
        colours = None
        if kind == "gif":
            some = np.linspace(0.0, times[-1], _COLOURS_FROM)
            colours = palette([await held.shot(float(time)) for time in some])
        with Encoder(kind, rate, colours) as encoder:
            for done, time in enumerate(times):
                progress(done, len(times))
                encoder.write(await held.shot(float(time)))
            return encoder.content()


def picture(scene: Scene, *, at: float = 0.0, view: View | None = None) -> bytes:
    """A scene at one moment, as PNG.

    Args:
        scene: What to show.
        at: Time since its start [s].
        view: How to look at it; None for the usual one.

    Raises:
        BadInput: The moment is out of bounds, or the browser is missing or fails.
    """
    instance("scene", scene, Scene, "gait_scene(), path_scene() or Scene()")
    at = real("at", at, low=0.0, high=float(scene.time[-1] - scene.time[0]))
    return _wait_for(_pictured(scene, View() if view is None else view, at))


async def _pictured(scene: Scene, view: View, at: float) -> bytes:
    async with camera(scene, view) as held:
        return await held.shot(at)


def write_film(
    scene: Scene,
    target: str | Path,
    *,
    view: View | None = None,
    rate: float | None = None,
    speed: float = 1.0,
    progress: Callable[[int, int], None] = silent,
) -> None:
    """Write :func:`film` to a file whose ending says its kind, whole or not at all.

    Raises:
        BadInput: See :func:`film` and :func:`kind_of`.
        CannotWrite: The file can't be written.
    """
    kind = kind_of(target)
    write_file(target, film(scene, kind, view=view, rate=rate, speed=speed, progress=progress))


def write_picture(
    scene: Scene, target: str | Path, *, at: float = 0.0, view: View | None = None
) -> None:
    """Write :func:`picture` to a file, whole or not at all.

    Raises:
        BadInput: See :func:`picture`, or the file isn't called ``.png``.
        CannotWrite: The file can't be written.
    """
    check_picture(target)
    write_file(target, picture(scene, at=at, view=view))


def check_picture(target: str | Path) -> None:
    """Refuse a file whose ending isn't that of a picture.

    Raises:
        BadInput: It isn't.
    """
    if not isinstance(target, str | Path) or Path(target).suffix.lower() != ".png":
        raise BadInput(f"a picture is to be {shown(target)}", allowed="a file that ends in .png")


def _wait_for(work: Coroutine[object, object, Made]) -> Made:
    """What a coroutine returns; on Ctrl-C it is cancelled first, which closes what it opened."""
    try:
        asyncio.get_running_loop()
    except RuntimeError:
        return asyncio.run(work)
    return _beside(work)  # a notebook's loop runs in this thread


def _beside(work: Coroutine[object, object, Made]) -> Made:
    """The same in a thread with a loop of its own."""
    found: list[Made] = []
    failed: list[BaseException] = []

    def run() -> None:
        try:
            found.append(asyncio.run(work))
        except BaseException as error:
            failed.append(error)

    thread = threading.Thread(target=run)
    thread.start()
    thread.join()
    if failed:
        raise failed[0]
    return found[0]
