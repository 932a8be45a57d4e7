"""What the wheel asks for is what the packages use, and the version stands once."""

import ast
import re
import subprocess
import sys
import tomllib
from functools import cache
from importlib.metadata import packages_distributions
from pathlib import Path

import pytest

import thesis_pin

ROOT = Path(__file__).parents[1]
PACKAGES = ("thesis_pin", "scout_pin", "pollard_pin")
EXTRAS = {
    "mujoco": ("mujoco",),
    "simulate": ("mujoco",),
    "film": ("imageio_ffmpeg", "playwright"),
    "sweep": ("pyarrow",),
    "distributed": ("distributed", "pyarrow", "threadpoolctl"),
}
"""Extra → what it brings: models, a second engine, films, rows in Parquet, clusters; each says so
without it."""
BROUGHT = {name for names in EXTRAS.values() for name in names}
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]


def canonical(name):
    return re.sub(r"[-_.]+", "-", name).lower()


def declared(requirements):
    return {canonical(re.match(r"[\w.-]+", line)[0]) for line in requirements}


@cache
def imported():
    """Top-level name of every import, late ones included, of modules that others wrote."""
    names = set()
    for package in PACKAGES:
        for path in (ROOT / package).rglob("*.py"):
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                if isinstance(node, ast.Import):
                    names |= {alias.name.partition(".")[0] for alias in node.names}
                elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
                    names.add(node.module.partition(".")[0])
    return names - set(PACKAGES) - set(sys.stdlib_module_names)


def test_what_a_verb_may_import_is_a_plain_dependency():
    names, found = imported() - BROUGHT, packages_distributions()
    assert len(names) > 15
    for name in sorted(names):
        # Pinocchio's wheel, pin, keeps its modules in a folder of its own and names none.
        brought_by = {"pin"} if name == "pinocchio" else set()
        brought_by |= {canonical(one) for one in found.get(name, ())}
        assert brought_by & declared(PROJECT["dependencies"]), f"{name} is brought by {brought_by}"


def test_no_extra_but_the_developers_exists_that_nothing_uses():
    assert set(PROJECT["optional-dependencies"]) == {"dev", *EXTRAS}
    assert imported() >= BROUGHT


@pytest.mark.parametrize(("extra", "names"), EXTRAS.items())
def test_what_an_extra_brings_is_imported_late(extra, names):
    assert declared(PROJECT["optional-dependencies"][extra]) == {canonical(one) for one in names}
    modules = (
        "thesis_pin.loops.loading, thesis_pin.pages.film.making, thesis_pin.command.verbs.sweep"
    )
    code = f"import sys, {modules}; assert not {set(names)!r} & set(sys.modules)"
    subprocess.run([sys.executable, "-c", code], check=True)


def test_the_version_stands_once():
    assert "version" in PROJECT["dynamic"]
    texts = [
        path.read_text(encoding="utf-8") for p in PACKAGES for path in (ROOT / p).rglob("*.py")
    ]
    written = re.compile(rf"""["']{re.escape(thesis_pin.__version__)}["']""")
    assert sum(len(written.findall(text)) for text in texts) == 1
