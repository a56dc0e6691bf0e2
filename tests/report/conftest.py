"""The browser, and reports of small results that the program under test (the environment's WEAVEFORM) computes."""

import json
import os
import subprocess
from pathlib import Path

import pytest

from page import Page, start_browser

repository = Path(__file__).resolve().parents[2]
examples = repository / "examples"


def weaveform(*arguments):
    done = subprocess.run([os.environ["WEAVEFORM"], *map(str, arguments)], capture_output=True, text=True, cwd=repository)
    assert done.returncode == 0, f"weaveform {arguments}: {done.stderr}"


def overrides(**values):
    return [word for key, value in values.items() for word in ("--set", f"{key.replace('__', '.')}={value}")]


@pytest.fixture(scope="session")
def browser():
    browser = start_browser()
    yield browser
    browser.quit()


@pytest.fixture
def opened(browser):
    return lambda file: Page(browser, file)


@pytest.fixture(scope="session")
def bias(tmp_path_factory):
    """The result folder of a bias extension of 76 cells, with its report."""
    folder = tmp_path_factory.mktemp("bias") / "result"
    weaveform("run", examples / "bias_extension_pw.toml", "--output", folder, "--quiet",
              *overrides(blank__coarsening=4, output__frames=6))
    weaveform("post", "report", folder)
    return folder


def drawn(folder, scene, coarsening):
    weaveform("run", examples / scene, "--output", folder, "--quiet", *overrides(blank__coarsening=coarsening, output__frames=8))
    weaveform("post", "report", folder)
    return folder


@pytest.fixture(scope="session")
def hemisphere(tmp_path_factory):
    """A drawn hemisphere of 121 cells with three tools."""
    return drawn(tmp_path_factory.mktemp("hemisphere") / "result", "hemisphere_pw_fast.toml", 8)


@pytest.fixture(scope="session")
def stack(tmp_path_factory):
    """Two plies of 256 and 264 cells drawn together."""
    return drawn(tmp_path_factory.mktemp("stack") / "result", "hemisphere_two_plies.toml", 4)


@pytest.fixture(scope="session")
def compared(tmp_path_factory):
    """A bias extension beside what an instrument would have measured of it."""
    folder = tmp_path_factory.mktemp("compared")
    result = folder / "result"
    weaveform("run", examples / "bias_extension_pw.toml", "--output", result, "--quiet", *overrides(blank__coarsening=4))
    weaveform("post", "virtual", result, "--format", "aramis", "--output", folder / "lab",
              *overrides(instrument__facet_size=6, virtual__noise=0.02, virtual__stages=3))
    weaveform("post", "compare", result, folder / "lab" / "stages", "--settings", folder / "lab" / "settings.toml")
    weaveform("post", "report", result)
    return result


@pytest.fixture(scope="session")
def study(tmp_path_factory):
    """A study of two coarsenings."""
    folder = tmp_path_factory.mktemp("study")
    (folder / "study.toml").write_text(
        f'scene = {json.dumps(str(examples / "bias_extension_pw.toml"))}\nmeasures = ["grips.top.force_N"]\n'
        '[set]\n"grip.top.travel" = 10\n[grid]\nblank.coarsening = [5, 4]\n')
    weaveform("study", folder / "study.toml", "--output", folder / "out", "--report", "--quiet")
    return folder / "out"
