"""What tests of derivations share."""

from pathlib import Path

import pytest

from thesis_pin import audit_derivation

FOLDER = Path(__file__).parents[4] / "examples" / "your_derivation"
URDF = FOLDER / "cart_pole.urdf"


def _listed(printed):
    members = [printed] if isinstance(printed, str) else printed
    return "[" + ", ".join(f"'{one}'" for one in members) + "]"


@pytest.fixture
def rows(tmp_path):
    """Audits lines (left, printed) on the example's cart-pole, with tables behind its header."""
    return lambda lines, tables="": _rows(tmp_path / "mine.toml", lines, tables)


def _rows(path, lines, tables):
    header = (FOLDER / "cart_pole.toml").read_text(encoding="utf-8").split("[[equation]]")[0]
    entries = [
        f"[[equation]]\nid = 'cartpole:1:e_{k}'\nleft = '{left}'\nprinted = {_listed(printed)}\n"
        for k, (left, printed) in enumerate(lines)
    ]
    path.write_text(f"{header}\n{tables}\n{''.join(entries)}", encoding="utf-8")
    return audit_derivation(path, URDF, with_effects=False).rows
