"""Pages on the loopback interface: one GET for the page, POSTs for its frame rate and questions."""

from __future__ import annotations

import errno
import json
import logging
import threading
from collections.abc import Callable, Mapping, Sequence
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

from thesis_pin.errors import BadInput
from thesis_pin.pages.browser import directions, graphical
from thesis_pin.pages.player import html
from thesis_pin.pages.scene import Look, Scene

_LOG = logging.getLogger(__name__)

HOST = "127.0.0.1"
DEFAULT_PORT = 7000
"""The port meshcat's users know; others follow if it is taken."""
TRIED = 20
"""Ports tried from the default on when none is asked for."""

SMOOTH = 30.0
"""Frames a second below which the viewer says that it drops frames."""

Answer = Callable[[bytes], bytes | None]
"""What a posted body is answered, JSON; None if it makes no sense."""

LONGEST = 1000
"""Bytes of a request's body that are read; a frame rate needs a few dozen."""
LONGEST_QUESTION = 50_000
"""The same of a question: a configuration of 200 joints has that many letters ten times over."""
PATIENCE = 10.0
"""Seconds a connection may stand still."""
_PIECE = 1 << 16
_HEED = 0.05
"""Seconds within which the server ends when it is told to; half a second is felt at Ctrl-C."""


def show(
    scene: Scene,
    *,
    speed: float = 1.0,
    look: Look = "3d",
    port: int | None = None,
    browser: bool = True,
    hold: float | None = None,
    say: Callable[[str], None] = _LOG.warning,
    ready: Callable[[str], None] | None = None,
) -> None:
    """Serve a scene on 127.0.0.1 until interrupted (Ctrl-C) or ``hold`` has passed.

    Args:
        scene: What to show.
        speed: Playing speed at first; 1 is real time.
        look: Where the camera stands at first.
        port: Port; None takes the first free one from :data:`DEFAULT_PORT` on.
        browser: Whether to open the page in the user's browser. Over SSH and where
            only a text browser is at hand, ``say`` is told how to reach it instead.
        hold: Seconds to serve; None for ever.
        say: Told the address, and when the browser can't draw every frame; left out,
            a log, which Python writes on standard error unless told otherwise.
        ready: Given the address, for a program that wants to know it.

    Raises:
        BadInput: The port is taken or not allowed.
    """
    page = html(scene, speed=speed, look=look)
    show_page(page, scene.title, port=port, browser=browser, hold=hold, say=say, ready=ready)


def show_page(
    page: bytes,
    title: str,
    *,
    port: int | None = None,
    browser: bool = True,
    hold: float | None = None,
    say: Callable[[str], None] = _LOG.warning,
    ready: Callable[[str], None] | None = None,
    answers: Mapping[str, Answer] | None = None,
    also: Sequence[int] = (),
) -> None:
    """Serve a page as :func:`show` does a scene's.

    Args:
        page: The page.
        title: What it shows.
        port: See :func:`show`.
        browser: The same.
        hold: The same.
        say: The same.
        ready: The same.
        answers: What the page may ask: path → what a posted body is answered.
        also: Ports of other servers whose pages it shows.

    Raises:
        BadInput: The port is taken or not allowed.
    """
    with PageServer(page, port, say, answers) as server:
        say(f"showing {title} at {server.address} (Ctrl-C ends)")
        if ready is not None:
            ready(server.address)
        if browser:
            window = graphical()
            if window is None or not window.open(server.address):
                say(directions(HOST, server.port, also=also))
        server.wait(hold)


class PageServer:
    """Serves one page to browsers on this machine; a context manager.

    Args:
        page: The page.
        port: Port to listen on; None takes the first free one from the default on.
        say: Told once when the browser draws fewer than :data:`SMOOTH` frames a second.
        answers: See :func:`show_page`.

    Raises:
        BadInput: The port is taken or not allowed.
    """

    def __init__(
        self,
        page: bytes,
        port: int | None,
        say: Callable[[str], None],
        answers: Mapping[str, Answer] | None = None,
    ) -> None:
        self._server = _listen(page, port, {"/frames": self._frames, **(answers or {})})
        self._say, self._said = say, False
        self._thread = threading.Thread(
            target=self._server.serve_forever, args=(_HEED,), daemon=True
        )

    @property
    def port(self) -> int:
        """The port it listens on."""
        return self._server.server_port

    @property
    def address(self) -> str:
        """Where the page is."""
        return f"http://{HOST}:{self.port}/"

    def __enter__(self) -> PageServer:
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._server.shutdown()
        self._server.server_close()

    def wait(self, seconds: float | None) -> None:
        """Return after some seconds, or on Ctrl-C; None waits for Ctrl-C alone."""
        try:
            threading.Event().wait(seconds)
        except KeyboardInterrupt:
            self._say("stopped")

    def _frames(self, body: bytes) -> bytes | None:
        rate = _rate(body)
        if rate is None:
            return None
        if rate < SMOOTH and not self._said:
            self._said = True
            self._say(
                f"the browser draws {rate:.0f} of {SMOOTH:.0f} frames a second: frames are "
                "dropped, the motion keeps its pace"
            )
        return b""


class _Server(ThreadingHTTPServer):
    daemon_threads = True
    request_queue_size = 512  # connections that may wait while a thread is made for each

    def __init__(self, page: bytes, port: int, answers: Mapping[str, Answer]) -> None:
        self.page, self.answers = page, answers
        super().__init__((HOST, port), _Handler)

    def handle_error(self, request: object, client_address: object) -> None:
        """What goes wrong in a request ends it; its text is a stranger's and isn't printed."""


def _listen(page: bytes, port: int | None, answers: Mapping[str, Answer]) -> _Server:
    last = min(DEFAULT_PORT + TRIED, 65536)
    for candidate in (port,) if port is not None else range(DEFAULT_PORT, last):
        try:
            return _Server(page, candidate, answers)
        except (OSError, OverflowError) as error:
            busy = isinstance(error, OSError) and error.errno == errno.EADDRINUSE
            if port is None and busy:
                continue
            raise BadInput(
                "the port is in use" if busy else f"can't listen there: {error}",
                where=f"port {candidate}",
                allowed="a free port from 0 (any) to 65535",
                remedy="Choose another with --port, or leave it out to take a free one",
            ) from None
    raise BadInput(
        f"ports {DEFAULT_PORT} to {last - 1} are all in use", remedy="Choose one with --port"
    )


class _Handler(BaseHTTPRequestHandler):
    server: _Server
    timeout = PATIENCE

    def do_GET(self) -> None:
        """Give the page, and nothing else."""
        if self._is_ours() and self.path == "/":
            self._answer(200, self.server.page)
        else:
            self._answer(404)

    def do_POST(self) -> None:
        """Answer what the page asks; only what is short enough is read at all."""
        answer = self.server.answers.get(self.path)
        if answer is None or not self._is_ours():
            self._answer(404)
            return
        length = self.headers.get("Content-Length", "0")
        if not (length.isascii() and length.isdecimal() and len(length) <= 5):
            self._answer(400)
        elif int(length) > (LONGEST if self.path == "/frames" else LONGEST_QUESTION):
            self._answer(413)
        elif (body := answer(self.rfile.read(int(length)))) is None:
            self._answer(400)
        elif body:
            self._answer(200, body, "application/json")
        else:
            self._answer(204)

    def _is_ours(self) -> bool:
        """Whether our own page asks: nothing is read or told otherwise.

        A foreign page may point its own host name at 127.0.0.1, which ``Host`` betrays,
        or post to us from where it is, which ``Origin`` betrays.
        """
        host = self.headers.get("Host", "")
        origin = self.headers.get("Origin", f"http://{host}")
        return host.rsplit(":", 1)[0] in (HOST, "localhost") and origin == f"http://{host}"

    def _answer(self, status: int, body: bytes = b"", kind: str = "text/html") -> None:
        self.send_response(status)
        self.send_header("Content-Type", f"{kind}; charset=utf-8")
        self.send_header("Content-Length", str(len(body)))
        self.send_header("Cache-Control", "no-store")
        self.send_header("X-Content-Type-Options", "nosniff")
        self.end_headers()
        # In pieces, as the socket's patience is for each call: a tunnel may be slow.
        for start in range(0, len(body), _PIECE):
            self.wfile.write(body[start : start + _PIECE])

    def log_message(self, format: str, *args: object) -> None:
        """Standard error belongs to messages for people."""


def _rate(body: bytes) -> float | None:
    """Frames a second that a page reports; None for anything else."""
    try:
        rate = json.loads(body)["frames_a_second"]
    except (ValueError, TypeError, KeyError, RecursionError):
        return None
    if isinstance(rate, bool) or not isinstance(rate, int | float):
        return None
    return float(rate) if 0 <= rate <= 1000 else None
