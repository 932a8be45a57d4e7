"""Short paths on which the arm stands, with servos that hold it."""

from functools import cache

import pytest

import pollard_pin
from pollard_pin.study.simulate.conditions import Conditions
from pollard_pin.study.simulate.draws import simulate_path

GAINS = (30.0, 30.0, 30.0, 0.3, 0.3, 0.01)


@pytest.fixture(scope="session")
def default_report():
    """Appendix B in 20 s at constant rate."""
    robot = pollard_pin.load()
    return pollard_pin.trajectory_report(
        robot, pollard_pin.appendix_b(robot.specification), samples=401
    )


@pytest.fixture(scope="session")
def arch(tmp_path_factory):
    """An arch of 1.2 s with the tool nodding, from rest to rest."""
    file = tmp_path_factory.mktemp("paths") / "arch.toml"
    file.write_text(
        'format = 1\nname = "arch"\n[start]\nposition = [0.45, -0.15, 0.0]\n'
        '[[segments]]\nkind = "arc"\nvia = [0.5, -0.05, 0.07]\nposition = [0.45, 0.05, 0.0]\n'
        "orientation_deg = [0.0, 15.0, 10.0]\nduration = 1.2\n"
    )
    return pollard_pin.load_path(file)


@pytest.fixture(scope="session")
def short_report(arch):
    """What the motors have to do on it."""
    return pollard_pin.trajectory_report(pollard_pin.load(), arch, samples=401)


@pytest.fixture(scope="session")
def held():
    """Conditions with servos, and more of them."""
    return lambda **more: Conditions(stiffness=GAINS, **more)


@pytest.fixture(scope="session")
def open_loop(default_report):
    """Appendix B without servos in an engine, by its name and perhaps its time step."""
    pytest.importorskip(
        "mujoco", reason="MuJoCo isn't installed: pip install 'thesis-pin[simulate]'"
    )

    @cache
    def done(engine, step):
        return simulate_path(default_report, Conditions(engine=engine, time_step=step))

    return lambda engine, step=None: done(engine, step)
