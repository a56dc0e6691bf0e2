"""Weaveform from Python: runs the program, and opens what it wrote.

    import weaveform as wf
    result = wf.run("examples/bias_extension_pw.toml", {"blank.coarsening": 2})
    result.history["top.force_N"]                      # NumPy, N
    result.frames[-1].cells["shear_angle_deg"]         # NumPy, deg
    result.frames[-1].picture("formed.png")            # off-screen

The program is found by program=..., else by the environment's WEAVEFORM, else on PATH. docs/python.md is the manual.
"""

from .commands import check, compare, drape, export, fit, mesh, post, report, run, solve, study, virtual
from .errors import (
    Defect,
    FileError,
    InputError,
    Interrupted,
    PhysicsError,
    ProgramNotFound,
    WeaveformError,
)
from .grid import Frame, Grid
from .package_version import package_version
from .program import Answer, Line, call, find_program
from .program import version as program_version
from .result import Comparison, Fit, Folder, Frames, Result, Study
from .result import open_result as open
from .table import Table, unit_of, words_of
from .tools import Surface

__version__ = package_version()

__all__ = [
    "Answer", "Comparison", "Defect", "FileError", "Fit", "Folder", "Frame", "Frames", "Grid", "InputError",
    "Interrupted", "Line", "PhysicsError", "ProgramNotFound", "Result", "Study", "Surface", "Table",
    "WeaveformError", "call", "check", "compare", "drape", "export", "find_program", "fit", "mesh", "open", "post",
    "program_version", "report", "run", "solve", "study", "unit_of", "virtual", "words_of",
]
