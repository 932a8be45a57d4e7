"""A robot with loops is called sound only if it closes and has one meaning."""

import pickle
from pathlib import Path

import numpy as np
import pytest

from thesis_pin.errors import ModelError, SingularPose, Undecidable
from thesis_pin.loops.checking import soundness
from thesis_pin.loops.dynamics import inverse_dynamics
from thesis_pin.loops.kinematics import close, residual
from thesis_pin.loops.loading import load

DATA = Path(__file__).parents[1] / "data"


def robot(name):
    return load(DATA / f"{name}.urdf", DATA / f"{name}.yaml")


@pytest.mark.parametrize(
    ("name", "freedom", "held"), [("four_bar", 1, 1), ("five_bar", 2, 2), ("rssr", 2, 1)]
)
def test_mechanisms_of_known_freedom_are_sound_and_found_closed(name, freedom, held):
    # The four-bar and five-bar linkages of every textbook; in RSSR the coupler spins by itself.
    one = robot(name)
    found = soundness.check(one)
    assert found.sound
    assert found.mobility.freedom == freedom
    assert found.mobility.held == held
    assert abs(residual(one, found.closed)).max() < 1e-6
    assert ("by itself" in " ".join(found.sentences())) == (held < freedom)


def test_a_description_of_which_nothing_moves_is_refused_by_its_name(tmp_path):
    still = tmp_path / "still.urdf"
    still.write_text('<robot name="table"><link name="top"/></robot>')
    with pytest.raises(ModelError, match="no joint of 'table' moves"):
        soundness.check(load(still))


def test_bars_that_cannot_meet_are_not_sound(tmp_path):
    # Crank 0.1, coupler 0.3 and rocker 0.25 m don't span 3 m.
    text = (DATA / "four_bar.urdf").read_text()
    assert text.count('<origin xyz="0.3 0 0"/>') == 1
    far = tmp_path / "far.urdf"
    far.write_text(text.replace('<origin xyz="0.3 0 0"/>', '<origin xyz="3 0 0"/>'))
    found = soundness.check(load(far, DATA / "four_bar.yaml"))
    assert not found.sound
    document = found.document()
    assert (document["closes"], document["freedom"]) == (False, None)
    assert "No closed configuration" in document["explanation"]


def test_a_pose_where_branches_cross_is_named_as_what_the_dynamics_refuse(tmp_path):
    # Crank and coupler as long as rocker and ground: flat at zero, where it goes on either way.
    text = (DATA / "four_bar.urdf").read_text()
    flat, pose = tmp_path / "flat.urdf", tmp_path / "flat.toml"
    text = text.replace('<origin xyz="0.3 0 0"/>', '<origin xyz="0.15 0 0"/>')
    flat.write_text(text.replace('upper="3.0"', 'upper="4.0"'))
    pose.write_text(f"format = 1\n[joints]\npin_b = {np.pi}\n")
    one = load(flat, DATA / "four_bar.yaml")
    found = soundness.check(one, pose=str(pose))
    assert (found.mobility.independent, found.mobility.elsewhere) == (2, 3)
    assert found.document()["freedom"]["independent_elsewhere"] == 3
    assert "3 equations are independent: branches cross" in " ".join(found.sentences())
    still = np.zeros(one.model.nv)
    with pytest.raises(SingularPose, match=r"3 equations .* branches cross"):
        inverse_dynamics(one, found.closed, still, still)
    bent = soundness.check(robot("four_bar"))
    assert bent.mobility.independent == bent.mobility.elsewhere
    assert "branches cross" not in " ".join(bent.sentences())


def test_what_another_reader_reads_differently_is_not_called_sound(monkeypatch):
    said = "the mass of link 'crank' is 1 and 2"
    monkeypatch.setattr(soundness, "second_reading", lambda _: [said])
    found = soundness.check(robot("four_bar"))
    assert found.closes
    assert not found.sound
    assert said in found.document()["explanation"]


def leaning(folder, angle):
    """The four-bar with its motor's axis off the others' by an angle."""
    text = (DATA / "four_bar.urdf").read_text()
    path = folder / "leaning.urdf"
    path.write_text(text.replace('<axis xyz="0 1 0"/>', f'<axis xyz="{angle} 1 0"/>', 1))
    return path


def test_a_freedom_that_nobody_can_tell_is_a_finding_with_both_answers(tmp_path):
    # Parallel axes: one freedom, as in every textbook. Four that aren't leave a structure.
    found = soundness.check(load(leaning(tmp_path, 7e-4), DATA / "four_bar.yaml"))
    assert (found.sound, found.closes, found.mobility) == (False, True, None)
    doubt = found.undecided
    assert [one.freedom for one in doubt.choices] == [0, 1]
    assert doubt.choices[0].precision == 0
    assert 1e-4 < doubt.weakest < 7e-4 < doubt.choices[1].precision < 1e-3
    assert doubt.loops == (found.robot.loops[0].name,)
    assert "axis 0.0007 of motor" in doubt.digits
    document = found.document()
    assert document["undecided"]["choices"][1]["freedom"] == 1
    assert (document["sound"], document["held"], document["freedom"]) == (False, None, None)
    assert document["assembly"]["gaps"][0]["distance"] < 1e-6
    assert "can't be told" in document["explanation"]


def test_a_precision_decides_what_nobody_can_tell(tmp_path):
    one = load(leaning(tmp_path, 7e-4), DATA / "four_bar.yaml")
    for choice in soundness.check(one).undecided.choices:
        found = soundness.check(one, precision=choice.precision)
        assert found.undecided is None
        assert found.mobility.freedom == choice.freedom


def test_the_refusal_keeps_its_numbers_on_its_way_from_another_process(tmp_path):
    one = load(leaning(tmp_path, 7e-4), DATA / "four_bar.yaml")
    with pytest.raises(Undecidable, match="nearly dependent") as caught:
        close(one, one.q0)
    again = pickle.loads(pickle.dumps(caught.value))
    assert (again.loops, again.precision) == (caught.value.loops, caught.value.precision)
    assert str(again) == str(caught.value)
