"""Cones that are known from an earlier time."""

import runpy
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import scout_pin
from scout_pin.specification import CONES_PATH
from thesis_pin.contacts.cones import Contact
from thesis_pin.contacts.known import contacts_of, known_form

SCRIPT = runpy.run_path(str(Path(__file__).parents[3] / "docs" / "shipped.py"))
SOLE = np.array([[0.0, 0.0], [0.1, 0.0], [0.1, 0.2], [0.0, 0.2]])


def same(one, other):
    assert one.friction == other.friction
    for name in ("outline", "hull", "rays"):
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name))
    # Facets are rounded to 1e-12, and sorted: rounding may exchange neighbours.
    assert one.facets.shape == other.facets.shape
    near = np.abs(one.facets[:, None] - other.facets[None]).max(axis=2)
    assert near.min(axis=1).max() < 1e-11


def test_known_facets_are_those_of_the_shipped_soles():
    for known, anew in zip(scout_pin.load().contacts, SCRIPT["cones"](), strict=True):
        same(known, anew)


def test_the_shipped_robot_needs_no_qhull():
    code = "import sys, scout_pin\nscout_pin.load().contacts\nprint('scipy' in sys.modules)"
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert ran.stdout == "False\n"


@pytest.mark.parametrize("change", ["friction", "corner"])
def test_another_sole_gets_its_own_cone(change):
    outline = np.array(scout_pin.Specification.read().legs.left.sole)
    friction = 0.5 if change == "friction" else 0.6
    outline[0, 0] -= 0.0 if change == "friction" else 1e-9
    (found,) = contacts_of([outline], friction, CONES_PATH)
    same(found, Contact.from_outline(outline, friction))


@pytest.mark.parametrize("text", [None, "", "{}", "[]"])
def test_without_a_file_cones_are_found_anew(tmp_path, text):
    path = tmp_path / "cones.json"
    if text is not None:
        path.write_text(text)
    (found,) = contacts_of([SOLE], 0.7, path)
    same(found, Contact.from_outline(SOLE, 0.7))


def test_of_several_soles_each_gets_its_own_cone(tmp_path):
    path = tmp_path / "cones.json"
    other = SOLE * [1.0, 2.0]
    path.write_text(known_form([Contact.from_outline(other, 0.7)]))
    for found, outline in zip(contacts_of([SOLE, other], 0.7, path), (SOLE, other), strict=True):
        same(found, Contact.from_outline(outline, 0.7))
