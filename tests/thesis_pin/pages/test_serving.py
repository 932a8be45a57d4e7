"""The page is served to this machine only, and the server says what it must."""

import http.client
import socket

import pytest

from thesis_pin.errors import BadInput
from thesis_pin.pages.serving import PageServer


def answer(server, method="GET", path="/", body=None, host=None):
    connection = http.client.HTTPConnection("127.0.0.1", server._server.server_port, timeout=20)
    connection.request(method, path, body, {"Host": host} if host else {})
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


@pytest.mark.parametrize("body", [b"", b"nonsense", b"[]", b'{"frames_a_second": "x"}', b"\xff"])
def test_nonsense_from_a_page_is_answered_and_forgotten(server, said, body):
    assert answer(server, "POST", "/frames", body)[0] == 400
    assert said == []


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
        port = server._server.server_port
    with PageServer(b"", port, print):
        pass
