"""What a derivation's symbols must equal are Pinocchio's numbers, and their exact derivatives."""

import numpy as np
import pinocchio as pin
import pytest

from thesis_pin.audit.derivation.moving import coordinates
from thesis_pin.audit.derivation.moving.states import Frames, States
from thesis_pin.audit.derivation.moving.tree import Tree
from thesis_pin.audit.derivation.references import References
from thesis_pin.audit.derivation.said import phrases
from thesis_pin.audit.derivation.said.glossary import Glossary, key
from thesis_pin.equations.catalogue import Catalogue
from thesis_pin.equations.evaluation import evaluate
from thesis_pin.equations.notation import Notation
from thesis_pin.errors import ModelError
from thesis_pin.loops.loading import load

NOTATION = Notation(shorthand=(), ranges=())
TOOL, LINK = "tool0", "forearm_link"


def refers(robot, said, meant, equations=()):
    """References of symbols on a robot, and the model."""
    model = robot.model
    tree = Tree.of(model)
    given = coordinates.read(said, tree.names, "file")
    states = States.random(tree, Frames.of(model), given, model.gravity.linear)
    symbols = {key(NOTATION.symbol(k)): phrases.parse(text, "file") for k, text in meant.items()}
    named = {key(NOTATION.symbol(text)): k for k, text in enumerate(said)}
    glossary = Glossary(named, {}, symbols)
    return References(states, glossary, Catalogue(equations, NOTATION))


@pytest.fixture(scope="module")
def ur5():
    return load("example:ur5_robot")


@pytest.fixture(scope="module")
def all_joints(ur5):
    return {rf"\theta_{k + 1}": name for k, name in enumerate(list(ur5.model.names)[1:])}


def worth(references, formula):
    (node,) = NOTATION.parse(formula)
    return evaluate(node, references, {}).array


def each(references, model):
    """(number of a state, q, v, a, fresh data) of Pinocchio's."""
    states = references.states
    for k in range(len(states.x)):
        q = pin.integrate(model, pin.neutral(model), states.coordinates.q(states.x)[k])
        joints = states.coordinates.joint_rates
        yield k, q, joints @ states.v[k], joints @ states.a[k], model.createData()


def test_terms_of_the_motion_are_pinocchios(ur5, all_joints):
    words = {
        "M": "mass matrix",
        "C": "coriolis matrix",
        "V": "coriolis vector",
        "G": "gravity vector",
        "N": "bias vector",
        "F": "inertial force",
        "u": "torque",
        "T": "kinetic energy",
        "U": "potential energy",
        "L": "lagrangian",
        "E": "energy",
        "p": "momentum",
    }
    references, model = refers(ur5, all_joints, words), ur5.model
    found = {name: worth(references, name) for name in words}
    for k, q, v, a, data in each(references, model):
        mass = pin.crba(model, data, q)
        mass = np.triu(mass) + np.triu(mass, 1).T
        weight = pin.computeGeneralizedGravity(model, data, q)
        bias = pin.nonLinearEffects(model, data, q, v)
        kinetic = pin.computeKineticEnergy(model, data, q, v)
        potential = pin.computePotentialEnergy(model, data, q)
        expected = {
            "M": mass,
            "G": weight,
            "N": bias,
            "V": bias - weight,
            "F": mass @ a,
            "u": pin.rnea(model, data, q, v, a),
            "T": kinetic,
            "U": potential,
            "L": kinetic - potential,
            "E": kinetic + potential,
            "p": mass @ v,
        }
        for name, value in expected.items():
            np.testing.assert_allclose(found[name][k], value, atol=1e-11, err_msg=name)
        np.testing.assert_allclose(found["C"][k] @ v, bias - weight, atol=1e-11)


def test_christoffels_matrix_is_half_of_the_mass_matrixs_rate_and_a_skew_one(ur5, all_joints):
    references = refers(ur5, all_joints, {"M": "mass matrix", "C": "coriolis matrix"})
    skew = worth(references, r"\dot{M} - 2 C")
    np.testing.assert_allclose(skew, -np.swapaxes(skew, -1, -2), atol=1e-11)


def test_points_and_turns_are_pinocchios(ur5, all_joints):
    words = {
        "p": f"position of {TOOL}",
        "v": f"velocity of {TOOL}",
        "a": f"acceleration of {TOOL}",
        "w": f"angular velocity of {TOOL}",
        "b": f"angular acceleration of {TOOL}",
        "R": f"rotation of {TOOL}",
        "J": f"jacobian of {TOOL}",
        "r": f"position of {TOOL} in {LINK}",
        "x": f"velocity of {TOOL} along zx",
        "c": "position of centre",
        "g": f"position of centre of {LINK}",
    }
    references, model = refers(ur5, all_joints, words), ur5.model
    found = {name: worth(references, name) for name in words}
    frame, seen = model.getFrameId(TOOL), model.getFrameId(LINK)
    joint = model.frames[seen].parentJoint
    aligned = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
    for k, q, v, a, data in each(references, model):
        pin.forwardKinematics(model, data, q, v, a)
        pin.updateFramePlacements(model, data)
        speed = pin.getFrameVelocity(model, data, frame, aligned)
        change = pin.getFrameClassicalAcceleration(model, data, frame, aligned)
        placed = data.oMf[frame]
        expected = {
            "p": placed.translation,
            "R": placed.rotation,
            "v": speed.linear,
            "w": speed.angular,
            "a": change.linear,
            "b": change.angular,
            "J": pin.computeFrameJacobian(model, data, q, frame, aligned),
            "r": (data.oMf[seen].inverse() * placed).translation,
            "x": speed.linear[[2, 0]],
            "g": data.oMi[joint] * model.inertias[joint].lever,
            "c": pin.centerOfMass(model, data, q),
        }
        for name, value in expected.items():
            np.testing.assert_allclose(found[name][k], value, atol=1e-11, err_msg=name)


def test_derivatives_of_derivatives_are_the_law_of_motion(ur5, all_joints):
    """Lagrange's equation at every coordinate: a derivative by time of one by a rate."""
    references = refers(ur5, all_joints, {"L": "lagrangian", "u": "torque"})
    force = worth(references, "u")
    for k in range(6):
        momentum = rf"\frac{{\partial L}}{{\partial \dot\theta_{k + 1}}}"
        law = rf"\frac{{d}}{{dt}}{momentum} - \frac{{\partial L}}{{\partial \theta_{k + 1}}}"
        np.testing.assert_allclose(worth(references, law), force[:, k], atol=1e-10)


def test_coordinates_may_be_sums_of_joints_and_joints_may_stand_still(ur5):
    """Absolute angles: generalized forces belong to them by the power they have."""
    said = {"x": "shoulder_lift_joint - 90 deg", "y": "shoulder_lift_joint + elbow_joint"}
    words = {"u": "torque", "M": "mass matrix", "T": "kinetic energy"}
    references, model = refers(ur5, said, words), ur5.model
    force, mass, kinetic = (worth(references, name) for name in words)
    x, v = references.states.x, references.states.v
    for k, q, joint_v, joint_a, data in each(references, model):
        assert q[1] == pytest.approx(x[k, 0] + np.pi / 2)
        assert q[1] + q[2] == pytest.approx(x[k, 1])
        assert not q[[0, 3, 4, 5]].any()
        torque = pin.rnea(model, data, q, joint_v, joint_a)
        assert force[k] @ v[k] == pytest.approx(torque @ joint_v, abs=1e-11)
        assert 0.5 * v[k] @ mass[k] @ v[k] == pytest.approx(kinetic[k], abs=1e-12)


def test_entries_and_dots_follow_from_the_whole(ur5, all_joints):
    words = {"M": "mass matrix", "q": "coordinates", "u": "torque", "h": "torque entry 2"}
    references = refers(ur5, all_joints, words)
    np.testing.assert_array_equal(worth(references, "M_{12}"), worth(references, "M")[:, 0, 1])
    np.testing.assert_array_equal(worth(references, "h"), worth(references, "u_2"))
    np.testing.assert_array_equal(worth(references, r"\ddot q_3"), references.states.a[:, 2])
    rate = worth(references, r"\frac{d}{dt}\left(M \dot q\right)")
    expected = worth(references, r"\dot M \dot q + M \ddot q")
    np.testing.assert_allclose(rate, expected, atol=1e-11)


def test_a_motion_that_differs_from_pinocchios_is_refused(ur5, all_joints):
    references = refers(ur5, all_joints, {})
    heavier = ur5.model.copy()
    heavier.inertias[3].mass *= 1.0 + 1e-6
    with pytest.raises(ModelError, match="differs from Pinocchio's"):
        references.states.check(heavier)
    assert references.states.check(ur5.model) < 1e-12


def test_a_single_joint_is_the_pendulum_of_the_schoolbook(tmp_path):
    urdf = tmp_path / "pendulum.urdf"
    urdf.write_text(
        '<robot name="pendulum"><link name="base"/><joint name="pivot" type="continuous">'
        '<parent link="base"/><child link="bob"/><axis xyz="0 1 0"/></joint><link name="bob">'
        '<inertial><origin xyz="0 0 -0.4"/><mass value="2"/>'
        '<inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link></robot>'
    )
    references = refers(load(urdf), {r"\theta": "pivot"}, {"u": "torque entry 1"})
    states = references.states
    x, a = states.x[:, 0], states.a[:, 0]
    expected = (2 * 0.4**2 + 0.1) * a + 2 * 9.81 * 0.4 * np.sin(x)
    np.testing.assert_allclose(worth(references, "u"), expected, rtol=1e-12, atol=1e-12)


def test_what_a_line_sets_equal_on_its_way_is_defined_by_it_and_judged_where_it_is_used(rows):
    inertia = r"\begin{pmatrix} M + m & h_{21} \\ h_{22} & J + m \ell^2 \end{pmatrix}"
    found = rows(
        [
            ("h_{12}", ["h_{21}", "h_{22}", r"-m \ell \cos\theta"]),
            (r"\mathcal{D}", inertia),
            (r"\mathcal{D}", inertia.replace("h_{22}", "2 h_{22}")),
            ("h_{21}", "h_{12}"),
            ("h_{21}", "2 h_{12}"),
            (r"\mathcal{D}_{12}", ["k_{12}", "h_{22}"]),  # begins with what has a meaning
            (r"\mathcal{D}_{12}", "k_{12}"),
        ]
    )
    verdicts = [row.verdict for row in found]
    assert verdicts == [
        "not checkable",
        "holds",
        "unexplained",
        *("holds", "unexplained", "holds", "holds"),
    ]
    assert "it defines h_12, h_21, h_22" in found[0].reason


def test_a_line_that_sets_what_has_a_meaning_equal_to_what_it_defines_is_judged(rows):
    lines = [("h_{12}", [r"\mathcal{D}_{12}", right]) for right in (r"-m \ell \cos\theta", "m")]
    assert [row.verdict for row in rows(lines[:1])] == ["holds"]
    assert [row.verdict for row in rows(lines[1:])] == ["unexplained"]
