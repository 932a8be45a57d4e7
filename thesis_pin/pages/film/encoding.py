"""Frames to a film: PNGs piped into ffmpeg, which holds no more than a few of them."""

from __future__ import annotations

import contextlib
import io
import subprocess
import tempfile
from collections.abc import Sequence
from types import TracebackType
from typing import IO

from thesis_pin.errors import BadInput

_YUV = "scale=out_color_matrix=bt709:out_range=tv,format=yuv420p"
_TAGS = ("-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709")

_ENCODERS = {
    "mp4": ("-vf", _YUV, "-c:v", "libx264", "-preset", "medium", "-crf", "18", *_TAGS),
    "webm": (
        *("-vf", _YUV, "-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0"),
        *("-deadline", "good", "-cpu-used", "3", "-row-mt", "1", *_TAGS),
    ),
    "gif": ("-lavfi", "[0][1]paletteuse=dither=none:diff_mode=rectangle", "-loop", "0"),
}
"""How each kind of film is encoded: so finely that thin lines and small text stay."""

KINDS = tuple(_ENCODERS)
"""Kinds of film, which are also the endings of their files."""


def ffmpeg() -> str:
    """Path of the encoder.

    Raises:
        BadInput: It isn't installed.
    """
    try:
        from imageio_ffmpeg import get_ffmpeg_exe

        path: str = get_ffmpeg_exe()
    except (ImportError, RuntimeError) as error:
        raise BadInput(
            f"films need ffmpeg through imageio-ffmpeg, which isn't here ({error})",
            remedy="pip install 'thesis-pin[film]'",
        ) from None
    return path


def palette(pictures: Sequence[bytes]) -> bytes:
    """Colours for a GIF of which these PNGs show all that matters, as a PNG of 16 × 16.

    One of the 256 is transparent: a pixel that stays as it was takes no room.
    """
    from PIL import Image

    opened = [Image.open(io.BytesIO(picture)).convert("RGB") for picture in pictures]
    width, height = opened[0].size
    every = Image.new("RGB", (width, height * len(opened)))
    for k, picture in enumerate(opened):
        every.paste(picture, (0, k * height))
    # By coverage: the median cut would drop an arrow's colour for one more grey of the floor.
    found = every.quantize(255, Image.Quantize.MAXCOVERAGE).getpalette() or []
    colours = [tuple(found[k : k + 3]) for k in range(0, min(len(found), 3 * 255), 3)]
    colours += [colours[-1]] * (255 - len(colours))
    square = Image.new("RGBA", (16, 16), (0, 0, 0, 0))
    square.putdata([(*colour, 255) for colour in colours])
    content = io.BytesIO()
    square.save(content, "PNG")
    return content.getvalue()


class Encoder:
    """ffmpeg at work; a context manager, after which nothing of it is left.

    Args:
        kind: One of :data:`KINDS`.
        rate: Frames a second.
        colours: A GIF's :func:`palette`.
    """

    def __init__(self, kind: str, rate: float, colours: bytes | None = None) -> None:
        # Files without a name: they vanish with the processes, however those end.
        self._open = contextlib.ExitStack()
        self._made, self._said = self._file(), self._file()
        inputs = ["-f", "image2pipe", "-c:v", "png", "-framerate", f"{rate:.12g}", "-i", "pipe:0"]
        passed = [self._made.fileno()]
        if colours is not None:
            kept = self._file()
            kept.write(colours)
            kept.flush()
            kept.seek(0)
            passed.append(kept.fileno())
            inputs += ["-f", "png_pipe", "-i", f"/dev/fd/{kept.fileno()}"]
        self._process = subprocess.Popen(
            [
                *(ffmpeg(), "-hide_banner", "-loglevel", "error", "-y", *inputs),
                *(*_ENCODERS[kind], "-an", "-map_metadata", "-1", "-fflags", "+bitexact"),
                *("-flags:v", "+bitexact", "-f", kind, f"/dev/fd/{self._made.fileno()}"),
            ],
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            stderr=self._said,
            pass_fds=passed,
            start_new_session=True,  # Ctrl-C is for us, who end it
        )

    def _file(self) -> IO[bytes]:
        return self._open.enter_context(tempfile.TemporaryFile())

    def __enter__(self) -> Encoder:
        return self

    def write(self, picture: bytes) -> None:
        """Add a frame, as PNG.

        Raises:
            BadInput: The encoder has failed.
        """
        try:
            assert self._process.stdin is not None
            self._process.stdin.write(picture)
        except BrokenPipeError:
            self._process.wait()
            raise self._failure() from None

    def content(self) -> bytes:
        """The film, after its last frame.

        Raises:
            BadInput: The encoder has failed.
        """
        assert self._process.stdin is not None
        with contextlib.suppress(BrokenPipeError):
            self._process.stdin.close()
        if self._process.wait() != 0:
            raise self._failure()
        self._made.seek(0)
        return self._made.read()

    def _failure(self) -> BadInput:
        self._said.seek(0)
        lines = self._said.read().decode(errors="replace").strip().splitlines()
        if lines:
            return BadInput(f"ffmpeg ended with: {lines[-1]}")
        return BadInput(  # what it had to say goes to a temporary file, as the film does
            f"ffmpeg ended with code {self._process.returncode} and said nothing",
            remedy=f"See whether {tempfile.gettempdir()}, where the film is made, has room, "
            "or name another folder in TMPDIR",
        )

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._process.poll() is None:
            self._process.kill()
            self._process.wait()
        if self._process.stdin is not None:
            with contextlib.suppress(BrokenPipeError):
                self._process.stdin.close()
        self._open.close()
