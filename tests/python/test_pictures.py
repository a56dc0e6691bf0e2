"""Pictures and charts are drawn without a screen."""

import os
import shutil
import subprocess
import sys

import numpy as np
import pytest

import weaveform as wf
from weaveform.display import NoDisplay

pytest.importorskip("vtkmodules.vtkRenderingOpenGL2")


@pytest.fixture(autouse=True)
def no_screen(monkeypatch):
    monkeypatch.delenv("DISPLAY", raising=False)


@pytest.fixture(autouse=True, scope="module")
def somewhere_to_draw():
    from weaveform.display import _needs_x

    if _needs_x() and not shutil.which("Xvfb"):
        pytest.skip("this VTK draws through X only, and xvfb is not installed")


def pixels(file):
    """(height, width, 3), bottom row first."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOImage import vtkPNGReader

    reader = vtkPNGReader()
    reader.SetFileName(str(file))
    reader.Update()
    image = reader.GetOutput()
    width, height, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)[:, :, :3]


def near(picture, colour):
    """How many pixels are of a colour, nearly."""
    return (np.abs(picture.astype(int) - colour).max(axis=2) < 40).sum()


def test_the_zones_of_a_bias_extension_are_seen_in_their_colours(bias, tmp_path):
    file = bias.frames[-1].picture(tmp_path / "a.png", "absolute_shear_angle_deg", size=(400, 600), yarns=False)
    picture = pixels(file)
    assert picture.shape == (600, 400, 3)
    part = picture[int(0.13 * 600) :]  # the strip with the colour bar is below
    middle, top = part[len(part) // 2, 200], part[-30, 200]
    assert middle[1] > 180 and middle[2] < 90  # greatest shear: yellow
    assert top[1] < 60 and top[0] > 40  # none: violet
    assert near(part, (255, 255, 255)) > 0.3 * part[:, :, 0].size


def test_signed_angles_are_white_at_zero(hemisphere, tmp_path):
    file = hemisphere.frames[0].picture(tmp_path / "a.png", "shear_angle_deg", range=(-1, 1), yarns=False, size=(300, 300),
                                        view="top")
    part = pixels(file)[60:]
    assert near(part, (255, 255, 255)) > 0.9 * part[:, :, 0].size  # nothing is sheared yet


def test_tools_are_drawn_over_the_part(hemisphere, tmp_path):
    frame = hemisphere.frames[-1]
    without, with_tools = (pixels(frame.picture(tmp_path / f"{tools}.png", size=(400, 300), tools=tools)) for tools in (False, True))
    assert (np.abs(with_tools.astype(int) - without).max(axis=2) > 10).mean() > 0.1


def test_what_cannot_be_drawn_says_why(bias, tmp_path):
    frame = bias.frames[-1]
    with pytest.raises(KeyError, match="no array 'shear'.*shear_angle_deg"):
        frame.picture(tmp_path / "a.png", "shear")
    with pytest.raises(ValueError, match="ends in .png"):
        frame.picture(tmp_path / "a.jpg")
    with pytest.raises(ValueError, match="view 'left'.*oblique"):
        frame.picture(tmp_path / "a.png", view="left")
    with pytest.raises(OSError, match="cannot be written"):
        frame.picture(tmp_path / "nowhere" / "a.png")


def test_a_wrong_display_does_not_end_the_process(bias, tmp_path, monkeypatch):
    monkeypatch.setenv("DISPLAY", ":4711")
    assert bias.frames[-1].picture(tmp_path / "a.png", size=(200, 200)).exists()
    assert os.environ["DISPLAY"] == ":4711"


def test_without_any_way_to_draw_it_says_what_to_install(bias, tmp_path, monkeypatch):
    from weaveform.display import _needs_x

    if not _needs_x():
        pytest.skip("this VTK draws without X")
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(NoDisplay, match="apt install xvfb"):
        bias.frames[-1].picture(tmp_path / "a.png")


def test_no_server_of_ours_is_left(bias, tmp_path, monkeypatch):
    from weaveform.display import _needs_x

    if not _needs_x():
        pytest.skip("this VTK draws without X")
    (tmp_path / "Xvfb").write_text(f'#!/bin/sh\necho $$ > "{tmp_path}/pid"; exec "{shutil.which("Xvfb")}" "$@"\n')
    (tmp_path / "Xvfb").chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path), prepend=os.pathsep)
    bias.frames[-1].picture(tmp_path / "a.png", size=(200, 200))
    with pytest.raises(ProcessLookupError):
        os.kill(int((tmp_path / "pid").read_text()), 0)
    assert "DISPLAY" not in os.environ


@pytest.mark.parametrize("library", ["vtk", "matplotlib"])
def test_charts_have_their_curve(bias, tmp_path, library):
    pytest.importorskip({"vtk": "vtkmodules.vtkChartsCore"}.get(library, library))
    file = bias.history.chart("top.displacement_mm", ["top.force_N", "bottom.force_N"], tmp_path / "force.png",
                              library=library, size=(600, 400), title="force")
    picture = pixels(file)
    assert picture.shape == (400, 600, 3)
    coloured = (picture.max(axis=2).astype(int) - picture.min(axis=2)) > 60
    assert coloured[:, :300].any() and coloured[:, 300:].any()
    with pytest.raises(KeyError, match="no column 'force'"):
        bias.history.chart("time_s", "force", tmp_path / "none.png", library=library)


def test_the_example_makes_its_picture_and_its_curve(examples, tmp_path):
    example = examples / "python" / "force_and_picture.py"
    done = subprocess.run([sys.executable, example], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert "greatest shear angle" in done.stdout
    for name in ("shear_angle.png", "force.png"):
        picture = pixels(tmp_path / "results" / "python" / name)
        assert 0.01 < (picture.min(axis=2) < 200).mean() < 0.9, name


def test_the_example_is_ten_lines_of_ones_own(examples):
    text = (examples / "python" / "force_and_picture.py").read_text()
    code = [line for line in text.splitlines() if line.strip() and not line.startswith("#")]
    assert len(code) <= 10
