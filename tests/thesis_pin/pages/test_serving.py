"""The page is served to this machine only, and the server says what it must."""

import contextlib
import http.client
import re
import socket

import numpy as np
import pytest

from thesis_pin.errors import BadInput
from thesis_pin.pages import scene, serving
from thesis_pin.pages.serving import PageServer


def answer(server, method="GET", path="/", body=None, host=None, **headers):
    connection = http.client.HTTPConnection("127.0.0.1", server.port, timeout=20)
    connection.request(method, path, body, {**({"Host": host} if host else {}), **headers})
    found = connection.getresponse()
    content = found.read()
    connection.close()
    return found.status, content


@pytest.fixture
def said():
    return []


@pytest.fixture
def server(said):
    with PageServer(b"<p>hello</p>", 0, said.append) as running:
        yield running


def test_the_page_is_all_there_is(server):
    assert answer(server) == (200, b"<p>hello</p>")
    for path in ("/etc/passwd", "/../pyproject.toml", "/favicon.ico", "/frames"):
        assert answer(server, path=path)[0] == 404


def test_only_the_loopback_interface_listens(server):
    assert server._server.socket.getsockname()[0] == "127.0.0.1"


def test_a_foreign_host_name_that_points_here_gets_nothing(server, said):
    assert answer(server, host="evil.example:80")[0] == 404
    assert answer(server, "POST", "/frames", b'{"frames_a_second": 1}', "evil.example")[0] == 404
    assert said == []
    assert answer(server, host="localhost:80")[0] == 200


def test_dropped_frames_are_told_once_and_smooth_play_never(server, said):
    assert answer(server, "POST", "/frames", b'{"frames_a_second": 60}')[0] == 204
    assert said == []
    for _ in range(3):
        assert answer(server, "POST", "/frames", b'{"frames_a_second": 11.6}')[0] == 204
    assert len(said) == 1
    assert "12 of 30 frames a second: frames are dropped" in said[0]


NONSENSE = [
    b"",
    b"nonsense",
    b"[]",
    b"[" * 1000,
    b"\xff",
    *(
        b'{"frames_a_second": %s}' % value
        for value in (b'"x"', b'"5"', b"true", b"NaN", b"-1", b"1e308", b"9" * 900, b"-Infinity")
    ),
]


@pytest.mark.parametrize("body", NONSENSE)
def test_nonsense_from_a_page_is_answered_and_forgotten(server, said, body):
    assert answer(server, "POST", "/frames", body)[0] == 400
    assert said == []


ORIGINS = ("https://evil.example", "null", "http://localhost:3000", "http://127.0.0.1:1")


@pytest.mark.parametrize("origin", ORIGINS)
def test_pages_of_other_origins_in_the_same_browser_are_not_heard(server, said, origin):
    body = b'{"frames_a_second": 1}'
    assert answer(server, "POST", "/frames", body, Origin=origin)[0] == 404
    assert said == []
    own = f"http://127.0.0.1:{server.port}"
    assert answer(server, "POST", "/frames", body, Origin=own)[0] == 204
    assert len(said) == 1


def test_the_page_is_heard_through_a_tunnel_with_another_port(server, said):
    host = "localhost:8000"
    body = b'{"frames_a_second": 1}'
    assert answer(server, "POST", "/frames", body, host, Origin=f"http://{host}")[0] == 204
    assert len(said) == 1


def raw(server, request):
    """The status line that a server gives to bytes; empty if it only closes."""
    with socket.create_connection(("127.0.0.1", server.port), timeout=20) as stream:
        stream.sendall(request)
        return stream.makefile("rb").readline()


@pytest.mark.parametrize("length", ["-1", "1001", "99999999999", "1_0", "+5", "٣", "x\x1b[2J", ""])
def test_a_length_out_of_bounds_is_refused_before_anything_is_read(server, said, capfd, length):
    head = f"POST /frames HTTP/1.1\r\nHost: localhost\r\nContent-Length: {length}\r\n\r\n"
    # No body follows: a server that reads would wait for it.
    status = raw(server, head.encode())
    assert status.split()[1] in (b"400", b"413")
    assert said == []
    assert capfd.readouterr() == ("", "")


def test_a_foreign_host_is_refused_before_its_body_is_read(server):
    head = b"POST /frames HTTP/1.1\r\nHost: evil.example\r\nContent-Length: 900\r\n\r\n"
    assert raw(server, head).split()[1] == b"404"


def test_nothing_of_a_request_reaches_the_terminal(server, said, capfd):
    for text in (b"\x1b[2J\r\n\r\n", b"GET /\x1b[2J HTTP/9.9\r\n\r\n", b"\x00" * 70_000):
        with contextlib.suppress(ConnectionError):  # it may hang up while we still send
            raw(server, text)
    assert answer(server)[0] == 200
    assert said == []
    assert capfd.readouterr() == ("", "")


def test_a_silent_connection_is_hung_up(said, monkeypatch, capfd):
    monkeypatch.setattr(serving._Handler, "timeout", 0.2)
    request = b"POST /frames HTTP/1.1\r\nHost: localhost\r\nContent-Length: 10\r\n\r\n{"
    with PageServer(b"", 0, said.append) as running:
        for beginning in (b"", b"GET / HTTP/1.1\r\nHost", request):
            with socket.create_connection(("127.0.0.1", running.port), timeout=20) as stream:
                stream.sendall(beginning)
                assert stream.recv(10) == b""
    assert capfd.readouterr() == ("", "")


def test_two_hundred_connections_at_once_are_all_served():
    # Before the first is accepted, so that all of them have to fit in the queue.
    page = b"x" * 300_000
    server = PageServer(page, 0, print)
    streams = [socket.create_connection(("127.0.0.1", server.port), timeout=5) for _ in range(200)]
    with server:
        for stream in streams:
            stream.sendall(b"GET / HTTP/1.0\r\nHost: localhost\r\n\r\n")
        for stream in streams:
            with stream, stream.makefile("rb") as answer:
                assert answer.read().endswith(page)


PICTURE = scene.Scene(
    "a ball",
    "It rests.",
    np.array([0.0, 1.0]),
    (scene.Group("a", "all"),),
    (scene.Ball("ball", "a", np.zeros((2, 3)), 0.1, ("#000000",)),),
)


def test_showing_over_ssh_opens_nothing_and_tells_the_way(said, monkeypatch):
    monkeypatch.setenv("SSH_CONNECTION", "10.0.0.2 50000 192.0.2.7 22")
    serving.show(PICTURE, port=0, hold=0.01, say=said.append)
    assert len(said) == 2
    port = re.search(r"http://127\.0\.0\.1:(\d+)/", said[0])[1]
    assert f"ssh -L {port}:127.0.0.1:{port} " in said[1]
    assert said[1].endswith("@192.0.2.7")


def test_showing_where_nobody_asks_for_a_browser_tells_the_address_alone(said, monkeypatch):
    monkeypatch.setattr(serving, "graphical", lambda: pytest.fail("looked for a browser"))
    serving.show(PICTURE, port=0, hold=0.01, browser=False, say=said.append)
    assert len(said) == 1


def test_a_busy_port_is_a_clear_error_and_the_default_moves_on():
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        with pytest.raises(BadInput, match=rf"port {port}: the port is in use.*--port"):
            PageServer(b"", port, print)
    with PageServer(b"", None, print) as first, PageServer(b"", None, print) as second:
        assert first.address != second.address


def test_a_port_that_does_not_exist_is_refused():
    with pytest.raises(BadInput, match="port 70000"):
        PageServer(b"", 70000, print)


def test_the_port_is_free_again_afterwards():
    with PageServer(b"", 0, print) as server:
        port = server.port
    with PageServer(b"", port, print):
        pass
