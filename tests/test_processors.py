"""Settings under which generated files have to come out the same."""

import processors


def test_a_setting_that_changes_no_bits_is_not_taken_for_a_check(monkeypatch, capsys):
    monkeypatch.delenv(processors.NUMPY, raising=False)  # this test may itself run under one
    unknown = {processors.NUMPY: "NO_SUCH_FEATURE"}
    monkeypatch.setattr(processors, "settings", lambda every: [unknown])
    assert processors.main(["--no-such-flag"]) == 0  # pytest would refuse the flag
    assert "NO_SUCH_FEATURE: not run, the same bits as the machine's own" in capsys.readouterr().out


def test_a_failure_under_a_setting_is_the_answer(monkeypatch):
    monkeypatch.setattr(processors, "settings", lambda every: [{processors.BLAS: "other"}])
    monkeypatch.setattr(processors, "probed", str)
    assert processors.main(["--no-such-flag"]) == 4  # pytest's exit code for wrong usage


def test_each_setting_names_only_features_that_numpy_can_switch_off():
    from numpy._core._multiarray_umath import __cpu_dispatch__

    for setting in processors.settings(every=True):
        assert set(setting.get(processors.NUMPY, "").split()) <= set(__cpu_dispatch__)


def test_the_probe_gives_the_same_bits_twice():
    assert processors.probed({}) == processors.probed({}) != ""
