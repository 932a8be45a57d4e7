"""A gait's scene holds the report's forces, points and areas, for turned feet too."""

from pathlib import Path

import numpy as np
import pytest

import scout_pin
from scout_pin.report.drawn.view import MARGIN_BOUNDS, MOST_SAMPLES, gait_scene
from thesis_pin.pages.scene import levels, thinned

WALK = Path(__file__).parents[4] / "examples" / "walk.toml"


@pytest.fixture(scope="module")
def report(tmp_path_factory):
    """A gait whose feet are turned outwards."""
    text = WALK.read_text()
    for foot, yaw in (("left", 11), ("right", -8)):
        text = text.replace(f"[{foot}_foot]\n", f"[{foot}_foot]\nyaw_deg = {yaw}\n")
    file = tmp_path_factory.mktemp("gaits") / "turned.toml"
    file.write_text(text)
    return scout_pin.gait_report(scout_pin.load(), scout_pin.load_gait(file), samples=61)


@pytest.fixture(scope="module")
def items(report):
    return {item.name: item for item in gait_scene(report).items}


@pytest.fixture(scope="module")
def shown(report):
    """Samples of the report that the scene shows: one of each pair beside an instant."""
    kept = thinned(report.joints.time, MOST_SAMPLES)
    assert 61 <= len(kept) < len(report.joints.time)
    return kept


def test_forces_start_where_the_floor_pushes_without_turning(report, items, shown):
    for k, side in enumerate(("left", "right")):
        foot = report.motion.left_foot if side == "left" else report.motion.right_foot
        assert np.abs(foot.rotation[:, 0, 1]).min() > 0.1
        wrench, arrow = report.dynamics.wrench[shown, k], items[f"{side}_force"]
        stands = report.motion.support[shown, k]
        lever = foot.position[shown] - arrow.origin
        moment = wrench[:, 3:] + np.cross(lever, wrench[:, :3])
        np.testing.assert_allclose(moment[stands, :2], 0.0, atol=1e-12)
        np.testing.assert_allclose(arrow.origin[stands, 2], 0.0, atol=1e-12)
        assert np.isnan(arrow.origin[~stands]).any(axis=1).all()


def test_forces_of_both_feet_are_the_weight_and_what_moves_the_robot(report, items):
    total = sum(np.nan_to_num(items[f"{side}_force"].vector) for side in ("left", "right"))
    assert total[:, 2].mean() == pytest.approx(report.robot.mass * 9.81, rel=0.02)
    scale = items["left_force"].scale
    assert scale * report.robot.mass * 9.81 == pytest.approx(report.com[:, 2].mean())


def test_colours_of_the_zero_moment_point_follow_its_margin(report, items, shown):
    assert levels(np.array([-1e-4, 1e-4, 4.9e-3, 5.1e-3]), MARGIN_BOUNDS).tolist() == [0, 1, 1, 2]
    level = items["zmp"].level
    np.testing.assert_array_equal(level == 0, report.margin[shown] < 0)
    np.testing.assert_array_equal(level == 2, report.margin[shown] >= 5e-3)


def test_torque_arcs_are_shares_of_the_stall_torque(report, items, shown):
    arcs = [item for name, item in items.items() if name.startswith("torque_")]
    assert len(arcs) == 12
    found = np.stack([arc.angle for arc in arcs], axis=1) / (2 * np.pi)
    share = report.dynamics.torque[shown] / report.robot.stall_torque
    np.testing.assert_allclose(found, np.clip(share, -1, 1), atol=1e-12)


def test_bodies_are_coloured_by_leg_and_soles_let_the_floor_be_seen(items):
    assert items["left_sole_0"].opacity < 1
    assert items["left_sole_0"].group == "soles"
    assert items["left_shank_0"].colour != items["right_shank_0"].colour
