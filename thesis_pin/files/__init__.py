"""The one place that writes: files and folders, whole or not at all."""

from thesis_pin.files.folder import Claim, write_folder
from thesis_pin.files.manifest import MANIFEST, unlike_manifest
from thesis_pin.files.single import (
    check_file,
    is_standard_output,
    name_as_text,
    write_file,
    write_files,
)

__all__ = [
    "MANIFEST",
    "Claim",
    "check_file",
    "is_standard_output",
    "name_as_text",
    "unlike_manifest",
    "write_file",
    "write_files",
    "write_folder",
]
