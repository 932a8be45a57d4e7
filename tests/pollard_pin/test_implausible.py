"""Sizes that nobody builds are named; robots there are stay unmentioned."""

from pathlib import Path

import pytest

import pollard_pin
from pollard_pin.implausible import implausible
from pollard_pin.specification import POLLARD_PATH, Specification
from thesis_pin.errors import ModelWarning

SKEWED = POLLARD_PATH.with_name("skewed.toml")


@pytest.mark.parametrize("path", [None, SKEWED])
def test_robots_there_are_stay_unmentioned(path):
    assert implausible(Specification.read(path)) == []


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (lambda data: data["chain_0"].update(x_32=500.0), "upper_arm: it is 500 m long"),
        (lambda data: data["chain_1"]["links"][0].update(mass=900.0), "chain1_arm: 900 kg"),
    ],
)
def test_a_mistaken_unit_is_named_and_warned_of(change, says):
    data = Specification.read(Path(SKEWED)).model_dump()
    change(data)
    specification = Specification.model_validate(data)
    with pytest.warns(ModelWarning) as warned:
        pollard_pin.load(specification)
    assert [str(one.message) for one in warned] == implausible(specification)
    assert says in implausible(specification)[0]
