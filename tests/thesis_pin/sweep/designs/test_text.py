"""Nested data as TOML: read by Python's own reader it is the same to the bit."""

import tomllib

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from studied import BASE

from thesis_pin.errors import BadInput
from thesis_pin.sweep.designs.text import toml

TEXT = st.text(st.characters(exclude_categories=["Cs"]))
VALUES = st.floats(allow_nan=False, allow_infinity=False) | st.integers(-(2**60), 2**60)
VALUES = VALUES | st.booleans() | TEXT
DATA = st.recursive(
    VALUES,
    lambda inner: st.dictionaries(TEXT, inner, max_size=4) | st.lists(inner, max_size=4),
    max_leaves=20,
)


@settings(deadline=None)
@given(data=st.dictionaries(TEXT, DATA, max_size=5), notes=st.lists(TEXT, max_size=2))
def test_every_nested_data_read_back_alike(data, notes):
    found = tomllib.loads(toml(data, notes))
    assert found == data
    assert repr(found) == repr(data) or _sorted(found) == _sorted(data)


def _sorted(data):
    """The order in which tables stand is TOML's."""
    if isinstance(data, dict):
        return sorted((key, _sorted(value)) for key, value in data.items())
    return [_sorted(one) for one in data] if isinstance(data, list) else repr(data)


def test_what_is_none_is_left_out():
    found = tomllib.loads(toml(BASE))
    assert found == {key: value for key, value in BASE.items() if value is not None}


def test_what_has_no_form_is_refused():
    with pytest.raises(BadInput, match="has no form in TOML"):
        toml({"x": object()})
