"""A program's end of meshcat: a server of our own, or one that was named."""

from __future__ import annotations

import errno
import json
import os
import subprocess
import sys
import weakref
from collections.abc import Callable

import zmq
from meshcat import Visualizer
from meshcat.visualizer import ViewerWindow

from thesis_pin.errors import BadInput
from thesis_pin.numeric.checks import shown
from thesis_pin.pages.meshcat.address import ALLOWED, is_address

FIRST_ANSWER = 4.0
"""Seconds within which a server that was named must answer."""
ANSWER = 20.0
"""Seconds within which a server must have taken what it is sent."""
START = 30.0
"""Seconds that our own server may take to start."""


class Window(ViewerWindow):  # type: ignore[misc] # meshcat has no types
    """meshcat's window, that prints nothing and waits for nobody for ever.

    Args:
        url: Address of a server, as ``tcp://127.0.0.1:6000``; None starts our own.
        port: Port of our own server's page, 0 for any; None takes the first free one from 7000.

    Attributes:
        zmq_url: Address that programs reach the server by.
        web_url: Address of its page.
        own: Whether it is our own server, which ends with this object.

    Raises:
        BadInput: The address is none, nobody answers there, or the port is taken.
    """

    def __init__(self, url: str | None = None, port: int | None = None) -> None:
        self.own = url is None
        self._closing: Callable[[], object] = lambda: None
        if url is None:
            self.server_proc, told = _start(port)
            self._end = weakref.finalize(self, _stop, self.server_proc)
            self.zmq_url, self.web_url = str(told["zmq"]), str(told["web"])
            self.connect_zmq()
        else:
            if not is_address(url):
                raise BadInput(f"{shown(url)} is no address of a meshcat server", allowed=ALLOWED)
            self.zmq_url = url
            self.connect_zmq()
            self.web_url = self._first_answer()
            self.connect_zmq()

    def connect_zmq(self) -> None:
        """Connect, with an end to every waiting."""
        self._closing()
        self.zmq_socket = self.context.socket(zmq.REQ)
        self._closing = weakref.finalize(self, self.zmq_socket.close, 0)
        self.zmq_socket.setsockopt(zmq.LINGER, 0)
        self._patience(ANSWER)
        try:
            self.zmq_socket.connect(self.zmq_url)
        except zmq.ZMQError as error:
            self._closing()
            raise BadInput(
                f"can't connect: {error}", where=shown(self.zmq_url), allowed=ALLOWED
            ) from None

    def send(self, command: object) -> None:
        """Send a command of meshcat's.

        Raises:
            BadInput: The server doesn't take it.
        """
        self._asked(super().send, command)

    def get_scene(self) -> str:
        """The page that meshcat's server makes of everything in it."""
        return str(self._asked(super().get_scene))

    def wait(self) -> str:
        """Block until a browser is connected, however long that takes."""
        self.zmq_socket.setsockopt(zmq.RCVTIMEO, -1)
        try:
            return str(super().wait())
        finally:
            self._patience(ANSWER)

    def get_image(self) -> object:
        """A picture from a page that is open."""
        return self._asked(super().get_image)

    def close(self) -> None:
        """Let go of the server; our own ends."""
        self._closing()
        if self.own:
            self._end()

    def _first_answer(self) -> str:
        self._patience(FIRST_ANSWER)
        try:
            self.zmq_socket.send(b"url")
            web = self.zmq_socket.recv().decode("utf-8", "replace")
        except zmq.ZMQError:
            self._closing()
            raise BadInput(
                "no meshcat server answers",
                where=self.zmq_url,
                remedy="Start one with meshcat-server and name its zmq_url, or leave the address "
                "out: a server of our own is started",
            ) from None
        if not (web.startswith(("http://", "https://")) and web.isprintable() and " " not in web):
            raise BadInput("what answers there is no meshcat server", where=self.zmq_url)
        return str(web)

    def _patience(self, seconds: float) -> None:
        for option in (zmq.RCVTIMEO, zmq.SNDTIMEO):
            self.zmq_socket.setsockopt(option, int(1000 * seconds))

    def _asked(self, ask: object, *words: object) -> object:
        try:
            return ask(*words)  # type: ignore[operator]
        except zmq.ZMQError as error:
            raise BadInput(
                f"the meshcat server doesn't answer any more ({error})", where=self.zmq_url
            ) from None


def visualizer(url: str | None = None, port: int | None = None) -> Visualizer:
    """A ``meshcat.Visualizer`` on a server of ours or on a named one; nothing is printed.

    Args:
        url: See :class:`Window`.
        port: See :class:`Window`.

    Raises:
        BadInput: See :class:`Window`.
    """
    return Visualizer(window=Window(url, port))


def _start(port: int | None) -> tuple[subprocess.Popen[bytes], dict[str, object]]:
    """A server of our own, and where it is."""
    words = [] if port is None else [str(port)]
    where = os.pathsep.join(path for path in sys.path if path)
    process = subprocess.Popen(
        [sys.executable, "-P", "-m", "thesis_pin.pages.meshcat.server", *words],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        env=os.environ | {"PYTHONPATH": where},
    )
    said = process.stdout.readline() if process.stdout else b""
    try:
        told: dict[str, object] = json.loads(said)
    except ValueError:
        _, why = process.communicate()
        last = why.decode(errors="replace").strip().splitlines()[-1:]
        raise BadInput(f"meshcat's server doesn't start: {' '.join(last)}") from None
    if "refused" in told:
        _stop(process)
        busy = told["refused"] == errno.EADDRINUSE
        raise BadInput(
            "the port is in use" if busy else f"can't listen there: {told['why']}",
            where="ports from 7000 on" if port is None else f"port {port}",
            allowed="a free port from 0 (any) to 65535",
            remedy="Choose another with --port, or leave it out to take a free one",
        )
    return process, told


def _stop(process: subprocess.Popen[bytes]) -> None:
    """End a server of ours; a forked child may hold its standard input open."""
    for pipe in (process.stdin, process.stdout, process.stderr):
        if pipe is not None:
            pipe.close()
    process.terminate()
    try:
        process.wait(ANSWER)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
