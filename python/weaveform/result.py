"""Folders that the program has written, opened: result = wf.open("results/hemisphere_pw").

Everything is read when it is first asked for and then kept; open the folder anew to see what a run under way has
added."""

import json
import weakref
import xml.etree.ElementTree as ElementTree
from collections.abc import Sequence
from functools import cached_property
from pathlib import Path

from .errors import FileError
from .grid import Frame, Grid, read_vtk
from .table import Table

try:
    import tomllib
except ImportError:  # before Python 3.11
    try:
        import tomli as tomllib
    except ImportError:
        tomllib = None


class Folder:
    """Any folder of the program's files. `answer` is what the call that made it came to (text, warnings, log), None of
    one that was only opened."""

    def __init__(self, path, answer=None):
        self.path = Path(path)
        self.answer = answer
        if not self.path.is_dir():
            raise FileError(f"{path}: is no folder; give the one that a command wrote (--output, results/NAME)")

    def _read(self, name):
        try:
            return (self.path / name).read_text("utf-8")
        except (OSError, UnicodeDecodeError) as error:
            reason = getattr(error, "strerror", None) or error
            said = f"{self.path / name}: cannot be read ({reason}); has the command that writes it been run?"
            raise FileError(said) from error

    def json(self, name):
        """A .json file as Python's dict."""
        text = self._read(name)
        try:
            return json.loads(text)
        except json.JSONDecodeError as error:
            place = f"{self.path / name}:{error.lineno}:{error.colno}"
            raise FileError(f"{place}: is damaged ({error.msg}); run again") from error

    def table(self, name):
        """A .csv file as a Table of NumPy columns."""
        return Table(self.path / name)

    def grid(self, name):
        """A .vtu file of yarns and cells as a Grid of NumPy arrays."""
        return Grid(self.path / name)

    def vtk(self, name):
        """A .vtu, .vtp or .stl file as a VTK object, e.g. "contours.vtp"."""
        return read_vtk(self.path / name)

    @cached_property
    def scene(self):
        """The folder's scene.toml, in which every value stands, as Python's dict. Needs Python 3.11, or tomli."""
        if tomllib is None:
            raise ImportError("no TOML reader: use Python 3.11 or later, or pip install tomli")
        text = self._read("scene.toml")
        try:
            return tomllib.loads(text)
        except tomllib.TOMLDecodeError as error:
            raise FileError(f"{self.path / 'scene.toml'}: is damaged ({error}); run again") from error

    def __repr__(self):
        return f"<{type(self).__name__} {self.path}>"


class Frames(Sequence):
    """The frames of a result in the order of time; frames[-1] is the last. A frame is read when it is first used, and
    kept as long as somebody holds it or no other has been asked for, so that a loop over all needs the memory of one."""

    def __init__(self, result):
        self.path = index = result.path / "result.pvd"  # for ParaView
        try:
            sets = ElementTree.parse(index).getroot().iter("DataSet")
        except OSError as error:
            raise FileError(f"{index}: cannot be read ({error.strerror}); solve the scene first") from error
        except ElementTree.ParseError as error:
            raise FileError(f"{index}: is damaged ({error}); solve again") from error
        self._result = result
        self._listed = [(result.path / one.get("file"), float(one.get("timestep"))) for one in sets]
        self._held = weakref.WeakValueDictionary()  # place -> Frame
        self._last = None

    @property
    def times(self):
        """s; of each frame."""
        import numpy as np

        return np.array([time for _, time in self._listed])

    def at(self, time):
        """The frame nearest to a time (s)."""
        return self[min(range(len(self)), key=lambda k: abs(self._listed[k][1] - time))]

    def __getitem__(self, which):
        if isinstance(which, slice):
            return [self[k] for k in range(*which.indices(len(self)))]
        place = range(len(self))[which]
        frame = self._held.get(place)
        if frame is None:
            frame = self._held[place] = Frame(*self._listed[place], self._result)
        self._last = frame
        return frame

    def __len__(self):
        return len(self._listed)


class Result(Folder):
    """What `run`, `mesh`, `solve`, `post`, `drape` and `import` leave; what has not been written yet raises FileError."""

    @cached_property
    def history(self):
        """history.csv: displacements, forces, angles and energies over time (docs/results.md)."""
        return self.table("history.csv")

    @cached_property
    def summary(self):
        """summary.json: the answers, the run's warnings and how far to trust them."""
        return self.json("summary.json")

    @cached_property
    def statistics(self):
        """solve.json: what the solve cost and how well its energy is balanced."""
        return self.json("solve.json")

    @property
    def finished(self):
        """Whether the solve has come to its end; asked anew each time."""
        return bool(self.json("solve.json")["finished"])

    @cached_property
    def frames(self):
        """The motion."""
        return Frames(self)

    @cached_property
    def mesh(self):
        """mesh.vtu: yarns and cells before the motion."""
        return self.grid("mesh.vtu")

    @cached_property
    def drape(self):
        """drape.vtu: the blank draped over its tool."""
        return self.grid("drape.vtu")

    @cached_property
    def drape_summary(self):
        """drape.json: what the drape came to."""
        return self.json("drape.json")

    def tools_at_start(self, program=None):
        """Name -> Surface of the tools where they stand at time 0 (see tools.py); asked of the program once."""
        if not hasattr(self, "_tools"):
            from .tools import tools_at_start

            self._tools = tools_at_start(self.path, program)
        return self._tools


class Study(Folder):
    """What `study` leaves."""

    @cached_property
    def cases(self):
        """study.csv: a row for each case, its settings and its measures."""
        return self.table("study.csv")

    def result(self, row):
        """The Result of a case, by its row in `cases` (from 0)."""
        return Result(self.path / "cases" / self.cases["case"][row])


class Fit(Folder):
    """What `fit` leaves: `card` is the path of the material card, for a scene's `fabric.material`."""

    @property
    def card(self):
        return self.path / "card.toml"

    @cached_property
    def report(self):
        """report.json: the card's numbers with their uncertainty."""
        return self.json("report.json")


class Comparison(Folder):
    """What `compare` leaves."""

    @cached_property
    def summary(self):
        """comparison.json."""
        return self.json("comparison.json")

    @cached_property
    def stages(self):
        """stages.csv: a row for each stage of the measurement."""
        return self.table("stages.csv")


def open_result(path):
    """A Result of a folder that the program wrote. Raises FileError where there is no folder."""
    return Result(path)
