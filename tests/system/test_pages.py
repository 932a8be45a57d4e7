"""Views in a real browser: they draw, move, obey, and ask nothing of any network."""

import signal
import subprocess
import sys
import urllib.request
from pathlib import Path

import numpy as np
import pytest
import shapely
from chromium import differing, share_drawn
from example_robots import NAMES, example_robot

import scout_pin
from scout_pin.report.drawn.view import gait_scene
from scout_pin.specification import SIDES
from thesis_pin.pages import drawing, scene
from thesis_pin.pages import player as viewer

pytestmark = pytest.mark.browser

ROOT = Path(__file__).parents[2]


@pytest.fixture
def view(browser, view_file):
    """The exported animation, paused at its start."""
    browser.watch(view_file)
    return browser


def test_an_exported_page_asks_for_nothing_complains_of_nothing_and_is_small(view, view_file):
    assert view.requests() == [view_file.as_uri()]
    assert view.complaints() == []
    assert view_file.stat().st_size < 3e6


def test_a_page_of_ten_seconds_with_every_overlay_stays_under_3_mb(folder):
    robot, gait = scout_pin.load(), scout_pin.load_gait(ROOT / "examples" / "walk.toml")
    slow = 10 / (gait.end - gait.start)
    long = scout_pin.gait_report(robot, gait, samples=scene.frames(10), time_unit=slow)
    assert len(viewer.html(gait_scene(long))) < 3e6


def test_the_robot_is_drawn_and_moves(view, report, artefacts):
    first = view.still(artefacts / "scout_view.png")
    assert share_drawn(first) > 0.02
    view.run(f"player.time = {report.joints.time[-1] / 3}")
    assert differing(first, view.still(artefacts / "scout_view_later.png")) > 2000


def test_the_animation_runs_by_itself_and_starts_again_at_its_end(view):
    view.run("player.time = player.duration - 0.05; player.play()")
    view.until("player.time < player.duration / 2")
    seen = view.run("player.time")
    view.until(f"player.time > {seen} + 0.1")
    assert view.run("document.querySelector('button.play').textContent").endswith("pause")


def test_a_page_plays_by_itself_unless_its_reader_wants_less_motion(browser, view_file):
    for wish, plays in (("no-preference", True), ("reduce", False)):
        browser.open(view_file.as_uri(), reduced_motion=wish)
        browser.until("window.player && player.framesDrawn > 0")
        assert browser.run("player.playing") is plays


def test_every_group_can_be_hidden_and_shown_again(view):
    names = view.run("[...player.groups.keys()]")
    assert {"soles", "com", "zmp", "polygon", "forces", "traces"} <= set(names)
    view.run("player.time = player.duration / 2; player.look('top')")
    for name in names:
        before = view.still()
        view.run(f"player.toggle({name!r})")
        assert differing(before, view.still()) > 20, name
        view.run(f"player.toggle({name!r})")
        assert differing(before, view.still()) < 20, name


def test_the_keyboard_plays_steps_and_toggles(view):
    view.press("Space")
    assert view.run("player.playing") is True
    view.press("Space")
    assert view.run("player.playing") is False
    view.press("Home")
    view.press("ArrowRight")
    step = view.run("player.time")
    assert step == pytest.approx(view.run("player.duration") / 100, rel=1e-6)
    view.press("End")
    assert view.run("player.time") == pytest.approx(view.run("player.duration"))
    visible = view.run("player.groups.get('robot').object.visible")
    view.press("1")
    assert view.run("player.groups.get('robot').object.visible") is not visible


def test_everything_a_reader_operates_has_a_name(view, report):
    unnamed = view.run(
        "[...document.querySelectorAll('button, input, select, canvas')].filter((e) => "
        "!(e.getAttribute('aria-label') || e.textContent || e.labels?.[0]?.textContent)).length"
    )
    assert unnamed == 0
    label = view.run("document.querySelector('canvas').getAttribute('aria-label')")
    assert report.verdict()[0] in label


def test_scrubbing_goes_to_the_moment_and_shows_its_values(view, report):
    view.run(
        "(() => { const s = document.querySelector('input[type=range]'); s.value = 3;"
        "s.dispatchEvent(new Event('input')); })()"
    )
    assert view.run("player.time") == pytest.approx(3.0)
    k = int(np.argmin(abs(report.joints.time - 3.0)))
    shown_values = view.run("[...document.querySelectorAll('dd')].map((e) => e.textContent)")
    assert f"{report.margin[k] * 1e3:.1f} mm" in shown_values


def test_an_arrow_starts_at_the_pressure_and_its_tip_is_where_the_force_says(view, report):
    for share in (0.1, 0.3, 0.8):
        k = int(share * (len(report.joints.time) - 1))
        view.run(f"player.time = {report.joints.time[k]}")
        scale = report.com[:, 2].mean() / (report.robot.mass * 9.81)
        for j, side in enumerate(SIDES):
            force = report.dynamics.wrench[k, j, :3]
            moment = report.dynamics.wrench[k, j, 3:]
            foot = report.motion.left_foot if side == "left" else report.motion.right_foot
            if not report.motion.support[k, j]:
                assert view.shown(f"{side}_force") is False
                continue
            # The floor is z = 0, so the pressure acts where the moment's x and y vanish.
            start = foot.position[k] + np.array([-moment[1], moment[0], 0.0]) / force[2]
            along = force / np.linalg.norm(force)
            points = view.vertices(f"{side}_force")
            reach = (points - start) @ along
            tip = points[np.argmax(reach)]
            np.testing.assert_allclose(tip, start + scale * force, atol=2e-5)
            assert reach.min() == pytest.approx(0.0, abs=2e-5)


def test_between_samples_everything_is_halfway(view, report):
    for k in (60, 150):
        view.run(f"player.time = {report.joints.time[k : k + 2].mean()}")
        centre = view.vertices("com").mean(axis=0)
        np.testing.assert_allclose(centre, report.com[k : k + 2].mean(axis=0), atol=2e-4)
        for side in SIDES:
            foot = report.motion.left_foot if side == "left" else report.motion.right_foot
            corners = report.robot.sole_vertices(side, foot.placement[k : k + 2])
            found = view.vertices(f"{side}_sole_0")
            np.testing.assert_allclose(found.min(axis=0)[:2], corners.mean(0).min(0)[:2], atol=1e-4)
            np.testing.assert_allclose(found.max(axis=0)[:2], corners.mean(0).max(0)[:2], atol=1e-4)


def test_traces_follow_the_feet_and_are_bold_up_to_now(view, report):
    for share in (0.0, 0.5, 1.0):
        view.run(f"player.time = {share} * player.duration")
        for side in SIDES:
            foot = report.motion.left_foot if side == "left" else report.motion.right_foot
            points = view.vertices(f"{side}_trace")
            gap = np.linalg.norm(points[:, None] - foot.position, axis=-1).min(axis=1)
            assert gap.max() < 1.5e-3
            bold = view.run(
                "(() => { const line = player.items.find((i) => i.name === "
                f"'{side}_trace').object.children[1].geometry;"
                "return line.drawRange.count / line.index.count; })()"
            )
            way = np.linalg.norm(np.diff(foot.position, axis=0), axis=1)
            moving = way > 1e-4  # how many of the pieces that move are done
            now = round(share * len(way))
            assert bold == pytest.approx(moving[:now].sum() / moving.sum(), abs=0.06)


def test_the_polygon_is_the_hull_of_the_soles_that_bear_load(view, report):
    for k in (0, 60, 180):
        view.run(f"player.time = {report.joints.time[k]}")
        found = np.array(
            view.run(
                "(() => { const found = []; for (const one of player.items.find((i) => i.name === "
                "'polygon').object.children) if (one.visible) found.push(...one.children[0]"
                ".geometry.attributes.position.array); return found; })()"
            )
        ).reshape(-1, 3)
        soles = [
            report.robot.sole_vertices(side, foot.placement[k])
            for j, (side, foot) in enumerate(
                zip(SIDES, (report.motion.left_foot, report.motion.right_foot), strict=True)
            )
            if report.motion.support[k, j]
        ]
        hull = shapely.MultiPoint(np.concatenate(soles)[:, :2]).convex_hull
        assert shapely.Polygon(found[:, :2]).symmetric_difference(hull).area < 1e-9


def test_soles_in_support_stand_on_the_floor_and_none_goes_below(view, report):
    for share in (0.0, 0.2, 0.5, 0.75, 1.0):
        k = int(share * (len(report.joints.time) - 1))
        view.run(f"player.time = {report.joints.time[k]}")
        for j, side in enumerate(SIDES):
            low = view.vertices(f"{side}_sole_0")[:, 2].min()
            if report.motion.support[k, j]:
                assert low == pytest.approx(0.0, abs=2e-6)
            assert low > -2e-6


def test_the_zero_moment_point_has_its_place_and_the_colour_of_its_margin(browser, folder):
    thesis = scout_pin.gait_report(scout_pin.load(), scout_pin.load_gait(), samples=241)
    viewer.write_html(gait_scene(thesis), folder / "thesis.html")
    browser.watch(folder / "thesis.html")
    colour = (
        "player.items.find((i) => i.name === 'zmp').object.material.color"
        ".clone().convertLinearToSRGB().getHexString()"
    )
    for k, expected in ((60, "d55e00"), (0, "0072b2")):
        assert (thesis.margin[k] < 0) == (expected == "d55e00")
        browser.run(f"player.time = {thesis.joints.time[k]}")
        assert browser.run(colour) == expected
        place = browser.vertices("zmp").mean(axis=0)[:2]
        np.testing.assert_allclose(place, thesis.zmp[k], atol=2e-4)


def test_a_value_that_rounds_to_zero_has_no_sign(browser, folder):
    values = np.array([-4e-9, -0.0])
    shown = scene.Scene(
        title="still",
        description="Nothing moves.",
        time=np.linspace(0, 1, 2),
        groups=(),
        items=(),
        readouts=(
            scene.Readout("torque", values, "N·m", 3),
            scene.Readout("speed", values - 0.25, "rad/s", 2),
        ),
    )
    viewer.write_html(shown, folder / "still.html")
    browser.watch(folder / "still.html")
    texts = browser.run("[...document.querySelectorAll('dd')].map((e) => e.textContent)")
    assert texts == ["0.000 N·m", "-0.25 rad/s"]


@pytest.mark.parametrize("name", NAMES)
def test_any_pinocchio_robot_can_be_shown(browser, folder, artefacts, name):
    model, visual, q = example_robot(name)
    picture = scene.Scene(
        title=Path(name).stem,
        description="A robot turns all its joints.",
        time=np.linspace(0, 3, len(q)),
        groups=(scene.Group("robot", "robot"),),
        items=tuple(drawing.robot_items(model, visual, q, colour=lambda name: "#0072B2")),
        floor=0.0 if "panda" in name else None,
    )
    file = folder / f"{Path(name).stem}.html"
    viewer.write_html(picture, file)
    browser.watch(file)
    browser.run("player.time = 1.5")
    image = browser.still(artefacts / f"{Path(name).stem}.png")
    assert share_drawn(image) > 0.02
    assert browser.complaints() == []


def live(*arguments):
    code = "import sys; from scout_pin.cli import main; sys.exit(main())"
    process = subprocess.Popen(
        [sys.executable, "-c", code, "view", "--no-browser", *arguments],
        stderr=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        cwd=ROOT,
    )
    return process, process.stderr.readline()


def test_the_live_page_draws_says_when_it_drops_frames_and_ends_cleanly_on_ctrl_c(
    browser, artefacts
):
    process, line = live("--port", "0", "--speed", "0.5")
    try:
        address = line.split(" at ")[1].split()[0]
        assert address.startswith("http://127.0.0.1:")
        browser.open(address, reduced_motion="no-preference")
        browser.until("window.player && player.framesDrawn > 5")
        assert browser.run("player.playing") is True
        assert browser.run("document.querySelector('.bar select').value") == "0.5"
        browser.run("player.pause()")
        image = browser.still(artefacts / "scout_live.png")
        assert share_drawn(image) > 0.02
        assert browser.complaints() == []
        browser.throttle(20)
        browser.run("player.play()")
        browser.until("document.querySelector('.status').textContent.includes('dropped')", 120)
        assert browser.run("player.frameRate") < 30
        browser.until("performance.getEntriesByType('resource').some((e) => /frames/.test(e.name))")
        assert all(url.startswith(address) for url in browser.requests())
    finally:
        browser.throttle(1)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=30)
    assert (process.returncode, out) == (0, "")
    assert "Traceback" not in err
    assert err.count("of 30 frames a second: frames are dropped") == 1
    with pytest.raises(OSError, match="refused"):
        urllib.request.urlopen(address)
