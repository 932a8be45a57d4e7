"""Warnings of the library in a command's words."""

import warnings

import pytest

from thesis_pin.command.warned import warned
from thesis_pin.errors import BadInput, ModelWarning


def fail(text, category):
    warnings.warn(text, category, stacklevel=1)
    raise BadInput("out of reach")


def test_a_warning_is_one_line_on_standard_error(capsys):
    with warned():
        warnings.warn("a leg of 100 m", ModelWarning, stacklevel=1)
    assert capsys.readouterr().err.endswith("warning: a leg of 100 m\n")


def test_what_was_warned_of_is_said_before_the_error_that_it_explains(capsys):
    with pytest.raises(BadInput, match="out of reach"), warned():
        fail("470 m: are these millimetres?", ModelWarning)
    assert "warning: 470 m: are these millimetres?" in capsys.readouterr().err


def test_warnings_of_others_are_passed_on_also_before_an_error():
    with pytest.warns(DeprecationWarning, match="old"), pytest.raises(BadInput), warned():
        fail("old", DeprecationWarning)


def test_strictly_they_are_errors():
    with pytest.raises(BadInput, match="a leg of 100 m"), warned(strict=True):
        warnings.warn("a leg of 100 m", ModelWarning, stacklevel=1)
