"""Orientations as CAM, robots and converters write them: one motion, whatever the columns."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

import pollard_pin
from pollard_pin.motion.files import load_path
from pollard_pin.motion.tables import read_poses
from thesis_pin.errors import BadInput, ModelWarning, SpecificationError, TrajectoryError
from thesis_pin.tables.orientations import from_euler, said_order

FORMS = ("psi", "quaternion", "negated", "rotation vector", "rpy", "ZYX", "ZYZ", "xyz")


def motion(seed=0, count=41):
    """Times, positions [m] and SciPy rotations of a smooth path within reach."""
    rng = np.random.default_rng(seed)
    time = np.linspace(0, 2, count)
    waves = np.sin(np.outer(time, rng.uniform(0.5, 2, 3)) + rng.uniform(0, 6, 3))
    angles = rng.uniform(-0.5, 0.5, 3) + rng.uniform(0.1, 0.6, 3) * waves
    place = [0.42, 0, 0.08] + 0.05 * np.sin(np.outer(time, [1.0, 1.3, 0.7]))
    return time, place, Rotation.from_euler("XYZ", angles)


def columns(form, turned):
    """Headings and values of one way to write rotations."""
    if form == "psi":
        theta, psi, phi = turned.as_euler("XYZ", degrees=True).T
        return "psi_deg,theta_deg,phi_deg", [psi, theta, phi]
    if form in ("quaternion", "negated"):
        x, y, z, w = turned.as_quat().T * (1 if form == "quaternion" else -1)
        return "qw,qz,qx,qy", [w, z, x, y]
    if form == "rotation vector":
        return "rx,ry,rz", list(turned.as_rotvec().T)
    if form == "rpy":
        return "roll_deg,pitch_deg,yaw_deg", list(turned.as_euler("xyz", degrees=True).T)
    return "a_deg,b_deg,c_deg", list(turned.as_euler(form, degrees=True).T)


def write(file, header, values):
    np.savetxt(file, np.column_stack(values), "%.17g", ",", header=header, comments="")
    return file


def euler(form):
    return form if form in ("ZYX", "ZYZ", "xyz") else None


@pytest.mark.parametrize("form", FORMS)
def test_every_way_to_write_a_path_gives_the_same_torques(tmp_path, pollard, form):
    time, place, turned = motion()
    torques = []
    for name in ("psi", form):
        heading, values = columns(name, turned)
        header = f"{heading},x_mm,t_ms,y_mm,z_mm"
        x, y, z = place.T * 1e3
        file = write(tmp_path / f"{name}.csv", header, [*values, x, time * 1e3, y, z])
        path = load_path(file, euler=euler(name))
        np.testing.assert_allclose(path.at(time).tool.rotation, turned.as_matrix(), atol=1e-12)
        report = pollard_pin.trajectory_report(pollard, path, samples=101)
        torques.append(report.torque)
    np.testing.assert_allclose(torques[1], torques[0], atol=1e-9)


@settings(
    max_examples=30, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(st.integers(0, 2**32 - 1), st.sampled_from(FORMS))
def test_random_motions_are_the_same_in_every_form(tmp_path, seed, form):
    time, place, turned = motion(seed)
    turned = Rotation.from_rotvec(np.outer(3 * time, [0, 0.6, 0.8])) * turned  # all around
    heading, values = columns(form, turned)
    file = write(tmp_path / "path.csv", f"t,x,y,z,{heading}", [time, place, *values])
    path = load_path(file, euler=euler(form))
    np.testing.assert_allclose(path.at(time).tool.rotation, turned.as_matrix(), atol=1e-9)
    fine = np.linspace(0, 2, 57)
    angles = columns("psi", turned)[1]
    named = write(tmp_path / "psi.csv", "t,x,y,z,psi_deg,theta_deg,phi_deg", [time, place, *angles])
    one, other = path.at(fine).tool, load_path(named).at(fine).tool
    np.testing.assert_allclose(one.omega, other.omega, atol=1e-8)
    np.testing.assert_allclose(one.alpha, other.alpha, atol=1e-6)


@pytest.mark.parametrize("order", ["ZYX", "XYZ", "ZYZ", "YXY", "zyx", "xzy", "zxz"])
def test_an_order_of_angles_is_the_product_it_says(order):
    angles = np.array([0.3, -0.8, 1.1])
    product = np.eye(3)
    for turn in said_order(order, "abc").split():  # as "Rz(a)"
        product = (
            product
            @ Rotation.from_rotvec(
                angles["abc".index(turn[3])] * np.eye(3)["xyz".index(turn[1])]
            ).as_matrix()
        )
    np.testing.assert_allclose(from_euler(order, angles[None])[0], product, atol=1e-14)


def test_angles_about_named_axes_may_stand_in_any_order_of_columns(tmp_path):
    time, place, turned = motion()
    x, y, z = turned.as_euler("xyz").T
    file = write(tmp_path / "path.csv", "t,x,y,z,rz,rx,ry", [time, place, z, x, y])
    for order, angles in (("xyz", (x, y, z)), ("ZYX", (z, y, x))):
        path = load_path(file, euler=order)
        expected = Rotation.from_euler(order, np.column_stack(angles)).as_matrix()
        np.testing.assert_allclose(path.at(time).tool.rotation, expected, atol=1e-12)
        assert any("Rz(rz) Ry(ry) Rx(rx)" in note for note in path.notes)


def test_what_was_taken_for_the_user_is_noted(tmp_path):
    time, place, turned = motion()
    for form, says in (
        ("rotation vector", "rotation vector"),
        ("rpy", "Rz(yaw) Ry(pitch) Rx(roll)"),
        ("ZYX", "Rz(a) Ry(b) Rx(c)"),
    ):
        heading, values = columns(form, turned)
        file = write(tmp_path / "path.csv", f"t,x,y,z,{heading}", [time, place, *values])
        assert any(says in note for note in load_path(file, euler=euler(form)).notes)


def test_rounded_quaternions_are_taken_and_brought_to_unit_length(tmp_path):
    time, place, turned = motion()
    file = tmp_path / "path.csv"
    rows = np.column_stack([time, place, turned.as_quat()])
    np.savetxt(file, rows, "%.3f", ",", header="t,x,y,z,qx,qy,qz,qw", comments="")
    found = load_path(file).at(time).tool.rotation
    np.testing.assert_allclose(np.linalg.det(found), 1, atol=1e-12)
    np.testing.assert_allclose(found, turned.as_matrix(), atol=3e-3)


TIMED = "t,x,y,z,"
ROWS = ("0,.4,0,.1,", "1,.4,.1,.1,", "2,.4,.2,.1,")


@pytest.mark.parametrize(
    ("heading", "cells", "order", "says"),
    [
        ("qx,qy,qz,qw", "1,1,1,1", None, r"csv:2: the quaternion's length is 2; allowed: unit"),
        ("qx,qy,qz,qw", "0,0,0,0", None, "length is 0"),
        ("qx,qy,qz", "0,0,0", None, "missing: qw"),
        ("a,b,c", "0,0,0", None, "nothing says in which order the angles a, b, c turn"),
        ("a,b,c", "0,0,0", "ZZX", "the order of the angles is 'ZZX'"),
        ("a,b,c", "0,0,0", "ZyX", "the order of the angles is 'ZyX'"),
        ("rx,ry,rz", "0,0,0", "ZYZ", "takes one twice"),
        ("psi,theta,phi", "0,0,0", "ZYX", r"are ours: Rx\(θ\) Ry\(ψ\) Rz\(φ\)"),
        ("qx,qy,qz,qw", "0,0,0,1", "ZYX", "have no order to choose"),
        ("rx,ry,rz,psi,theta,phi", "0,0,0,0,0,0", None, "given as psi, theta, phi and as rx"),
    ],
)
def test_orientations_that_could_mean_anything_are_refused(tmp_path, heading, cells, order, says):
    file = tmp_path / "path.csv"
    file.write_text("\n".join([TIMED + heading, *(row + cells for row in ROWS)]))
    with pytest.raises(BadInput, match=says):
        load_path(file, euler=order)


def test_half_a_turn_between_two_rows_names_their_lines(tmp_path):
    file = tmp_path / "path.csv"
    turned = ("0,0,0,1", "0,0,0,1", "1,0,0,0")
    rows = (row + cells for row, cells in zip(ROWS, turned, strict=True))
    file.write_text("\n".join(["# a comment", TIMED + "qx,qy,qz,qw", *rows]))
    with pytest.raises(
        TrajectoryError, match=r"path.csv:4 to .*path.csv:5: the tool turns by half"
    ):
        load_path(file)


def test_499_degrees_between_two_rows_are_139_and_noted_with_the_lines(tmp_path):
    file = tmp_path / "path.csv"
    file.write_text(
        "t,x,y,z,psi_deg,theta_deg,phi_deg\n0,.4,0,.1,0,0,0\n1,.4,.1,.1,0,0,0\n2,.4,.2,.1,0,0,499\n"
    )
    path = load_path(file)
    assert path.parameters["largest_turn"] == pytest.approx(np.radians(139))
    assert any("path.csv:3 to" in note and "139°" in note for note in path.notes)


NODES = """
format = 1
{top}
[[poses]]
time = 0
position = [0.4, 0, 0.1]
{first}
[[poses]]
time = 1
position = [0.4, 0.1, 0.1]
{last}
"""


@pytest.mark.parametrize(
    ("top", "line"),
    [
        ("", "orientation_deg = {ours}"),
        ("", "quaternion = {quaternion}"),
        ("", "rotation_vector = {vector}"),
        ('euler = "ZYX"', "orientation_deg = {zyx}"),
    ],
)
def test_toml_takes_the_same_forms(tmp_path, top, line):
    ends = Rotation.from_euler("XYZ", [[0.1, 0.2, 0.3], [0.4, -0.3, 1.2]])
    lines = []
    for end in ends:
        theta, psi, phi = end.as_euler("XYZ", degrees=True)
        forms = {
            "ours": [psi, theta, phi],
            "quaternion": (-end.as_quat()).tolist(),
            "vector": end.as_rotvec().tolist(),
            "zyx": end.as_euler("ZYX", degrees=True).tolist(),
        }
        lines.append(line.format(**forms).replace("np.float64(", "").replace(")", ""))
    file = tmp_path / "path.toml"
    file.write_text(NODES.format(top=top, first=lines[0], last=lines[1]))
    expected = ends.as_matrix()
    np.testing.assert_allclose(load_path(file).at([0, 1]).tool.rotation, expected, atol=1e-12)
    segments = (
        f"format = 1\n{top}\n[start]\nposition = [0.4, 0, 0.1]\n{lines[0]}\n[[segments]]\n"
        f'kind = "line"\nposition = [0.4, 0.1, 0.1]\nduration = 1.0\n{lines[1]}\n'
    )
    file.write_text(segments)
    np.testing.assert_allclose(load_path(file).at([0, 1]).tool.rotation, expected, atol=1e-12)


@pytest.mark.parametrize(
    ("top", "line", "says"),
    [
        ("", "quaternion = [1, 1, 0, 0]", "poses.1..quaternion.*length 1.41421; it must be 1"),
        ("", "quaternion = [0, 0, 0, 1]\norientation_deg = [0, 0, 0]", "second orientation"),
        ('euler = "ZZX"', "", "euler.*must be three axes"),
        ("speed = 0.1", "", "has a time, and a speed gives it"),
    ],
)
def test_bad_forms_in_toml_are_refused_with_their_key(tmp_path, top, line, says):
    file = tmp_path / "path.toml"
    file.write_text(NODES.format(top=top, first="", last=line))
    with pytest.raises(SpecificationError, match=says):
        load_path(file)


def test_flags_of_tables_are_refused_beside_toml(tmp_path):
    file = tmp_path / "path.toml"
    file.write_text(NODES.format(top="", first="", last=""))
    for flags, key in (({"euler": "ZYX"}, "euler"), ({"feed": 0.1}, "speed")):
        with pytest.raises(BadInput, match=f"{key} = "):
            load_path(file, **flags)


def test_a_path_as_a_robot_s_sheet_has_it_is_the_same_path(tmp_path):
    plain, sheet = tmp_path / "plain.csv", tmp_path / "sheet.csv"
    plain.write_text("t,x,y,z,psi,theta,phi\n0,0.45,0,0.3,0,0,0\n1,0.46,0,0.3,0,0,0\n")
    sheet.write_bytes(
        "\tTime [ms]\tX (mm)\tY (mm)\tZ (mm)\tψ [°]\tθ [°]\tφ [°]\tPrice\r\n"
        "0\t0\t450\t0\t300\t0\t0\t0\t1,299.00\r\n"
        "1\t1000\t460\t0\t300\t0\t0\t0\t12.50\r\n".encode("utf-16")
    )
    one, other = read_poses(plain), read_poses(sheet)
    assert [c.values.tolist() for c in one.position] == [c.values.tolist() for c in other.position]
    assert one.time.values.tolist() == other.time.values.tolist()
    assert (one.rotation == other.rotation).all()
    assert one.notes == ()
    assert any("UTF-16" in note for note in other.notes)
    assert any("Price" in note for note in other.notes)


def test_degrees_without_their_unit_are_asked_about(tmp_path):
    file = tmp_path / "a.csv"
    file.write_text("t,x,y,z,roll,pitch,yaw\n0,0.45,0,0.3,0,0,90\n1,0.46,0,0.3,0,0,92\n")
    with pytest.warns(ModelWarning, match="yaw reach 92 rad: if these are degrees"):
        poses = read_poses(file)
    assert any("as in yaw_deg" in note for note in poses.notes)
