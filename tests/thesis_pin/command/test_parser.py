"""How the three commands read a command line."""

import os

import numpy as np
import pytest

from thesis_pin.command.parser import Parser
from thesis_pin.errors import BadInput, NotFinite, ThesisPinError
from thesis_pin.files import MANIFEST, write_file, write_folder
from thesis_pin.report.summary import csv_bytes, figure_files, json_bytes, new_figure, summarise


def reading(*words, **options):
    parser = Parser(prog="robot-pin")
    parser.add_argument("--point", nargs=2)
    parser.add_argument("pose", nargs="*")
    return parser.parse_args([*words])


@pytest.mark.parametrize(
    "word",
    [
        "-1",
        "-0.5",
        "-.5",
        "-1.",
        "-1e-3",
        "-1E+3",
        "-.5e2",
        "-1.25e-17",
        "-inf",
        "-nan",
        "-Infinity",
    ],
)
def test_negative_numbers_are_values_also_with_exponents(word):
    assert float(word) == float(word) or "nan" in word
    assert reading(word, "2").pose == [word, "2"]
    assert reading("--point", word, word).point == [word, word]


@pytest.mark.parametrize("word", ["-e3", "-1e", "-1-2", "-x", "-1x", "--1"])
def test_other_words_with_a_minus_stay_flags(word, capsys):
    with pytest.raises(SystemExit) as end:
        reading(word)
    assert end.value.code == 2
    assert word in capsys.readouterr().err


def test_a_flag_whose_value_is_two_dashes_is_refused(capsys):
    with pytest.raises(SystemExit):
        reading("--point=--")
    assert "'--' is no value" in capsys.readouterr().err


def test_flags_are_not_guessed_from_their_beginnings(capsys):
    with pytest.raises(SystemExit):
        reading("--poi", "1", "2")


def test_what_the_parser_quotes_cannot_command_a_terminal(capsys):
    with pytest.raises(SystemExit):
        reading("--\x1b[31mred\0" + "9" * 100_000)
    err = capsys.readouterr().err
    assert "\\x1b[31mred\\x00" in err
    assert err.isascii()
    assert set(err) & set(map(chr, range(32))) == {"\n"}
    assert len(err) < 2500


def test_debug_may_stand_before_and_behind_a_verb():
    top = Parser(prog="robot-pin")
    top.add_subparsers().add_parser("walk")
    assert top.parse_args(["--debug", "walk"]).debug
    assert top.parse_args(["walk", "--debug"]).debug
    assert not hasattr(top.parse_args(["walk"]), "debug")


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


def test_json_refuses_what_it_cannot_say_and_names_the_place():
    for bad in (np.nan, np.inf):
        with pytest.raises(NotFinite, match=r"a\.b"):
            json_bytes({"a": {"b": np.array([1.0, bad])}})
        with pytest.raises(NotFinite, match="x"):
            json_bytes({"x": [1.0, bad]})
    import json

    data = {"x": np.eye(2)[:, ::-1], "y": None, "z": np.float64(0.1), "big": np.zeros(20_000)}
    read = json.loads(json_bytes(data))
    assert read["x"] == [[0.0, 1.0], [1.0, 0.0]]
    assert read["z"] == 0.1


def test_csv_reads_back_exactly():
    values = np.array([0.1, 1 / 3, -2e-17, np.nan])
    lines = csv_bytes({"x": values, "name": ["a", "b", "c", "d"]}).decode().splitlines()
    assert lines[0] == "x,name"
    assert [float(line.split(",")[0]) for line in lines[1:4]] == values[:3].tolist()
    assert lines[4] == ",d"


def test_summary_of_a_known_motion():
    time = np.linspace(0, 2 * np.pi, 20_001)
    torque, speed = 3 * np.cos(time)[:, None], 2 * np.cos(time)[:, None]
    s = summarise(["a"], time, torque, speed)
    assert s.peak_torque[0] == pytest.approx(3)
    assert s.rms_torque[0] == pytest.approx(3 / np.sqrt(2), rel=1e-6)
    assert s.peak_power[0] == pytest.approx(6)
    assert s.net_work[0] == pytest.approx(6 * np.pi, rel=1e-6)
    assert s.negative_work[0] == pytest.approx(0, abs=1e-9)


def test_a_figure_gives_the_same_bytes_twice():
    def draw():
        figure, axes = new_figure(3, 2)
        axes[0, 0].plot([0, 1], [0, 1], label="line")
        return figure_files("line", figure)

    first, second = draw(), draw()
    assert set(first) == {"line.png", "line.svg"}
    assert first == second
    assert first["line.png"].startswith(b"\x89PNG")


def test_csv_of_numbers_and_words_reads_back_exactly_also_what_json_cannot_say():
    numbers = np.random.default_rng(3).normal(size=50) * 10.0 ** np.arange(-25, 25)
    infinite = np.where(np.arange(50) == 7, np.inf, numbers[::-1])
    columns = {"a": numbers, "b": -numbers, "word": ["x"] * 50, "c": infinite, "n": np.arange(50)}
    header, *lines = csv_bytes(columns).decode().splitlines()
    assert header == "a,b,word,c,n"
    rows = [line.split(",") for line in lines]
    for k, expected in enumerate(columns.values()):
        column = [row[k] for row in rows]
        assert column == expected if k == 2 else np.array_equal(np.array(column, float), expected)
    assert csv_bytes({"a": np.zeros(0)}) == b"a\n"


def test_a_figure_is_drawn_as_large_as_it_was_laid_out_and_once_a_format(monkeypatch):
    from matplotlib.figure import Figure

    drawn = []
    draw = Figure.draw
    monkeypatch.setattr(Figure, "draw", lambda *a, **k: (drawn.append(1), draw(*a, **k))[1])
    figure, axes = new_figure(4, 3)
    axes[0, 0].plot([0, 1], [0, 1])
    files = figure_files("figure", figure)
    assert len(drawn) == 2
    width, height = (int.from_bytes(files["figure.png"][k : k + 4], "big") for k in (16, 20))
    assert (width, height) == (600, 450)
    assert b'width="288pt" height="216pt"' in files["figure.svg"]
