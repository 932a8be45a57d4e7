"""Files, devices and pipes are read to a limit and no further."""

import os
import threading

import pytest

from thesis_pin.errors import BadInput
from thesis_pin.model import source
from thesis_pin.model.limits import Limits
from thesis_pin.model.source import read_bytes, read_text


def test_a_file_up_to_the_limit_is_read_and_one_byte_more_is_refused(tmp_path):
    file = tmp_path / "a.toml"
    file.write_bytes(b"x" * 4096)
    assert read_bytes("gait", file, 4096) == b"x" * 4096
    with pytest.raises(BadInput, match=r"a\.toml: the gait is larger than"):
        read_bytes("gait", file, 4095)


@pytest.mark.skipif(not os.path.exists("/dev/zero"), reason="no such device here")
def test_a_device_without_end_is_refused_at_the_limit():
    with pytest.raises(BadInput, match=r"/dev/zero: the gait is larger than 1 MiB"):
        read_text("gait", "/dev/zero", 2**20)


def test_a_pipe_is_read_as_a_file_is(tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    content = b"a = 1\n" * 50_000
    writer = threading.Thread(target=pipe.write_bytes, args=(content,))
    writer.start()
    assert read_bytes("gait", pipe, 2**20) == content
    writer.join()


def test_a_pipe_without_end_is_refused_at_the_limit(tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)

    def write():
        try:
            with pipe.open("wb", buffering=0) as stream:
                while True:
                    stream.write(b"x" * 4096)
        except BrokenPipeError:
            pass

    writer = threading.Thread(target=write)
    writer.start()
    with pytest.raises(BadInput, match="larger than"):
        read_bytes("gait", pipe, 100_000)
    writer.join()


def test_a_pipe_into_which_nobody_writes_is_told_so(tmp_path, monkeypatch):
    monkeypatch.setattr(source, "LIMITS", Limits(patience=0.1))
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(BadInput, match="nobody writes into this pipe"):
        read_bytes("gait", tmp_path / "pipe", 100)


@pytest.mark.parametrize("name", ["nowhere.toml", ".", "a\0b", ""])
def test_what_cannot_be_opened_is_told_with_the_reason(name):
    with pytest.raises(BadInput, match="gait"):
        read_bytes("gait", name, 100)


def test_text_has_one_kind_of_line_end_and_no_byte_order_mark(tmp_path):
    file = tmp_path / "a.toml"
    file.write_bytes("\ufeffa\r\nb\rθ\n".encode())
    assert read_text("gait", file) == "a\nb\nθ\n"
