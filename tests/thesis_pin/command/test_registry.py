"""How the three commands read a command line."""

import pytest

from thesis_pin.command.registry import Parser


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


@pytest.mark.parametrize("place", range(4))
@pytest.mark.parametrize("words", [["FILE", "CLOSURES", "-1e-3"], ["FILE", "MOTION"]])
def test_options_may_stand_between_the_words(words, place):
    parser = Parser(prog="robot-pin")
    verb = parser.add_subparsers().add_parser("torque")
    verb.add_argument("file")
    verb.add_argument("closures", nargs="?")
    verb.add_argument("motion")
    verb.add_argument("--json")
    line = ["torque", *words[:place], "--json", "out", *words[place:]]
    for _ in range(2):  # the parser is as it was
        found = parser.parse_args(line)
        closures = words[1] if len(words) == 3 else None
        assert (found.file, found.closures, found.motion) == (words[0], closures, words[-1])
        assert found.json == "out"


def test_a_word_too_many_is_named_wherever_it_stands(capsys):
    parser = Parser(prog="robot-pin")
    verb = parser.add_subparsers().add_parser("check")
    verb.add_argument("file")
    verb.add_argument("--json")
    with pytest.raises(SystemExit) as end:
        parser.parse_args(["check", "FILE", "--json", "out", "MORE"])
    assert end.value.code == 2
    assert "unrecognized arguments: MORE" in capsys.readouterr().err


def test_a_verb_parses_alike_without_the_others(capsys):
    from scout_pin.cli import COMMAND

    words = ["--debug", "gait", "--samples", "11", "--cycle"]
    alone, among = (vars(COMMAND.parser(only).parse_args(words)) for only in ("gait", None))
    assert alone == among
    for wrong in (["gait", "--sample", "3"], ["gait", "extra"], ["gait", "--help"]):
        said = []
        for only in ("gait", None):
            with pytest.raises(SystemExit):
                COMMAND.parser(only).parse_args(wrong)
            said.append(capsys.readouterr())
        assert said[0] == said[1]
    with pytest.raises(SystemExit):
        COMMAND.main(["--help", "gait"])
    assert "convert" in capsys.readouterr().out
