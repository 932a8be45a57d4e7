"""Files are whole or untouched; what isn't a file is written into."""

import io
import os
import random
import socket
import stat
import subprocess
import sys
import threading
from functools import partial
from pathlib import Path

import pytest
from users import NOBODY, as_user

from thesis_pin.errors import BadInput, CannotWrite
from thesis_pin.files import check_file, is_standard_output, write_file, write_files

ROOT = Path(__file__).parents[3]


@pytest.fixture(autouse=True)
def _umask():
    before = os.umask(0o022)
    yield
    os.umask(before)


def mode(path: Path) -> int:
    return stat.S_IMODE(path.stat().st_mode)


def refusal(target: object, content: bytes = b"new") -> str:
    """Why a target is refused; the check before the work and the writing agree."""
    with pytest.raises(CannotWrite) as checked:
        check_file(target)
    with pytest.raises(CannotWrite) as written:
        write_file(target, content)
    assert str(checked.value) == str(written.value)
    return str(written.value)


def test_a_file_is_written_and_replaced_and_nothing_is_left_beside_it(tmp_path):
    for content in (b"old and longer", b"new", b""):
        check_file(tmp_path / "a")
        write_file(tmp_path / "a", content)
        assert (tmp_path / "a").read_bytes() == content
    assert os.listdir(tmp_path) == ["a"]


def test_a_check_changes_nothing(tmp_path):
    (tmp_path / "old").write_text("kept")
    for name in ("old", "new"):
        check_file(tmp_path / name)
    assert os.listdir(tmp_path) == ["old"]
    assert (tmp_path / "old").read_text() == "kept"


@pytest.mark.parametrize(("umask", "expected"), [(0o022, 0o644), (0o077, 0o600), (0o002, 0o664)])
def test_a_new_file_obeys_the_umask(tmp_path, umask, expected):
    os.umask(umask)
    write_file(tmp_path / "a", b"x")
    assert mode(tmp_path / "a") == expected


@pytest.mark.parametrize("before", [0o600, 0o640, 0o666, 0o755])
def test_a_file_that_is_replaced_keeps_its_mode(tmp_path, before):
    (tmp_path / "a").write_text("old")
    (tmp_path / "a").chmod(before)
    write_file(tmp_path / "a", b"new")
    assert mode(tmp_path / "a") == before
    assert (tmp_path / "a").read_bytes() == b"new"


def test_a_file_that_is_replaced_keeps_its_owner_but_not_its_age(tmp_path):
    (tmp_path / "a").write_text("old")
    os.utime(tmp_path / "a", (1, 1))
    if os.geteuid() == 0:
        os.chown(tmp_path / "a", NOBODY, NOBODY)
    before = (tmp_path / "a").stat()
    write_file(tmp_path / "a", b"new")
    after = (tmp_path / "a").stat()
    assert (after.st_uid, after.st_gid) == (before.st_uid, before.st_gid)
    assert after.st_mtime > 1e9


def test_links_are_followed_also_to_what_is_not_there_yet(tmp_path):
    (tmp_path / "far").mkdir()
    (tmp_path / "far" / "old").write_text("old")
    for name in ("old", "new"):
        (tmp_path / f"to_{name}").symlink_to(f"far/{name}")
        check_file(tmp_path / f"to_{name}")
        write_file(tmp_path / f"to_{name}", b"written")
        assert (tmp_path / f"to_{name}").is_symlink()
        assert (tmp_path / "far" / name).read_bytes() == b"written"
    assert sorted(os.listdir(tmp_path)) == ["far", "to_new", "to_old"]


def test_a_pipe_gives_its_reader_everything(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    content, got = os.urandom(300_000), []
    reader = threading.Thread(target=lambda: got.append((tmp_path / "pipe").read_bytes()))
    check_file(tmp_path / "pipe")
    reader.start()
    write_file(tmp_path / "pipe", content)
    reader.join(timeout=30)
    assert got == [content]
    assert (tmp_path / "pipe").is_fifo()


def test_a_reader_that_leaves_a_pipe_is_told_apart_from_a_full_disk(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    reader = threading.Thread(target=lambda: os.close(os.open(tmp_path / "pipe", os.O_RDONLY)))
    reader.start()
    with pytest.raises(BrokenPipeError):
        write_file(tmp_path / "pipe", bytes(10_000_000))
    reader.join(timeout=30)


@pytest.mark.skipif(os.geteuid() != 0, reason="only root makes devices")
def test_a_device_is_written_into_and_stays_one(tmp_path):
    null = tmp_path / "null"
    os.mknod(null, 0o666 | stat.S_IFCHR, os.makedev(1, 3))
    try:
        check_file(null)
        write_file(null, b"gone")
    except CannotWrite:
        pytest.skip("devices don't work on this file system")
    assert null.is_char_device()
    assert os.listdir(tmp_path) == ["null"]


def test_a_full_device_is_named():
    with pytest.raises(CannotWrite, match=r"^/dev/full: can't write it: No space left on device"):
        write_file("/dev/full", b"x")
    assert Path("/dev/full").is_char_device()


def test_a_socket_is_refused_before_and_after_the_work(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # the name of a socket is short
    with socket.socket(socket.AF_UNIX) as listener:
        listener.bind("socket")
        with pytest.raises(CannotWrite, match="nobody listens there"):
            write_file("socket", b"x")
        assert Path("socket").is_socket()


def test_what_cannot_be_written_is_refused_before_the_work_and_stays(tmp_path):
    (tmp_path / "file").write_text("kept")
    (tmp_path / "folder").mkdir()
    (tmp_path / "circle").symlink_to("circle")
    assert "there is no folder" in refusal(tmp_path / "missing" / "a")
    assert "a folder stands there" in refusal(tmp_path / "folder")
    assert "no folder" in refusal(tmp_path / "file" / "a")
    assert "isn't the name of a file" in refusal("")
    assert "isn't the name of a file" in refusal(f"{tmp_path}/new/")
    assert "symbolic links" in refusal(tmp_path / "circle")
    assert "null byte" in refusal(f"{tmp_path}/a\0b")
    assert "too long" in refusal(tmp_path / ("n" * 256))
    assert "too long" in refusal(tmp_path / "/".join(["n" * 250] * 20))
    assert sorted(os.listdir(tmp_path)) == ["circle", "file", "folder"]
    assert (tmp_path / "file").read_text() == "kept"


@pytest.mark.parametrize(
    "name", ["n" * 255, "ü" * 127, b"latin-1 \xfc".decode("utf-8", "surrogateescape")]
)
def test_every_name_the_file_system_takes_is_taken(tmp_path, name):
    check_file(tmp_path / name)
    write_file(tmp_path / name, b"x")
    assert os.listdir(tmp_path) == [name]


def test_a_user_is_refused_where_they_may_not_write_and_nothing_changes(tmp_path):
    (tmp_path / "theirs").mkdir()
    (tmp_path / "theirs" / "open").write_text("kept")
    (tmp_path / "theirs" / "open").chmod(0o666)
    (tmp_path / "theirs").chmod(0o555)
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine").chmod(0o777)
    (tmp_path / "mine" / "read-only").write_text("kept")
    (tmp_path / "mine" / "read-only").chmod(0o444)

    def work(root: Path) -> str:
        for name in ("theirs/new", "theirs/open", "mine/read-only"):
            assert "Permission denied" in refusal(root / name), name
        check_file(root / "mine" / "new")
        write_file(root / "mine" / "new", b"x")
        return "done"

    assert as_user(tmp_path, work) == "done"
    assert (tmp_path / "theirs" / "open").read_text() == "kept"
    assert (tmp_path / "mine" / "read-only").read_text() == "kept"
    assert sorted(os.listdir(tmp_path / "mine")) == ["new", "read-only"]


def in_a_process(code: str, **streams: object) -> subprocess.CompletedProcess[bytes]:
    """Python code that may write, in a process of its own."""
    words = [sys.executable, "-c", f"from thesis_pin.files import *\n{code}"]
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    return subprocess.run(words, env=environment, check=False, timeout=60, **streams)


@pytest.mark.parametrize("target", ["-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"])
def test_standard_output_keeps_what_stands_in_it(tmp_path, target):
    log = tmp_path / "log"
    log.write_text("before\n")
    code = (
        f"print('text')\ncheck_file({target!r})\nwrite_file({target!r}, b'bytes\\n')\nprint('more')"
    )
    with log.open("ab") as stream:
        done = in_a_process(code, stdout=stream, stderr=subprocess.PIPE)
    assert (done.returncode, done.stderr) == (0, b"")
    assert log.read_text() == "before\ntext\nbytes\nmore\n"
    assert is_standard_output(target)
    assert os.listdir(tmp_path) == ["log"]


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can become somebody else")
def test_a_user_may_write_to_the_standard_output_that_root_opened():
    code = "check_file('/dev/stdout')\nwrite_file('/dev/stdout', b'bytes')"
    become = f"import os\nos.setgid({NOBODY})\nos.setuid({NOBODY})\n"
    done = in_a_process(become + code, capture_output=True)
    assert (done.stdout, done.stderr) == (b"bytes", b"")


def test_a_closed_or_full_standard_output_is_named(tmp_path):
    code = (
        "import os, sys\nfrom thesis_pin.errors import CannotWrite\n"
        "try:\n    check_file('-')\n    write_file('-', b'x')\n"
        "except CannotWrite as error:\n    os.write(2, str(error).encode())\nos._exit(0)"
    )
    with open("/dev/full", "wb") as full:
        said = in_a_process(code, stdout=full, stderr=subprocess.PIPE).stderr
    assert said == b"-: can't write it: No space left on device"
    said = in_a_process(f"import sys\nsys.stdout = None\n{code}", stderr=subprocess.PIPE).stderr
    assert b"standard output is closed" in said


def test_a_stream_that_takes_a_part_at_a_time_gets_everything(monkeypatch):
    class Slow(io.BytesIO):
        def write(self, content):
            return super().write(content[:3])

    monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(Slow()))
    write_file("-", b"0123456789")
    assert sys.stdout.buffer.getvalue() == b"0123456789"


def test_an_open_file_that_is_only_read_is_refused_before_the_work(tmp_path):
    (tmp_path / "a").write_text("kept")
    with (
        (tmp_path / "a").open("rb") as stream,
        pytest.raises(CannotWrite, match="reading only"),
    ):
        check_file(f"/dev/fd/{stream.fileno()}")
    assert not is_standard_output(tmp_path / "a")
    assert not is_standard_output(7)


def test_a_file_is_old_or_new_whatever_line_a_run_is_killed_at(tmp_path, killer):
    target, new = tmp_path / "a", b"new" * 100
    seen = set()
    for line in range(1000):
        target.write_bytes(b"old")
        done = not killer.at_line([partial(write_file, target, new)], line)
        found = target.read_bytes()
        assert found in (b"old", new)
        seen.add(found)
        assert set(os.listdir(tmp_path)) <= {"a", ".a.partial"}
        if done:
            break
    assert line > 20  # the last line was reached, and it wasn't the first
    assert seen == {b"old", new}
    (tmp_path / ".a.partial").write_bytes(b"left by a killed run")
    write_file(target, b"newest")
    assert os.listdir(tmp_path) == ["a"]


def test_100_kills_at_any_moment_leave_a_whole_file(tmp_path, killer):
    random.seed(1)
    target = tmp_path / "a"
    contents = [bytes([k]) * 3_000_000 for k in range(2)]
    write_file(target, contents[0])
    work = [partial(write_file, target, content) for content in contents]
    for _ in range(100):
        assert killer.after(work, random.uniform(0.001, 0.02))
        assert target.read_bytes() in contents
        assert set(os.listdir(tmp_path)) <= {"a", ".a.partial"}
    write_file(target, b"last")
    assert os.listdir(tmp_path) == ["a"]


def test_runs_that_write_the_same_file_wait_for_each_other(tmp_path):
    target = tmp_path / "a"
    contents = [bytes([k]) * 200_000 for k in range(8)]

    def work(content: bytes) -> None:
        for _ in range(20):
            write_file(target, content)

    threads = [threading.Thread(target=work, args=(content,)) for content in contents]
    for thread in threads:
        thread.start()
    while any(thread.is_alive() for thread in threads):
        assert not target.exists() or target.read_bytes() in contents
    assert target.read_bytes() in contents
    assert os.listdir(tmp_path) == ["a"]


def test_generated_files_have_the_same_bytes_everywhere(tmp_path):
    paths = write_files({"a.txt": "one\ntwo\n", "sub/b.txt": "θ"}, tmp_path / "new")
    assert [path.read_bytes() for path in paths] == [b"one\ntwo\n", "θ".encode()]
    with pytest.raises(BadInput):
        write_files({"a.txt/b": "x"}, tmp_path / "new")
