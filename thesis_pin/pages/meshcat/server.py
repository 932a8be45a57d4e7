"""meshcat's server, bound to this machine, deaf to other pages, and gone with who started it.

meshcat's own listens on every address of the machine and answers whoever asks. This one is
run as a process of its own (``python -m thesis_pin.pages.meshcat.server PORT``), says in one
line of JSON where it is, and ends with the program that started it, however that ends: when
its standard input does, which a child that the program forked may hold open, or its parent.
"""

from __future__ import annotations

import contextlib
import json
import os
import select
import signal
import sys
import threading
from collections.abc import Sequence
from typing import Any, TextIO

import tornado.web
import tornado.websocket
import zmq
from meshcat.servers import zmqserver
from tornado.netutil import bind_sockets

from thesis_pin.pages.meshcat.page import index, policy
from thesis_pin.pages.serving import DEFAULT_PORT, HOST, TRIED

OWN = (HOST, "localhost")
"""Names of this machine that a browser may ask for."""

PARENT = 1.0
"""Seconds between two looks at who is this process's parent."""


def is_ours(host: str, origin: str | None) -> bool:
    """Whether a page of this server asks.

    A foreign page may point its own host name at 127.0.0.1, which ``Host`` betrays, or ask
    from where it is, which ``Origin`` betrays.

    Args:
        host: What the request says in ``Host``.
        origin: What it says in ``Origin``, None if nothing.
    """
    return host.rsplit(":", 1)[0] in OWN and origin in (None, f"http://{host}")


class _Guarded(tornado.web.RequestHandler):  # type: ignore[misc, unused-ignore]
    """Answers this server's own pages alone."""

    def prepare(self) -> None:
        """Refuse what another page asks."""
        headers = self.request.headers
        if not is_ours(headers.get("Host", ""), headers.get("Origin")):
            raise tornado.web.HTTPError(404)

    def set_default_headers(self) -> None:
        """Nothing is guessed, kept or told to other pages."""
        self.set_header("X-Content-Type-Options", "nosniff")
        self.set_header("Cache-Control", "no-store")
        self.set_header("Referrer-Policy", "no-referrer")
        self.clear_header("Server")

    def write_error(self, status_code: int, **_: Any) -> None:
        """Nothing of a request is repeated."""
        self.finish()


class _Page(_Guarded):
    """meshcat's page."""

    def get(self) -> None:
        """The page, with the camera where a scene asks for it."""
        self.set_header("Content-Type", "text/html; charset=utf-8")
        self.set_header("Content-Security-Policy", policy(self.request.host))
        self.finish(index())


class _Files(_Guarded, tornado.web.StaticFileHandler):  # type: ignore[misc, unused-ignore]
    """What meshcat's page loads."""


class _Socket(_Guarded, zmqserver.WebSocketHandler):  # type: ignore[misc]
    """What a page hears, and how it answers with pictures."""

    def check_origin(self, origin: str) -> bool:
        """Whether this server's own page connects."""
        return is_ours(self.request.headers.get("Host", ""), origin)


class _Application(tornado.web.Application):  # type: ignore[misc, unused-ignore]
    """Listens on this machine alone, whatever it is told."""

    port = 0

    def listen(self, port: int, *_: Any, **__: Any) -> Any:
        """Listen on 127.0.0.1."""
        from tornado.httpserver import HTTPServer

        sockets = bind_sockets(port, HOST)
        self.port = sockets[0].getsockname()[1]
        server = HTTPServer(self, max_header_size=1 << 16)
        server.add_sockets(sockets)
        return server


class Bridge(zmqserver.ZMQWebSocketBridge):  # type: ignore[misc]
    """meshcat's bridge between a program and its pages, on 127.0.0.1.

    Args:
        port: Port of the pages; 0 is any.
    """

    def __init__(self, port: int) -> None:
        super().__init__(zmq_url=f"tcp://{HOST}:*", host=HOST, port=port)
        self.zmq_url = self.zmq_socket.getsockopt(zmq.LAST_ENDPOINT).decode()
        self.web_url = f"http://{HOST}:{self.app.port}/static/"

    def make_app(self) -> _Application:
        """What is answered: the page, the file it loads, and its connection."""
        root = zmqserver.VIEWER_ROOT
        return _Application(
            [
                (r"/static/(?:index\.html)?", _Page),
                (r"/static/(main\.min\.js)", _Files, {"path": root}),
                (r"/", _Socket, {"bridge": self}),
            ]
        )

    def forward_to_websockets(self, frames: Sequence[bytes]) -> None:
        """Tell every page; one that has just gone must not keep the program waiting."""
        for page in tuple(self.websocket_pool):
            with contextlib.suppress(tornado.websocket.WebSocketClosedError):
                page.write_message(frames[2], binary=True)


def main(words: Sequence[str]) -> int:
    """Serve until standard input ends.

    Args:
        words: The port to listen on, 0 for any; without one the first free one.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for who started it
    said, parent = sys.stdout, os.getppid()
    # What meshcat and tornado say of requests is a stranger's.
    sys.stdout = sys.stderr = open(os.devnull, "w")  # noqa: SIM115 # for good
    ports = [int(word) for word in words] or list(range(DEFAULT_PORT, DEFAULT_PORT + TRIED))
    for port in ports:
        try:
            bridge = Bridge(port)
        except OSError as error:
            refusal = error
            continue
        told = {"zmq": bridge.zmq_url, "web": bridge.web_url, "port": bridge.app.port}
        _say(told, said)
        threading.Thread(target=_end_with_parent, args=(parent,), daemon=True).start()
        bridge.run()
    _say({"refused": refusal.errno, "why": str(refusal)}, said)
    return 1


def _say(told: dict[str, object], where: TextIO) -> None:
    where.write(json.dumps(told) + "\n")
    where.flush()


def _end_with_parent(parent: int) -> None:
    while os.getppid() == parent:
        ended, _, _ = select.select([sys.stdin], [], [], PARENT)
        if ended and not os.read(sys.stdin.fileno(), 1):
            break
    os._exit(0)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
