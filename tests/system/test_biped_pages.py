"""Pages of a biped of one's own in a real browser: its neutral pose and its drawing."""

import numpy as np
import pytest
from chromium import share_drawn

import scout_pin
from scout_pin.report.drawn.neutral import neutral_scene
from scout_pin.report.info import page
from scout_pin.specification import NEW_PATH, SIDES
from thesis_pin.pages import player

pytestmark = pytest.mark.browser


@pytest.fixture(scope="module")
def robot():
    return scout_pin.load(NEW_PATH)


def test_the_neutral_pose_stands_on_the_floor_and_is_drawn(robot, browser, tmp_path, artefacts):
    player.write_html(neutral_scene(robot), tmp_path / "neutral.html")
    browser.watch(tmp_path / "neutral.html")
    assert share_drawn(browser.still(artefacts / "neutral_pose.png")) > 0.02
    assert browser.complaints() == []
    names = browser.run("player.items.map((item) => item.name)")
    for side in SIDES:
        (sole,) = [name for name in names if name.startswith(f"{side}_sole")]
        corners = browser.vertices(sole)
        assert corners[:, 2].min() == pytest.approx(0.0, abs=1e-6)
        outline = robot.sole_vertices(side, robot.neutral_feet()[side])
        np.testing.assert_allclose(
            corners[:, :2].min(axis=0), outline[:, :2].min(axis=0), atol=1e-6
        )


def test_the_page_of_a_specification_is_quiet_and_shows_both_legs(robot, browser, tmp_path):
    (tmp_path / "info.html").write_bytes(page(robot))
    browser.open((tmp_path / "info.html").as_uri())
    assert browser.run("document.querySelectorAll('figure.drawing svg').length") == 2
    widths = browser.run(
        "[...document.querySelectorAll('figure.drawing svg')]"
        ".map((one) => one.getBoundingClientRect().width)"
    )
    assert min(widths) > 300
    assert browser.complaints() == []
    assert browser.requests() == [(tmp_path / "info.html").as_uri()]
