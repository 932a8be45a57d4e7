"""Words of closures against the freedoms they leave."""

import itertools

import pytest

from thesis_pin.model.mechanism.closure_types import WORDS, rows_of, word_of


@pytest.mark.parametrize(
    ("word", "rows"),
    [
        ("3d", "111000"),
        ("6D", "111111"),
        ("hinge_x", "111011"),
        ("hinge_z", "111110"),
        ("universal_xy", "111001"),
        ("universal_zy", "111100"),
        ("rod", "000000"),
        ("xyz--z", "111001"),
        ("-y----", "010000"),
    ],
)
def test_words_mean_rows(word, rows):
    assert rows_of(word) == tuple(letter == "1" for letter in rows)


@pytest.mark.parametrize(
    "word", ["", "4d", "hinge", "hinge_w", "hinge_xy", "universal_x", "xyz", "zyx---", "------"]
)
def test_other_words_mean_nothing(word):
    assert rows_of(word) is None


def test_every_mask_has_a_word_that_means_it():
    for rows in itertools.product((False, True), repeat=6):
        assert rows_of(word_of(rows)) == rows
    assert {word_of(rows_of(word)) for word in WORDS} < set(WORDS)
