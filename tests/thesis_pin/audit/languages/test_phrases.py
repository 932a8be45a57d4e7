"""Sentences in another language: whole, with fields, and several in one."""

import pytest

from thesis_pin.audit.languages.phrases import Phrases
from thesis_pin.errors import SpecificationError

TABLE = {
    "a dot": "un punto",
    "a cat": "un gato",
    "one; two": "uno; dos",
    "is {*one} where {*other} belongs": "es {*one} donde corresponde {*other}",
    "by {d} mm": "por {d} mm",
}
TEMPLATES = {"{n} lines": "{n} renglones"}


@pytest.mark.parametrize(
    ("english", "spanish"),
    [
        ("a dot", "un punto"),
        ("by 0.25 mm", "por 0.25 mm"),
        ("is a dot where a cat belongs", "es un punto donde corresponde un gato"),
        ("a dot; by 3 mm", "un punto; por 3 mm"),
        ("one; two; a cat", "uno; dos; un gato"),
        ("a cat, a dot", "un gato, un punto"),
        ("(3.4) → 12", "(3.4) → 12"),
    ],
)
def test_what_the_table_has_is_said(english, spanish):
    say = Phrases(TABLE)
    assert say(english) == spanish
    assert say.missing == set()


@pytest.mark.parametrize("english", ["a dog", "is a dog where a cat belongs", "a dot; a dog"])
def test_what_the_table_lacks_stays_and_is_noted_whole(english):
    say = Phrases(TABLE)
    assert say(english) == english
    assert say.missing == {english}


def test_a_template_is_filled_afterwards_and_matches_no_other_sentence():
    say = Phrases(TABLE, TEMPLATES)
    assert say("{n} lines", n=3) == "3 renglones"
    assert Phrases()("{n} lines", n=3) == "3 lines"
    assert say("3 lines") == "3 lines"
    assert say("{n} dogs", n=3) == "3 dogs"
    assert say.missing == {"3 lines", "{n} dogs"}


def test_braces_of_a_formula_are_no_fields():
    assert Phrases()(r"\dot{x}") == r"\dot{x}"
    assert Phrases(TABLE)(r"by \dot{x} mm") == r"por \dot{x} mm"


def test_the_checked_in_table_can_be_read():
    assert Phrases.spanish()("misprint") == "errata"


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ('[[phrase]]\nen = "by {d} mm"\nes = "por {e} mm"\n', "other fields"),
        ('[[phrase]]\nen = "a"\nes = "b"\n[[phrase]]\nen = "a"\nes = "c"\n', "used twice"),
        ('[[phrase]]\nen = "a"\n', "es"),
    ],
)
def test_a_table_with_a_mistake_is_refused(text, word, tmp_path):
    file = tmp_path / "words.toml"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(SpecificationError, match=word):
        Phrases.spanish(file)


def test_findings_of_two_members_are_said_each():
    one = "is a 3×3 matrix where a vector of 3 belongs"
    said = "es una matriz 3×3 donde corresponde un vector de 3"
    assert Phrases.spanish()(f"member 1 {one}; member 2 {one}") == (
        f"miembro 1: {said}; miembro 2: {said}"
    )
