"""Gaits from files: what is refused because no gait is like that."""

import pytest

from scout_pin.motion.files import load_gait
from thesis_pin.errors import BadInput, TrajectoryError

from ..conftest import EXAMPLES


def test_support_that_flickers_is_refused_at_the_limit(tmp_path):
    sides = ("left", "right")
    lines = "".join(f"{k},{sides[k % 2]}\n" for k in range(10_002))
    (tmp_path / "noise.csv").write_text(f"t,support\n{lines}")
    with pytest.raises(TrajectoryError, match=r"noise\.csv: support changes 10,001 times"):
        load_gait(tmp_path / "noise.csv")


def test_a_method_for_nodes_is_refused_where_all_curves_are_exact():
    exact = EXAMPLES / "cruise.toml"
    with pytest.raises(BadInput, match=r"interpolation is 'linear'.* are exact") as caught:
        load_gait(exact, "linear")
    assert "Leave it out" in caught.value.remedy
    assert load_gait(exact).end > 0.0
    assert load_gait(EXAMPLES / "walk.toml", "linear").curves["torso"][0].c.shape[0] == 2
