"""Commands import nothing heavy that they don't use: it would take longer than their work."""

import subprocess
import sys

import pytest

HEAVY = ("scipy", "matplotlib", "yourdfpy", "plotly")


@pytest.mark.parametrize(
    "command",
    [
        "scout_pin.cli gait --samples 11",
        "pollard_pin.cli trajectory --samples 11",
    ],
)
def test_a_command_works_without_what_is_heavy(tmp_path, command):
    module, *words = command.split()
    code = (
        f"import sys\nfrom {module} import main\n"
        f"try: main({words})\nexcept SystemExit: pass\n"
        f"sys.stderr.write('left ' + str([one for one in {HEAVY} if one in sys.modules]))\n"
    )
    ran = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, cwd=tmp_path, check=True
    )
    assert ran.stderr.endswith("left []")
    assert ran.stdout
