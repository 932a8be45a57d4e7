"""Numbers that no walk is planned or simulated with are refused in the flag's own words."""

import pytest
from commands import run

PLAN = [
    (["--knee", "0.5"], "--knee is 0.5; allowed: a finite number of at least 1 and at most 80"),
    (["--knee", "0.2"], "[degrees]"),
    (["--step-length", "0.05"], "--step-length is 0.05 mm; allowed: at least 1 mm. Write it in mm"),
    (["--step-length", "0.1"], "--step-length is 0.1 mm; allowed: at least 1 mm. Write it in mm"),
    (["--step-length", "20000"], "--step-length is 20000"),
    (["--lift", "0.15"], "--lift is 0.15 mm; allowed: at least 1 mm. Write it in mm, as 15"),
    (["--foot-spacing", "0.3"], "--foot-spacing is 0.3 mm; allowed: at least 1 mm. Write it in mm"),
    (["--margin", "0.01"], "--margin is 0.01 mm; allowed: 0 or at least 0.1 mm. Write it in mm"),
    (["--height", "0.2", "0.24"], "--height is 0.2; allowed: a finite number of at least 1 and"),
    (["--servo-rate", "1e9"], "--servo-rate is 1e+09 Hz; allowed: 1 to 10000 Hz. Hobby servos"),
    (["--servo-rate", "0.02"], "--servo-rate is 0.02 Hz; allowed: 1 to 10000 Hz. Hobby servos"),
    (
        ["--step-length", "50", "--step-time", "0.4", "--walking-speed", "100"],
        "--step-length, --step-time and --walking-speed are all given; allowed: two of them",
    ),
    (["--fastest", "--step-time", "1"], "Leave --step-time or --fastest out"),
    (["--torque-reserve", "100"], "at least 0 and at most 95 [percent]"),
    (["--walking-speed", "20000"], "--walking-speed is 20000"),
    (["--walking-speed", "20000"], "at most 10000 [mm/s]"),
    (["--roll", "90"], "--roll is 90.0; allowed: "),
    (["--height", "0.2", "230"], "--height is 0.2; allowed: "),
    (["--height", "230", "200"], "--height is from 230 to 200 mm"),
    (["--friction", "1e-9"], "--friction is 1e-09"),
    (["--pitch", "0.15"], "--pitch is 0.15 degrees; allowed: at least 0.5 degrees. Write it in"),
    (["--roll", "0.2"], "--roll is 0.2 degrees"),
    (["--yaw", "0.1"], "--yaw is 0.1 degrees"),
    (["--side", "-0.02"], "--side is -0.02 mm; allowed: 0 or at least 1 mm. Write it in mm, as"),
    (["--turn", "0.17"], "--turn is 0.17 degrees; allowed: 0 or at least 0.5 degrees"),
    (["--turn", "200"], "--turn is 200.0; allowed: "),
    (["--side", "20000"], "--side is 20000"),
    (["--turn", "10", "--steps", "51"], "51 steps that turn"),
    (["--turn", "15", "--foot-spacing", "62"], "the soles touch where the feet are 62 mm apart"),
]
SIMULATE = [
    (["--floor-tilt", "80", "0"], "--floor-tilt is '80'; allowed: -45 to 45 degrees"),
    (["--servo-zero-error", "400"], "--servo-zero-error is '400'; allowed: 0 to 45 degrees"),
    (["--mass-error", "5"], "--mass-error is '5'; allowed: 0 to 0.3"),
]


@pytest.mark.parametrize(
    ("verb", "words", "said"),
    [("plan", *one) for one in PLAN] + [("simulate", *one) for one in SIMULATE],
)
def test_a_number_out_of_range_is_refused_in_the_unit_of_its_flag(verb, words, said, capfd):
    code, out, err = run(f"scout-pin {verb}", [verb, *words], capfd)
    assert (code, out) == (2, "")
    said_once = " ".join(err.split())
    assert said in said_once


@pytest.mark.parametrize("words", [["--servo-rate", "1e9"], ["--step-length", "0.1"]], ids=str)
def test_what_cant_be_meant_is_refused_before_a_walk_is_sought(words, monkeypatch, capfd):
    from scout_pin.study.plan import planning

    def sought(*_, **__):
        raise AssertionError("the search began")

    monkeypatch.setattr(planning, "plan_gait", sought)
    assert run("scout-pin plan", ["plan", *words], capfd)[0] == 2


@pytest.mark.parametrize("flag", ["pitch", "roll", "yaw", "knee", "lift", "torque-reserve"])
def test_the_ends_of_a_range_may_be_asked_for(flag, monkeypatch, capfd):
    from scout_pin.study.plan import planning
    from thesis_pin.errors import BadInput

    def seen(robot, request, **_):
        raise BadInput("that far")

    monkeypatch.setattr(planning, "plan_gait", seen)
    ends = {"knee": (1, 80), "lift": (1, 10000), "torque-reserve": (0, 95)}
    for end in ends.get(flag, (0.5, 85.9)):
        _, _, err = run("scout-pin plan", ["plan", f"--{flag}", str(end)], capfd)
        assert "that far" in err
