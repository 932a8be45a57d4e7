"""What tests of commands and pages share: a command called here, a walk, its view and its page."""

from pathlib import Path
from types import SimpleNamespace

import pytest
from commands import run

import scout_pin
from scout_pin.report.drawn.page import gait_page
from scout_pin.report.drawn.view import gait_scene
from thesis_pin.pages import player as viewer

ROOT = Path(__file__).parents[2]


@pytest.fixture(name="scout_pin")
def scout_command(capfd, monkeypatch):
    """The command called in this process: saves starting Python at every call."""
    return called("scout-pin", capfd, monkeypatch)


@pytest.fixture(name="pollard_pin")
def pollard_command(capfd, monkeypatch):
    """The same of Pollard's."""
    return called("pollard-pin", capfd, monkeypatch)


def called(name, capfd, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")

    def call(*arguments, cwd=None):
        if cwd is not None:
            monkeypatch.chdir(cwd)
        code, out, err = run(name, list(map(str, arguments)), capfd)
        return SimpleNamespace(returncode=code, stdout=out, stderr=err)

    return call


@pytest.fixture(scope="module")
def report():
    return scout_pin.gait_report(
        scout_pin.load(), scout_pin.load_gait(ROOT / "examples" / "walk.toml"), samples=241
    )


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("pages")


@pytest.fixture(scope="module")
def view_file(report, folder):
    viewer.write_html(gait_scene(report), folder / "view.html")
    return folder / "view.html"


@pytest.fixture(scope="module")
def report_file(report, folder):
    (folder / "report.html").write_bytes(gait_page(report))
    return folder / "report.html"
