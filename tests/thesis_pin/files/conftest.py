"""What tests of writing share."""

import pytest
from killing import Killer


@pytest.fixture(scope="module")
def killer():
    """What runs work in processes of their own and kills them."""
    with Killer() as running:
        yield running
