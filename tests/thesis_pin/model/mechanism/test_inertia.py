"""Reading printed inertias, and refusing impossible ones."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from thesis_pin.errors import NonPhysicalInertia
from thesis_pin.model.mechanism.inertia import (
    centroidal_inertia,
    check_physical,
    parallel_axis,
    pseudo_inertia,
)


def cloud(seed, count=6):
    """Random point masses: mass, centre and centroidal tensor by summation."""
    rng = np.random.default_rng(seed)
    masses, points = rng.uniform(0.1, 1, count), rng.normal(size=(count, 3))
    mass = masses.sum()
    com = masses @ points / mass
    tensor = sum(parallel_axis(m, p - com) for m, p in zip(masses, points, strict=True))
    return masses, points, mass, com, tensor


@given(seed=st.integers(0, 2**32 - 1))
@settings(max_examples=50, deadline=None)
def test_every_convention_leads_back_to_the_centroidal_tensor(seed):
    masses, points, mass, com, tensor = cloud(seed)
    about_joint = sum(parallel_axis(m, p) for m, p in zip(masses, points, strict=True))
    products = np.einsum("k,ki,kj->ij", masses, points, points)
    printed = np.where(np.eye(3, dtype=bool), about_joint, products)
    for matrix, convention in (
        (tensor, "tensor_about_com"),
        (about_joint, "tensor_about_joint"),
        (printed, "products_about_joint"),
    ):
        found = centroidal_inertia(matrix, mass, com, convention)
        np.testing.assert_allclose(found, tensor, atol=1e-10)
        np.testing.assert_array_equal(
            centroidal_inertia(matrix, mass, com, convention, "printed"), matrix
        )


@given(seed=st.integers(0, 2**32 - 1))
@settings(max_examples=50, deadline=None)
def test_bodies_made_of_points_are_physical_and_their_pseudo_inertia_positive(seed):
    _, _, mass, com, tensor = cloud(seed)
    check_physical("cloud", mass, com, tensor)
    assert np.linalg.eigvalsh(pseudo_inertia(mass, com, tensor)).min() > 0


@pytest.mark.parametrize(
    ("mass", "diagonal", "says"),
    [
        (1.0, (1.0, 1.0, 2.5), "exceeds the sum of the others by 0.5"),
        (1.0, (-1.0, 1.0, 1.0), "isn't positive"),
        (0.0, (1.0, 1.0, 1.0), "mass isn't positive"),
    ],
)
def test_impossible_inertias_are_refused_with_link_and_by_how_much(mass, diagonal, says):
    with pytest.raises(NonPhysicalInertia, match=says) as caught:
        check_physical("arm", mass, np.zeros(3), np.diag(diagonal))
    assert caught.value.link == "arm"
    assert "link 'arm'" in str(caught.value)
    assert caught.value.principal == pytest.approx(sorted(diagonal))
    assert caught.value.eigenvalues[0] <= 0
