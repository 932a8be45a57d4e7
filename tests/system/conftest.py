"""A walk, its view and its report page, which tests in a browser share."""

from pathlib import Path

import pytest

import scout_pin
from scout_pin.report.drawn.page import gait_page
from scout_pin.report.drawn.view import gait_scene
from thesis_pin.pages import player as viewer

ROOT = Path(__file__).parents[2]


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
