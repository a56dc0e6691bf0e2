"""A result's tools as triangles and quads where they stand at a moment.

The shapes are the program's own: it writes them, within 0.2 mm, into a deck (`weaveform export --format openradioss`),
from which they are read. They are moved as the program moves them: along each tool's direction by its
`NAME.displacement_mm` of history.csv, between rows in a straight line."""

import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .errors import FileError
from .program import call

_prefix = "tool_"  # of a tool's part in the deck


@dataclass(frozen=True)
class Surface:
    """A tool's surface; what goes on for ever ends where the fabric cannot get to."""

    name: str
    positions: np.ndarray  # (points, 3), mm
    faces: np.ndarray  # (faces, 4) of points, counter-clockwise from outside; the last is -1 of a triangle

    def moved(self, way):
        """The same, displaced by a vector (mm)."""
        return Surface(self.name, self.positions + way, self.faces)

    def vtk(self):
        """vtkPolyData."""
        from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
        from vtkmodules.vtkCommonCore import vtkPoints
        from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

        real = self.faces >= 0
        begin = np.concatenate([[0], np.cumsum(real.sum(axis=1))]).astype(np.int64)
        points, faces, data = vtkPoints(), vtkCellArray(), vtkPolyData()
        points.SetData(numpy_to_vtk(np.ascontiguousarray(self.positions), deep=True))
        faces.SetData(
            numpy_to_vtkIdTypeArray(begin, deep=True),
            numpy_to_vtkIdTypeArray(np.ascontiguousarray(self.faces[real], dtype=np.int64), deep=True),
        )
        data.SetPoints(points)
        data.SetPolys(faces)
        return data

    def pyvista(self):
        """pyvista.PolyData."""
        from .grid import to_pyvista

        return to_pyvista(self.vtk())


def _blocks(deck):
    """(keyword, rows) of a Radioss deck, comments left out."""
    keyword, rows = "", []
    for line in deck.splitlines():
        if line.startswith("/"):
            yield keyword, rows
            keyword, rows = line, []
        elif not line.startswith("#"):
            rows.append(line)
    yield keyword, rows


def surfaces_of_deck(deck):
    """Name -> Surface of the rigid tools in the text of a deck that the program wrote."""
    numbers, positions, faces, names = [], [], {}, {}
    for keyword, rows in _blocks(deck):
        kind, _, part = keyword[1:].partition("/")
        if kind == "NODE":
            numbers += [int(row[:10]) for row in rows]
            positions += [[float(row[k : k + 20]) for k in (10, 30, 50)] for row in rows]
        elif kind in ("SHELL", "SH3N"):
            corners = ([int(one) for one in row.split()[1:]] for row in rows)
            faces.setdefault(part, []).extend((one + [0])[:4] for one in corners)
        elif kind == "PART" and rows[0].startswith(_prefix):
            names[part] = rows[0][len(_prefix) :].strip()
    place = np.full(max(numbers, default=0) + 1, -1)
    place[numbers] = np.arange(len(numbers))
    positions = np.array(positions)
    found = {}
    for part, name in names.items():
        nodes = place[np.array(faces[part])]  # 0, no node of the deck, gives -1
        used = np.unique(nodes[nodes >= 0])
        found[name] = Surface(name, positions[used], np.where(nodes < 0, -1, np.searchsorted(used, nodes)))
    return found


def tools_at_start(folder, program=None):
    """Name -> Surface of a result's tools at time 0. Raises what the program's export raises (missing tool files...)."""
    meshed = (Path(folder) / "mesh.vtu").exists()  # of a drape there is the scene alone
    source = folder if meshed else Path(folder) / "scene.toml"
    with tempfile.TemporaryDirectory() as place:
        file = Path(place) / "tools_0000.rad"
        call(["export", source, "--format=openradioss", f"--output={file}", "--quiet"], program=program, progress=False)
        return surfaces_of_deck(file.read_text("utf-8"))


def direction_of(tool):
    """Unit vector of a tool's motion, from its table in a result's scene.toml; where that leaves it open: the way a
    plane or ring faces, a sphere's tip, else downwards (docs/scene.md)."""
    axis = np.array(tool.get("axis", [0, 0, 1]), dtype=float)
    usual = {"plane": axis, "ring": axis, "sphere": -axis}.get(tool["shape"], np.array([0.0, 0.0, -1.0]))
    way = np.array(tool.get("direction", usual), dtype=float)
    return way / np.linalg.norm(way)


def tools_at(result, time, program=None):
    """Name -> Surface of a result's tools at a time (s). Raises FileError when the history lacks them, and what the
    export raises."""
    described = result.scene.get("tools", {})
    if not described:
        return {}
    placed = {}
    for name, surface in result.tools_at_start(program).items():
        column = f"{name}.displacement_mm"
        if column not in result.history or not result.history.rows:
            raise FileError(f"{result.path / 'history.csv'}: has no {column} yet; solve the scene, or wait for a row")
        way = np.interp(time, result.history["time_s"], result.history[column])
        placed[name] = surface.moved(way * direction_of(described[name]))
    return placed
