"""Replays do what physics does: two engines agree, energy closes, unstable motions run away."""

import numpy as np
import pinocchio as pin
import pytest

import pollard_pin
from pollard_pin.specification import Specification
from pollard_pin.study.simulate import engines
from pollard_pin.study.simulate.conditions import Conditions
from pollard_pin.study.simulate.draws import simulate_path

pytest.importorskip("mujoco", reason="MuJoCo isn't installed: pip install 'thesis-pin[simulate]'")

BOTH = pytest.mark.parametrize("engine", ["mujoco", "pinocchio"])


def criterion(simulation, name):
    (one,) = [one for one in simulation.criteria if one.name == name]
    return one


@BOTH
def test_under_servos_the_tool_keeps_within_a_hundredth_of_a_millimetre(short_report, held, engine):
    done = simulate_path(short_report, held(engine=engine))
    assert done.passed, done.verdict()
    assert done.replay.peak_deviation[0] < 1e-5
    assert done.replay.ended == (pytest.approx(1.2), "")
    np.testing.assert_allclose(done.replay.time[[0, -1]], [0.0, 1.2], atol=1e-12)


def test_both_engines_take_a_robot_of_wrong_masses_the_same_way(short_report, held):
    """It leaves the plan by a tenth of a millimetre; their difference is a hundredth of that."""
    found = {
        engine: simulate_path(
            short_report, held(engine=engine, mass_error=0.1, time_step=5e-4, seed=4)
        ).replay
        for engine in ("mujoco", "pinocchio")
    }
    one, other = found["mujoco"], found["pinocchio"]
    off = np.abs(one.q - one.planned).max()
    assert off > 1e-4
    np.testing.assert_allclose(one.time, other.time, atol=1e-12)
    assert np.abs(one.q - other.q).max() < 0.01 * off


@pytest.mark.parametrize(
    ("engine", "asked", "step"),
    [
        ("mujoco", 1e-3, 1e-3),
        ("mujoco", None, 5e-4),
        ("mujoco", 1e-4, 1e-4),
        ("pinocchio", 4e-3, 4e-3),
        ("pinocchio", None, 2e-3),
    ],
)
def test_energy_closes_and_loops_stay_closed_at_several_time_steps(open_loop, engine, asked, step):
    """Open loop until the tool is lost, some joules exchanged: a thousandth is what others lose."""
    done = open_loop(engine, asked)
    assert done.prepared.time_step == pytest.approx(step)
    assert done.replay.exchanged > 1.0
    for name in ("energy", "opening"):
        assert criterion(done, name).met, criterion(done, name).words
    assert done.replay.relative_energy_error < 3e-8
    assert done.replay.peak_opening[0] < 1e-7


def test_work_is_the_integral_of_torque_times_rate(short_report, held):
    """By the trapezoidal rule over what was recorded, each 2.5 ms."""
    replay = simulate_path(short_report, held()).replay
    motors = list(short_report.robot.actuated)
    power = (replay.torque * replay.v[:, motors]).sum(axis=1)
    found = np.concatenate([[0.0], np.cumsum(np.diff(replay.time) * (power[1:] + power[:-1]) / 2)])
    np.testing.assert_allclose(replay.work.sum(axis=1), found, atol=2e-3 * replay.exchanged)


def test_energy_is_pinocchios(short_report, held):
    """Of the mass matrix, and of every body's height."""
    replay = simulate_path(short_report, held()).replay
    model = short_report.robot.model
    data, energy = model.createData(), []
    for q, v in zip(replay.q[::20], replay.v[::20], strict=True):
        mass = pin.crba(model, data, q)
        mass = np.triu(mass) + np.triu(mass, 1).T
        height = pin.centerOfMass(model, data, q)[2]
        energy.append(v @ mass @ v / 2 + pin.computeTotalMass(model) * 9.81 * height)
    np.testing.assert_allclose(replay.energy[::20], np.array(energy) - energy[0], atol=1e-12)


def test_an_integrator_that_loses_energy_fails_by_it(short_report, held, monkeypatch):
    class Lossy(engines.Springs):
        def __init__(self, *arguments):
            super().__init__(*arguments)
            self.engine.model.opt.integrator = self.engine.mujoco.mjtIntegrator.mjINT_EULER

    monkeypatch.setattr(engines, "Springs", Lossy)
    done = simulate_path(short_report, held())
    assert not done.passed
    assert [one.name for one in done.criteria if not one.met] == ["energy"]
    assert any("Take shorter steps" in one for one in done.verdict())


@BOTH
def test_open_loop_the_default_path_is_lost_and_the_reason_is_its_instability(open_loop, engine):
    done = open_loop(engine)
    assert not done.passed
    assert 1.0 < done.replay.left < 4.0
    assert done.replay.ended[1] == "the tool is 50 mm off its path"
    assert done.replay.deviation[-1] == pytest.approx(0.05, rel=0.05)
    growth = done.prepared.growth
    assert done.replay.slope == pytest.approx(growth.factor[-1] / growth.time[-1], rel=0.03)
    (reason,) = [one for one in done.verdict() if one.startswith("The reason")]
    assert "by a factor of e each 0.140 s" in reason
    assert done.verdict()[0].startswith("FAIL")


def test_recorded_torques_of_an_open_loop_are_the_plans(default_report, open_loop):
    done = open_loop("mujoco")
    time = done.replay.time[:-1]
    joints = pollard_pin.joint_trajectory(default_report.robot, default_report.path.at(time))
    plan = pollard_pin.inverse_dynamics(
        default_report.robot, default_report.path.at(time), joints
    ).torque
    step = done.prepared.time_step  # held since, so that it is that of half a step later
    change = np.abs(np.gradient(plan, time, axis=0)).max()
    assert np.abs(done.replay.torque[:-1] - plan).max() < change * step
    later = default_report.path.at(time + step / 2)
    joints = pollard_pin.joint_trajectory(default_report.robot, later)
    plan = pollard_pin.inverse_dynamics(default_report.robot, later, joints).torque
    off = np.abs(done.replay.torque[:-1] - plan).max(axis=1)
    assert np.median(off) < 0.01 * change * step  # a stretch ends with the torque held before


@BOTH
def test_a_motor_that_is_too_weak_is_named_and_fails(short_report, held, engine):
    weak = short_report.robot.specification
    peak = short_report.actuators.peak_torque
    effort = tuple((1.5 * peak * [0.5, 1, 1, 1, 1, 1] + 1e-3).tolist())
    limits = weak.assumptions.joint_limits.model_copy(update={"effort": effort})
    assumptions = weak.assumptions.model_copy(update={"joint_limits": limits})
    robot = pollard_pin.load(weak.model_copy(update={"assumptions": assumptions}))
    report = pollard_pin.trajectory_report(robot, short_report.path, samples=101)
    done = simulate_path(report, held(engine=engine))
    assert not done.passed
    one = criterion(done, "saturation")
    assert not one.met
    assert one.words.startswith("θ21 is at its largest torque")
    at_limit = np.abs(done.replay.torque[:, 0]) >= effort[0] * (1 - 1e-12)
    assert done.replay.saturated[0] == pytest.approx(at_limit.mean(), abs=0.02)
    assert done.replay.saturated[0] > 0.01
    assert done.verdict()[1].startswith("The plan asks more than the motors give: θ21 for ")
    assert np.abs(done.replay.torque[:, 0]).max() == pytest.approx(effort[0])


@BOTH
def test_rotors_and_unequal_chains_are_simulated_too(short_report, held, engine):
    """Of the skewed robot: β54 ≠ 0, other lengths, another branch of its own."""
    from pollard_pin.specification import SKEWED_PATH

    spec = Specification.read(SKEWED_PATH)
    motors = spec.motors.model_copy(update={"rotor_inertia": 2e-6, "gear_ratio": 30.0})
    robot = pollard_pin.load(spec.model_copy(update={"motors": motors}))
    report = pollard_pin.trajectory_report(robot, short_report.path, samples=101)
    done = simulate_path(report, held(engine=engine))
    assert done.passed, done.verdict()
    assert done.replay.relative_energy_error < 1e-7


@BOTH
def test_a_plan_that_no_motor_carries_is_told_from_its_first_instants(engine):
    """Appendix B in 0.3 s: a thousand newton metres; one engine gives up, the other is lost."""
    robot = pollard_pin.load()
    path = pollard_pin.appendix_b(robot.specification, duration=0.3)
    report = pollard_pin.trajectory_report(robot, path, samples=101)
    done = simulate_path(report, Conditions(engine=engine))
    assert not done.passed
    assert done.replay.ended[0] < 0.02
    assert done.replay.ended[1]
    assert done.reason is None  # it is the motors
    assert done.verdict()[1].startswith("The plan asks more than the motors give: θ21 for 1")
    assert len(done.replay.time) == len(done.replay.deviation) >= 1
    assert done.replay.deviation[0] == 0


def test_servos_too_soft_are_told_so(default_report):
    done = simulate_path(default_report, Conditions(stiffness=(0.5, 0.5, 0.5, 0.1, 0.1, 0.01)))
    assert not done.passed
    assert done.reason.startswith("The reason: these servos are too soft to correct errors")
    assert done.reason.endswith("Stiffer ones end it.")
    growth = done.prepared.growth
    assert 0 < growth.factor[-1] / growth.time[-1] < 7.0
