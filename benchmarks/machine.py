"""What the benchmarks ran on."""

from __future__ import annotations

import importlib.metadata
import importlib.util
import os
import platform

PEERS = ("eaik", "mujoco")
"""Peers that may be missing."""


def machine() -> dict[str, object]:
    """Processor, cores, who else is at work, and the SIMD features that NumPy's loops use here."""
    import numpy as np

    simd = np.show_config(mode="dicts")["SIMD Extensions"]
    used = [*simd.get("baseline", []), *(one for one in simd.get("found", []) if enabled(one))]
    return {
        "processor": _processor(),
        "architecture": platform.machine(),
        "cores": cores(),
        "simd": used,
        "system": platform.system(),
        "load": os.getloadavg()[0] if hasattr(os, "getloadavg") else 0.0,
    }


def cores() -> int:
    """Cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def enabled(feature: str) -> bool:
    """Whether this processor has a feature, and nobody has switched it off."""
    from numpy._core._multiarray_umath import __cpu_features__

    return bool(__cpu_features__.get(feature, False))


def wide_features() -> list[str]:
    """Names of NumPy's loops for AVX-512, as far as they run here."""
    from numpy._core._multiarray_umath import __cpu_dispatch__

    wide = [one for one in __cpu_dispatch__ if one.startswith("AVX512") or one == "X86_V4"]
    return [one for one in wide if enabled(one)]


def versions() -> dict[str, str | None]:
    """Versions of what took part; None for what isn't installed."""
    from thesis_pin.version import __version__

    found: dict[str, str | None] = {
        "thesis-pin": __version__,
        "python": platform.python_version(),
    }
    for name in ("numpy", "scipy", "pin", "daqp", *PEERS):
        missing = name in PEERS and not installed(name)
        found[name] = None if missing else importlib.metadata.version(name)
    return found


def installed(name: str) -> bool:
    """Whether a peer is installed."""
    return importlib.util.find_spec(name) is not None


def _processor() -> str:
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as lines:
            named = [line.partition(":")[2] for line in lines if line.startswith("model name")]
    except OSError:
        named = []
    return " ".join(named[0].split()) if named else platform.processor()
