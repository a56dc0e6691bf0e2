"""A place to draw where there is no screen.

VTK draws off-screen by itself where it was built for it (EGL, OSMesa: the packages of PyPI from 9.4). Debian's
python3-vtk9 can only draw through X, and ends the whole process when there is none. So it is asked first, and where no X
server answers, Xvfb (Debian: xvfb), which needs no screen, is started for as long as the picture takes."""

import contextlib
import ctypes
import ctypes.util
import os
import select
import shutil
import subprocess
import threading

_patience_s = 30  # of starting Xvfb
_one_at_a_time = threading.Lock()  # DISPLAY is the whole process'


class NoDisplay(RuntimeError):
    """There is no way to draw here; says what to install."""


def _needs_x():
    """Whether the VTK at hand draws through X, if there is a server or not."""
    from vtkmodules import vtkRenderingOpenGL2  # noqa: F401  brings the window's class in
    from vtkmodules.vtkRenderingCore import vtkRenderWindow

    return vtkRenderWindow().GetClassName() == "vtkXOpenGLRenderWindow"


def _x_answers():
    """Whether the X server that DISPLAY names lets us in."""
    if not os.environ.get("DISPLAY"):
        return False
    name = ctypes.util.find_library("X11")
    if name is None:
        return False
    x11 = ctypes.CDLL(name)
    x11.XOpenDisplay.restype = ctypes.c_void_p
    connection = x11.XOpenDisplay(None)
    if connection:
        x11.XCloseDisplay(ctypes.c_void_p(connection))
    return bool(connection)


def _first_line(file, patience=_patience_s):
    """Text up to the line's end, which comes in a write of its own: Xvfb dies when nobody takes it. "" when it does not
    come."""
    text = b""
    while not text.endswith(b"\n"):
        if not select.select([file], [], [], patience)[0]:
            return ""
        more = os.read(file, 64)
        if not more:
            return ""
        text += more
    return text.decode().strip()


def _start_xvfb():
    """(process, display) of an X server of our own."""
    program = shutil.which("Xvfb")
    if program is None:
        raise NoDisplay(
            "this VTK draws through X, no X server answers and there is no Xvfb: apt install xvfb, or set DISPLAY, or"
            " pip install vtk (9.4 or later draws without X)"
        )
    read, write = os.pipe()
    command = [program, "-displayfd", str(write), "-screen", "0", "640x480x24", "-nolisten", "tcp", "-noreset"]
    process = subprocess.Popen(command, pass_fds=(write,), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(write)
    number = _first_line(read)
    os.close(read)
    if not number:
        process.kill()
        process.wait()
        raise NoDisplay(f"{program} did not start within {_patience_s} s; start an X server and set DISPLAY")
    return process, f":{number}"


@contextlib.contextmanager
def _display_of_our_own():
    process, name = _start_xvfb()
    before = os.environ.get("DISPLAY")
    os.environ["DISPLAY"] = name
    try:
        yield
    finally:
        if before is None:
            del os.environ["DISPLAY"]
        else:
            os.environ["DISPLAY"] = before
        process.terminate()
        process.wait()


@contextlib.contextmanager
def display():
    """While it lasts, VTK can draw off-screen, for one thread at a time. Windows must be finalised before it ends. Raises
    NoDisplay."""
    with _one_at_a_time:
        if not _needs_x() or _x_answers():
            yield
        else:
            with _display_of_our_own():
                yield
