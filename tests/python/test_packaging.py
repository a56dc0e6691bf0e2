"""Wheel and source archive are built and installed with what Debian has, and carry the program's version."""

import os
import re
import shutil
import subprocess
import sys
import tarfile
import zipfile

import pytest

import weaveform as wf
from conftest import repository

pytest.importorskip("setuptools")
pytest.importorskip("wheel")
pytest.importorskip("pip")

version = re.search(r"project\(weaveform VERSION (\S+)", (repository / "CMakeLists.txt").read_text())[1]
offline = ["--no-deps", "--no-build-isolation", "--no-index", "--disable-pip-version-check", "--quiet"]


def run(command, **options):
    done = subprocess.run(command, capture_output=True, text=True, **options)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout.strip()


@pytest.fixture(scope="module")
def copy(tmp_path_factory):
    """The package in a repository of its own: builds leave files beside the sources."""
    root = tmp_path_factory.mktemp("repository")
    shutil.copytree(repository / "python", root / "python", ignore=shutil.ignore_patterns("build", "dist", "*.egg-info"))
    shutil.copy(repository / "CMakeLists.txt", root)
    return root / "python"


@pytest.fixture(scope="module")
def archive(copy, tmp_path_factory):
    target = tmp_path_factory.mktemp("dist")
    code = f"from setuptools.build_meta import build_sdist; build_sdist({str(target)!r})"
    run([sys.executable, "-W", "ignore", "-c", code], cwd=copy)
    return next(target.iterdir())


def installed(source, folder):
    """The version that an installed package says it has, away from the repository."""
    run([sys.executable, "-m", "venv", "--system-site-packages", "--without-pip", folder])
    python = folder / "bin" / "python"
    run([sys.executable, "-m", "pip", "--python", python, "install", *offline, source])
    away = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    code = "import weaveform as wf; print(wf.__version__, wf.__file__); wf.program_version()"
    said, _, place = run([python, "-c", code], env=away, cwd=folder).partition(" ")
    assert place.startswith(str(folder))
    return said


def test_the_versions_of_package_and_program_are_one(request):
    assert wf.__version__ == version == wf.program_version().split()[1]


def test_it_installs_from_the_repository(copy, tmp_path):
    assert installed(copy, tmp_path / "venv") == version


def test_it_installs_from_the_source_archive(archive, tmp_path):
    assert archive.name == f"weaveform-{version}.tar.gz"
    with tarfile.open(archive) as files:
        assert not [name for name in files.getnames() if "CMakeLists" in name]
    assert installed(archive, tmp_path / "venv") == version


def test_the_wheel_is_pure_and_has_every_module(copy, tmp_path):
    run([sys.executable, "-m", "pip", "wheel", *offline, "-w", tmp_path, copy])
    wheel = next(tmp_path.iterdir())
    assert wheel.name == f"weaveform-{version}-py3-none-any.whl"
    modules = {file.name for file in (repository / "python" / "weaveform").glob("*.py")}
    assert modules == {name.partition("/")[2] for name in zipfile.ZipFile(wheel).namelist() if name.startswith("weaveform/")}


def test_another_version_in_the_repository_is_another_of_the_package(copy, tmp_path):
    root = tmp_path / "repository"
    shutil.copytree(copy, root / "python")
    shutil.copy(copy.parent / "CMakeLists.txt", root)
    text = (root / "CMakeLists.txt").read_text().replace(f"weaveform VERSION {version}", "weaveform VERSION 7.8.9")
    (root / "CMakeLists.txt").write_text(text)
    code = "from setuptools.build_meta import build_wheel; print(build_wheel('.'))"
    assert "weaveform-7.8.9-py3-none-any.whl" in run([sys.executable, "-W", "ignore", "-c", code], cwd=root / "python")
