"""What tests in a real browser share."""

from pathlib import Path

import chromium
import pytest


@pytest.fixture(scope="session")
def browser():
    """A headless Chromium; without one the tests that need it are skipped."""
    if chromium.find() is None:
        pytest.skip("no Chromium on this machine (Debian and Ubuntu: apt-get install chromium)")
    with chromium.Chromium() as running:
        yield running


@pytest.fixture(scope="session")
def artefacts():
    """Folder for screenshots, which git ignores."""
    return Path(__file__).parents[1] / "artefacts"
