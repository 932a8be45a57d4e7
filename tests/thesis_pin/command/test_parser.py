"""What both commands share."""

import os

import pytest

from thesis_pin.command.parser import Parser, count, number, run
from thesis_pin.errors import BadInput, ThesisPinError
from thesis_pin.files import MANIFEST, write_file, write_folder


def failing(error):
    parser = Parser(prog="robot-pin")

    def verb(_):
        raise error

    parser.set_defaults(run=verb)
    return parser


def test_our_errors_become_one_line_and_exit_code_2(capsys):
    assert run(failing(BadInput("it is bent", where="arm", allowed="straight")), []) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err == "robot-pin: error: arm: it is bent; allowed: straight\n"


def test_bugs_are_not_hidden():
    with pytest.raises(ZeroDivisionError):
        run(failing(ZeroDivisionError()), [])


def test_an_interruption_ends_quietly(capsys):
    assert run(failing(KeyboardInterrupt()), []) == 130
    assert "Traceback" not in capsys.readouterr().err


@pytest.mark.parametrize(
    ("read", "text"),
    [
        (number("--x", positive=True), "0"),
        (number("--x", positive=True), "-1"),
        (number("--x"), "nan"),
        (number("--x"), "inf"),
        (number("--x"), "one"),
        (count("--n", 2), "1"),
        (count("--n", 2), "2.5"),
    ],
)
def test_numbers_are_checked_where_they_are_read(read, text):
    import argparse

    with pytest.raises(argparse.ArgumentTypeError, match="allowed"):
        read(text)
    assert number("--x")("-2.5") == -2.5
    assert count("--n", 2)("2") == 2


def test_files_are_written_whole_and_leave_nothing_behind(tmp_path):
    write_folder(tmp_path / "deep" / "er", {"a.txt": b"one", "sub/b.txt": b"two"})
    assert (tmp_path / "deep/er/a.txt").read_bytes() == b"one"
    assert (tmp_path / "deep/er/sub/b.txt").read_bytes() == b"two"
    assert sorted(os.listdir(tmp_path / "deep/er")) == ["a.txt", MANIFEST, "sub"]


def test_unwritable_places_are_refused_and_what_stood_there_stays(tmp_path):
    (tmp_path / "file").write_text("kept")
    with pytest.raises(BadInput, match="folder"):
        write_folder(tmp_path / "file", {"a.txt": b"x"})
    with pytest.raises(BadInput, match="can't write"):
        write_file(tmp_path / "missing" / "a.txt", b"x")
    (tmp_path / "taken").mkdir()
    with pytest.raises(ThesisPinError, match="can't write"):
        write_file(tmp_path / "taken", b"x")
    assert (tmp_path / "file").read_text() == "kept"
    assert sorted(os.listdir(tmp_path)) == ["file", "taken"]
