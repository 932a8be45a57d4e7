"""``audit --errata`` writes both theses' errata, in both languages, as they are checked in."""

from pathlib import Path

import pytest

from pollard_pin.cli import main as pollard_main
from scout_pin.cli import main as scout_main
from thesis_pin.audit.thesis import Thesis

FOLDER = Path(__file__).parents[2] / "docs" / "audit"
MAINS = {"scout": scout_main, "pollard": pollard_main}


@pytest.fixture
def known(monkeypatch, scout_audit, pollard_audit):
    """Both audits, which are worked out elsewhere."""
    reports = {"scout": scout_audit, "pollard": pollard_audit}
    monkeypatch.setattr(Thesis, "audit", lambda thesis, **how: reports[thesis.robot])
    return reports


@pytest.mark.parametrize("robot", ["scout", "pollard"])
@pytest.mark.parametrize(("language", "name"), [("en", "errata"), ("es", "erratas.es")])
def test_the_checked_in_errata_are_current_and_wholly_translated(
    known, robot, language, name, tmp_path, capsys
):
    file = tmp_path / "errata.md"
    assert MAINS[robot](["audit", "--errata", str(file), "--language", language]) == 0
    assert "no Spanish" not in capsys.readouterr().err
    text = file.read_text(encoding="utf-8")
    assert text.count("\n**") == len(known[robot].failures)
    command = f"{robot}-pin audit --language {language} --errata docs/audit/{robot}_{name}.md"
    assert command in text
    current = (FOLDER / f"{robot}_{name}.md").read_text(encoding="utf-8")
    assert text == current, f"stale: run {command}"


def test_errata_on_standard_output_are_alone(known, capsys):
    assert scout_main(["audit", "--errata", "-"]) == 0
    assert capsys.readouterr().out.startswith("# Errata of the Scout thesis\n")


def test_what_means_nothing_beside_errata_is_refused(capsys):
    assert scout_main(["audit", "--language", "es"]) == 2
    assert "--errata" in capsys.readouterr().err
    assert scout_main(["audit", "--errata", "-", "--equation", "4.1"]) == 2
    assert "--equation" in capsys.readouterr().err
    assert scout_main(["audit", "--errata", "-", "--json", "-"]) == 2
    assert "standard output" in capsys.readouterr().err
