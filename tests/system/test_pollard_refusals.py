"""What the command pollard-pin refuses or answers by no: one message, its reason, and no files."""

import json

import numpy as np
import pytest

POSES = "time_s,x_m,y_m,z_m,psi_deg,theta_deg,phi_deg\n"
CROSSING = POSES + "0,0.45,0,-0.1,0,0,0\n2,0.25,0,-0.1,0,0,0\n"
BACKWARDS = POSES + "0,0.45,0,0,0,0,0\n2,0.46,0,0,0,0,0\n1,0.47,0,0,0,0,0\n"


def bad_inputs(folder):
    """Command lines that must be refused, with a word of the reason."""
    files = {
        "crossing.csv": CROSSING,
        "backwards.csv": BACKWARDS,
        "four.csv": "0,0.45,0,0\n1,0.46,0,0\n",
        "broken.toml": "format = 1\nname = 3\n",
        "untimed.csv": "x,y,z,a,b,c\n.4,0,0,0,0,0\n.4,.1,0,0,0,0\n",
    }
    for name, text in files.items():
        (folder / name).write_text(text)
    return {
        "singular pose": (
            # Straight up the wrist: with the elbow up, tool along the forearm.
            ("ik", "--branch=-++-+++", *straight_wrist()),
            "wrist straight",
        ),
        "path across a singularity": (
            ("trajectory", "--path", folder / "crossing.csv"),
            "determinant of the three base motors changes sign",
        ),
        "the print unshifted": (
            ("trajectory", "--placement", "0", "0", "0"),
            "too near to the shoulder",
        ),
        "four columns": (("trajectory", "--path", folder / "four.csv"), "4 columns"),
        "time backwards": (
            ("trajectory", "--path", folder / "backwards.csv"),
            "backwards.csv:4: time goes from 2 to 1",
        ),
        "path and duration": (
            ("trajectory", "--path", folder / "crossing.csv", "--duration", "3"),
            "--duration belongs to appendix B",
        ),
        "feed without a path": (("trajectory", "--feed", "0.1"), "--feed belongs to a path"),
        "feed beside times": (
            ("trajectory", "--path", folder / "crossing.csv", "--feed", "0.1"),
            "the path has times",
        ),
        "timing beside times": (
            ("trajectory", "--path", folder / "crossing.csv", "--timing", "ramped"),
            "the path has times",
        ),
        "neither time nor feed": (
            ("trajectory", "--path", folder / "untimed.csv", "--euler", "ZYX"),
            "neither a column of time nor a speed",
        ),
        "no order of angles": (
            ("trajectory", "--path", folder / "untimed.csv", "--feed", "0.1"),
            "nothing says in which order the angles a, b, c turn",
        ),
        "no order at all": (
            ("trajectory", "--path", folder / "untimed.csv", "--euler", "ABC"),
            "the order of the angles is 'ABC'",
        ),
        "missing path": (("trajectory", "--path", folder / "none.csv"), "can't read the path"),
        "broken specification": (
            ("trajectory", "--specification", folder / "broken.toml"),
            "problems in the specification",
        ),
        "branch": (("ik", "0.45", "0", "0", "0", "0", "0", "--branch=+-"), "seven signs"),
        "axis the wrong way": (("workspace", "--x", "0.8", "0.1"), "ascending"),
    }


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (("ik", "2", "0", "0", "0", "0", "0"), "too far from the shoulder"),
        (("ik", "0.07", "0", "0.05", "0", "0", "0"), "too near to the shoulder"),
        (("fk", "-35", "-140", "140", "0", "20", "0"), "no assembly mode"),
    ],
)
def test_what_cannot_be_reached_is_answered_by_no_and_the_reason(pollard_pin, arguments, says):
    done = pollard_pin(*arguments)
    assert (done.returncode, done.stderr) == (1, "")
    assert says in " ".join(done.stdout.split())
    document = pollard_pin(*arguments, "--json", "-")
    assert (document.returncode, document.stderr) == (1, "")
    assert says in json.loads(document.stdout)["explanation"]


def straight_wrist():
    from pollard_pin.model import load

    robot = load()
    angles = robot.inverse_kinematics([0.45, 0.03, 0.02, 0.0, 0.0, 0.0]).angles.copy()
    angles[4] = 0.0
    pose = robot.pose(angles)
    pose[3:] = np.degrees(pose[3:])
    return ["--", *map(repr, pose.tolist())]


def test_every_bad_input_gets_one_message_exit_code_2_and_writes_nothing(pollard_pin, tmp_path):
    inputs, out = tmp_path / "inputs", tmp_path / "out"
    inputs.mkdir()
    out.mkdir()
    for name, (arguments, says) in bad_inputs(inputs).items():
        arguments = list(map(str, arguments))
        flags = ["--json", str(out / "x.json")]
        if arguments[0] in ("trajectory", "workspace"):
            flags += ["--out", str(out / "new")]
        done = pollard_pin(arguments[0], *flags, *arguments[1:])
        assert done.returncode == 2, (name, done.stdout, done.stderr)
        assert says in " ".join(done.stderr.split()), (name, done.stderr)
        assert done.stderr.startswith("pollard-pin: error: "), name
        assert "Traceback" not in done.stderr, name
        assert done.stdout == "", name
        assert list(out.iterdir()) == [], name


@pytest.mark.parametrize(
    "arguments",
    [
        ("trajectory", "--samples", "1"),
        ("trajectory", "--duration", "-3"),
        ("trajectory", "--actuators", "four"),
        ("ik", "1", "2", "nan", "0", "0", "0"),
        ("fly",),
    ],
)
def test_a_bad_flag_is_refused_by_name(pollard_pin, arguments):
    done = pollard_pin(*arguments)
    assert done.returncode == 2
    assert "usage: pollard-pin" in done.stderr
    assert done.stdout == ""


def test_an_unwritable_place_is_named(pollard_pin, tmp_path):
    blocked = tmp_path / "file"
    blocked.write_text("")
    done = pollard_pin("trajectory", "--samples", "11", "--json", blocked / "x.json")
    assert done.returncode == 3
    assert str(blocked) in done.stderr.replace("\n", "")
