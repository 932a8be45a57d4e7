"""Whatever the encoding, something readable comes out."""

import io
import sys

import pytest
from hypothesis import given
from hypothesis import strategies as st

from thesis_pin.command.readable import prepare_streams, readable

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
