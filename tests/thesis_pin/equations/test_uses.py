"""What a line of a thesis uses, and what uses it."""

import pytest

from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.equations.notation import Notation
from thesis_pin.equations.uses import used_by, uses


def catalogue(**lines):
    rows = [
        Equation(id=f"arm:1:{name}", left=left, printed=right)
        for name, (left, right) in lines.items()
    ]
    return Catalogue(rows, Notation())


@pytest.fixture
def arm():
    return catalogue(
        a=("a", "x + y"),
        r=(r"\mathbf{r}_i", r"a \mathbf{k}"),
        v=(r"\dot{\mathbf{r}}_1", r"\dot{a} \mathbf{k}"),
        dr=(r"\frac{\partial \mathbf{r}_1}{\partial q_j}", "b"),
        w=("w", r"\mathbf{r}_2 + \dot{\mathbf{r}}_1 + \dot{\mathbf{r}}_2"),
        j=("J", r"\frac{\partial \mathbf{r}_1}{\partial q_j}"),
        t=("T", r"\frac{d \mathbf{r}_1}{dt}"),
        bad=("z", "a + ("),
    )


def names(found):
    return {
        key.removeprefix("arm:1:"): [n.removeprefix("arm:1:") for n in v]
        for key, v in found.items()
    }


def test_a_line_uses_the_definitions_of_its_symbols(arm):
    found = names(uses(arm))
    assert found["a"] == []
    assert found["r"] == ["a"]
    assert found["v"] == ["a"]  # no line defines the rate of a
    assert found["w"] == ["r", "v"]
    assert found["j"] == ["dr"]
    assert found["t"] == ["v"]


def test_a_line_that_cant_be_read_uses_what_its_correction_does(arm):
    assert names(uses(arm))["bad"] == []
    mended = arm.with_equation(arm["arm:1:bad"].model_copy(update={"corrected": {1: "a + 1"}}))
    assert names(uses(mended))["bad"] == ["a"]


def test_some_lines_alone_are_asked_for(arm):
    assert names(uses(arm, ["arm:1:w"])) == {"w": ["r", "v"]}


def test_used_by_is_the_other_way_round(arm):
    assert names(used_by(uses(arm)))["r"] == ["w"]
    assert names(used_by(uses(arm)))["a"] == ["r", "v"]


@pytest.mark.parametrize("robot", ["scout", "pollard"])
def test_no_line_of_a_thesis_uses_itself_and_all_exist(robot):
    import importlib

    listed = importlib.import_module(f"{robot}_pin.thesis.catalogue").catalogue()
    found = uses(listed)
    assert set(found) == set(listed.by_id)
    assert all(name not in used and set(used) <= set(found) for name, used in found.items())
    assert sum(map(bool, found.values())) > len(found) / 2
