"""Samples of equal keys, of more than fit into one block."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from thesis_pin.numeric.alike import alike
from thesis_pin.numeric.elementwise import BLOCK


def by_hand(keys):
    """Kind → all its samples, in the order of the kinds."""
    found = {}
    for k, key in enumerate(keys.tolist()):
        found.setdefault(tuple(key), []).append(k)
    return [found[key] for key in sorted(found)]


@given(st.lists(st.tuples(st.integers(-1, 1), st.integers(0, 1)), min_size=1, max_size=40))
def test_every_sample_is_among_those_of_its_key_and_the_first_comes_first(pairs):
    keys = np.array(pairs, dtype=float)
    found = alike(len(keys), lambda part: keys[part])
    assert [rows.tolist() for _, rows in found] == by_hand(keys)
    assert [first for first, _ in found] == [rows[0] for _, rows in found]


@pytest.mark.parametrize("stretch", [1, 700])
def test_kinds_go_on_across_blocks(stretch):
    rng = np.random.default_rng(2)
    keys = np.repeat(rng.integers(0, 3, size=(3 * BLOCK // stretch, 2)), stretch, axis=0) - 1.0
    found = alike(len(keys), lambda part: keys[part])
    assert [rows.tolist() for _, rows in found] == by_hand(keys)
