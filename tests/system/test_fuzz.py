"""A few hundred broken files, seeded; ``python tests/fuzz.py`` tries more."""

import os
import subprocess
import sys
from pathlib import Path

FUZZER = Path(__file__).parents[1] / "fuzz.py"


def test_broken_files_bring_out_our_errors_only(tmp_path):
    """In a process of its own, which a native crash would end."""
    done = subprocess.run(
        [sys.executable, str(FUZZER), "400", "7"],
        env=os.environ | {"TMPDIR": str(tmp_path)},
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stdout + done.stderr[-2000:]
    assert "0 failed" in done.stdout


def test_the_fuzzer_would_see_another_error(tmp_path):
    """With a reader that fails like a programmer's mistake."""
    script = (
        f"import sys; sys.path.insert(0, {str(FUZZER.parent)!r})\n"
        "import fuzz\n"
        "fuzz.targets = lambda: {'x': ('a = 1', '.toml', lambda path: 1 / 0)}\n"
        "sys.exit(fuzz.main(1, 1))\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", script],
        env=os.environ | {"TMPDIR": str(tmp_path)},
        capture_output=True,
        text=True,
    )
    assert done.returncode == 1
    assert "ZeroDivisionError" in done.stdout
