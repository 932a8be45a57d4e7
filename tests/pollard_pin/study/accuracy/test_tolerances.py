"""Tolerances by name, pattern and kind, from TOML and tables as people write them."""

import numpy as np
import pytest

from pollard_pin.study.accuracy.files import read_tolerances
from pollard_pin.study.accuracy.parameters import COLUMNS, PARAMETERS
from pollard_pin.study.accuracy.tolerances import (
    DEVIATION,
    Rule,
    default_tolerances,
    tolerances,
)
from thesis_pin.errors import BadInput, SpecificationError, UnknownName


def sizes(found):
    return {one.parameter.name: one.written for one in found.each}


def read(tmp_path, text, name="tolerances.toml"):
    path = tmp_path / name
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return read_tolerances(path)


def test_names_say_each_number_of_a_specification_once(pollard):
    dumped = pollard.specification.model_dump()
    keys = {
        f"{chain}.{key.removesuffix('_deg')}"
        for chain in ("chain_0", "chain_1", "chain_2")
        for key, value in dumped[chain].items()
        if isinstance(value, int | float)
    }
    kinds = {"lengths": 17, "angles": 4, "axes": 15, "offsets": 14, "motors": 6}
    assert {one.name for one in PARAMETERS if one.kind in ("lengths", "angles")} == keys
    for kind, count in kinds.items():
        assert sum(one.kind == kind for one in PARAMETERS) == count
    assert len({one.name for one in PARAMETERS}) == len(PARAMETERS)
    assert len(COLUMNS) == sum(kinds.values())


def test_the_default_is_a_tenth_of_everything_but_play_and_says_so():
    found = default_tolerances()
    assert list(sizes(found).values()) == pytest.approx([0.1] * len(found.each))
    assert len(found.each) == len(COLUMNS)
    assert "ours" in found.notes[0]
    assert {one.parameter.kind for one in found.each}.isdisjoint({"play", "backlash", "zero"})


def test_a_later_rule_comes_before_an_earlier_one_and_zero_is_exact():
    found = sizes(
        tolerances([Rule("*", 0.1, "mm"), Rule("x_8*", 0.02, "mm"), Rule("chain_1.z_32", 0, "mm")])
    )
    assert found["chain_1.x_87"] == found["chain_2.x_87"] == pytest.approx(0.02)
    assert found["chain_2.z_32"] == pytest.approx(0.1)
    assert "chain_1.z_32" not in found
    assert "motor.wrist_roll" not in found


@pytest.mark.parametrize(
    ("pattern", "unit", "count"),
    [
        ("chain_1.*", "mm", 6),
        ("chain_1.*", "deg", 2),
        ("beta_1413_deg", "deg", 2),
        ("wrist_roll", "deg", 1),
        ("axes", "deg", 15),
        ("play.*", "mm", 4),
        ("backlash.wrist_*", "deg", 2),
        ("*", "mm", 31),
        ("*", "deg", 25),
    ],
)
def test_patterns_mean_names_ends_of_names_and_kinds(pattern, unit, count):
    assert len(tolerances([Rule(pattern, 0.1, unit)]).each) == count


@pytest.mark.parametrize(
    ("rule", "error", "said"),
    [
        (Rule("x_99", 0.1, "mm"), UnknownName, "x_99"),
        (Rule("x_87", 0.1, "deg"), BadInput, "allowed: mm, for chain_1.x_87"),
        (Rule("axes", 0.1, "mm"), BadInput, "allowed: deg"),
        (Rule("x_87", -0.1, "mm"), BadInput, "a tolerance is -0.1"),
        (Rule("x_87", 100.0, "mm"), BadInput, "at most 20"),
        (Rule("x_87", 0.0, "mm"), BadInput, "nothing is off"),
        (Rule("x_87", float("nan"), "mm"), BadInput, "nan"),
    ],
)
def test_what_cannot_be_is_refused(rule, error, said):
    with pytest.raises(error, match=said):
        tolerances([rule])


TOML = """format = 1
distribution = "normal"
[[tolerances]]
of = ["lengths", "offsets"]
mm = 0.05
[[tolerances]]
of = "encoder"
deg = 0.044
distribution = "uniform"
[[tolerances]]
of = "play.ball_joint_*"
mm = 0.02
"""


def test_toml_says_sizes_patterns_and_distributions(tmp_path):
    found = read(tmp_path, TOML)
    ways = {one.parameter.kind: one.distribution for one in found.each}
    assert ways == {"lengths": "normal", "offsets": "normal", "encoder": "uniform", "play": "ends"}
    assert sizes(found)["encoder.wrist_roll"] == pytest.approx(0.044)


def test_toml_names_every_mistake_with_its_line(tmp_path):
    text = TOML.replace("mm = 0.05", "").replace('"encoder"', '"lengths"').replace("0.02", "-1")
    with pytest.raises(SpecificationError) as caught:
        read(tmp_path, text)
    said = str(caught.value)
    assert "greater than or equal to 0" in said
    text = TOML.replace("mm = 0.05", "").replace('"encoder"', '"lengths"')
    with pytest.raises(SpecificationError) as caught:
        read(tmp_path, text)
    assert "2 problems" in str(caught.value)
    assert "toml:3: tolerances[0]: has no size" in str(caught.value)
    assert "tolerances.toml:7: tolerances[1].of" in str(caught.value)


@pytest.mark.parametrize(
    "text",
    [
        "parameter,tolerance_mm,tolerance_deg\nx_87,0.02,\nmotors,,0.05\n",
        "Parameter;Tolerance [mm];Tolerance [°]\nx_87;±0,02;\nmotors;;± 0,05\n",
        "name,tolerance,unit,price\nx_87,20,µm,3\nmotors,0.05,°,4\n",
        "# from the drawing\nparameter\ttolerance\tunit\nx_87\t0.02\tmm\nmotors\t0.05\tdeg\n",
        "﻿sep=;\nparameter;tolerance;unit;distribution\nx_87;0,02;mm;uniform\nmotors;0,05;deg;\n",
    ],
)
def test_tables_are_read_as_people_write_them(tmp_path, text):
    found = sizes(read(tmp_path, text, "t.csv"))
    assert found["chain_1.x_87"] == pytest.approx(0.02)
    assert found["motor.wrist_yaw"] == pytest.approx(0.05)
    assert len(found) == 8


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("parameter,tolerance\nx_87,0.02\n", "'tolerance' says no unit"),
        ("what,tolerance_mm\nx_87,0.02\n", "no column is called parameter"),
        ("parameter,tolerance_mm\nx_87,\n", "t.csv:2: x_87 has no tolerance"),
        ("parameter,tolerance_mm\nx_87,tight\n", "t.csv:2, column 2: the tolerance is 'tight'"),
        ("parameter,tolerance_mm\nx_87,nan\n", "t.csv:2"),
        ("parameter,tolerance,unit\nx_87,0.1,inch\n", "allowed: a number in mm"),
        ("parameter,tolerance_mm\nx_86,0.1\n", "t.csv:2"),
        ("parameter,tolerance_mm,distribution\nx_87,0.1,gauss\n", "t.csv:2"),
        ("parameter,tolerance_mm\nx_87,500\n", "t.csv:2"),
        ("parameter,tolerance_mm,tolerance_mm\nx_87,0.1,0.2\n", "x_87 has two tolerances in mm"),
        ("parameter,tolerance_mm,tolerance_um\nx_87,0.1,20\n", "x_87 has two tolerances in mm"),
        ("", "empty"),
        ("parameter,tolerance_mm\n", "no tolerance"),
    ],
)
def test_a_bad_row_is_one_error_with_its_line(tmp_path, text, said):
    with pytest.raises(BadInput) as caught:
        read(tmp_path, text, "t.csv")
    assert said in str(caught.value)


@pytest.mark.parametrize("way", DEVIATION)
def test_drawn_errors_have_the_deviation_that_is_said(way):
    found = tolerances([Rule("x_87", 0.1, "mm", way)])
    drawn = found.drawn(3, range(4000))
    assert drawn.shape == (2, 4000)
    np.testing.assert_allclose(drawn.std(axis=1), found.deviations, rtol=0.04)
    np.testing.assert_allclose(drawn.mean(axis=1), 0.0, atol=4e-6)
    if way != "normal":
        assert np.abs(drawn).max() <= 1e-4
    if way == "ends":
        assert set(np.abs(drawn).ravel()) == {1e-4}


def test_a_draw_depends_on_seed_and_number_alone():
    found = default_tolerances()
    np.testing.assert_array_equal(found.drawn(1, range(9))[:, 5:7], found.drawn(1, range(5, 7)))
    assert (found.drawn(1, [0]) != found.drawn(2, [0])).any()


def test_several_tolerances_of_one_number_add_up():
    found = tolerances(
        [Rule("zero.wrist_roll", 0.1, "deg"), Rule("encoder.wrist_roll", 0.2, "deg")]
    )
    whole = found.whole(found.sizes[:, None])
    assert whole.sum() == pytest.approx(np.radians(0.3))
    assert (whole > 0).sum() == 1
