"""A scene in meshcat's own page, in a real browser: what is drawn, where, and that it plays."""

import json

import numpy as np
import pytest

from thesis_pin.errors import BadInput
from thesis_pin.pages.meshcat.display import show
from thesis_pin.pages.scene import (
    Arc,
    Arrow,
    Ball,
    Group,
    Polygon,
    Readout,
    Scene,
    Shape,
    Trace,
)

pytestmark = pytest.mark.browser

TIME = np.linspace(3.0, 5.0, 41)
"""Not from zero: meshcat's bar counts from there."""
FORCE = np.column_stack([np.sin(TIME), np.cos(2 * TIME), 1 + 0.1 * TIME])
FORCE[20:23] = np.nan
WAY = np.column_stack([0.1 * TIME, np.zeros_like(TIME), np.full_like(TIME, 0.3)])
SCALE = 0.2

VERTICES = """(() => {
  const node = %s, found = [];
  viewer.scene.updateMatrixWorld(true);
  node.object.traverse((part) => {
    const places = part.geometry?.attributes.position;
    for (let i = 0; places && i < places.count; i++) {
      const point = new MeshCat.THREE.Vector3().fromBufferAttribute(places, i);
      found.push(viewer.scene.worldToLocal(part.localToWorld(point)).toArray());
    }
  });
  return found;
})()"""
"""Every vertex of a node in our world, of which meshcat's scene is a turned copy."""


CORNERS = """(() => {
  const box = new MeshCat.THREE.Box3().setFromObject(%s.object), across = [], high = [];
  for (let i = 0; i < 8; i++) {
    const corner = new MeshCat.THREE.Vector3(...["x", "y", "z"].map(
      (axis, bit) => box[i >> bit & 1 ? "max" : "min"][axis])).project(viewer.camera);
    across.push(Math.abs(corner.x));
    high.push(Math.abs(corner.y));
  }
  return [across, high];
})()"""
"""Where a node's box is in the window, whose edges are at 1."""


def picture(**more):
    """A scene with every kind of item."""
    still = np.zeros((41, 7))
    still[:, 6] = 1
    body = still.copy()
    body[:, :3] = WAY
    square = 0.2 * np.array([[1, 1, 0], [-1, 1, 0], [-1, -1, 0], [1, -1, 0.0]])
    which = np.where(TIME < 4, 0.0, -1.0)
    items = (
        Shape("body/one", "robot", {"type": "box", "size": [0.1, 0.1, 0.1]}, body, np.eye(4)),
        Ball("ball", "points", WAY, 0.02, ("#ff0000", "#0000ff"), (TIME > 4).astype(float)),
        Arrow("pull", "forces", WAY, FORCE, SCALE, 0.01, "#009E73"),
        Trace("way", "traces", WAY, 0.005, "#CC79A7"),
        Polygon("hull", "polygon", (square, 0.5 * square), which, "#0072B2", 0.004),
        Arc("turn", "torques", still, TIME - 4, 0.1, ("#000000", "#D55E00"), (TIME > 4) * 1.0),
    )
    groups = [Group(name, name) for name in ("robot", "points", "forces", "traces", "polygon")]
    return Scene(
        title="A scene, 100 %",
        description="Everything there is.",
        time=TIME,
        groups=(*groups, Group("torques", "torques", visible=False)),
        items=items,
        readouts=(Readout("time", TIME),),
        **more,
    )


@pytest.fixture(scope="module")
def viewer():
    with show(picture(), port=0) as shown:
        yield shown


@pytest.fixture
def page(browser, viewer):
    viewer.play()
    browser.open(viewer.url)
    browser.until("window.viewer && viewer.animator.duration > 0")
    return browser


def node(*steps):
    """JavaScript for a node below the scene's title."""
    path = json.dumps(["meshcat", "A scene, 100 %", *steps])
    return f"{path}.reduce((node, step) => node.children[step], viewer.scene_tree)"


def told(page, viewer):
    """Wait until the page has taken all that it has been sent."""
    told.count += 1
    viewer.visualizer["told"].set_property("count", told.count)
    page.until(f"viewer.scene_tree.children.meshcat.children.told?.object.count === {told.count}")


told.count = 0


def vertices(page, *steps):
    return np.array(page.run(VERTICES % node(*steps)))


def visible(page, *steps):
    """Whether a node's own switch is on."""
    return page.run(node(*steps) + ".object.visible")


def tip(page):
    """The farthest point of the arrow along itself, by its cone's tip."""
    points = vertices(page, "forces", "pull", "head")
    start = vertices(page, "forces", "pull").mean(axis=0)
    far = np.linalg.norm(points - start, axis=1)
    return points[np.isclose(far, far.max(), atol=1e-6)].mean(axis=0)


def seek(page, t):
    page.run(
        "(() => { viewer.animator.play(); viewer.animator.pause(); "
        f"viewer.animator.seek({t}); return 1; }})()"
    )


def test_everything_stands_below_its_title_and_its_group(page, viewer, artefacts):
    tree = page.run(
        f"Object.fromEntries(Object.entries({node()}.children)"
        ".map(([name, node]) => [name, Object.keys(node.children)]))"
    )
    assert tree.pop("floor") == ["<object>"]
    tree.pop("animation", None)
    assert tree == {
        "robot": ["body-one"],
        "points": ["ball"],
        "forces": ["pull"],
        "traces": ["way"],
        "polygon": ["hull"],
        "torques": ["turn"],
    }
    assert visible(page, "torques") is False
    assert visible(page, "forces") is True
    page.still(artefacts / "meshcat_items.png")
    assert page.complaints() == []
    # It speaks to its own server alone.
    assert page.requests() == [viewer.url, viewer.url + "main.min.js"]


def test_the_animation_advances_by_itself_and_moves_things(page, viewer):
    page.open(viewer.url, reduced_motion="no-preference")
    page.until("window.viewer && viewer.animator.duration > 0")
    first = page.run("viewer.animator.time")
    before = vertices(page, "robot", "body-one").mean(axis=0)
    page.until(f"viewer.animator.time > {first} + 0.2")
    assert np.linalg.norm(vertices(page, "robot", "body-one").mean(axis=0) - before) > 0.005
    assert page.run("viewer.animator.duration") == pytest.approx(TIME[-1] - TIME[0], abs=1e-5)
    page.until("viewer.animator.time < 0.3")  # again and again


@pytest.mark.parametrize("k", [0, 7, 31, 40])
def test_an_arrows_tip_is_where_the_scene_says_on_the_bar_and_at_a_moment(page, viewer, k):
    wanted = WAY[k] + SCALE * FORCE[k]
    seek(page, TIME[k] - TIME[0])
    np.testing.assert_allclose(tip(page), wanted, atol=2e-6)
    viewer.display(TIME[k])
    told(page, viewer)
    np.testing.assert_allclose(tip(page), wanted, atol=2e-6)


def test_what_isnt_known_hides_and_comes_back(page, viewer):
    for k, wanted in ((10, True), (21, False), (30, True)):
        seek(page, TIME[k] - TIME[0])
        assert visible(page, "forces", "pull") is wanted
        viewer.display(TIME[k])
        told(page, viewer)
        assert visible(page, "forces", "pull") is wanted
        viewer.play()
        told(page, viewer)


def colour(page, *steps):
    return page.run(node(*steps, "<object>") + ".object.material.color.getHexString()")


def test_levels_polygons_arcs_and_ways_change_with_time(page):
    limit = node("torques", "turn", "ring", "<object>") + ".object.material.alphaTest"
    drawn = []
    for t, level, dark, polygon in (
        (0.2, "ff0000", "000000", True),
        (1.6, "0000ff", "d55e00", False),
    ):
        seek(page, t)
        assert colour(page, "points", "ball") == level
        assert colour(page, "torques", "turn", "head") == dark
        assert visible(page, "polygon", "hull", "outline 0") is polygon
        assert visible(page, "polygon", "hull", "outline 1") is False
        drawn.append((1 - page.run(limit)) * 64 * 2 * np.pi)
    assert drawn == pytest.approx([0.8, 0.6], abs=2e-3)


def test_a_group_is_hidden_by_meshcats_own_control_while_it_plays(page):
    page.run(f"{node('forces')}.vis_controller.setValue(false) && 1")
    page.run("viewer.animator.play()")
    seen = page.run("viewer.animator.time")
    page.until(f"viewer.animator.time !== {seen}")
    assert visible(page, "forces") is False


def test_who_wants_less_motion_gets_a_page_at_rest(browser, viewer):
    viewer.play()
    browser.open(viewer.url, reduced_motion="reduce")
    browser.until("window.viewer && viewer.animator.duration > 0")
    assert browser.run("viewer.animator.playing") is False


def test_the_static_page_plays_alone_and_asks_for_nothing(browser, viewer, tmp_path, artefacts):
    viewer.play()
    file = tmp_path / "page.html"
    file.write_text(viewer.static_html(), encoding="utf-8")
    assert file.stat().st_size < 1e6
    for width in (1280, 390):
        browser.open(file.as_uri(), width=width, reduced_motion="no-preference")
        browser.until("window.viewer && viewer.animator.duration > 0")
        browser.until("viewer.animator.time > 0.1")
        browser.still(artefacts / f"meshcat_static_{width}.png")
        across, high = browser.run(CORNERS % node("polygon"))
        assert max(across) < 1, "the picture fits the window's width"
        assert max(high) < 1
        seek(browser, TIME[31] - TIME[0])
        np.testing.assert_allclose(tip(browser), WAY[31] + SCALE * FORCE[31], atol=2e-6)
        assert browser.requests() == [file.as_uri()]
        assert browser.complaints() == []


def test_a_scene_on_a_named_server_leaves_its_stage_and_other_objects_alone(page, viewer):
    viewer.visualizer["mine"].set_transform(np.eye(4))
    with show(picture(floor=None), viewer.visualizer.window.zmq_url) as guest:
        assert guest.url == viewer.url
        page.until("viewer.animator.duration > 0")
        assert page.run("'mine' in viewer.scene_tree.children.meshcat.children")
        assert page.run(f"'floor' in {node()}.children") is False
    viewer.display(TIME[0])  # our server outlives its guest
    assert viewer.jupyter_cell(300).data.count(viewer.url) == 1


def test_what_is_no_scene_no_moment_or_no_speed_is_refused(viewer):
    with pytest.raises(BadInput, match="scene is"):
        show("walk.toml")
    with pytest.raises(BadInput, match="t is"):
        viewer.display("now")
    with pytest.raises(BadInput, match="speed is"):
        show(picture(), speed=0)
