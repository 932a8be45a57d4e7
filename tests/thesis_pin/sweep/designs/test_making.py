"""Designs: every combination, pairs, draws, tables."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from studied import BASE

from thesis_pin.errors import BadInput, UnknownName
from thesis_pin.sweep.designs.making import combined, drawn, joined, listed, paired, vary


def made(*texts, how=combined, **more):
    return how([vary(BASE, text) for text in texts], **more)


def test_every_combination_is_there_once_the_last_key_changing_fastest():
    designs = made("x=1,2,3", "legs.*.length=0.1,0.2")
    assert designs.values == ((1, 0.1), (1, 0.2), (2, 0.1), (2, 0.2), (3, 0.1), (3, 0.2))
    assert [one.label for one in designs.parameters] == ["x", "legs.*.length"]


def test_a_design_sets_every_key_that_its_pattern_stands_for():
    found = made("x=1,2", "legs.*.length=0.1,0.2").data(BASE, 3)
    assert found["x"] == 2.0
    assert found["legs"] == {"left": {"length": 0.2}, "right": {"length": 0.2}}
    assert found["beta"] is BASE["beta"]


def test_shares_multiply_each_key_by_itself():
    found = made("legs.*.length=50%,200%").data(BASE, 1)
    assert found["legs"] == {"left": {"length": 0.6}, "right": {"length": 0.8}}


def test_several_keys_with_commas_take_the_same_value():
    found = made("x,legs.left.length=5,6").data(BASE, 1)
    assert (found["x"], found["legs"]["left"]["length"]) == (6.0, 6.0)
    assert found["legs"]["right"]["length"] == 0.4


def test_whole_numbers_stay_whole_where_they_were():
    values = [made("count=1,2,2.5").data(BASE, k)["count"] for k in range(3)]
    assert [(value, type(value)) for value in values] == [(1, int), (2, int), (2.5, float)]


def test_pairs_go_side_by_side_and_need_equally_many():
    assert made("x=1,2", "count=3,4", how=paired).values == ((1, 3), (2, 4))
    with pytest.raises(BadInput, match=r"equally many values \(x: 2, count: 3\)"):
        made("x=1,2", "count=3,4,5", how=paired)


@pytest.mark.parametrize("count", [1, 7, 50])
def test_a_latin_hypercube_has_one_draw_in_each_slice_of_every_range(count):
    designs = made("x=2:4", "legs.left.length=0.1:0.2", how=drawn, count=count)
    x, length = np.array(designs.values).T
    for share in ((x - 2) / 2, (length - 0.1) / 0.1):
        assert sorted(np.floor(share * count).astype(int)) == list(range(count))


@pytest.mark.parametrize("how", ["latin", "random"])
def test_draws_depend_on_their_seed_alone_and_keep_to_their_values(how):
    def draw(seed):
        texts = ("x=2:4", "kind=round,flat")
        return made(*texts, how=lambda varied: drawn(varied, 40, seed, how)).values

    assert draw(1) == draw(1) != draw(2)
    assert all(2 <= x <= 4 for x, _ in draw(1))
    assert {kind for _, kind in draw(1)} == {"round", "flat"}


def test_a_table_is_a_design_a_row():
    columns = {"x": ["1", "2"], "kind": ["round", "0.5"], "legs.*.length": ["90%", "110%"]}
    designs = listed(BASE, columns, "table.csv")
    assert designs.values == ((1.0, "round", 0.9), (2.0, 0.5, 1.1))
    assert designs.data(BASE, 1)["legs"]["left"]["length"] == pytest.approx(0.33)
    with pytest.raises(UnknownName, match="unknown key 'y'"):
        listed(BASE, {"y": ["1"]}, "table.csv")
    with pytest.raises(BadInput, match="x has no value in row 2"):
        listed(BASE, {"x": ["1", " "]}, "table.csv")
    with pytest.raises(BadInput, match="can't be '1:2:3'"):
        listed(BASE, {"x": ["1:2:3"]}, "table.csv")


def test_a_table_beside_ranges_gives_each_of_its_designs_with_each_of_those():
    both = joined(listed(BASE, {"x": ["1", "2"]}, ""), made("count=3,4"))
    assert both.values == ((1.0, 3.0), (1.0, 4.0), (2.0, 3.0), (2.0, 4.0))
    with pytest.raises(BadInput, match="x varies twice"):
        joined(listed(BASE, {"x": ["1"]}, ""), made("x=3,4"))


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("x", "varies nothing"),
        ("=1", "varies nothing"),
        ("x,=1", "varies nothing"),
        ("x=round", "is 1.0 and can't be 'round'"),
        ("x=true", "can't be True"),
        ("kind=50%", "of which there is no share"),
        ("nothing=50%", "of which there is no share"),
    ],
)
def test_what_can_be_no_design_is_refused(text, why):
    with pytest.raises(BadInput, match=why):
        vary(BASE, text)


def test_ranges_without_a_number_of_steps_belong_to_draws():
    for how in (combined, paired):
        with pytest.raises(BadInput, match="says no number of steps"):
            made("x=1:2", how=how)


def test_too_many_designs_are_refused_before_they_are_made():
    with pytest.raises(BadInput, match="1,000,000,000 designs"):
        made("x=0:1:1000", "count=0:1:1000", "legs.left.length=1:2:1000")
    with pytest.raises(BadInput, match="nothing varies"):
        combined([])
    with pytest.raises(BadInput, match=r"legs.left.length varies twice"):
        made("legs.*.length=1,2", "legs.left.length=3,4")


@settings(deadline=None)
@given(counts=st.lists(st.integers(1, 4), min_size=1, max_size=3))
def test_there_are_as_many_designs_as_combinations_and_all_differ(counts):
    keys = ("x", "count", "legs.left.length")
    texts = [f"{key}={','.join(map(str, range(n)))}" for key, n in zip(keys, counts, strict=False)]
    designs = made(*texts)
    assert len(designs) == len(set(designs.values)) == np.prod(counts)
