"""Which way a walk sets out changes nothing of it: the floor has no north."""

import csv

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from scout_pin.coordinates import POSE_NAMES
from scout_pin.motion.files import load_gait
from scout_pin.motion.gait import BODIES
from scout_pin.motion.writing import rows_of, supports
from scout_pin.report.document import gait_report
from scout_pin.study.simulate.conditions import Conditions
from scout_pin.study.simulate.draws import simulate_gait

from ...conftest import EXAMPLES
from .conftest import STEP

pytest.importorskip("mujoco", reason="MuJoCo isn't installed: pip install mujoco")


def turned_table(folder, degrees):
    """The walk as a table whose torso and soles are all turned about the vertical."""
    gait, turn = load_gait(EXAMPLES / "walk.toml"), Rotation.from_euler("z", degrees, degrees=True)
    t = rows_of(gait, 601)
    columns = {"t": t * gait.time_unit, "support": supports(gait, t)}
    for body in BODIES:
        pose = np.stack([curve(t) for curve in gait.curves[body]], axis=1)
        angles = (turn * Rotation.from_euler("XYZ", pose[:, 3:])).as_euler("XYZ")
        for k, name in enumerate(POSE_NAMES):
            columns[f"{body}_{name}"] = np.hstack([turn.apply(pose[:, :3]), angles])[:, k]
    file = folder / "turned.csv"
    with file.open("w", newline="") as stream:
        writer = csv.writer(stream)
        writer.writerow(columns)
        writer.writerows(zip(*columns.values(), strict=True))
    return file


@pytest.mark.parametrize("degrees", [90.0, -145.0])
def test_a_walk_that_sets_out_another_way_is_simulated_as_itself(scout, walked, tmp_path, degrees):
    gait = load_gait(turned_table(tmp_path, degrees), smooth="none")
    found = simulate_gait(gait_report(scout, gait, samples=101), Conditions(time_step=STEP))
    (mine,), (its,) = walked.draws, found.draws
    assert found.passed
    assert its.distance == pytest.approx(mine.distance, abs=5e-5)
    assert its.heading == pytest.approx(mine.heading, abs=1e-4)
    assert its.worst_slip.distance == pytest.approx(mine.worst_slip.distance, abs=5e-5)
    np.testing.assert_allclose(its.peak_torque, mine.peak_torque, atol=3e-3)
