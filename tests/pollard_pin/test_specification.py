"""Chapter 4 as data, and what a broken file is told."""

import numpy as np
import pytest

from pollard_pin.specification import (
    ACTUATOR_SYMBOLS,
    LINK_NAMES,
    POLLARD_PATH,
    SKEWED_PATH,
    Specification,
)
from thesis_pin.errors import SpecificationError


def test_mass_is_the_sum_of_what_4_4_prints():
    chain_0 = 0.166 + 0.188 + 0.04 + 0.035 + 0.035
    assert Specification.read().mass == pytest.approx(chain_0 + 2 * (0.166 + 0.062), abs=1e-15)


def test_lengths_are_those_of_4_1():
    spec = Specification.read()
    chain = spec.chain_0
    assert (chain.z_10, chain.x_32, chain.x_65) == (0.05, 0.33, 0.37)
    assert (chain.x_1514, chain.x_1918) == (0.1, 0.06)
    for side, beta in zip(spec.side_chains, (270, 90), strict=True):
        assert (side.y_10, side.z_32, side.x_43, side.beta_54_deg) == (0.085, 0.035, 0.33, 0)
        assert (side.x_87, side.x_1211, side.z_1312) == (0.325, 0.015, 0.02)
        assert side.beta_1413_deg == beta


def test_actuators_stand_in_the_documented_order():
    assert ACTUATOR_SYMBOLS == ("θ21", "θ211", "θ212", "θ1615", "θ1716", "θ1817")


def test_printed_inertias_are_the_digits_taken_as_centroidal():
    spec = Specification.read()
    forearm = spec.centroidal("forearm", "printed") * 1e6
    np.testing.assert_allclose(
        forearm, [[199.423, -5.176, 1381.812], [-5.176, 45670, 0.314], [1381.812, 0.314, 45670]]
    )
    np.testing.assert_allclose(
        spec.centroidal("chain1_rod", "printed") * 1e6, np.diag([2.62, 2322.307, 2322.307])
    )


def test_printed_forearm_is_impossible_about_any_point_of_the_link():
    """Radius of gyration 493 mm; mass inside 470 mm reaches 470 mm about an end at most."""
    spec = Specification.read()
    largest = np.linalg.eigvalsh(spec.centroidal("forearm", "printed"))[-1]
    assert np.sqrt(largest / spec.links["forearm"].mass) > spec.span("forearm")


@pytest.mark.parametrize("link", LINK_NAMES)
def test_physical_inertias_fit_into_the_links(link):
    """About its centre, a body along a link has at most half its length of gyration."""
    spec = Specification.read()
    largest = np.linalg.eigvalsh(spec.centroidal(link, "physical"))[-1]
    reach = spec.span(link) if "wrist" in link or link == "tool" else spec.span(link) / 2
    assert np.sqrt(largest / spec.links[link].mass) < reach


def test_rod_inertia_about_the_joint_is_near_a_uniform_rods():
    """m L²/12 = 546 kg·mm²; about the joint the print leaves 685, about the centre 2 322."""
    tensor = Specification.read().centroidal("chain1_rod", "physical")
    assert tensor[1, 1] * 1e6 == pytest.approx(2322.307 - 0.062 * 162.5**2, rel=1e-12)


def test_second_specification_differs_where_the_thesis_robot_vanishes():
    spec = Specification.read(SKEWED_PATH)
    assert all(side.beta_54_deg != 0 for side in spec.side_chains)
    assert spec.chain_1 != spec.chain_2
    assert all(np.abs(spec.com(link)[1:]).min() > 0 for link in ("forearm", "tool"))


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("x_32 = 0.33", "x_32 = -0.33", "chain_0.x_32: input should be greater than 0"),
        ("x_32 = 0.33", "x_33 = 0.33", "chain_0.x_33: unknown key"),
        ("value = [-1, 1]", "value = [-1, 0]", "assumptions.signs.value"),
        ("lower_deg = -360", "lower_deg = 400", "range of chain0_shoulder is empty"),
        ("x_65 = 0.37", "x_65 = -0.2", "x_65 + x_1514 must be positive"),
        ("mass = 0.166", "mass = nan", "finite number"),
        ("format = 1", "format = 7", "format"),
        ('why = "appendix B gives', 'why = ""\nhow = "appendix B gives', "motion.why"),
        (
            "  [0.0, 3027.487e-6, 0.0],\n  [0.0, 0.0, 3016.058e-6],",
            "  [0.0, 3027.487e-6, 0.0],\n  [0.0, 0.0, 9016.058e-6],",
            "isn't physical",
        ),
        ('link = "forearm"', 'link = "forehead"', "replaced_inertias"),
    ],
)
def test_a_broken_specification_is_told_where_and_what(tmp_path, old, new, says):
    text = POLLARD_PATH.read_text()
    assert old in text
    file = tmp_path / "robot.toml"
    file.write_text(text.replace(old, new, 1))
    with pytest.raises(SpecificationError) as caught:
        Specification.read(file)
    assert says.lower() in str(caught.value).lower()
    assert f"{file}:" in str(caught.value)


def test_every_problem_is_reported_at_once(tmp_path):
    text = POLLARD_PATH.read_text().replace("x_32 = 0.33", "x_32 = 0").replace("z_10 = 0.05", "")
    (tmp_path / "robot.toml").write_text(text)
    with pytest.raises(SpecificationError) as caught:
        Specification.read(tmp_path / "robot.toml")
    assert len(caught.value.problems) == 2
