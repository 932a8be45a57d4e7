"""Public names imported on first use."""

import pytest

import pollard_pin
import scout_pin
from thesis_pin.lazy import lazy_names


@pytest.mark.parametrize("package", [scout_pin, pollard_pin])
def test_every_public_name_is_found_and_listed(package):
    assert dir(package) == sorted(package.__all__)
    for name in package.__all__:
        assert getattr(package, name) is not None


@pytest.mark.parametrize("package", [scout_pin, pollard_pin])
def test_a_name_that_does_not_exist_is_an_attribute_error_that_names_it(package):
    with pytest.raises(AttributeError, match=rf"'{package.__name__}' has no attribute 'laod'"):
        package.laod  # noqa: B018


def test_a_name_comes_from_its_module():
    find, _ = lazy_names("thesis_pin", {"BadInput": "errors"})
    from thesis_pin.errors import BadInput

    assert find("BadInput") is BadInput
