"""The verb ``sweep`` of both robots: what is written, what ends it, what goes on."""

import csv
import io
import json
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pyarrow.parquet as parquet
import pytest
from commands import MODULES, run

ROOT = Path(__file__).parents[2]
WALK = ("--gait", str(ROOT / "examples" / "walk.toml"), "--samples", "41")
VARY = ("--vary", "legs.*.x_3=0.06:0.08:3", "--vary", "servos.*.stall_torque=0.3,0.5")
MANY = ("sweep", *WALK, "--vary", "legs.*.x_3=0.06:0.08:16")
SCOUT = ("sweep", *WALK, *VARY, "--jobs", "1")
ARCH = ("--path", str(ROOT / "examples" / "spray_arch.toml"))


@pytest.fixture(scope="module")
def swept(tmp_path_factory):
    """A sweep with everything that it writes."""
    folder = tmp_path_factory.mktemp("swept")
    files = ["--out", str(folder / "out"), "--html", str(folder / "page.html")]
    done = called("scout-pin", *SCOUT, *files, "--json", str(folder / "answer.json"))
    assert done.returncode == 0, done.stderr
    return folder, done


def called(name, *words, **more):
    code = (
        f"import sys; from {MODULES[name]} import main\nif __name__ == '__main__': sys.exit(main())"
    )
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    command = [sys.executable, "-c", code, *map(str, words)]
    return subprocess.run(
        command, env=environment, capture_output=True, text=True, check=False, **more
    )


def table(out):
    return (out / "designs.csv").read_bytes()


def test_all_that_is_written_says_the_same(swept):
    folder, done = swept
    out = folder / "out"
    assert {path.name for path in out.iterdir()} == {
        *("designs.json", "rows", "manifest.sha256", "report.json", "designs.csv", "best.toml"),
        *("pareto.png", "pareto.svg"),
    }
    found = json.loads((folder / "answer.json").read_bytes())
    rows = list(csv.DictReader(io.StringIO(table(out).decode())))
    parts = parquet.read_table(out / "rows").to_pydict()
    assert len(rows) == len(found["designs"]) == len(parts["design"]) == 6
    names = [column["name"] for column in found["columns"]]
    for k, row in enumerate(rows):
        margin = found["designs"][k]["cells"][names.index("margin")]
        assert float(row["margin [m]"]) == parts["margin"][k] == margin
        assert float(row["legs.*.x_3"]) == parts["legs.*.x_3"][k]
    assert f"is design {found['best']}:" in " ".join(done.stdout.split())
    assert "judging 6 designs by 1 process" in done.stderr
    assert re.search(r"at most \d+ MB each", done.stdout)
    assert found["effort"]["memory"] < 200 * 2**20


def test_the_design_that_is_chosen_is_a_specification_that_gait_reads(swept, tmp_path, capfd):
    folder, _ = swept
    found = json.loads((folder / "answer.json").read_bytes())
    robot = ("--specification", str(folder / "out" / "best.toml"))
    out = tmp_path / "report.json"
    code, _, _ = run("scout-pin gait", ["gait", *robot, *WALK, "--json", str(out)], capfd)
    assert code == 0
    summary = json.loads(out.read_bytes())["summary"]
    cells = dict(
        zip(
            [column["name"] for column in found["columns"]],
            found["designs"][found["best"]]["cells"],
            strict=True,
        )
    )
    assert cells["servo_use"] == max(summary["servo_use"])
    assert cells["margin"] == summary["worst_margin"]
    assert cells["within_limits"] == summary["within_limits"] is True


def test_a_finished_sweep_is_asked_again_without_work(swept, tmp_path):
    folder, _ = swept
    again = called(
        "scout-pin", *SCOUT, "--out", folder / "out", "--resume", "--wish", "margin>0.0088,mass<1"
    )
    assert again.returncode == 0, again.stderr
    assert "Every row stood in the folder already." in again.stdout
    assert "Nearest to the wish is design 3" in again.stdout
    missed = called(
        *("scout-pin", *SCOUT, "--out", folder / "out", "--resume"),
        *("--wish", "mass<0.1", "--strict"),
    )
    assert missed.returncode == 1
    assert "misses the wish: mass is 0.89854 kg, not at most 0.1 kg" in " ".join(
        missed.stdout.split()
    )


def test_a_folder_with_another_sweep_is_refused_with_what_differs(swept, capfd):
    folder, _ = swept
    before = table(folder / "out")
    for words, told in (
        (SCOUT, "a sweep stands in this folder already"),
        ((*SCOUT, "--resume", "--inertia", "printed"), "inertia is printed, was physical"),
        ((*SCOUT, "--resume", "--vary", "torso.mass=1"), "parameters"),
    ):
        code, _, err = run("scout-pin sweep", [*words, "--out", str(folder / "out")], capfd)
        assert code == 2
        assert told in err
    assert table(folder / "out") == before


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """The table of a sweep that nobody disturbs, by one process."""
    folder = tmp_path_factory.mktemp("whole")
    done = called("scout-pin", *MANY, "--jobs", "1", "--out", folder / "out")
    assert done.returncode == 0, done.stderr
    return table(folder / "out")


@pytest.mark.parametrize("how", [signal.SIGKILL, signal.SIGINT])
def test_a_command_that_is_killed_goes_on_to_the_same_table(how, tmp_path, whole):
    """Also its workers are gone, and Ctrl-C says what is kept."""
    code = f"import sys; from {MODULES['scout-pin']} import main\nsys.exit(main())"
    words = [*MANY, "--jobs", "2"]
    out = tmp_path / "out"
    process = subprocess.Popen(
        [sys.executable, "-c", code, *words, "--out", str(out)],
        env=os.environ | {"PYTHONPATH": str(ROOT)},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    until = time.monotonic() + 300
    while len(list(out.glob("rows/*.parquet"))) < 3:
        assert process.poll() is None, process.communicate()[1]
        assert time.monotonic() < until
        time.sleep(0.02)
    process.send_signal(how)
    _, err = process.communicate(timeout=200)
    while _session(process.pid):
        assert time.monotonic() < until
        time.sleep(0.02)
    if how == signal.SIGINT:
        assert process.returncode == 130
        assert re.search(r"\d+ of 16 designs were done; they stand in --out", err)
    done = len(list(out.glob("rows/*.parquet")))
    assert 3 <= done < 16
    again = called("scout-pin", *words, "--out", out, "--resume")
    assert again.returncode == 0, again.stderr
    assert f"{16 - done} designs in" in again.stdout
    assert table(out) == whole


def _session(leader):
    """Processes of a session that live, where the system says."""
    alive = []
    for place in Path("/proc").glob("[0-9]*"):
        try:
            fields = (place / "stat").read_text().rsplit(")", 1)[1].split()
        except OSError:
            continue
        if int(fields[3]) == leader and fields[0] != "Z":
            alive.append(place.name)
    return alive


def test_a_table_as_excel_writes_it_is_a_design_a_row(tmp_path, capfd):
    file = tmp_path / "designs.csv"
    file.write_bytes(
        "\ufeffchain_*.x_43;chain_0.links.*.mass;name\r\n0,33;100%;one\r\n0,34;90%;two\r\n".encode()
    )
    out = tmp_path / "answer.json"
    words = ["sweep", *ARCH, "--samples", "41", "--designs", str(file), "--jobs", "1"]
    code, _, err = run("pollard-pin sweep", [*words, "--json", str(out)], capfd)
    assert code == 0, err
    found = json.loads(out.read_bytes())
    assert [one["values"] for one in found["designs"]] == [[0.33, 1.0, "one"], [0.34, 0.9, "two"]]
    assert found["judged"] == 2


def test_a_key_with_two_columns_is_refused_rather_than_one_of_them_taken(tmp_path, capfd):
    file = tmp_path / "designs.csv"
    file.write_text("chain_0.x_32,name,chain_0.x_32\n0.3,one,0.31\n", encoding="utf-8")
    code, _, err = run("pollard-pin sweep", ["sweep", *ARCH, "--designs", str(file)], capfd)
    assert code == 2
    assert "columns 1 and 3 are both called 'chain_0.x_32'" in " ".join(err.split())


def test_a_dry_run_says_what_there_is_and_judges_nothing_else(tmp_path, capfd):
    words = ["sweep", *ARCH, "--vary", "chain_*.x_43=0.3:0.36:1000", "--vary", "chain_0.x_32=1,2"]
    code, out, _ = run("pollard-pin sweep", [*words, "--dry-run"], capfd)
    assert code == 0
    assert "2,000 designs in 200 chunks of 10; one takes" in out
    assert "(mean of 5)" in " ".join(out.split()), "designs from all over say how long one takes"
    assert list(tmp_path.iterdir()) == []


def test_keys_can_be_listed(capfd):
    code, out, _ = run("scout-pin sweep", ["sweep", "--keys", "legs.*.x_3"], capfd)
    assert code == 0
    assert re.search(r"legs\.left\.x_3\s+0\.0746", out)
    assert run("pollard-pin sweep", ["sweep", "--keys", "*"], capfd)[1].count("\n") > 100


def test_designs_that_all_fail_end_with_1_and_their_reason(capfd):
    words = ["sweep", *ARCH, "--vary", "chain_*.x_87=0.1,0.11", "--jobs", "1"]
    code, out, _ = run("pollard-pin sweep", words, capfd)
    assert code == 1
    assert "0 of 2 designs keep every limit" in out
    assert "unreachable" in out


def test_designs_are_timed_and_planned(tmp_path, capfd):
    timed = ["sweep", *ARCH, "--timed", "fastest", "--jobs", "1"]
    more = ["--vary", "assumptions.joint_limits.effort=2,4", "--json", str(tmp_path / "t.json")]
    assert run("pollard-pin sweep", [*timed, *more], capfd)[0] == 0
    found = json.loads((tmp_path / "t.json").read_bytes())
    times = [one["cells"][1] for one in found["designs"]]
    assert times[0] > times[1] > 0
    planned = ["sweep", "--plan", "speed=0.03", "--steps", "1", "--jobs", "1"]
    more = ["--vary", "torso.mass=0.16,0.17", "--json", str(tmp_path / "p.json")]
    assert run("scout-pin sweep", [*planned, *more], capfd)[0] == 0
    found = json.loads((tmp_path / "p.json").read_bytes())
    assert [one["cells"][0] for one in found["designs"]] == [True, True]


def test_json_on_standard_output_is_all_that_stands_there(capfd):
    words = ["sweep", *ARCH, "--samples", "41", "--vary", "chain_0.x_32=0.33", "--jobs", "1"]
    code, out, _ = run("pollard-pin sweep", [*words, "--json", "-"], capfd)
    assert code == 0
    assert json.loads(out)["feasible"] == 1
