"""Public names of the three packages, imported on first use."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

import pollard_pin
import scout_pin
import thesis_pin

PACKAGES = [thesis_pin, scout_pin, pollard_pin]
ROBOTS = [scout_pin, pollard_pin]


def stub(package):
    return Path(package.__file__).with_suffix(".pyi").read_text(encoding="utf-8")


@pytest.mark.parametrize("package", PACKAGES)
def test_every_public_name_is_found_and_listed(package):
    assert dir(package) == sorted(package.__all__)
    assert package.__version__ == thesis_pin.version.__version__
    for name in package.__all__:
        assert getattr(package, name) is not None


@pytest.mark.parametrize("package", PACKAGES)
def test_a_name_that_does_not_exist_is_an_attribute_error_that_names_it(package):
    with pytest.raises(AttributeError, match=rf"{package.__name__} attribute laod"):
        package.laod  # noqa: B018


@pytest.mark.parametrize("package", PACKAGES)
def test_importing_a_package_waits_for_nothing_heavy(package):
    code = (
        f"import sys, {package.__name__}\n"
        "print([name for name in ('numpy', 'pinocchio', 'scipy') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_both_robots_list_the_same_concerns_in_the_same_order_and_their_own_last():
    def concerns(package):
        return [line for line in stub(package).splitlines() if line.startswith("#")]

    scout, pollard = map(concerns, ROBOTS)
    assert scout[:-1] == pollard[:-1]
    assert (scout[-1], pollard[-1]) == ("# Only Scout", "# Only Pollard")


@pytest.mark.parametrize("package", PACKAGES)
def test_a_stub_exports_each_name_once_and_under_its_own_name(package):
    names = [
        (alias.name, alias.asname)
        for node in ast.walk(ast.parse(stub(package)))
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    ]
    assert all(name == again for name, again in names)
    assert len(set(names)) == len(names)


@pytest.mark.parametrize("package", PACKAGES)
def test_type_checkers_are_told_that_the_package_has_types(package):
    assert Path(package.__file__).with_name("py.typed").is_file()
