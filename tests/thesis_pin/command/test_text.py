"""Whatever a message quotes, and whatever the encoding, something readable comes out."""

import io
import sys

import pytest
from hypothesis import given
from hypothesis import strategies as st

from thesis_pin.command.text import LONGEST, MOST_LINES, clean, prepare_streams, readable, say


@given(st.text(st.characters(codec=None)))
def test_nothing_that_cannot_be_printed_comes_out(text):
    assert all(letter.isprintable() for letter in clean(text).replace("\n", ""))


@given(st.text(st.characters(codec="ascii", exclude_categories=["C"]), max_size=LONGEST))
def test_plain_lines_come_out_as_they_are(text):
    assert clean(f"{text}\nθ21 needs 5 N·m") == f"{text}\nθ21 needs 5 N·m"


def test_escapes_bells_and_directions_of_writing_are_spelt_out():
    assert clean("a\x1b[2Jb\x07\0\x9b\u202ec\udcff") == ("a\\x1b[2Jb\\x07\\x00\\x9b\\u202ec\\udcff")


def test_long_lines_and_many_lines_are_cut_and_counted():
    assert clean("x" * 5000).endswith("x... (5000 characters)")
    assert len(clean("\0" * 5000)) < 2 * LONGEST
    lines = clean("y\n" * 10_000).splitlines()
    assert len(lines) == MOST_LINES + 1
    assert lines[-1] == f"... {10_001 - MOST_LINES} more lines"
    assert len(clean("z" * 33_000_000)) < 2 * LONGEST


def test_what_is_said_goes_to_standard_error(capsys):
    say("done\x1b")
    assert capsys.readouterr() == ("", "done\\x1b\n")


ENCODINGS = ("ascii", "latin-1", "cp1252", "cp437", "utf-8")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("τ [N·m], θ̇21, ẋ, ÿ, Ṅ", "tau [N*m], theta_dot21, x_dot, y_ddot, N_dot"),
        ("−4.5° ± 2 ≤ π/2 → Φ × λ", "-4.5deg +- 2 <= pi/2 -> Phi x lambda"),
        ("m·s⁻²⁰, kg·m², x³", "m*s^-20, kg*m^2, x^3"),
        ("Müller’s robot – no. ½ …", "Muller's robot - no. 1/2 ..."),
        ("ℂ 𝔻 ᵀ ∂V/∂q √2", "C D ^T dV/dq sqrt2"),
        ("│ ─", "- -"),
    ],
)
def test_ascii_reads_as_one_would_say_it(text, said):
    assert readable(text, "ascii") == said


def test_what_an_encoding_has_is_left_alone():
    assert readable("12° N·m² ÿ θ −1", "latin-1") == "12° N·m² ÿ theta -1"
    assert readable("s⁻² and m²", "latin-1") == "s^-2 and m²"
    assert readable("δ ≤ 1 θ", "cp437") == "δ ≤ 1 theta"
    assert readable("θ̇ ⁻²⁰ 𝔻", "utf-8") == "θ̇ ⁻²⁰ 𝔻"


def test_bytes_of_a_name_that_are_no_text_are_shown():
    assert readable("gait_\udcff.toml θ", "utf-8") == "gait_\\xff.toml θ"


@pytest.mark.parametrize("encoding", ENCODINGS)
@given(text=st.text(alphabet=st.characters()))
def test_every_text_can_be_printed_in_every_encoding(encoding, text):
    said = readable(text, encoding)
    said.encode(encoding)
    assert readable(said, encoding) == said


@pytest.mark.parametrize("encoding", ENCODINGS)
def test_prepared_streams_take_what_anybody_prints(encoding, monkeypatch):
    for name in ("stdout", "stderr"):
        monkeypatch.setattr(sys, name, io.TextIOWrapper(io.BytesIO(), encoding=encoding))
    prepare_streams()
    for stream in (sys.stdout, sys.stderr):
        print("θ \udcff", file=stream, flush=True)
        said = stream.buffer.getvalue().decode(encoding)
        assert said == ("θ" if encoding == "utf-8" else "theta") + " \\xff\n"
