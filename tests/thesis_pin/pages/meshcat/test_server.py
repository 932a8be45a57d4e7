"""meshcat's server on this machine only, for its own page only, and gone with its program."""

import contextlib
import http.client
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
import tornado.httpclient
import tornado.ioloop
import tornado.websocket
from loops import beside

from thesis_pin.errors import BadInput
from thesis_pin.pages.meshcat import window
from thesis_pin.pages.meshcat.server import is_ours
from thesis_pin.pages.meshcat.window import Window, visualizer

needs_proc = pytest.mark.skipif(not Path("/proc/net/tcp").exists(), reason="no /proc")


@pytest.fixture(scope="module")
def server():
    running = Window(port=0)
    yield running
    running.close()


def port_of(server):
    return int(server.web_url.split(":")[2].split("/")[0])


def status(server, path="/static/", **headers):
    connection = http.client.HTTPConnection("127.0.0.1", port_of(server), timeout=20)
    connection.request("GET", path, headers=headers)
    found = connection.getresponse()
    content = found.read()
    connection.close()
    return found.status, content


def listening(process):
    """Local addresses, as the kernel writes them, that a process listens on."""
    inodes = set()
    for entry in Path(f"/proc/{process}/fd").iterdir():
        with contextlib.suppress(FileNotFoundError):  # closed while we look
            target = os.readlink(entry)
        if target.startswith("socket:["):
            inodes.add(target[8:-1])
    found = []
    for table in ("tcp", "tcp6"):
        for line in Path(f"/proc/{process}/net/{table}").read_text().splitlines()[1:]:
            words = line.split()
            if words[3] == "0A" and words[9] in inodes:
                found.append((table, words[1].split(":")[0]))
    return found


@needs_proc
def test_its_process_listens_on_the_loopback_interface_alone(server):
    assert listening(server.server_proc.pid) == [("tcp", "0100007F")] * 2  # pages, programs


@needs_proc
def test_the_look_at_sockets_sees_one_that_listens_everywhere():
    import socket

    with socket.socket() as everywhere:
        everywhere.bind(("", 0))
        everywhere.listen()
        assert ("tcp", "00000000") in listening(os.getpid())


def test_its_own_page_is_served(server):
    code, page = status(server)
    assert code == 200
    assert b"makeViewer" in page
    code, script = status(server, "/static/main.min.js")
    assert code == 200
    assert len(script) > 100_000
    for path in ("/static/../pyproject.toml", "/static/index.htm", "/etc/passwd", "/static/x.js"):
        assert status(server, path)[0] in (403, 404)


@pytest.mark.parametrize(
    "headers",
    [
        {"Host": "evil.example"},
        {"Host": "evil.example:7000"},
        {"Host": "127.0.0.1.evil.example"},
        {"Origin": "https://evil.example"},
        {"Origin": "null"},
        {"Origin": "http://localhost:3000"},
    ],
)
@pytest.mark.parametrize("path", ["/static/", "/static/main.min.js", "/"])
def test_other_pages_get_nothing(server, headers, path):
    code, content = status(server, path, **headers)
    assert code == 404
    assert content == b""


def connect(server, **headers):
    """Open a page's connection and close it again."""

    async def attempt():
        request = tornado.httpclient.HTTPRequest(f"ws://127.0.0.1:{port_of(server)}/")
        for name, value in headers.items():
            request.headers[name] = value
        (await tornado.websocket.websocket_connect(request)).close()

    beside(lambda: tornado.ioloop.IOLoop(make_current=False).run_sync(attempt, timeout=20))


def test_only_its_own_page_is_told_what_is_drawn(server):
    here = f"127.0.0.1:{port_of(server)}"
    connect(server, Origin=f"http://{here}")
    for foreign in ("https://evil.example", "http://localhost:3000", "null"):
        with pytest.raises(tornado.httpclient.HTTPClientError):
            connect(server, Origin=foreign)
    with pytest.raises(tornado.httpclient.HTTPClientError):
        connect(server, Host="evil.example", Origin="http://evil.example")


def test_a_tunnel_of_ssh_with_another_port_is_its_own_page_too():
    assert is_ours("localhost:9000", "http://localhost:9000")
    assert is_ours("127.0.0.1:7000", None)
    assert not is_ours("localhost.evil.example:9000", "http://localhost.evil.example:9000")
    assert not is_ours("", None)


def test_a_named_server_is_spoken_to_and_outlives_who_spoke(server):
    guest = Window(server.zmq_url)
    assert guest.web_url == server.web_url
    guest.close()
    assert status(server)[0] == 200
    assert server.server_proc.poll() is None


def test_nothing_is_printed_and_the_end_leaves_no_process(capfd):
    drawn = visualizer(port=0)
    drawn["ball"].set_transform(np.eye(4))
    process = drawn.window.server_proc
    drawn.close()
    assert process.poll() is not None
    assert capfd.readouterr() == ("", "")


def alive(pid):
    """Whether a process runs; one whose parent has died may be left as a zombie."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except OSError:
        return False


@needs_proc
@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGTERM])
def test_it_ends_with_its_program_however_that_ends(number):
    code = (
        "import sys, time\n"
        "from thesis_pin.pages.meshcat.window import Window\n"
        "kept = Window(port=0)\n"
        "print(kept.server_proc.pid, flush=True)\n"
        "time.sleep(600)\n"
    )
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE) as program:
        pid = int(program.stdout.readline())
        assert alive(pid)
        os.kill(program.pid, number)
    deadline = time.monotonic() + 30
    while alive(pid):
        assert time.monotonic() < deadline
        time.sleep(0.05)


@needs_proc
@pytest.mark.parametrize("closed", [False, True])
def test_a_forked_child_of_the_program_keeps_no_server_alive(closed):
    code = (
        "import os, sys, time\n"
        "from thesis_pin.pages.meshcat.window import Window\n"
        "kept = Window(port=0)\n"
        "child = os.fork()\n"
        "if not child:\n"
        "    os.close(1)\n"
        "    time.sleep(600)\n"
        "    os._exit(0)\n"
        "print(child, kept.server_proc.pid, flush=True)\n"
        f"{'kept.close()' if closed else ''}\n"
        "time.sleep(0 if kept.server_proc.poll() is None else 600)\n"
        "os._exit(0)\n"
    )
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE) as program:
        child, pid = map(int, program.stdout.readline().split())
        try:
            deadline = time.monotonic() + 15
            while alive(pid):
                assert time.monotonic() < deadline
                time.sleep(0.05)
            assert alive(child)
        finally:
            os.kill(child, signal.SIGKILL)
            program.kill()


def test_a_server_that_has_died_is_an_error_and_no_hang(monkeypatch):
    monkeypatch.setattr(window, "ANSWER", 0.5)
    drawn = visualizer(port=0)
    drawn.window.server_proc.kill()
    drawn.window.server_proc.wait()
    for _ in range(2):  # the second time there is nothing left to send to
        with pytest.raises(BadInput, match="doesn't answer any more"):
            drawn["ball"].set_transform(np.eye(4))
    drawn.close()


def test_a_port_that_is_taken_is_one_error(server):
    with pytest.raises(BadInput, match=rf"port {port_of(server)}: the port is in use"):
        Window(port=port_of(server))


def test_nobody_at_a_named_address_is_an_error_within_seconds(monkeypatch):
    monkeypatch.setattr(window, "FIRST_ANSWER", 0.5)
    start = time.monotonic()
    with pytest.raises(BadInput, match="no meshcat server answers"):
        Window("tcp://127.0.0.1:9")
    assert time.monotonic() - start < 20
    assert window.FIRST_ANSWER < 10


@pytest.mark.parametrize(
    "url",
    [
        "",
        "127.0.0.1:6000",
        "http://127.0.0.1:7000",
        "tcp://127.0.0.1",
        "walk.toml",
        "tcp://:6000",
        6000,
    ],
)
def test_what_is_no_address_is_refused(url):
    with pytest.raises(BadInput, match=r"no address of a meshcat server.*tcp://HOST:PORT"):
        Window(url)


def test_an_address_that_cannot_be_connected_to_is_refused():
    with pytest.raises(BadInput, match="can't connect: File name too long"):
        Window("ipc:///" + "x" * 150)
