"""Which files of a folder one run wrote, and whether they are still whole."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

MANIFEST = "manifest.sha256"
"""File in each folder that names what we wrote, as ``sha256sum`` does."""
_HEADING = "# What one run of thesis-pin wrote here."
"""Its first line, without which a manifest is somebody else's."""


def unlike_manifest(folder: str | Path) -> tuple[str, ...]:
    """Files of a folder that aren't what its :data:`MANIFEST` says; empty if it has none."""
    listed = _listed(Path(folder))
    return tuple(name for name, total in listed.items() if _sum(Path(folder) / name) != total)


def manifest(sums: Mapping[str, str]) -> bytes:
    """The manifest of files with these SHA-256 sums: name → sum in hexadecimal."""
    lines = (f"{total}  {name}" for name, total in sorted(sums.items()))
    return "\n".join((_HEADING, *lines, "")).encode()


def _listed(folder: Path) -> dict[str, str]:
    """The manifest of a folder: name → sum; empty if there is none or it isn't one."""
    try:
        heading, *lines = (folder / MANIFEST).read_text(encoding="utf-8").splitlines()
        pairs = [line.split("  ", 1) for line in lines]
        return {name: total for total, name in pairs} if heading == _HEADING else {}
    except (OSError, ValueError):
        return {}


def _sum(path: Path) -> str:
    try:
        with path.open("rb") as stream:
            import hashlib

            return hashlib.file_digest(stream, "sha256").hexdigest()
    except OSError:
        return ""


def stale_files(folder: Path, sums: Mapping[str, str]) -> dict[str, str]:
    """What an earlier run wrote, nobody changed, and this run doesn't write."""
    return {
        name: total
        for name, total in _listed(folder).items()
        if name not in sums
        and (folder / name).resolve().is_relative_to(folder)
        and not (folder / name).is_symlink()
        and _sum(folder / name) == total
    }
