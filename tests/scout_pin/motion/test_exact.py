"""A planned gait's file: what is read back is what was written, to the bit."""

from dataclasses import replace

import numpy as np
import pytest

import scout_pin
from scout_pin.motion.exact import exact_toml
from scout_pin.motion.files import load_gait
from scout_pin.motion.gait import BODIES
from thesis_pin.errors import BadInput, SpecificationError

from ..conftest import EXAMPLES


def again(gait, folder, header=()):
    path = folder / "gait.toml"
    path.write_text(exact_toml(gait, header), encoding="utf-8")
    return load_gait(path)


@pytest.mark.parametrize("name", ["walk.toml", "lopsided_walk.toml", "thesis"])
def test_curves_read_back_to_the_bit(tmp_path, name):
    gait = load_gait(EXAMPLES / name if "." in name else name)
    found = again(gait, tmp_path)
    t = gait.sample_times(501)
    for body in BODIES:
        for mine, its in zip(gait.curves[body], found.curves[body], strict=True):
            for order in (0, 1, 2):
                np.testing.assert_array_equal(mine(t, order), its(t, order))
    assert (found.phases, found.time_unit, found.name) == (gait.phases, gait.time_unit, gait.name)


def test_the_report_of_what_is_read_back_is_the_same(tmp_path):
    robot, gait = scout_pin.load(), load_gait(EXAMPLES / "walk.toml")
    first = scout_pin.gait_report(robot, gait, samples=101, time_unit=0.1)
    second = scout_pin.gait_report(robot, again(gait, tmp_path), samples=101, time_unit=0.1)
    np.testing.assert_allclose(second.dynamics.torque, first.dynamics.torque, atol=1e-9)
    np.testing.assert_allclose(second.margin, first.margin, atol=1e-9)


def test_names_and_branches_of_any_kind_read_back_and_the_header_is_comments(tmp_path):
    gait = replace(load_gait(EXAMPLES / "walk.toml"), name='a "b"\n\\é', branch="+++", cycle=True)
    found = again(gait, tmp_path, ["scout-pin plan --out walk", "two\nlines"])
    assert (found.name, found.branch, found.cycle) == (gait.name, "+++", True)
    text = (tmp_path / "gait.toml").read_text(encoding="utf-8")
    assert text.startswith("# scout-pin plan --out walk\n# two\n# lines\n")


def test_a_gait_from_samples_is_refused(tmp_path):
    rows = "".join(f"{k / 100},double,{0.2 + 1e-3 * (k % 3)}\n" for k in range(50))
    (tmp_path / "log.csv").write_text(f"t,support,torso_z\n{rows}")
    gait = load_gait(tmp_path / "log.csv", smooth="1mm")
    with pytest.raises(BadInput, match="was smoothed from samples"):
        exact_toml(gait)


PIECES = """format = 1
name = "pieces"
time_unit = 1.0
[torso]
z = {curve}
[left_foot]
x_mm = -30
[right_foot]
x_mm = 30
[[phases]]
start = 10
end = 12
support = "double"
"""


def read(folder, curve):
    path = folder / "pieces.toml"
    path.write_text(PIECES.format(curve=curve), encoding="utf-8")
    return load_gait(path)


def test_pieces_count_from_their_own_start(tmp_path):
    gait = read(tmp_path, "[{ t = [10, 11, 12], pieces = [[2, 0, 0.2], [4, 2.2]] }]")
    z = gait.curves["torso"][2]
    np.testing.assert_array_equal(z([10.0, 10.5, 11.0, 11.5]), [0.2, 0.7, 2.2, 4.2])


@pytest.mark.parametrize(
    ("curve", "said"),
    [
        ("[{ t = [10, 11, 12], pieces = [[0.2]] }]", "each of the 2 intervals"),
        (
            "[{ t = [10, 12], pieces = [[0.2]], value = [0.2, 0.2] }]",
            "value or polynomial or pieces",
        ),
        ("[{ t = [10, 12], pieces = [[0.2]], interpolation = 'cubic' }]", "neither interpolation"),
        ("[{ t = [10, 12], pieces = [[0.2]], until = 13 }]", "neither interpolation nor until"),
        ("[{ t = [10, 12], pieces = [[]] }]", "pieces"),
        (f"[{{ t = [10, 12], pieces = [[{', '.join(['0.1'] * 33)}]] }}]", "pieces"),
    ],
)
def test_pieces_that_say_nothing_clear_are_refused(tmp_path, curve, said):
    with pytest.raises(SpecificationError, match=said):
        read(tmp_path, curve)


def test_pieces_that_do_not_meet_are_refused(tmp_path):
    with pytest.raises(BadInput, match="jumps by"):
        read(tmp_path, "[{ t = [10, 11, 12], pieces = [[0.2], [0.3]] }]")
