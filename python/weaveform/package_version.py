"""The version of this package, which is the program's: it stands in the repository's CMakeLists.txt and nowhere else."""

import re
from importlib import metadata
from pathlib import Path


def package_version():
    """Of a repository the number in CMakeLists.txt, of an installed package the one it was built with, from there."""
    file = Path(__file__).resolve().parents[2] / "CMakeLists.txt"
    found = re.search(r"^project\(weaveform VERSION (\S+)", file.read_text("utf-8"), re.M) if file.is_file() else None
    return found[1] if found else metadata.version("weaveform")
