"""What a report of very many samples keeps in memory, measured in a process of its own."""

import subprocess
import sys

import pytest

SCRIPT = """
import resource
import sys
from {package} import load, {report} as report
{make}
report(*made, samples=401)
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
count = 150_000
found = report(*made, samples=count)
grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
print(grown * (1 if sys.platform == "darwin" else 1024) / count)
"""

CASES = {
    "scout_pin": (
        "gait_report",
        "from scout_pin import load_gait; made = load(), load_gait()",
        2400,
    ),
    "pollard_pin": (
        "trajectory_report",
        "from pollard_pin import appendix_b; made = load(), appendix_b()",
        1100,
    ),
}


@pytest.mark.parametrize("package", CASES)
def test_a_long_report_keeps_its_memory_per_sample_under_a_bound(package):
    report, make, most = CASES[package]
    script = SCRIPT.format(package=package, report=report, make=make)
    run = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert float(run.stdout) < most, f"{float(run.stdout):.0f} bytes a sample"
