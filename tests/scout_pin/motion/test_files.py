"""Gaits from files: what is refused because no gait is like that."""

import pytest

from scout_pin.motion.files import load_gait
from thesis_pin.errors import TrajectoryError


def test_support_that_flickers_is_refused_at_the_limit(tmp_path):
    sides = ("left", "right")
    lines = "".join(f"{k},{sides[k % 2]}\n" for k in range(10_002))
    (tmp_path / "noise.csv").write_text(f"t,support\n{lines}")
    with pytest.raises(TrajectoryError, match=r"noise\.csv: support changes 10,001 times"):
        load_gait(tmp_path / "noise.csv")
