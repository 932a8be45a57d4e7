"""``scout-pin audit`` answers, explains, and refuses what it doesn't know."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import orjson
import pytest

from scout_pin.cli import main
from thesis_pin.audit.thesis import Thesis


@pytest.fixture(scope="module")
def outputs(tmp_path_factory, scout_audit):
    """Everything that the command writes of the whole audit, which is worked out elsewhere."""
    folder = tmp_path_factory.mktemp("audit")
    names = {kind: folder / f"audit.{kind}" for kind in ("json", "html", "markdown")}
    asked = []

    def whole(thesis, **how):
        asked.append((thesis.robot, how["only"]))
        return scout_audit

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Thesis, "audit", whole)
        words = [part for k, path in names.items() for part in (f"--{k}", str(path))]
        assert main(["audit", *words]) == 0
    assert asked == [("scout", None)]
    return names


def test_the_json_has_every_row_with_the_promised_keys(outputs):
    document = orjson.loads(outputs["json"].read_bytes())
    keys = {"id", "source", "printed", "corrected", "verdict", "attribution"}
    keys |= {"residual_printed", "residual_corrected", "effect", "note"}
    assert all(keys <= set(row) for row in document["rows"])
    assert sum(document["counts"].values()) == len(document["rows"])
    assert document["coverage"]["missing"] == []
    assert document["coverage"]["numbered"] == 59


def test_the_page_is_whole_and_needs_no_network(outputs):
    page = outputs["html"].read_text(encoding="utf-8")
    assert page.startswith("<!doctype html>")
    assert page.rstrip().endswith("</html>")
    assert "src=" not in page
    assert page.count("href=") == page.count('href="#')  # links lead to the page itself


def test_the_document_can_be_written_anywhere(outputs):
    assert outputs["markdown"].read_text(encoding="utf-8").startswith("# Audit of the Scout thesis")


def test_one_equation_is_explained(capsys):
    assert main(["audit", "--equation", "4.4.2:dr_0i/dq_j"]) == 0
    text = " ".join(capsys.readouterr().out.split())
    for part in ("misprint, by the thesis", "as printed", "corrected", "effect", "left leg"):
        assert part in text


def test_an_equation_that_holds_says_so(capsys):
    assert main(["audit", "--equation", "scout:3.2:3.16"]) == 0
    assert "holds" in capsys.readouterr().out


def test_one_equation_names_the_lines_it_uses(capsys):
    assert main(["audit", "--equation", "4.1:V_B"]) == 0
    (used,) = [line for line in capsys.readouterr().out.splitlines() if line.startswith("uses ")]
    assert "4.1:b_B" in used.split()


def test_json_on_standard_output_is_only_json(capsysbinary):
    assert main(["audit", "--equation", "6.2:ZMP_x", "--json", "-"]) == 0
    document = orjson.loads(capsysbinary.readouterr().out)
    assert [row["verdict"] for row in document["rows"]] == ["holds"]


def test_an_unknown_equation_is_refused_with_near_names(capsys):
    assert main(["audit", "--equation", "4.3.3:dot_e_9"]) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert "dot_e_9i" in captured.err
    assert "Traceback" not in captured.err


def test_a_file_that_can_not_be_written_is_refused(tmp_path, capsys):
    target = tmp_path / "missing" / "audit.json"
    assert main(["audit", "--equation", "6.2:ZMP_x", "--json", str(target)]) == 3
    assert "can't write" in capsys.readouterr().err


def test_ctrl_c_ends_the_processes_that_share_the_work_in_one_line():
    root = str(Path(__file__).parents[2])
    code = "import sys; from scout_pin.cli import main; sys.exit(main(['audit', '--jobs', '2']))"
    run = subprocess.Popen(
        [sys.executable, "-c", code],
        env=os.environ | {"PYTHONPATH": root},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,  # Ctrl-C is sent to all processes of a terminal's job
    )
    words = ["pgrep", "-g", str(run.pid), "-f", "spawn_main"]
    end = time.monotonic() + 60
    while not subprocess.run(words, capture_output=True).stdout and time.monotonic() < end:
        time.sleep(0.02)
    os.killpg(run.pid, signal.SIGINT)
    out, err = run.communicate(timeout=60)
    assert (run.returncode, out, err) == (130, "", "scout-pin: interrupted\n")
    while (left := subprocess.run(words, capture_output=True).stdout) and time.monotonic() < end:
        time.sleep(0.02)
    assert not left
