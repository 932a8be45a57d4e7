"""Public signatures say what they take and give."""

import ast
from pathlib import Path

ROOT = Path(__file__).parents[1]
PACKAGES = ("thesis_pin", "scout_pin", "pollard_pin")


def public_signatures():
    """(place, annotation or None) of each parameter, result and field that users see."""
    for package in PACKAGES:
        for path in sorted((ROOT / package).rglob("*.py")):
            place = str(path.relative_to(ROOT))
            tree = ast.parse(path.read_text(encoding="utf-8"))
            yield from _of(tree.body, place, in_class=False)


def _of(body, place, *, in_class):
    for node in body:
        if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
            yield from _of(node.body, f"{place}:{node.name}", in_class=True)
        elif isinstance(node, ast.FunctionDef) and _is_public(node.name):
            yield from _of_function(node, f"{place}:{node.lineno}:{node.name}", in_class)
        elif (
            isinstance(node, ast.AnnAssign)
            and isinstance(node.target, ast.Name)
            and _is_public(node.target.id)
        ):
            yield f"{place}:{node.lineno}:{node.target.id}", node.annotation


def _is_public(name):
    return not name.startswith("_") or (name.startswith("__") and name.endswith("__"))


def _of_function(node, place, in_class):
    decorators = {ast.unparse(decorator) for decorator in node.decorator_list}
    given = node.args
    names = [*given.posonlyargs, *given.args, *given.kwonlyargs]
    if in_class and "staticmethod" not in decorators:
        names = names[1:]
    names += [name for name in (given.vararg, given.kwarg) if name]
    for name in names:
        yield f"{place}({name.arg})", name.annotation
    yield f"{place} →", node.returns


def test_no_public_signature_says_any_or_nothing():
    loose = [
        place
        for place, annotation in public_signatures()
        if annotation is None
        or any(
            getattr(node, "id", getattr(node, "attr", "")) == "Any" for node in ast.walk(annotation)
        )
    ]
    assert loose == []
