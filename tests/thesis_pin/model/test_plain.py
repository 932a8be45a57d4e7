"""What plainly fits a schema, against pydantic."""

import copy
import random
import tomllib
from pathlib import Path
from typing import Annotated, Literal

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import Field, ValidationError

import pollard_pin
import scout_pin
from pollard_pin.specification import POLLARD_PATH, SKEWED_PATH
from scout_pin.motion.files import GAITS, GaitFile
from scout_pin.specification import NEW_PATH, SCOUT_PATH
from thesis_pin.model.limits import bounded
from thesis_pin.model.plain import Doubt, plainly
from thesis_pin.model.strict import Held, Positive, Strict

EXAMPLES = Path(__file__).parents[3] / "examples"
FILES = {
    SCOUT_PATH: scout_pin.Specification,
    NEW_PATH: scout_pin.Specification,
    EXAMPLES / "lopsided.toml": scout_pin.Specification,
    POLLARD_PATH: pollard_pin.Specification,
    SKEWED_PATH: pollard_pin.Specification,
    **{path: GaitFile for path in (*GAITS.glob("*.toml"), *EXAMPLES.glob("*walk.toml"))},
}
ODD = [
    *(None, True, False, 0, 1, -1, 2**60, 10**400, 0.0, -0.0, 1e-12, -2.5, float("nan")),
    *(float("inf"), "", "0.33", "left", "scout\n", "ä", "+-+", (), (1,), (1.0, 2.0), (0, 0, 0)),
    *({}, {"x": 1}, b"bytes", 1j, [1, 2], {1: 2}),
]


def read(path):
    return bounded(tomllib.loads(path.read_text(encoding="utf-8")))[0]


def places(value, key=()):
    """Every place in nested data."""
    yield key
    items = value.items() if isinstance(value, dict) else ()
    items = enumerate(value) if isinstance(value, tuple) else items
    for name, one in items:
        yield from places(one, (*key, name))


def changed(value, key, change):
    """The data with the value at a place changed by a function."""
    if not key:
        return change(value)
    if isinstance(value, tuple):
        parts = list(value)
        parts[key[0]] = changed(parts[key[0]], key[1:], change)
        return tuple(parts)
    found = dict(value)
    found[key[0]] = changed(found[key[0]], key[1:], change)
    return found


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_files_that_are_right_fit_plainly_and_are_what_pydantic_reads(path):
    data, schema = read(path), FILES[path]
    assert repr(plainly(schema, data)) == repr(schema.model_validate(data, strict=True))


@given(seed=st.integers(0, 2**32 - 1), path=st.sampled_from(list(FILES)))
@settings(max_examples=400, deadline=None)
def test_nothing_fits_plainly_that_pydantic_refuses_or_reads_otherwise(seed, path):
    chance, data, schema = random.Random(seed), read(path), FILES[path]
    for _ in range(chance.randint(1, 2)):
        key = chance.choice(list(places(data)))
        kind = chance.choice(["odd", "add", "drop"])

        def change(value, kind=kind):
            if kind == "odd" or not isinstance(value, dict | tuple):
                return copy.copy(chance.choice(ODD))
            if isinstance(value, tuple):
                return (*value, chance.choice(ODD)) if kind == "add" else value[1:]
            if kind == "add":
                return value | {chance.choice(["unknown", "mass", "knee"]): chance.choice(ODD)}
            gone = chance.choice(list(value) or [None])
            return {name: one for name, one in value.items() if name != gone}

        data = changed(data, key, change)
    try:
        found = plainly(schema, data)
    except Doubt:
        return
    assert repr(found) == repr(schema.model_validate(data, strict=True))


class Loose(Strict):
    """Fields that only pydantic reads."""

    either: int | float = 1
    bounded: Annotated[int, Field(gt=3)] = 4
    several: Annotated[int, Held(multiple_of=2)] = 2


class Exact(Strict):
    """Fields with what is easily mistaken."""

    whole: int = 0
    yes: bool = False
    one: Literal[1] = 1
    size: Positive = 1.0
    named: Annotated[str, Held(pattern="^[a-z]+$")] = "a"
    table: dict[str, float] = {}  # noqa: RUF012


@pytest.mark.parametrize("data", [{"either": 1}, {"bounded": 5}, {"several": 4}])
def test_what_only_pydantic_knows_is_left_to_it(data):
    with pytest.raises(Doubt):
        plainly(Loose, data)
    Loose.model_validate(data)


@pytest.mark.parametrize("name", Exact.field_names())
@pytest.mark.parametrize("value", ODD, ids=repr)
def test_odd_values_fit_plainly_only_as_pydantic_reads_them(name, value):
    try:
        found = plainly(Exact, {name: value})
    except Doubt:
        return
    try:
        expected = Exact.model_validate({name: value}, strict=True)
    except ValidationError:
        pytest.fail(f"{value!r} is no {name}")
    assert repr(found) == repr(expected)
