"""What the tests share: the program under test, and small results of it, solved once.

The program is the environment's WEAVEFORM and the package the repository's own, as tests/CMakeLists.txt says; by hand:
    WEAVEFORM=build/bin/weaveform PYTHONPATH=python /usr/bin/python3 -m pytest tests/python"""

from pathlib import Path

import pytest

import weaveform as wf

repository = Path(__file__).resolve().parents[2]
small = {"blank.coarsening": 4, "grip.top.travel": 10, "analysis.duration": 0.1, "output.frames": 4}


@pytest.fixture(scope="session")
def examples():
    return repository / "examples"


@pytest.fixture(scope="session")
def bias(examples, tmp_path_factory):
    """A bias extension of 76 cells: no tools."""
    folder = tmp_path_factory.mktemp("bias") / "result"
    return wf.run(examples / "bias_extension_pw.toml", small, output=folder, progress=False)


@pytest.fixture(scope="session")
def hemisphere(examples, tmp_path_factory):
    """A drawn hemisphere of 36 cells: three tools, quads and triangles."""
    folder = tmp_path_factory.mktemp("hemisphere") / "result"
    overrides = {"blank.coarsening": 16, "output.frames": 6}
    return wf.run(examples / "hemisphere_pw_fast.toml", overrides, output=folder, progress=False)
