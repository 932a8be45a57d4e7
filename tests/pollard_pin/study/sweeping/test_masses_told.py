"""What a sweep of another robot doesn't count is said with its answer."""

import pytest

import pollard_pin
import thesis_pin
from thesis_pin.sweep.result import Effort, Sweep


@pytest.mark.parametrize(
    ("varied", "told"),
    [
        (["chain_*.x_43=0.3,0.36"], True),
        (["chain_*.x_43=0.3,0.36", "place.position.0=0,0.1"], True),
        (["chain_*.x_43=0.3,0.36", "chain_*.links.*.mass=90%,110%"], False),
        (["place.position.0=0,0.1"], False),
    ],
)
def test_kept_masses_are_said_where_the_robot_varies_without_them(varied, told):
    study = pollard_pin.path_study()
    designs = thesis_pin.make_designs(study, varied)
    choice = thesis_pin.Choice.of(Sweep(study, designs, (), Effort(0, None, 0, 0.0, 0.0)))
    assert any("Masses and inertias stay" in one for one in choice.sentences()) == told
