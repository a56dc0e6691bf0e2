"""The version of the package is the program's own, which stands in one place: project(... VERSION ...) in the
repository's CMakeLists.txt. A source archive has left the repository and carries the number in its PKG-INFO."""

import re
from pathlib import Path

from setuptools import setup

here = Path(__file__).resolve().parent


def version() -> str:
    for file, pattern in (
        (here / "PKG-INFO", r"^Version: (\S+)"),
        (here.parent / "CMakeLists.txt", r"^project\(weaveform VERSION (\S+)"),
    ):
        found = re.search(pattern, file.read_text("utf-8"), re.MULTILINE) if file.is_file() else None
        if found:
            return found[1]
    raise SystemExit("setup.py: no version: neither PKG-INFO nor ../CMakeLists.txt is here; build from the repository")


setup(version=version())
