"""Keys of nested data: patterns, values, errors that name what was meant."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from studied import BASE

from thesis_pin.errors import BadInput, UnknownName
from thesis_pin.sweep.designs.keys import changed, dotted, leaves, matching, split, value_at


@pytest.mark.parametrize(
    ("pattern", "keys"),
    [
        ("x", [("x",)]),
        ("legs.left.length", [("legs", "left", "length")]),
        ("legs.*.length", [("legs", "left", "length"), ("legs", "right", "length")]),
        ("legs.r*.l?ngth", [("legs", "right", "length")]),
        ("beta.1", [("beta", 1)]),
        ("beta.*", [("beta", 0), ("beta", 1), ("beta", 2)]),
        ("bodies.*.mass", [("bodies", 0, "mass"), ("bodies", 1, "mass")]),
        ('servos."a.b".torque', [("servos", "a.b", "torque")]),
        ("servos.HS-5475HB.torque", [("servos", "HS-5475HB", "torque")]),
        ("nothing", [("nothing",)]),
    ],
)
def test_a_pattern_stands_for_every_key_that_fits_it_part_by_part(pattern, keys):
    assert matching(BASE, pattern) == keys


@pytest.mark.parametrize(
    ("pattern", "meant"),
    [
        ("servo.torque", 'servos."a.b".torque'),
        ("legs.left.lenght", "legs.left.length"),
        ("mass", "bodies.*.mass"),
    ],
)
def test_an_unknown_key_is_told_with_the_one_that_was_meant_first(pattern, meant):
    with pytest.raises(UnknownName) as error:
        matching(BASE, pattern)
    assert error.value.known[0] == meant
    assert f"unknown key {pattern!r}" in str(error.value)


def test_a_table_or_list_is_refused_with_the_keys_in_it():
    with pytest.raises(BadInput, match=r"legs.left is no single value; allowed: legs.left.length"):
        matching(BASE, "legs.left")
    with pytest.raises(BadInput, match=r"allowed: beta.0, beta.1"):
        matching(BASE, "beta")


@pytest.mark.parametrize("pattern", ["", ".", "a.", ".a", "a..b", "'a", 'a".b', "a b"])
def test_what_is_no_key_is_refused(pattern):
    with pytest.raises(BadInput, match="is no key"):
        split(pattern)


def test_a_change_shares_what_it_leaves_and_leaves_what_was():
    found = changed(BASE, {("legs", "left", "length"): 0.5, ("beta", 1): 7.0})
    assert found["legs"]["left"]["length"] == 0.5
    assert found["beta"] == [1.0, 7.0, 3.0]
    assert found["legs"]["right"] is BASE["legs"]["right"]
    assert BASE["legs"]["left"]["length"] == 0.3
    assert BASE["beta"] == [1.0, 2.0, 3.0]


NAMES = st.text(st.characters(exclude_characters="\"'", exclude_categories=["Cs"]), min_size=1)
DATA = st.recursive(
    st.floats(allow_nan=False) | st.booleans(),
    lambda inner: (
        st.dictionaries(NAMES, inner, min_size=1, max_size=3)
        | st.lists(inner, min_size=1, max_size=3)
    ),
    max_leaves=8,
)


@settings(deadline=None)
@given(data=st.dictionaries(NAMES.filter(lambda name: "*" not in name), DATA, min_size=1))
def test_every_key_as_it_is_written_leads_back_to_itself(data):
    for key in leaves(data):
        if not any(isinstance(part, str) and set(part) & set("*?[]") for part in key):
            assert split(dotted(key)) == tuple(map(str, key))
            assert key in matching(data, dotted(key))
            assert value_at(data, key) == value_at(changed(data, {}), key)
