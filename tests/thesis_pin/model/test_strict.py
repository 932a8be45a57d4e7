"""Objects read from files: what pydantic's own do, without pydantic until it is needed."""

import copy
import pickle
import subprocess
import sys
from typing import Annotated

import pytest
from pydantic import BaseModel, ConfigDict, ValidationError

from thesis_pin.model.strict import After, Held, Positive, Strict


def is_even(value):
    if value % 2:
        raise ValueError("must be even")
    return value


class Inner(Strict):
    """A part."""

    size: Positive
    even: Annotated[int, After(is_even)] = 2


class Outer(Strict):
    """A whole."""

    name: Annotated[str, Held(pattern="^[a-z]+$")]
    inner: Inner
    many: tuple[Inner, ...] = ()
    either: float | tuple[Inner, ...] | None = None


class More(Outer):
    """With one key more."""

    extra: bool = False


class TheirInner(BaseModel):
    """The same in pydantic's own words."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)
    size: float
    even: int = 2


class TheirOuter(BaseModel):
    """The same in pydantic's own words."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)
    name: str
    inner: TheirInner
    many: tuple[TheirInner, ...] = ()
    either: float | tuple[TheirInner, ...] | None = None


DATA = {"name": "a", "inner": {"size": 1}, "many": ({"size": 2.5, "even": 4},)}


def test_values_are_those_of_a_pydantic_model():
    ours, theirs = Outer.model_validate(DATA, strict=True), TheirOuter.model_validate(DATA)
    assert ours.model_dump() == theirs.model_dump()
    assert ours.model_dump(mode="json") == theirs.model_dump(mode="json")
    assert repr(ours) == repr(theirs).replace("Their", "")
    assert type(ours.inner.size) is float
    assert [name for name, _ in ours] == [name for name, _ in theirs]
    assert list(More.model_fields) == ["name", "inner", "many", "either", "extra"]


@pytest.mark.parametrize(
    ("change", "place"),
    [
        ({"name": "A"}, ("name",)),
        ({"name": 1}, ("name",)),
        ({"unknown": 1}, ("unknown",)),
        ({"inner": {"size": 0}}, ("inner", "size")),
        ({"inner": {"size": 1e-12}}, ("inner", "size")),
        ({"inner": {"size": float("nan")}}, ("inner", "size")),
        ({"inner": {"size": "1"}}, ("inner", "size")),
        ({"inner": {"size": 1, "even": 3}}, ("inner", "even")),
        ({"inner": {}}, ("inner", "size")),
        ({"inner": 3}, ("inner",)),
        ({"many": ({"size": 1}, {"size": -1})}, ("many", 1, "size")),
    ],
)
def test_what_is_wrong_is_said_with_its_place(change, place):
    with pytest.raises(ValidationError) as caught:
        Outer.model_validate(DATA | change, strict=True)
    assert [error["loc"] for error in caught.value.errors()] == [place]


def test_objects_made_by_hand_are_checked_too():
    inner = Inner(size=2)
    assert Outer(name="a", inner=inner).inner is inner
    for wrong in ({"name": "a"}, {"name": "a", "inner": inner, "more": 1}, {}):
        with pytest.raises(ValidationError):
            Outer(**wrong)


def test_objects_are_immutable_equal_by_value_and_can_be_copied():
    one, other = Outer.model_validate(DATA), Outer.model_validate(DATA)
    assert one == other
    assert hash(one) == hash(other)
    assert one != More.model_validate(DATA)
    assert one != one.model_copy(update={"name": "b"})
    for again in (copy.copy(one), copy.deepcopy(one), pickle.loads(pickle.dumps(one))):
        assert again == one
    with pytest.raises(AttributeError, match="immutable"):
        one.name = "b"
    with pytest.raises(AttributeError, match="immutable"):
        del one.name
    assert Outer.model_validate(one) is one


def test_pydantic_is_imported_when_something_is_checked():
    code = (
        "import sys\n"
        "from thesis_pin.model.strict import Strict\n"
        "class One(Strict):\n    size: float = 1.0\n"
        "one, other = One(), One.made(size=2.0)\n"
        "assert one != other and one.model_copy(update={'size': 2.0}) == other\n"
        "print('pydantic' in sys.modules, end=' ')\n"
        "One(size=2)\n"
        "print('pydantic' in sys.modules)\n"
    )
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert ran.stdout == "False True\n"
