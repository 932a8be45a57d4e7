"""docs/your_biped.md, run as it stands: from nothing to a page to mail in six commands."""

import json
import re
import shlex
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
URDF = ROOT / "urdf" / "scout" / "scout.urdf"


def commands(page):
    """The command lines of a page's shell blocks."""
    blocks = re.findall(
        r"```bash\n(.*?)```", (ROOT / "docs" / page).read_text(encoding="utf-8"), re.DOTALL
    )
    return [shlex.split(line)[1:] for block in blocks for line in block.splitlines()]


def test_six_commands_lead_from_nothing_to_a_page_to_mail(scout_pin, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    lines = commands("your_biped.md")[:6]
    assert [words[0] for words in lines] == ["new", "info", "view", "new", "gait", "gait"]
    for words in lines:
        done = scout_pin(*words)
        assert done.returncode == 0, done.stderr
        assert "warning" not in done.stderr
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "My_biped can walk this gait" in page
    assert "thesis" not in re.sub(r"thesis[-_ ]pin", "", page.split("<script")[0])
    assert "<svg" in (tmp_path / "info.html").read_text(encoding="utf-8")


def test_nothing_is_replaced_unless_it_is_asked_for(scout_pin, tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text("mine")
    for words in (
        ("new", str(path)),
        ("new", str(path), "--motion", "sway"),
        ("new", str(path), "--example", "walk.toml"),
        ("from-urdf", URDF, "--to", str(path)),
    ):
        done = scout_pin(*words)
        assert done.returncode == 2
        assert "there is such a file already" in done.stderr
        assert path.read_text() == "mine"
    assert scout_pin("new", str(path), "--force").returncode == 0
    assert "my_biped" in path.read_text()


def test_a_file_that_is_there_is_refused_before_anything_is_read_for_it(scout_pin, tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text("mine")
    nowhere = tmp_path / "nowhere"
    for words in (
        ("new", path, "--motion", "sway", "--specification", nowhere),
        ("from-urdf", nowhere, "--to", path),
    ):
        done = scout_pin(*words)
        assert done.returncode == 2
        assert "there is such a file already" in done.stderr
        assert "No such file" in scout_pin(*words, "--force").stderr


def test_a_urdf_becomes_the_same_robot_on_the_command_line(scout_pin, tmp_path):
    target = tmp_path / "again.toml"
    done = scout_pin("from-urdf", URDF, "--to", str(target))
    assert done.returncode == 0, done.stderr
    reports = [
        json.loads(scout_pin("gait", *words, "--samples", "11", "--json", "-").stdout)
        for words in ((), ("--specification", str(target), "--gait", "thesis"))
    ]
    peaks = [report["summary"]["peak_torque"] for report in reports]
    assert peaks[1] == pytest.approx(peaks[0], rel=1e-9)
    assert scout_pin("from-urdf", URDF).stdout == target.read_text()


def test_a_tilted_sole_is_an_error_of_info_with_the_angle_to_change(scout_pin, tmp_path):
    path = tmp_path / "tilted.toml"
    assert scout_pin("new", str(path)).returncode == 0
    text = path.read_text().replace("[180, 90, 335, 50, 65, 180]", "[180, 90, 335, 50, 75, 180]")
    path.write_text(text)
    done = scout_pin("info", "--specification", str(path))
    assert done.returncode == 2
    assert "legs.left.beta_deg" in done.stderr
    assert "β_5 = 65° instead of 75°" in done.stderr
    path.write_text(
        text.replace('name = "my_biped"', 'name = "my_biped"\nneutral_soles = "tilted"')
    )
    assert scout_pin("info", "--specification", str(path)).returncode == 0


def test_a_robot_without_a_gait_is_shown_in_its_neutral_pose_and_told_where_gaits_are(
    scout_pin, tmp_path
):
    path, page, told = tmp_path / "mine.toml", tmp_path / "page.html", tmp_path / "told.json"
    assert scout_pin("new", str(path)).returncode == 0
    words = ("--specification", str(path))
    assert scout_pin("view", *words, "--html", str(page), "--json", str(told)).returncode == 0
    assert json.loads(told.read_text())["title"] == "My_biped, neutral pose"
    assert "new FILE --motion sway" in scout_pin("gait", *words).stderr
    # The thesis's own robot keeps the thesis's gait.
    assert scout_pin("view", "--html", str(page), "--json", str(told)).returncode == 0
    assert json.loads(told.read_text())["title"] == "Scout, gait thesis"


def test_sizes_that_nobody_builds_are_warned_of_and_refused_under_strict(scout_pin, tmp_path):
    path = tmp_path / "heavy.toml"
    assert scout_pin("new", str(path)).returncode == 0
    path.write_text(path.read_text().replace("mass = 0.50", "mass = 600.0", 1))
    done = scout_pin("info", "--specification", str(path), "--json", "-")
    assert done.returncode == 0
    assert "torso: 600 kg" in done.stderr
    document = json.loads(done.stdout)
    assert "torso: 600 kg" in document["implausible"][0]
    assert document["assumptions"][-1]["name"] == "implausible size"
    done = scout_pin("info", "--specification", str(path), "--strict")
    assert done.returncode == 2
    assert "torso: 600 kg" in done.stderr
