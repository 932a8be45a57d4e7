"""However a command ends, it says so, tidily."""

import errno
import os
import signal
import subprocess
import sys
import threading
from pathlib import Path

import pytest

from thesis_pin.command.registry import Parser
from thesis_pin.command.running import SIGNALS, ExitCode, run, tidy_end
from thesis_pin.errors import BadInput, Busy, CannotWrite, Unreachable

ROOT = Path(__file__).parents[3]
CONVENTIONS = (ROOT / "docs" / "conventions.md").read_text(encoding="utf-8")


def doing(verb):
    parser = Parser(prog="robot-pin")
    parser.set_defaults(run=verb)
    return parser


def failing(error):
    def verb(_):
        raise error

    return doing(verb)


@pytest.mark.parametrize(
    ("error", "code", "says"),
    [
        (BadInput("it is bent", where="arm", allowed="straight"), 2, "arm: it is bent; allowed"),
        (Unreachable("too far"), 2, "error: too far"),
        (CannotWrite("no folder", where="--out"), 3, "error: --out: no folder"),
        (Busy("another run writes", where="--out"), 3, "another run writes"),
        (MemoryError(), 2, "isn't enough memory"),
        (KeyboardInterrupt(), 130, "interrupted"),
        (OSError(errno.ENOSPC, "No space left on device"), 3, "standard output can't be written"),
        (ZeroDivisionError("division by zero"), 70, "bug: ZeroDivisionError: division by zero"),
        (OSError(errno.ENOENT, "No such file"), 70, "bug: FileNotFoundError"),
        (RecursionError("too deep"), 70, "bug: RecursionError"),
    ],
)
def test_an_error_becomes_one_line_and_its_code(error, code, says, capsys):
    assert run(failing(error), []) == code
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("robot-pin: ")
    assert err.count("\n") == 1
    assert says in err


def test_garbage_is_looked_for_as_before_where_the_process_is_the_caller_s():
    text = """
import gc, sys
from scout_pin.cli import main
def after(*words):
    try:
        main(*words)
    except SystemExit:
        pass
    return gc.isenabled(), *gc.get_threshold()
print(gc.isenabled(), *gc.get_threshold())
print(*after(["--version"]))
sys.argv[1:] = ["--version"]
print(*after())
"""
    done = subprocess.run(
        [sys.executable, "-c", text],
        stdout=subprocess.PIPE,
        text=True,
        check=True,
        timeout=60,
        cwd=ROOT,
    )
    usual, called, own = (
        line.split() for line in done.stdout.splitlines() if line.startswith(("True", "False"))
    )
    assert called == usual
    assert own[0] == "True"
    assert int(own[1]) > 10 * int(usual[1])


@pytest.mark.parametrize("code", [ExitCode.DONE, ExitCode.NO])
def test_a_verb_s_own_code_is_the_command_s(code):
    assert run(doing(lambda _: code), []) == code


def while_a_compiled_module_is_imported(signalled):
    """What such modules make of an exception that a signal raises in them."""

    def verb(_):
        raise ImportError("initialization failed") from signalled

    return doing(verb)


def test_ctrl_c_while_a_compiled_module_is_imported_is_no_bug(capsys):
    assert run(while_a_compiled_module_is_imported(KeyboardInterrupt()), []) == 130
    assert capsys.readouterr().err == "robot-pin: interrupted\n"


def test_a_signal_to_end_while_a_compiled_module_is_imported_ends_the_process():
    with pytest.raises(SystemExit) as end:
        run(while_a_compiled_module_is_imported(SystemExit(143)), [])
    assert end.value.code == 143


def test_a_bug_says_where_it_is_and_how_to_report_it(capsys):
    assert run(failing(KeyError("left\nknee")), []) == 70
    err = capsys.readouterr().err
    assert "test_running.py, line" in err
    assert "please report it" in err
    assert "--debug" in err
    assert "Traceback" not in err


def test_debug_shows_a_bug_s_traceback(capsys):
    assert run(failing(KeyError("left_knee")), ["--debug"]) == 70
    err = capsys.readouterr().err
    assert "Traceback (most recent call last)" in err
    assert err.splitlines()[-1].startswith("robot-pin: bug: KeyError")


def test_messages_are_shown_not_obeyed(capsys):
    run(failing(BadInput("the name \x1b]0;owned\x07\0 is " + "x" * 50_000)), [])
    err = capsys.readouterr().err
    assert "\\x1b]0;owned\\x07\\x00" in err
    assert set(err) & set(map(chr, range(32))) == {"\n"}
    assert len(err) < 1200


def process(verb, **options):
    """A command whose verb is a line of Python, in a process of its own."""
    code = (
        "import sys, os\n"
        "from thesis_pin.command.registry import Parser\n"
        "from thesis_pin.command.running import run\n"
        f"def verb(_):\n    {verb}\n    return 0\n"
        "p = Parser(prog='robot-pin'); p.set_defaults(run=verb)\n"
        "sys.exit(run(p))"
    )
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    return subprocess.run(
        [sys.executable, "-c", code, *options.pop("words", [])],
        stderr=subprocess.PIPE,
        text=True,
        env=environment,
        check=False,
        **options,
    )


@pytest.mark.parametrize("lines", [1, 100_000])
def test_a_closed_pipe_ends_quietly_with_0(lines):
    reader, writer = os.pipe()
    os.close(reader)
    done = process(f"print('x\\n' * {lines})", stdout=writer)
    os.close(writer)
    assert (done.returncode, done.stderr) == (0, "")


def test_help_into_a_closed_pipe_ends_quietly_with_0():
    reader, writer = os.pipe()
    os.close(reader)
    done = process("pass", stdout=writer, words=["--help"])
    os.close(writer)
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full on this system")
@pytest.mark.parametrize("lines", [1, 100_000])
def test_a_full_standard_output_is_3(lines):
    with open("/dev/full", "w") as full:
        done = process(f"print('x\\n' * {lines})", stdout=full)
    assert done.returncode == 3
    assert done.stderr == (
        "robot-pin: error: standard output can't be written: No space left on device\n"
    )


def test_the_documents_list_every_code():
    table = CONVENTIONS.split("## Exit codes")[1].split("\n## ")[0]
    rows = [line.split("|")[1].strip() for line in table.splitlines() if line.startswith("| ")]
    assert [row for row in rows if row.isdigit()] == [str(code.value) for code in ExitCode]


HOLDS_MESHES = """
import signal, sys, time
import scout_pin
from thesis_pin.command.running import tidy_end

signal.signal(signal.SIGHUP, signal.SIG_DFL)  # ignored below nohup, and inherited

with tidy_end():
    robot = scout_pin.load()
    robot.visual_model  # Pinocchio reads meshes from files
    print("ready", flush=True)
    time.sleep(300)
"""


@pytest.mark.parametrize("number", SIGNALS)
def test_a_robot_whose_command_a_signal_ends_leaves_no_temporary_folder(tmp_path, number):
    process = subprocess.Popen(
        [sys.executable, "-c", HOLDS_MESHES],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        cwd=ROOT,
        env=os.environ | {"TMPDIR": str(tmp_path)},
    )
    try:
        ready = process.stdout.readline()
        during = list(tmp_path.iterdir())
        process.send_signal(number)
        _, rest = process.communicate(timeout=60)
    finally:
        process.kill()
    assert ready == "ready\n"
    assert during, "the folder that has to go was never there"
    assert process.returncode == 128 + number
    assert "Traceback" not in rest
    assert list(tmp_path.iterdir()) == []


def test_what_is_open_is_closed_and_the_signals_are_as_before():
    closed = []

    @tidy_end()
    def verb():
        try:
            signal.raise_signal(signal.SIGTERM)
        finally:
            closed.append(True)

    with pytest.raises(SystemExit) as ended:
        verb()
    assert (ended.value.code, closed) == (143, [True])
    assert signal.getsignal(signal.SIGTERM) is signal.SIG_DFL


def test_ignored_signals_stay_ignored_as_nohup_wants():
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        with tidy_end():
            signal.raise_signal(signal.SIGHUP)
            assert signal.getsignal(signal.SIGTERM) is not signal.SIG_DFL
        assert signal.getsignal(signal.SIGHUP) is signal.SIG_IGN
    finally:
        signal.signal(signal.SIGHUP, before)


def test_a_command_run_in_a_thread_leaves_signals_alone():
    seen = []

    @tidy_end()
    def verb():
        seen.append(signal.getsignal(signal.SIGTERM))

    thread = threading.Thread(target=verb)
    thread.start()
    thread.join()
    assert seen == [signal.SIG_DFL]


@pytest.mark.parametrize("through", ["itself", "a link"])
def test_what_a_command_reads_is_not_replaced_by_what_it_writes(through, tmp_path, capsys):
    read = tmp_path / "arm.urdf"
    read.write_text("<robot/>")
    target = read if through == "itself" else tmp_path / "link.json"
    if through == "a link":
        target.symlink_to(read)
    parser = doing(lambda _: ExitCode.DONE)
    parser.add_argument("file")
    parser.add_argument("--json")
    assert run(parser, [str(read), "--json", str(target)]) == ExitCode.BAD_INPUT
    assert "would replace" in capsys.readouterr().err
    assert run(parser, [str(read), "--json", str(tmp_path / "new.json")]) == ExitCode.DONE
    assert read.read_text() == "<robot/>"


@pytest.mark.parametrize("through", ["its name", "another name", "a link"])
def test_two_outputs_can_t_be_one_file(through, tmp_path, capsys):
    first, second = tmp_path / "out", tmp_path / "out"
    if through == "another name":
        (tmp_path / "inner").mkdir()
        second = tmp_path / "inner" / ".." / "out"
    if through == "a link":
        second = tmp_path / "link"
        second.symlink_to(first)
    parser = doing(lambda _: ExitCode.DONE)
    parser.add_argument("--json")
    parser.add_argument("--html")
    command = ["--json", str(first), "--html", str(second)]
    assert run(parser, command) == ExitCode.BAD_INPUT
    assert "--json and --html can't both be" in capsys.readouterr().err
    first.write_text("of an earlier run")
    assert run(parser, command) == ExitCode.BAD_INPUT
    assert run(parser, [*command[:-1], str(tmp_path / "page")]) == ExitCode.DONE


def test_two_outputs_can_go_to_one_pipe(tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    parser = doing(lambda _: ExitCode.DONE)
    parser.add_argument("--json")
    parser.add_argument("--html")
    assert run(parser, ["--json", str(pipe), "--html", str(pipe)]) == ExitCode.DONE
