"""Paths from files: CSV in any order of columns, TOML, and refusals with their place."""

import numpy as np
import pytest

from pollard_pin.motion.files import load_path
from thesis_pin.errors import BadInput, SpecificationError, TrajectoryError

HEADER = "time_s,x_m,y_m,z_m,psi_deg,theta_deg,phi_deg\n"


def write(tmp_path, name, text):
    file = tmp_path / name
    file.write_text(text)
    return file


def test_csv_columns_may_be_in_any_order_and_in_degrees(tmp_path):
    rows = "phi_deg,time_s,x_m,y_m,z_m,psi_deg,theta_rad\n90,0,.4,0,0,45,1\n0,2,.5,.1,0,0,0\n"
    path = load_path(write(tmp_path, "a.csv", rows))
    assert path.duration == 2.0
    pose = path.at(0.0).pose[0]
    np.testing.assert_allclose(pose, [0.4, 0, 0, np.pi / 4, 1.0, np.pi / 2], atol=1e-14)


def test_csv_without_a_header_is_seven_columns_in_radians(tmp_path):
    path = load_path(write(tmp_path, "a.csv", "1,.4,0,0,.1,.2,.3\n2,.5,0,0,0,0,0\n"))
    np.testing.assert_allclose(path.at(0.0).pose[0], [0.4, 0, 0, 0.1, 0.2, 0.3], atol=1e-14)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("0,1,2,3\n1,1,2,3\n", "4 columns without a header"),
        ("time_s,x_m,y_m,z_m\n0,1,2,3\n", "missing: psi or psi_rad or psi_deg"),
        (HEADER + "0,.4,0,0,0,0,0\n2,.4,0,0,0,0,0\n1,.4,0,0,0,0,0\n", "csv:4: time goes from 2"),
        (HEADER + "0,.4,0,0,0,0,0\n1,.4,0,0,0,0\n", "csv:3: 6 cells"),
        (HEADER + "0,.4,0,0,0,0,0\n1,.4,0,nan,0,0,0\n", "csv:3, column 4: z is 'nan'"),
        (HEADER + "0,.4,0,0,0,0,0\n1,.4,0,zero,0,0,0\n", "z is 'zero'; allowed: a finite number"),
        (HEADER + "0,.4,0,0,0,0,0\n", "1 pose;"),
        (HEADER, "0 poses"),
        ("", "the path is empty"),
        (
            HEADER.replace("psi_deg", "psi_deg,psi_rad") + "0,.4,0,0,0,0,0,0\n",
            "columns 'psi_deg' and 'psi_rad' say the same",
        ),
    ],
)
def test_a_bad_csv_is_refused_with_line_and_reason(tmp_path, text, says):
    with pytest.raises(BadInput, match=says.replace("(", r"\(")):
        load_path(write(tmp_path, "bad.csv", text))


SEGMENTS = """
format = 1
name = "arch"
[start]
position = [0.4, 0.0, 0.0]
[[segments]]
kind = "line"
position = [0.45, 0.0, 0.05]
orientation_deg = [0, 10, 0]
duration = 1.0
[[segments]]
kind = "arc"
via = [0.45, 0.05, 0.1]
position = [0.45, 0.1, 0.05]
duration = 2.0
"""


def test_toml_segments_follow_each_other(tmp_path):
    path = load_path(write(tmp_path, "a.toml", SEGMENTS))
    assert path.name == "arch"
    assert path.duration == 3.0
    poses = path.at([0.0, 1.0, 2.0, 3.0]).pose
    np.testing.assert_allclose(poses[0], [0.4, 0, 0, 0, 0, 0], atol=1e-12)
    np.testing.assert_allclose(poses[1, :3], [0.45, 0, 0.05], atol=1e-12)
    np.testing.assert_allclose(poses[2, :3], [0.45, 0.05, 0.1], atol=1e-12)
    np.testing.assert_allclose(poses[3, 4], np.radians(10), atol=1e-12)


def test_toml_poses_are_splined(tmp_path):
    text = "format = 1\n" + "".join(
        f"[[poses]]\ntime = {t}\nposition = [{x}, 0, 0]\n"
        for t, x in ((0, 0.4), (1, 0.5), (3, 0.4))
    )
    path = load_path(write(tmp_path, "a.toml", text))
    np.testing.assert_allclose(path.at([0, 1, 3]).pose[:, 0], [0.4, 0.5, 0.4], atol=1e-12)


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("duration = 1.0", "duration = -1.0", "toml:10: segments.0..duration"),
        ('kind = "line"', 'kind = "spiral"', "spiral"),
        ("via = [0.45, 0.05, 0.1]", "", "segments.1..via"),
        ("[start]\nposition = [0.4, 0.0, 0.0]", "", "need a .start."),
        ("format = 1", "format = 2", "format"),
        ("via = [0.45, 0.05, 0.1]", "via = [0.45, 0.05, 0.05]", "lie on a line"),
        ("duration = 1.0", 'duration = 1.0\ntiming = "constant-rate"', "rate jumps"),
    ],
)
def test_a_bad_toml_path_is_refused_with_key_and_reason(tmp_path, old, new, says):
    file = write(tmp_path, "bad.toml", SEGMENTS.replace(old, new))
    with pytest.raises((SpecificationError, TrajectoryError), match=says):
        load_path(file)


def test_toml_poses_with_time_going_backwards_are_refused(tmp_path):
    text = "format = 1\n" + "".join(
        f"[[poses]]\ntime = {t}\nposition = [0.4, 0, 0]\n" for t in (0, 2, 1)
    )
    with pytest.raises(SpecificationError, match="time goes from 2 to 1"):
        load_path(write(tmp_path, "a.toml", text))


def test_an_unknown_file_type_is_refused():
    with pytest.raises(BadInput, match=r"\.csv or \.toml"):
        load_path("path.xlsx")
