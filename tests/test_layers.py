"""Imports go downwards, also late ones, those for types, and names of modules in strings."""

import ast
from copy import deepcopy
from functools import cache
from pathlib import Path

import grimp
import pytest
from importlinter.api import read_configuration
from importlinter.contracts.acyclic_siblings import AcyclicSiblingsContract
from importlinter.contracts.forbidden import ForbiddenContract
from importlinter.contracts.independence import IndependenceContract
from importlinter.contracts.layers import LayersContract
from importlinter.contracts.protected import ProtectedContract

ROOT = Path(__file__).parents[1]
PACKAGES = ("thesis_pin", "scout_pin", "pollard_pin")
KINDS = {
    "acyclic_siblings": AcyclicSiblingsContract,
    "forbidden": ForbiddenContract,
    "independence": IndependenceContract,
    "layers": LayersContract,
    "protected": ProtectedContract,
}
CONFIGURATION = read_configuration(str(ROOT / "pyproject.toml"))
CONTRACTS = {options["name"]: options for options in CONFIGURATION["contracts_options"]}
# What imports a module by a name it is given; those who give the name are found by its string.
IMPORTS_BY_NAME = "thesis_pin.command."


@cache
def sources():
    """(module, string, line) of every string of the packages; (module, call) of what may import."""
    strings, calls = [], []
    for package in PACKAGES:
        for path in sorted((ROOT / package).rglob("*.py")):
            parts = path.relative_to(ROOT).with_suffix("").parts
            module = ".".join(part for part in parts if part != "__init__")
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                if isinstance(node, ast.Constant) and isinstance(node.value, str):
                    strings.append((module, node.value, node.lineno))
                elif isinstance(node, ast.Call):
                    name = getattr(node.func, "attr", getattr(node.func, "id", None))
                    if name in ("import_module", "__import__"):
                        calls.append((module, node))
    return strings, calls


def in_strings(graph):
    """(module, module it names in a string, line) of all strings but docstrings.

    ``module`` and ``module:function`` count, the latter also seen from the package.
    """
    modules = graph.modules - set(PACKAGES)
    for module, text, line in sources()[0]:
        named, colon, _ = text.partition(":")
        names = {named, f"{module.partition('.')[0]}.{named}"} if colon else {named}
        for name in names & modules:
            yield module, name, line


def in_stubs():
    """(package, module that a public name comes from, line)."""
    for package in PACKAGES:
        stub = (ROOT / package / "__init__.pyi").read_text(encoding="utf-8")
        for node in ast.walk(ast.parse(stub)):
            if isinstance(node, ast.ImportFrom):
                assert node.level == 1, "a stub imports from its own package only"
                yield package, f"{package}.{node.module}", node.lineno


@pytest.fixture(scope="module")
def whole_graph():
    """Every import, written as a statement, a string or a line of a stub."""
    graph = grimp.build_graph(*PACKAGES, cache_dir=None)
    for importer, imported, line in [*in_strings(graph), *in_stubs()]:
        assert imported in graph.modules, f"{importer}, line {line}: no module {imported}"
        graph.add_import(
            importer=importer, imported=imported, line_number=line, line_contents=imported
        )
    return graph


def broken(options, graph):
    """Whether a contract is broken; import-linter prints by what. Changes the graph."""
    contract = KINDS[options["type"]](options["name"], CONFIGURATION["session_options"], options)
    check = contract.check(graph, verbose=False)
    if not check.kept:
        contract.render_broken_contract(check)
    return not check.kept


@pytest.mark.parametrize("name", CONTRACTS)
def test_imports_keep_the_contract(name, whole_graph):
    assert not broken(CONTRACTS[name], deepcopy(whole_graph))


@pytest.mark.parametrize(
    ("importer", "imported", "name"),
    [
        ("scout_pin.model", "pollard_pin.model", "The robots stand on thesis_pin"),
        ("thesis_pin.errors", "scout_pin.model", "The robots stand on thesis_pin"),
        ("thesis_pin.files", "thesis_pin.numeric.checks", "Layers of thesis_pin"),
        ("thesis_pin.numeric.checks", "thesis_pin.equations.values", "Layers of thesis_pin"),
        ("thesis_pin.equations.values", "thesis_pin.loops.closures", "Equations stand"),
        ("pollard_pin.urdf", "pollard_pin.model", "Layers of a robot"),
        ("scout_pin.model", "thesis_pin.command.flags.options", "Only commands"),
        ("thesis_pin.tables.reading", "thesis_pin.command.progress", "Only commands"),
        ("thesis_pin.numeric.checks", "thesis_pin", "Layers of thesis_pin"),
        ("thesis_pin.errors", "thesis_pin.files", "No circles"),
    ],
)
def test_a_contract_sees_an_import_that_breaks_it(importer, imported, name, whole_graph):
    graph = deepcopy(whole_graph)
    graph.add_import(importer=importer, imported=imported)
    options = next(CONTRACTS[full] for full in CONTRACTS if full.startswith(name))
    assert broken(options, graph)


def test_modules_are_imported_by_a_name_in_a_variable_by_the_commands_only():
    places = {
        module
        for module, node in sources()[1]
        if ast.unparse(node.func) in ("import_module", "importlib.import_module", "__import__")
        and not isinstance(node.args[0], ast.Constant)
    }
    assert all(place.startswith(IMPORTS_BY_NAME) for place in places), places


def test_modules_named_in_strings_are_found(whole_graph):
    importers = {importer for importer, _, _ in in_strings(whole_graph)}
    assert {"scout_pin.cli", "pollard_pin.cli"} <= importers
