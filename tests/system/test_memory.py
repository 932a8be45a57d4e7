"""What a report of very many samples needs of memory, measured in a process of its own."""

import subprocess
import sys
from pathlib import Path

import pytest

MOST = 530e6
"""Bytes of a whole process in which a report of a million samples is made and summed up, beside
the pages of libraries: 70 to 100 MB, as the Python in use maps them, for all processes at once."""

PEAK = """
import resource
import sys

def peak():
    try:  # what Linux calls ru_maxrss begins at the size of the process that started this one
        with open("/proc/self/status") as lines:
            status = dict(line.split(":", 1) for line in lines)
        most, libraries = (int(status[key].split()[0]) for key in ("VmHWM", "RssFile"))
        return (most - libraries) * 1024
    except FileNotFoundError:
        size = 1 if sys.platform == "darwin" else 1024
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * size - 70e6
"""

SCRIPT = """
from {package} import load, {report} as report
{make}
report(*made, samples=401).summary()
before, count = peak(), 250_000
found = report(*made, samples=count)
found.summary()
print(before, (peak() - before) / count)
"""

CASES = {
    "scout_pin": (
        "gait_report",
        "from scout_pin import load_gait; made = load(), load_gait()",
    ),
    "pollard_pin": (
        "trajectory_report",
        "from pollard_pin import appendix_b; made = load(), appendix_b()",
    ),
}


@pytest.mark.parametrize("package", CASES)
def test_a_million_samples_and_their_summary_fit_in_600_megabytes(package):
    """Measured with a quarter of them: what is kept grows with their number, nothing else."""
    report, make = CASES[package]
    script = PEAK + SCRIPT.format(package=package, report=report, make=make)
    run = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    before, each = map(float, run.stdout.split())
    assert before + 1e6 * each < MOST, f"{before / 1e6:.0f} MB and {each:.0f} bytes a sample"


FEET = """
import numpy as np
from standing_robots import standing
from thesis_pin.contacts.balance.dynamics import foot_dynamics

robot, feet, pose = standing("talos")

def found(count):
    v = np.zeros((count, robot.model.nv))
    v[:, 6:] = np.sin(np.outer(np.linspace(0.0, 6.0, count), np.arange(robot.model.nv - 6.0)))
    given = np.repeat(pose[None], count, axis=0), v, np.zeros_like(v)
    before = peak()
    found = foot_dynamics(robot, feet, *given)
    found.margin, found.contact_margin, found.friction_used
    return peak() - before

found(1024)
print(found(16 * 1024) / (16 * 1024))
"""


def test_a_robot_on_its_feet_takes_memory_for_answers_and_none_for_its_jacobians():
    """Those of Talos' two feet would be 3.6 kB a sample, beside 2.7 to 3.5 of answers."""
    helpers = str(Path(__file__).parents[1])
    script = PEAK + f"sys.path.insert(0, {helpers!r})" + FEET
    run = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    each = float(run.stdout)
    assert each < 4900, f"{each:.0f} bytes a sample"
