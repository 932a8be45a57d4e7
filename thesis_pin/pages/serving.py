"""A page on the loopback interface: one GET for it, one POST for its frame rate."""

from __future__ import annotations

import errno
import json
import sys
import threading
from collections.abc import Callable
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

from thesis_pin.errors import BadInput

HOST = "127.0.0.1"
DEFAULT_PORT = 7000
"""The port meshcat's users know; others follow if it is taken."""
TRIED = 20
"""Ports tried from the default on when none is asked for."""

SMOOTH = 30.0
"""Frames a second below which the viewer says that it drops frames."""


class PageServer:
    """Serves one page to browsers on this machine; a context manager.

    Args:
        page: The page.
        port: Port to listen on; None takes the first free one from the default on.
        say: Told once when the browser draws fewer than :data:`SMOOTH` frames a second.

    Raises:
        BadInput: The port is taken or not allowed.
    """

    def __init__(self, page: bytes, port: int | None, say: Callable[[str], None]) -> None:
        self._server = _listen(_handler(page, self._frames), port)
        self._say, self._said = say, False
        self._thread = threading.Thread(target=self._server.serve_forever, daemon=True)

    @property
    def address(self) -> str:
        """Where the page is."""
        return f"http://{HOST}:{self._server.server_port}/"

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

    def _frames(self, rate: float) -> None:
        if rate < SMOOTH and not self._said:
            self._said = True
            self._say(
                f"the browser draws {rate:.0f} of {SMOOTH:.0f} frames a second: frames are "
                "dropped, the motion keeps its pace"
            )


class _Server(ThreadingHTTPServer):
    def handle_error(self, request: Any, client_address: Any) -> None:
        """A browser that leaves halfway is no error of ours; anything else is."""
        if not isinstance(sys.exc_info()[1], ConnectionError):
            super().handle_error(request, client_address)


def _listen(handler: type[BaseHTTPRequestHandler], port: int | None) -> _Server:
    last = min(DEFAULT_PORT + TRIED, 65536)
    for candidate in (port,) if port is not None else range(DEFAULT_PORT, last):
        try:
            return _Server((HOST, candidate), handler)
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


def _handler(page: bytes, frames: Callable[[float], None]) -> type[BaseHTTPRequestHandler]:
    class Handler(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            if self._is_ours() and self.path == "/":
                self._answer(200, page)
            else:
                self._answer(404, b"")

        def do_POST(self) -> None:
            body = self.rfile.read(min(int(self.headers.get("Content-Length") or 0), 1000))
            try:
                rate = float(json.loads(body)["frames_a_second"])
            except (ValueError, TypeError, KeyError):
                self._answer(400, b"")
                return
            if self._is_ours() and self.path == "/frames":
                frames(rate)
                self._answer(204, b"")
            else:
                self._answer(404, b"")

        def _is_ours(self) -> bool:
            # A foreign page may point its own host name at 127.0.0.1.
            host = (self.headers.get("Host") or "").rsplit(":", 1)[0]
            return host in (HOST, "localhost")

        def _answer(self, status: int, body: bytes) -> None:
            self.send_response(status)
            self.send_header("Content-Type", "text/html; charset=utf-8")
            self.send_header("Content-Length", str(len(body)))
            self.send_header("Cache-Control", "no-store")
            self.send_header("X-Content-Type-Options", "nosniff")
            self.end_headers()
            self.wfile.write(body)

        def log_message(self, format: str, *args: object) -> None:
            """Standard error belongs to messages for people."""

    return Handler
