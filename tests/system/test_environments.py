"""Other people's environments: another pinocchio, settings of Matplotlib, one that is broken."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from commands import COMMANDS, MODULES

ROOT = Path(__file__).parents[2]
DELTA = ["examples/delta.urdf", "examples/delta.yaml"]
CART = "examples/your_derivation/cart_pole.urdf"
VERBS = {
    "scout-pin": (
        ["gait"],
        ["plan"],
        ["size", "examples/servos.csv"],
        ["sweep", "--vary", "torso.mass=0.1,0.2", "--samples", "41"],
        ["size"],
        ["simulate"],
        ["new", "my_biped.toml"],
        ["from-urdf", "urdf/scout/scout.urdf"],
        ["view", "--html", "-"],
        ["convert", "--as", "joints"],
        ["ik", "left", "--position", "0", "0", "-0.2"],
        ["info"],
        ["urdf"],
        ["audit"],
    ),
    "pollard-pin": (
        ["trajectory"],
        ["size", "examples/servos.csv"],
        ["size", "--path", "examples/spray_arch.toml"],
        ["sweep", "--vary", "chain_0.x_32=0.32,0.33", "--samples", "41"],
        ["simulate"],
        ["view", "--html", "-"],
        ["convert", "--as", "joints"],
        ["ik", "0.45", "0", "0.1", "0", "0", "0"],
        ["fk", "0", "0", "0", "0", "0", "0"],
        ["time"],
        ["workspace"],
        ["place", "--grid-only", "--samples", "21"],
        ["accuracy"],
        ["info"],
        ["urdf"],
        ["audit"],
    ),
    "thesis-pin": (
        ["check", *DELTA],
        ["torque", *DELTA, "examples/delta_pick.csv"],
        ["balance", "urdf/scout/scout.urdf"],
        ["size", *DELTA, "examples/delta_pick.csv", "--list", "examples/servos.csv"],
        ["size", *DELTA, "examples/delta_pick.csv"],
        ["view", *DELTA, "examples/delta_pick.csv", "--html", "-"],
        ["workspace", *DELTA],
        ["audit", "examples/your_derivation/cart_pole.toml", "--model", CART],
        ["formats"],
    ),
}
GAIT = ["gait", "--samples", "11"]


def command(name, *words, path=(), environment=None):
    code = f"import sys; from {MODULES[name]} import main; sys.exit(main())"
    settings = os.environ | {"PYTHONPATH": os.pathsep.join(map(str, (*path, ROOT)))}
    return subprocess.run(
        [sys.executable, "-c", code, *map(str, words)],
        env=settings | (environment or {}),
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
    )


@pytest.mark.parametrize(
    ("name", "words"), [(name, words) for name, every in VERBS.items() for words in every]
)
def test_every_verb_names_another_pinocchio_and_the_cure(name, words, tmp_path):
    (tmp_path / "pinocchio").mkdir()
    (tmp_path / "pinocchio" / "__init__.py").write_text('__version__ = "0.5.1"  # a nose plug-in')
    done = command(name, *words, path=(tmp_path,))
    assert (done.returncode, done.stdout) == (2, "")
    assert str(tmp_path / "pinocchio" / "__init__.py") in done.stderr
    assert "pip uninstall pinocchio, pip install pin" in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize("name", COMMANDS)
def test_every_verb_is_asked(name):
    assert {verb.name for verb in COMMANDS[name].verbs} == {words[0] for words in VERBS[name]}


def figures(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.suffix == ".svg"}


@pytest.fixture(scope="module")
def plain(tmp_path_factory):
    """The figures of someone who has set nothing."""
    folder = tmp_path_factory.mktemp("plain") / "out"
    done = command("scout-pin", *GAIT, "--out", folder)
    assert done.returncode == 0, done.stderr
    return figures(folder)


@pytest.mark.parametrize("name", ["settings", "backend"])
def test_a_users_settings_of_matplotlib_change_no_figure(plain, tmp_path, name):
    (tmp_path / "matplotlibrc").write_text(
        "text.usetex: True\nbackend: tkagg\nfont.size: 40\naxes.facecolor: black\n"
    )
    environment = (
        {"MATPLOTLIBRC": str(tmp_path / "matplotlibrc")}
        if name == "settings"
        else {"MPLBACKEND": "no such backend"}
    )
    done = command("scout-pin", *GAIT, "--out", tmp_path / "theirs", environment=environment)
    assert done.returncode == 0, done.stderr
    assert figures(tmp_path / "theirs") == plain != {}


def test_where_figures_cannot_be_drawn_the_data_are_written_all_the_same(tmp_path):
    (tmp_path / "matplotlib").mkdir()
    (tmp_path / "matplotlib" / "__init__.py").write_text("raise ImportError('broken')")
    out, file = tmp_path / "out", tmp_path / "report.json"
    done = command("scout-pin", *GAIT, "--out", out, "--json", file, path=(tmp_path,))
    assert done.returncode not in (0, 1)
    assert "broken" in done.stderr
    assert sorted(os.listdir(out)) == ["manifest.sha256", "report.json", "samples.csv"]
    assert file.read_bytes() == (out / "report.json").read_bytes()
