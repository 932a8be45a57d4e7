"""What tests in a real browser share; and the suite leaves the checkout as it was."""

import gc
import signal
import subprocess
from pathlib import Path

import chromium
import pytest
from once import once

ROOT = Path(__file__).parents[1]
_BEFORE = pytest.StashKey[set[str]]()


@pytest.fixture(scope="session")
def running_browser():
    """A headless Chromium; without one the tests that need it are skipped."""
    if chromium.find() is None:
        pytest.skip("no Chromium on this machine (Debian and Ubuntu: apt-get install chromium)")
    with chromium.Chromium() as running:
        yield running


@pytest.fixture
def browser(running_browser):
    """The Chromium of all tests, without a page before and after."""
    yield running_browser
    running_browser.leave()


@pytest.fixture(scope="session")
def artefacts():
    """Folder for screenshots, which git ignores."""
    return ROOT / "artefacts"


def _scout_audit():
    from scout_pin.thesis.audit import audit

    return audit()


def _pollard_audit():
    from pollard_pin.thesis.audit import audit

    return audit()


@pytest.fixture(scope="session")
def scout_audit(request, tmp_path_factory):
    """The whole audit of the Scout thesis, which takes 15 s."""
    return once(request, tmp_path_factory, _scout_audit)


@pytest.fixture(scope="session")
def pollard_audit(request, tmp_path_factory):
    """The whole audit of the Pollard thesis, likewise."""
    return once(request, tmp_path_factory, _pollard_audit)


def _untidy():
    """What git finds changed or new in the checkout; empty outside one."""
    command = ["git", "status", "--porcelain", "--untracked-files=all"]
    try:
        found = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    except OSError:
        return set()
    return set(found.stdout.splitlines()) if found.returncode == 0 else set()


def pytest_configure(config):
    """Let the commands under test be interrupted, also where a shell's background job can't be.

    Workers that share the cores leave them to each other: a BLAS's threads would wait for a core
    that they don't get, and spin meanwhile. Processes that they start are as a user's.
    """
    if hasattr(config, "workerinput"):
        import scipy.linalg  # noqa: F401 # it brings a BLAS beside NumPy's
        from threadpoolctl import threadpool_limits

        threadpool_limits(1)
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.hookimpl(wrapper=True)
def pytest_collection():
    """Look for no garbage among what is collected: it took a quarter of the time to collect it."""
    gc.disable()
    try:
        return (yield)
    finally:
        gc.freeze()
        gc.enable()


def pytest_collection_modifyitems(items):
    """Mark what needs a browser, so that it can be counted."""
    for item in items:
        if "running_browser" in getattr(item, "fixturenames", ()):
            item.add_marker("browser")


def pytest_terminal_summary(terminalreporter):
    """Say whether tests of pages ran: skipped ones are easily overlooked."""
    stats = terminalreporter.stats
    ran, skipped = (
        sum("browser" in one.keywords for kind in kinds for one in stats.get(kind, ()))
        for kinds in (("passed", "failed"), ("skipped",))
    )
    if ran:
        terminalreporter.write_line(f"pages: {ran} tests ran in {chromium.version()}")
    if skipped:
        why = "" if chromium.find() else ", no Chromium"
        terminalreporter.write_line(f"pages: {skipped} tests SKIPPED{why}", yellow=True)


def pytest_sessionstart(session):
    """Note what is changed before the suite begins, once for all workers."""
    if not hasattr(session.config, "workerinput"):
        session.config.stash[_BEFORE] = _untidy()


def pytest_sessionfinish(session):
    """Fail a suite that leaves something behind in the checkout."""
    if hasattr(session.config, "workerinput"):
        return
    if left := _untidy() - session.config.stash[_BEFORE]:
        print(f"\nthe suite left these behind in the checkout: {sorted(left)}")
        session.exitstatus = pytest.ExitCode.TESTS_FAILED
