"""A robot with loops is called sound only if it closes and has one meaning."""

from pathlib import Path

import pytest

from thesis_pin.loops import soundness
from thesis_pin.loops.kinematics import residual
from thesis_pin.loops.loading import load

DATA = Path(__file__).parent / "data"


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


def test_what_another_reader_reads_differently_is_not_called_sound(monkeypatch):
    said = "the mass of link 'crank' is 1 and 2"
    monkeypatch.setattr(soundness, "second_reading", lambda _: [said])
    found = soundness.check(robot("four_bar"))
    assert found.closes
    assert not found.sound
    assert said in found.document()["explanation"]
