"""``--formats``, ``--dpi`` and ``--size`` of the figures that commands write."""

import pytest
from commands import ROOT, run
from PIL import Image

DELTA = ["examples/delta.urdf", "examples/delta.yaml"]
COMMANDS = {
    "scout-pin gait": [],
    "pollard-pin trajectory": [],
    "pollard-pin workspace": ["--points", "5"],
    "pollard-pin place": ["--grid-only", "--samples", "21"],
    "pollard-pin accuracy": ["--samples", "31"],
    "thesis-pin workspace": [*DELTA, "--points", "5"],
    "thesis-pin torque": [*DELTA, "examples/delta_pick.csv", "--frame", "platform"],
}


@pytest.mark.parametrize("name", COMMANDS)
def test_figures_come_in_the_formats_the_resolution_and_the_size_that_are_asked_for(
    name, tmp_path, monkeypatch, capfd
):
    monkeypatch.chdir(ROOT)
    out = tmp_path / "out"
    words = [name.split()[1], *COMMANDS[name], "--out", str(out), "--formats", "pdf,png"]
    code, _, err = run(name, [*words, "--dpi", "100", "--size", "127x76.2mm"], capfd)
    assert code == 0, err
    drawn = {path.name for path in out.iterdir() if path.suffix in (".png", ".svg", ".pdf")}
    assert drawn
    assert {name.rpartition(".")[2] for name in drawn} == {"png", "pdf"}
    for path in out.glob("*.png"):
        with Image.open(path) as picture:
            assert picture.size == (500, 300)
    for path in out.glob("*.pdf"):
        assert path.read_bytes().startswith(b"%PDF-")


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (["--formats", "pdf"], "--formats belongs to the figures of --out"),
        (["--dpi", "300"], "--dpi belongs to the figures of --out"),
        (["--size", "80x60mm"], "--size belongs to the figures of --out"),
        (["--out", "made", "--size", "800x600"], "with one: 160x90mm"),
        (["--out", "made", "--size", "1x1mm"], "0.5 to 50 inches"),
        (["--out", "made", "--formats", "pdf,jpg"], "any of png,svg,pdf"),
    ],
)
def test_what_figures_can_t_be_is_one_message_and_no_file(
    words, reason, tmp_path, monkeypatch, capfd
):
    monkeypatch.chdir(tmp_path)
    code, out, err = run("scout-pin gait", ["gait", *words], capfd)
    assert (code, out) == (2, ""), err
    assert reason in err
    assert list(tmp_path.iterdir()) == []
