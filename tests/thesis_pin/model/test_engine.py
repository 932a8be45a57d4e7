"""Another module called pinocchio is named, with its file and the cure."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from thesis_pin.errors import BadInput
from thesis_pin.model import engine

ROOT = Path(__file__).parents[3]
CODE = (
    "from thesis_pin.errors import BadInput\n"
    "from thesis_pin.model.engine import require_pinocchio\n"
    "try:\n    require_pinocchio()\nexcept BadInput as error:\n    print(error)"
)
OTHERS = {
    "a plug-in of nose": ('__version__ = "0.5.1"', "isn't the library of rigid-body dynamics"),
    "for another Python": (
        "from .pinocchio_pywrap_default import *",
        "can't be imported (ModuleNotFoundError: No module named 'pinocchio.pinocchio_pywrap",
    ),
    "broken": ("1 / 0", "can't be imported (ZeroDivisionError"),
    "too old": ('__version__ = "2.7.1"\nbuildModelFromUrdf = 1', "has version 2.7.1"),
    "too new": ('__version__ = "5.0.0"\nbuildModelFromUrdf = 1', "has version 5.0.0"),
}


def said(path):
    done = subprocess.run(
        [sys.executable, "-c", CODE],
        env=os.environ | {"PYTHONPATH": os.pathsep.join(map(str, path))},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stderr == ""
    return done.stdout


@pytest.mark.parametrize("name", OTHERS)
def test_another_pinocchio_is_named_with_its_file_and_the_cure(tmp_path, name):
    text, what = OTHERS[name]
    place = tmp_path / "pinocchio" / "__init__.py"
    place.parent.mkdir()
    place.write_text(text)
    message = said((tmp_path, ROOT))
    assert message.startswith(f"{place}: the module pinocchio that Python finds here {what}")
    assert "pip uninstall pinocchio, pip install pin" in message


def test_ctrl_c_while_it_is_imported_is_no_broken_installation(tmp_path):
    """A compiled module that is interrupted while it imports another says that that one failed."""
    (tmp_path / "pinocchio.py").write_text(
        "import os, signal, time\n"
        "try:\n    os.kill(os.getpid(), signal.SIGINT)\n    time.sleep(0.1)\n"
        "except KeyboardInterrupt:\n    raise ImportError('could not import datetime')\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", "from scout_pin.cli import main\nraise SystemExit(main(['info']))"],
        env=os.environ | {"PYTHONPATH": os.pathsep.join(map(str, (tmp_path, ROOT)))},
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (130, "scout-pin: interrupted\n")


def test_where_there_is_none_that_is_said(monkeypatch):
    monkeypatch.setitem(sys.modules, "pinocchio", None)  # makes its import fail
    monkeypatch.setattr(engine.PathFinder, "find_spec", lambda _: None)
    with pytest.raises(BadInput, match=r"^Pinocchio isn't installed\. pip install pin$"):
        engine.require_pinocchio()


def test_the_right_one_is_accepted():
    engine.require_pinocchio()
    assert callable(sys.modules["pinocchio"].rnea)
