"""Specifications as text: reading gives the same, to the last bit."""

from pathlib import Path

import pytest

from scout_pin.making.text import toml
from scout_pin.specification import NEW_PATH, Specification
from thesis_pin.model.specification import parse_toml

EXAMPLES = Path(__file__).parents[3] / "examples"


@pytest.mark.parametrize("path", [None, NEW_PATH, EXAMPLES / "lopsided.toml"])
def test_the_text_of_a_specification_reads_as_the_same(path):
    spec = Specification.read(path)
    assert (
        parse_toml("specification", Specification, toml(spec, ["one note", "two\nlines"])) == spec
    )


def test_words_that_toml_would_misread_survive():
    changed = {"source": 'a "word"\\n\ttab', "knee": "backward", "neutral_soles": "tilted"}
    spec = Specification.read().model_copy(update=changed)
    again = parse_toml("specification", Specification, toml(spec, ['"quoted" \\ # note']))
    assert again == spec
