"""Sliders of a page in a file: its forward kinematics against Pinocchio's, in Chromium."""

import json

import numpy as np
import pinocchio as pin
import pytest

import thesis_pin
from thesis_pin.loops.checking.poses import named_pose
from thesis_pin.loops.kinematics import residual
from thesis_pin.loops.loading import load
from thesis_pin.loops.moving.coordinates import coordinates
from thesis_pin.model.mechanism.supplement import Coupling
from thesis_pin.pages.live.alone import tree
from thesis_pin.pages.player import web_file

SLANTED = np.array([0.0, 0.6, 0.8])

KINDS = {
    "free": pin.JointModelFreeFlyer(),
    "x": pin.JointModelRX(),
    "slanted": pin.JointModelRevoluteUnaligned(SLANTED),
    "round": pin.JointModelRUBZ(),
    "slide": pin.JointModelPY(),
    "slanted slide": pin.JointModelPrismaticUnaligned(SLANTED),
    "screw": pin.JointModelHelicalUnaligned(SLANTED, 0.1),
    "ball": pin.JointModelSpherical(),
    "cardan": pin.JointModelUniversal(np.array([1.0, 0, 0]), np.array([0, 0.8, 0.6])),
    "zyx": pin.JointModelSphericalZYX(),
    "shift": pin.JointModelTranslation(),
    "planar": pin.JointModelPlanar(),
}


def every_kind():
    """A chain with a joint of each kind, at places of no symmetry."""
    model, rng = pin.Model(), np.random.default_rng(3)
    for k, (name, kind) in enumerate(KINDS.items()):
        place = pin.SE3(pin.rpy.rpyToMatrix(rng.uniform(-3, 3, 3)), rng.uniform(-1, 1, 3))
        joint = model.addJoint(k, kind, place, name)
        model.appendBodyToJoint(joint, pin.Inertia.Random(), pin.SE3.Random())
    return model


def hooks(model):
    one = {"at": [0.1, -0.2, 0.3], "marks": None, "level": False}
    return [
        *({"kind": "placement", "joint": k, "tip": None} | one for k in range(model.njoints)),
        {"kind": "ball", "joint": -1, "tip": None} | one | {"at": [0, 0, 0]},
        {"kind": "ball", "joint": 3, "tip": None} | one,
        {"kind": "arrow", "joint": 2, "tip": [5, [0.4, 0.5, 0.6]]} | one,
    ]


@pytest.fixture
def moved(browser, tmp_path):
    """``moved`` of the page's script, for a model's tree."""

    def of(model, couplings=()):
        found = tree(model, coordinates(model), couplings)
        assert not isinstance(found, str), found
        words = json.dumps(found), json.dumps(hooks(model))
        (tmp_path / "tree.html").write_text(
            f"<script>{web_file('tree.js')};window.tree = makeTree({words[0]}, {words[1]})</script>"
        )
        browser.open((tmp_path / "tree.html").as_uri())
        browser.until("window.tree")

        def call(q, k, value):
            state = json.dumps({"state": q.tolist(), "readouts": []})
            return browser.run(f"tree.moved({state}, {k}, {value!r})")

        return call

    return of


def same_turn(one, other):
    """Whether quaternions turn alike: their signs may differ."""
    return min(np.abs(one - other).max(), np.abs(one + other).max())


@pytest.mark.browser
def test_every_joint_of_every_kind_is_where_pinocchio_puts_it(moved):
    model = every_kind()
    call, data, rng = moved(model), model.createData(), np.random.default_rng(1)
    model.lowerPositionLimit[:3], model.upperPositionLimit[:3] = -1, 1
    for k, one in enumerate(coordinates(model)):
        q = pin.randomConfiguration(model, -2 * np.ones(model.nq), 2 * np.ones(model.nq))
        value = float(rng.uniform(-1.5, 1.5))
        found, wanted = call(q, k, value), one.placed(q, value)
        for joint in range(1, model.njoints):
            part = slice(
                model.joints[joint].idx_q, model.joints[joint].idx_q + model.joints[joint].nq
            )
            state, known = np.array(found["state"])[part], wanted[part]
            turned = one.kind == "angle" and joint == one.joint
            if turned:
                begin = one.q - model.joints[joint].idx_q
                assert same_turn(state[begin:], known[begin:]) < 1e-9
            else:
                np.testing.assert_allclose(state, known, atol=1e-12)
        pin.forwardKinematics(model, data, wanted)
        for joint in range(model.njoints):
            place = np.array(found["items"][joint]["placement"])
            np.testing.assert_allclose(place[:3], data.oMi[joint].translation, atol=1e-9)
            turn = pin.Quaternion(data.oMi[joint].rotation).coeffs()
            assert same_turn(place[3:], turn) < 1e-9
        com, ball, arrow = found["items"][model.njoints :]
        np.testing.assert_allclose(
            com["position"], pin.centerOfMass(model, data, wanted), atol=1e-9
        )
        point = data.oMi[3].act(np.array([0.1, -0.2, 0.3]))
        np.testing.assert_allclose(ball["position"], point, atol=1e-9)
        origin = data.oMi[2].act(np.array([0.1, -0.2, 0.3]))
        end = data.oMi[5].act(np.array([0.4, 0.5, 0.6]))
        np.testing.assert_allclose(arrow["origin"], origin, atol=1e-9)
        np.testing.assert_allclose(np.add(arrow["origin"], arrow["vector"]), end, atol=1e-9)
        np.testing.assert_allclose(
            found["values"], [c.value(wanted) for c in coordinates(model)], atol=1e-9
        )


@pytest.mark.browser
def test_coupled_joints_go_along_whichever_of_them_is_moved(moved):
    model = every_kind()
    couplings = [
        Coupling("gear", {"x": 1.0, "slanted": -2.0}, 0.1),
        Coupling("rack", {"slanted": 0.5, "slide": 3.0}, -0.2),
    ]
    call = moved(model, couplings)
    names = [one.name for one in coordinates(model)]
    for name in ("x", "slanted", "slide"):
        values = call(pin.neutral(model), names.index(name), 0.7)["values"]
        x, slanted, slide = (values[names.index(one)] for one in ("x", "slanted", "slide"))
        assert values[names.index(name)] == 0.7
        assert x - 2 * slanted == pytest.approx(0.1, abs=1e-12)
        assert 0.5 * slanted + 3 * slide == pytest.approx(-0.2, abs=1e-12)


@pytest.mark.parametrize(
    ("couplings", "why"),
    [
        ([Coupling("three", {"x": 1.0, "slanted": 1.0, "slide": 1.0})], "'three' isn't one of two"),
        ([Coupling("turns", {"x": 1.0, "round": 1.0})], "'turns' isn't one of two"),
        ([Coupling("a", {"x": 1, "slide": 1}), Coupling("b", {"slide": 1, "x": 2})], "'b' ties"),
    ],
)
def test_couplings_that_a_page_cannot_follow_are_told(couplings, why):
    model = every_kind()
    assert why in tree(model, coordinates(model), couplings)


def test_a_joint_of_another_kind_is_told():
    model, joint = pin.Model(), pin.JointModelComposite()
    joint.addJoint(pin.JointModelRX())
    joint.addJoint(pin.JointModelRY(), pin.SE3.Random())
    model.addJoint(0, joint, pin.SE3.Identity(), "knuckle")
    assert tree(model, coordinates(model)) == "joint 'knuckle' is a JointModelComposite"


def opened(browser, file, width=1280, height=720):
    browser.open(file.as_uri(), width, height)
    browser.until("window.live && player.framesDrawn > 0")


@pytest.mark.browser
@pytest.mark.parametrize("name", ["example:panda", "example:bolt"])
def test_sliders_of_a_page_in_a_file_move_the_robot_as_its_command_would(
    name, browser, tmp_path, artefacts
):
    root = pin.JointModelFreeFlyer() if "bolt" in name else None
    robot = load(name, root_joint=root)
    page, file = thesis_pin.slider_page(robot), tmp_path / "page.html"
    file.write_bytes(page.html())
    opened(browser, file)
    before = browser.still()
    rng = np.random.default_rng(0)
    values = [float(rng.uniform(one.low, one.high)) for one in page.rig.sliders]
    browser.run(f"{values}.forEach((value, k) => live.move(k, value))")
    found = browser.run("live.stand")
    q = np.array(found["state"])
    if robot.equations:
        assert np.abs(residual(robot, q)).max() < 1e-12
    data = robot.model.createData()
    pin.forwardKinematics(robot.model, data, q)
    for one, item in zip(page.layers.hung, found["items"], strict=True):
        if "placement" in item:
            wanted = data.oMi[one.joint]
            np.testing.assert_allclose(item["placement"][:3], wanted.translation, atol=1e-9)
            turn = pin.Quaternion(wanted.rotation).coeffs()
            assert same_turn(np.array(item["placement"][3:]), turn) < 1e-9
    # What is said is what the server would say of the same configuration.
    stand = page.rig.moved(q, 0, found["values"][0])
    assert found["marks"] == list(stand.marks)
    np.testing.assert_allclose(found["values"], stand.values, atol=1e-9)
    (tmp_path / "pose.toml").write_text(found["toml"])
    np.testing.assert_allclose(named_pose(robot, str(tmp_path / "pose.toml")), q, atol=1e-12)
    names = {"np": np}
    exec(found["q"], names)
    np.testing.assert_array_equal(names["q"], q)
    after = browser.still(artefacts / f"alone_{name.removeprefix('example:')}_1280.png")
    assert (np.abs(before - after).max(axis=-1) > 24).sum() > 2000
    browser.run("[...document.querySelectorAll('#panel button')].at(0).click()")
    assert browser.run("live.stand.state") == list(page.rig.start().state)
    assert browser.complaints() == []
    assert browser.requests() == [file.as_uri()]
    opened(browser, file, 390, 844)
    assert browser.run("document.documentElement.scrollWidth") <= 390
    browser.still(artefacts / f"alone_{name.removeprefix('example:')}_390.png")


@pytest.mark.browser
def test_scouts_page_in_a_file_moves_and_leaves_its_knees_to_the_command(
    browser, tmp_path, artefacts
):
    import scout_pin
    from scout_pin.report.drawn.sliders import slider_page

    page, file = slider_page(scout_pin.load()), tmp_path / "scout.html"
    file.write_bytes(page.html())
    opened(browser, file)
    assert browser.run("live.stand.readouts") == [list(one) for one in page.rig.start().readouts]
    number = next(k for k, one in enumerate(page.rig.sliders) if "left_knee" in one.name)
    browser.run(f"document.getElementById('slider-{number}').focus()")
    browser.press("ArrowRight")
    assert browser.run(f"live.stand.values[{number}]") != page.rig.start().values[number]
    assert {text for _, text in browser.run("live.stand.readouts")} == {"–"}
    assert "scout-pin view --sliders" in browser.run("panel.innerText")
    browser.still(artefacts / "alone_scout_1280.png")
    assert browser.complaints() == []
