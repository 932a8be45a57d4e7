"""Folders change in one step or say that they are a mixture; what isn't ours stays."""

import fcntl
import os
import random
import stat
import subprocess
import sys
from functools import partial
from pathlib import Path

import pytest
from killing import one_by_one as one_by_one_in_a_process
from users import as_user

from thesis_pin.errors import Busy, CannotWrite
from thesis_pin.files import MANIFEST, Claim, unlike_manifest, write_folder

ROOT = Path(__file__).parents[3]
OLD = {"a.txt": b"old a", "sub/b.txt": b"old b", "stale.txt": b"old only"}
NEW = {"a.txt": b"new a", "sub/b.txt": b"new b", "sub/c.txt": b"new c"}


def tree(folder: Path) -> dict[str, bytes]:
    """All files of a folder but the manifest."""
    files = (path for path in folder.rglob("*") if path.is_file() and path.name != MANIFEST)
    return {str(path.relative_to(folder)): path.read_bytes() for path in files}


@pytest.fixture
def one_by_one(monkeypatch):
    """As on a system that can't exchange two folders."""
    monkeypatch.setattr("thesis_pin.files.folder.swap", lambda *_: False)


@pytest.fixture(params=["exchanged", "one by one"])
def way(request):
    """Both ways a folder's files come to stand in it."""
    if request.param == "one by one":
        request.getfixturevalue("one_by_one")
    return request.param


def test_a_folder_is_made_with_those_above_it_and_nothing_is_left_beside_it(tmp_path):
    write_folder(tmp_path / "deep" / "er", NEW)
    assert tree(tmp_path / "deep" / "er") == NEW
    assert os.listdir(tmp_path) == ["deep"]
    assert os.listdir(tmp_path / "deep") == ["er"]


def test_the_second_run_replaces_the_first_and_what_only_the_first_wrote(tmp_path, way):
    folder = tmp_path / "out"
    write_folder(folder, OLD)
    before = folder.stat().st_ino
    write_folder(folder, NEW)
    assert tree(folder) == NEW
    assert (folder.stat().st_ino != before) == (way == "exchanged")
    assert os.listdir(tmp_path) == ["out"]


def test_the_manifest_is_one_that_sha256sum_reads(tmp_path):
    write_folder(tmp_path, NEW)
    done = subprocess.run(
        ["sha256sum", "--check", "--strict", MANIFEST],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stdout.count(": OK")) == (0, len(NEW)), done.stderr
    (tmp_path / "a.txt").write_text("edited")
    assert unlike_manifest(tmp_path) == ("a.txt",)


def test_what_others_put_into_a_folder_stays_as_it_is(tmp_path, way):
    folder = tmp_path / "out"
    write_folder(folder, OLD)
    (folder / "notes").write_text("mine")
    (folder / "notes").chmod(0o400)
    (folder / "sub" / "more").write_text("mine too")
    (folder / "link").symlink_to("nowhere")
    os.mkfifo(folder / "pipe")
    (folder / "stale.txt").write_text("ours once, edited since")
    inode = (folder / "notes").stat().st_ino
    write_folder(folder, NEW)
    kept = {"notes": b"mine", "sub/more": b"mine too", "stale.txt": b"ours once, edited since"}
    assert tree(folder) == NEW | kept
    assert os.readlink(folder / "link") == "nowhere"
    assert (folder / "pipe").is_fifo()
    assert (folder / "notes").stat().st_ino == inode
    assert stat.S_IMODE((folder / "notes").stat().st_mode) == 0o400


def test_somebody_elses_manifest_makes_no_file_ours(tmp_path):
    folder = tmp_path / "downloads"
    folder.mkdir()
    for name in ("film", "song"):
        (folder / name).write_bytes(b"mine")
    total = subprocess.run(
        ["sha256sum", "film", "song"], cwd=folder, capture_output=True, text=True, check=True
    ).stdout
    for name in ("SHA256SUMS", MANIFEST):
        (folder / name).write_text(total)
    write_folder(folder, NEW)
    assert tree(folder) == NEW | {"film": b"mine", "song": b"mine", "SHA256SUMS": total.encode()}


@pytest.mark.parametrize("reason", ["folders of others", "links of ours", "links to a folder"])
def test_a_folder_that_cannot_be_exchanged_keeps_its_inode_and_all_it_holds(tmp_path, reason):
    folder = tmp_path / "out"
    write_folder(folder, OLD)
    if reason == "folders of others":
        (folder / "theirs" / "deep").mkdir(parents=True)
        (folder / "theirs" / "deep" / "file").write_text("kept")
    elif reason == "links of ours":
        (folder / "a.txt").rename(tmp_path / "real")
        (folder / "a.txt").symlink_to("../real")
    else:
        (folder / "sub").rename(tmp_path / "real")
        (folder / "sub").symlink_to("../real")
    before = folder.stat().st_ino
    write_folder(folder, NEW)
    assert folder.stat().st_ino == before
    if reason == "folders of others":
        assert (folder / "theirs" / "deep" / "file").read_text() == "kept"
    elif reason == "links of ours":
        assert (folder / "a.txt").is_symlink()
        assert (tmp_path / "real").read_bytes() == b"new a"
    else:
        assert (folder / "sub").is_symlink()
        assert (tmp_path / "real" / "c.txt").read_bytes() == b"new c"
    assert unlike_manifest(folder) == ()
    assert {name: (folder / name).read_bytes() for name in NEW} == NEW


def test_the_folder_a_user_stands_in_stays_the_one_they_stand_in(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_folder(".", NEW)
    assert tree(Path()) == NEW
    assert Path().stat().st_ino == tmp_path.stat().st_ino
    assert sorted(os.listdir()) == ["a.txt", MANIFEST, "sub"]
    assert f".{tmp_path.name}.partial" not in os.listdir(tmp_path.parent)


def test_a_link_to_a_folder_is_followed(tmp_path, way):
    write_folder(tmp_path / "real", OLD)
    (tmp_path / "link").symlink_to("real")
    write_folder(tmp_path / "link", NEW)
    assert (tmp_path / "link").is_symlink()
    assert tree(tmp_path / "real") == NEW


def test_modes_are_kept_and_new_files_obey_the_umask(tmp_path, way):
    folder = tmp_path / "out"
    before = os.umask(0o027)
    try:
        write_folder(folder, OLD)
        (folder / "a.txt").chmod(0o600)
        folder.chmod(0o770)
        write_folder(folder, NEW)
    finally:
        os.umask(before)
    modes = {path: stat.S_IMODE((folder / path).stat().st_mode) for path in (".", *NEW)}
    assert modes == {".": 0o770, "a.txt": 0o600, "sub/b.txt": 0o640, "sub/c.txt": 0o640}


def test_what_cannot_be_written_is_refused_before_the_work_and_stays(tmp_path):
    (tmp_path / "file").write_text("kept")
    for name, says in {
        "file": "isn't a folder",
        "file/deep": "file isn't a folder",
        "n" * 256: "too long",
        "a\0b": "null byte",
    }.items():
        with pytest.raises(CannotWrite, match=says):
            Claim(f"{tmp_path}/{name}")
    with pytest.raises(CannotWrite, match="isn't the name of a folder"):
        Claim("")
    assert os.listdir(tmp_path) == ["file"]
    (tmp_path / "out" / "a.txt").mkdir(parents=True)
    with pytest.raises(CannotWrite, match=r"there is a folder 'a\.txt'"):
        write_folder(tmp_path / "out", NEW)
    assert os.listdir(tmp_path / "out") == ["a.txt"]


def test_a_user_is_refused_where_they_may_not_write_and_nothing_changes(tmp_path):
    for name, mode in {"theirs": 0o755, "mine": 0o777, "locked": 0o777}.items():
        (tmp_path / name).mkdir()
        (tmp_path / name).chmod(mode)

    def work(root: Path) -> str:
        for name in ("theirs", "theirs/new", "theirs/new/deep"):
            with pytest.raises(CannotWrite, match="Permission denied"):
                Claim(root / name)
        write_folder(root / "mine" / "out", OLD)
        (root / "mine" / "out").chmod(0o555)
        with pytest.raises(CannotWrite, match="Permission denied"):
            Claim(root / "mine" / "out")
        (root / "mine" / "out").chmod(0o755)
        (root / "mine" / "out" / "a.txt").chmod(0o444)
        with pytest.raises(CannotWrite, match="read-only"):
            write_folder(root / "mine" / "out", NEW)
        assert tree(root / "mine" / "out") == OLD
        # Nothing can be made beside this one: all is done inside.
        write_folder(root / "locked", NEW)
        assert sorted(os.listdir(root / "locked")) == ["a.txt", MANIFEST, "sub"]
        return "done"

    assert as_user(tmp_path, work) == "done"


def test_a_file_that_is_to_be_kept_is_not_replaced_by_another(tmp_path):
    read = tmp_path / "samples.csv"
    read.write_bytes(b"theirs")
    with Claim(tmp_path, keep=[read]) as claim:
        with pytest.raises(CannotWrite, match=r"reads samples\.csv"):
            claim.write({"report.json": b"ours", "samples.csv": b"ours"})
        claim.write({"report.json": b"ours", "samples.csv": b"theirs"})
    assert read.read_bytes() == b"theirs"
    assert (tmp_path / "report.json").read_bytes() == b"ours"


def test_a_claim_that_is_not_used_leaves_no_trace(tmp_path):
    with Claim(tmp_path / "deep" / "er" / "out") as claim:
        assert str(claim) == str(tmp_path / "deep" / "er" / "out")
        assert os.listdir(tmp_path / "deep" / "er") == [".out.partial"]
    assert os.listdir(tmp_path) == []


def other_run(folder: Path) -> subprocess.Popen[str]:
    """Another process that claims a folder, says so, and works until its input ends."""
    code = (
        "import sys\nfrom thesis_pin.files import Claim\n"
        f"with Claim({str(folder)!r}) as claim:\n    print('claimed', flush=True)\n"
        "    sys.stdin.read()\n    claim.write({'a.txt': b'theirs'})\n"
    )
    process = subprocess.Popen(
        [sys.executable, "-c", code],
        env=os.environ | {"PYTHONPATH": str(ROOT)},
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    assert process.stdout.readline() == "claimed\n"
    return process


def test_of_two_runs_into_one_folder_the_second_is_refused_before_its_work(tmp_path):
    folder = tmp_path / "out"
    first = other_run(folder)
    with pytest.raises(Busy, match=f"^{folder}: another run is writing to this folder"):
        Claim(folder)
    with Claim(tmp_path / "elsewhere"):
        pass
    first.communicate(timeout=30)
    assert first.returncode == 0
    assert tree(folder) == {"a.txt": b"theirs"}
    write_folder(folder, NEW)
    assert tree(folder) == NEW
    assert os.listdir(tmp_path) == ["out"]


def test_two_claims_of_one_process_are_told_apart(tmp_path):
    with Claim(tmp_path / "out") as claim:
        with pytest.raises(Busy):
            Claim(tmp_path / "out")
        claim.write(NEW)
    assert tree(tmp_path / "out") == NEW


def test_a_killed_run_keeps_nobody_out_also_while_its_workers_live(tmp_path):
    code = (
        "import os, sys, time\nfrom thesis_pin.files import Claim\n"
        f"claim = Claim({str(tmp_path / 'out')!r})\n"
        "if not os.fork():\n    sys.stdin.read()\n    os._exit(0)\n"
        "print('claimed', flush=True)\nos.kill(os.getpid(), 9)\n"
    )
    with subprocess.Popen(
        [sys.executable, "-c", code],
        env=os.environ | {"PYTHONPATH": str(ROOT)},
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
    ) as process:
        assert process.wait(timeout=30) == -9
        assert os.listdir(tmp_path) == [".out.partial"]
        write_folder(tmp_path / "out", NEW)
        assert os.listdir(tmp_path) == ["out"]


def test_a_lock_that_its_last_owner_removes_is_taken_anew(tmp_path, monkeypatch):
    lock, lockf = tmp_path / ".out.partial" / "lock", fcntl.lockf

    def late(*arguments: int) -> None:
        if not calls:
            lock.unlink()  # between our opening and our locking it
        calls.append(1)
        lockf(*arguments)

    calls: list[int] = []
    monkeypatch.setattr("thesis_pin.files.folder.fcntl.lockf", late)
    with Claim(tmp_path / "out"):
        assert lock.exists()
        assert len(calls) == 2


def lay(folder: Path, files: dict[str, bytes]) -> None:
    """Whatever stands in a folder, it is what a first run and a user's note leave."""
    write_folder(folder, files)
    (folder / "notes").write_text("mine")


def test_an_exchanged_folder_is_old_or_new_whatever_line_a_run_is_killed_at(tmp_path, killer):
    folder, note = tmp_path / "out", {"notes": b"mine"}
    seen = []
    for line in range(0, 5000, 3):
        lay(folder, OLD)
        assert tree(folder) == OLD | note
        done = not killer.at_line([partial(write_folder, folder, NEW)], line)
        found = tree(folder)
        assert found in (OLD | note, NEW | note)
        assert unlike_manifest(folder) == ()
        assert set(os.listdir(tmp_path)) <= {"out", ".out.partial"}
        seen.append(found == NEW | note)
        if done:
            break
    assert done
    assert (seen[0], seen[-1]) == (False, True)
    assert sorted(seen) == seen  # there is one moment at which it changes
    write_folder(folder, NEW)
    assert os.listdir(tmp_path) == ["out"]


@pytest.mark.parametrize("before", ["one of our runs", "files of the same names"])
def test_what_a_killed_run_leaves_of_single_files_is_known_to_be_a_mixture(
    tmp_path, one_by_one, before, killer
):
    folder, note = tmp_path / "out", {"notes": b"mine"}
    write = partial(one_by_one_in_a_process, write_folder, folder, NEW)
    mixtures = 0
    for line in range(0, 5000, 3):
        lay(folder, OLD)
        if before != "one of our runs":
            (folder / MANIFEST).unlink()
            (folder / "stale.txt").unlink()
        old = tree(folder)
        done = not killer.at_line([write], line)
        found, unlike = tree(folder), unlike_manifest(folder)
        assert found["notes"] == b"mine"
        assert found in (old, NEW | note) or unlike
        assert set(os.listdir(tmp_path)) <= {"out", ".out.partial"}
        assert set(os.listdir(folder)) <= {"sub", MANIFEST, "notes", *OLD, *NEW}
        mixtures += bool(unlike)
        if not done:
            with Claim(folder) as claim:
                assert claim.mixture == unlike
        else:
            break
    assert done
    assert mixtures  # it can happen, and was seen
    assert tree(folder) == NEW | note


def test_100_kills_at_any_moment_leave_a_whole_folder(tmp_path, killer):
    random.seed(2)
    folder, note = tmp_path / "out", {"notes": b"mine"}
    runs = [{f"{k}.bin": bytes([run]) * 1_000_000 for k in range(3)} for run in range(2)]
    lay(folder, runs[0])
    work = [partial(write_folder, folder, files) for files in runs]
    for _ in range(100):
        assert killer.after(work, random.uniform(0.001, 0.03))
        assert tree(folder) in [run | note for run in runs]
        assert set(os.listdir(tmp_path)) <= {"out", ".out.partial"}
    write_folder(folder, runs[0])
    assert os.listdir(tmp_path) == ["out"]


def test_runs_that_come_one_after_another_never_meet_a_dead_ones_lock(tmp_path):
    """Many processes for one folder: each writes it whole or is told that it is busy."""
    folder = tmp_path / "out"
    code = (
        "import sys, time\nfrom thesis_pin.errors import Busy\n"
        "from thesis_pin.files import write_folder\n"
        "done = 0\nwhile done < 20:\n    try:\n"
        f"        write_folder({str(folder)!r}, {{n: sys.argv[1].encode() for n in 'abc'}})\n"
        "        done += 1\n    except Busy:\n        pass\n    time.sleep(0.001)\n"
    )
    processes = [
        subprocess.Popen(
            [sys.executable, "-c", code, str(k)],
            env=os.environ | {"PYTHONPATH": str(ROOT)},
            stderr=subprocess.PIPE,
        )
        for k in range(4)
    ]
    assert [process.communicate(timeout=60)[1] for process in processes] == [b""] * 4
    assert len(set(tree(folder).values())) == 1
    assert unlike_manifest(folder) == ()
    assert os.listdir(tmp_path) == ["out"]
