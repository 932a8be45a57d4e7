"""``view --meshcat`` of all three commands: a server that comes, is told of, and goes."""

import http.client
import json
import os
import signal
import subprocess
import sys
from urllib.parse import urlsplit

import pytest
from commands import MODULES, ROOT, example, run

from thesis_pin.pages.meshcat import window
from thesis_pin.pages.meshcat.window import Window

NAMES = ("scout-pin view", "pollard-pin view", "thesis-pin view")


def answers(address):
    """What a page's server answers; None where nobody is."""
    place = urlsplit(address)
    connection = http.client.HTTPConnection(place.hostname, place.port, timeout=20)
    try:
        connection.request("GET", place.path)
        return connection.getresponse().status
    except ConnectionRefusedError:
        return None
    finally:
        connection.close()


@pytest.mark.parametrize("name", NAMES)
def test_a_motion_goes_to_meshcat_and_its_server_ends_with_the_command(
    name, tmp_path, monkeypatch, capfd
):
    monkeypatch.chdir(ROOT)
    told = tmp_path / "shown.json"
    words = ["--meshcat", "--port", "0", "--no-browser", "--hold", "0.2", "--json", str(told)]
    code, out, err = run(name, [*example(name), *words], capfd)
    assert (code, out) == (0, "")
    document = json.loads(told.read_text())
    assert document["address"].startswith("http://127.0.0.1:")
    assert document["meshcat"].startswith("tcp://127.0.0.1:")
    assert f" in meshcat at {document['address']} (Ctrl-C ends)\n" in err
    assert answers(document["address"]) is None


def test_a_server_that_is_named_keeps_what_it_is_shown(tmp_path, capfd):
    server = Window(port=0)
    words = ["view", "--gait", str(ROOT / "examples" / "squat.toml"), "--meshcat", server.zmq_url]
    code, out, err = run("scout-pin view", words, capfd)
    assert (code, out) == (0, "")
    assert err.splitlines()[-1].endswith(f" in meshcat at {server.web_url}")
    assert server.get_scene().count("fetch(") > 30
    assert answers(server.web_url) == 200
    server.close()


@pytest.mark.parametrize("flag", ["--port", "--hold"])
def test_flags_of_our_own_server_mean_nothing_on_another(flag, capfd):
    words = ["view", "--meshcat", "tcp://127.0.0.1:6000", flag, "9"]
    code, out, err = run("scout-pin view", words, capfd)
    assert (code, out) == (2, "")
    assert f"{flag} means nothing beside --meshcat" in err


@pytest.mark.parametrize("name", NAMES)
def test_a_server_that_isnt_there_is_one_error(name, monkeypatch, capfd):
    monkeypatch.setattr(window, "FIRST_ANSWER", 0.5)
    monkeypatch.chdir(ROOT)
    words = [*example(name), "--meshcat", "tcp://127.0.0.1:9"]
    code, out, err = run(name, words, capfd)
    assert (code, out) == (2, "")
    assert err.count(": error: ") == 1
    assert "tcp://127.0.0.1:9: no meshcat server answers" in err


def test_a_file_behind_the_flag_is_told_from_an_address(capfd):
    code, _, err = run("scout-pin view", ["view", "--meshcat", "walk.toml"], capfd)
    assert code == 2
    assert "'walk.toml' is no address of a meshcat server" in err


def test_ctrl_c_ends_the_command_and_its_server():
    code = f"import sys; from {MODULES['scout-pin']} import main; sys.exit(main())"
    words = ["view", "--meshcat", "--port", "0", "--no-browser"]
    with subprocess.Popen(
        [sys.executable, "-c", code, *words],
        stderr=subprocess.PIPE,
        text=True,
        env=os.environ | {"PYTHONPATH": str(ROOT)},
        start_new_session=True,
    ) as command:
        address = command.stderr.readline().split(" at ")[1].split()[0]
        assert answers(address) == 200
        os.killpg(command.pid, signal.SIGINT)  # as a terminal does: the server hears it too
        assert command.stderr.read().splitlines()[-1] == "stopped"
    assert command.returncode == 0
    assert answers(address) is None
