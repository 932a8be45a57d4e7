"""Run the tests of generated files as other processors would add up.

``python tests/processors.py [--all] [words for pytest]`` runs the tests marked ``bytes``
once for each setting of OpenBLAS, NumPy and the C library that this machine has. A setting is
run only if it is seen to change some bits: unknown names are ignored without a word.
"""

from __future__ import annotations

import hashlib
import math
import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
BLAS = "OPENBLAS_CORETYPE"
NUMPY = "NPY_DISABLE_CPU_FEATURES"
LIBC = "GLIBC_TUNABLES"
NO_FMA = "glibc.cpu.hwcaps=-AVX2,-FMA"


def settings(every: bool) -> list[dict[str, str]]:
    """Environments to run under, besides the machine's own."""
    from numpy._core._multiarray_umath import __cpu_dispatch__, __cpu_features__

    newer = " ".join(name for name in __cpu_dispatch__ if __cpu_features__[name])
    old = {NUMPY: newer} if newer else {}
    if os.uname().machine != "x86_64":
        return [old, {BLAS: "ARMV8"}, {BLAS: "NEOVERSEN1"}]
    if not every:
        return [{BLAS: "Nehalem", LIBC: NO_FMA} | old, {BLAS: "Haswell"}, {BLAS: "SkylakeX"}]
    kinds = ("Prescott", "Nehalem", "Haswell", "Zen", "SkylakeX", "Cooperlake")
    return [*({BLAS: kind} for kind in kinds), old, {LIBC: NO_FMA}]


def probe() -> str:
    """Digest of sums, products, factorisations and sines on this processor."""
    import numpy as np

    random = np.random.default_rng(0)
    square, line = random.normal(size=(60, 60)), random.normal(size=1001)
    values = [square @ square, square @ line[:60], line @ line, line.sum(), square.sum(axis=0)]
    values += [np.linalg.svd(square)[1], np.linalg.solve(square, line[:60])]
    values += [np.sin(line), np.cos(100 * line), np.exp(line), np.sqrt(np.abs(line))]
    values += [np.array([f(50 * x) for x in line for f in (math.sin, math.cos, math.atan)])]
    return hashlib.sha256(b"".join(np.asarray(value).tobytes() for value in values)).hexdigest()


def probed(setting: dict[str, str]) -> str:
    """What :func:`probe` gives under a setting; empty if this processor can't run it."""
    done = subprocess.run(
        [sys.executable, __file__, "--probe"],
        env=os.environ | setting,
        capture_output=True,
        text=True,
        check=False,
    )
    return done.stdout if done.returncode == 0 else ""


def marked() -> list[str]:
    """Files that mark tests: to collect all others takes longer than to run what is marked."""
    texts = {path: path.read_text(encoding="utf-8") for path in (ROOT / "tests").rglob("test_*.py")}
    return sorted(str(path) for path, text in texts.items() if "pytest.mark.bytes" in text)


def main(words: list[str]) -> int:
    """Run the marked tests under each setting that changes bits; the first failure's code."""
    every = "--all" in words
    words = [word for word in words if word != "--all"]
    if not any(Path(word.partition("::")[0]).exists() for word in words):
        words += marked()
    seen = {probed({}): "the machine's own"}
    for setting in settings(every):
        name = " ".join(f"{key}={value}" for key, value in setting.items())
        bits = probed(setting)
        if not bits or bits in seen:
            why = f"the same bits as {seen[bits]}" if bits else "this processor can't"
            print(f"{name or 'no setting of NumPy'}: not run, {why}", flush=True)
            continue
        seen[bits] = name
        print(name, flush=True)
        command = [sys.executable, "-m", "pytest", "-q", "-m", "bytes", *words]
        if code := subprocess.run(command, cwd=ROOT, env=os.environ | setting).returncode:
            return code
    return 0


if __name__ == "__main__":
    if sys.argv[1:] == ["--probe"]:
        print(probe())
    else:
        sys.exit(main(sys.argv[1:]))
