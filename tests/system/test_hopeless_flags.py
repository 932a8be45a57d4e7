"""Every flag of every command with values it can't take: one message, code 2 or 3, no file."""

import pytest
from commands import OUTPUTS, ROOT, VERBS, example, flags, into, run

HOPELESS = {"nothing": "", "two dashes": "--", "a NUL": "\0x", "far too long": "9" * 5000}
"""Values that no flag of any command takes."""

FLAGS = [
    (name, action.option_strings[0])
    for name in VERBS
    for action in flags(name)
    if action.option_strings and action.nargs != 0
]


@pytest.mark.parametrize(("name", "flag"), FLAGS, ids=map(" ".join, FLAGS))
def test_hopeless_values_are_refused_before_anything_is_written(
    name, flag, tmp_path, monkeypatch, capfd
):
    for folder in ("examples", "urdf"):
        (tmp_path / folder).symlink_to(ROOT / folder)
    before = set(tmp_path.iterdir())
    monkeypatch.chdir(tmp_path)
    outputs = [] if flag in OUTPUTS else into(name, tmp_path)
    if name.endswith(" view") and flag == "--json":
        outputs = ["--html", str(tmp_path / "page.html")]  # rather than serve it
    for what, value in HOPELESS.items():
        code, out, err = run(name, [*example(name), *outputs, f"{flag}={value}"], capfd)
        allowed = (2, 3) if flag in OUTPUTS else (2,)
        assert code in allowed, (what, out, err)
        assert err.count(": error: ") == 1, (what, err)
        assert len(err) < 3000, what
        assert out == "", what
        assert set(tmp_path.iterdir()) == before, what


@pytest.mark.parametrize("name", ["scout-pin gait", "pollard-pin trajectory"])
def test_more_samples_than_memory_holds_is_one_message(name, monkeypatch, capfd):
    import numpy as np

    def full(*_, **__):
        raise MemoryError

    command, verb = name.split()
    monkeypatch.setattr(np, "linspace", full)
    code, out, err = run(name, [verb, "--samples", "100000000"], capfd)
    assert (code, out) == (2, "")
    assert err == f"{command}: error: there isn't enough memory for this; ask for less at once\n"


@pytest.mark.parametrize("text", ["x = " + "[" * 5000, "[" * 5000])
def test_a_file_nested_too_deeply_is_refused(text, tmp_path, capfd):
    (tmp_path / "deep.toml").write_text(text)
    words = ["info", "--specification", str(tmp_path / "deep.toml")]
    code, _, err = run("scout-pin info", words, capfd)
    assert code == 2
    assert "the specification is" in err
