"""Meshes and frames: their elements and fields as NumPy arrays, and as VTK, PyVista and meshio objects.

VTK is imported when a mesh is first read, so that calling the program and reading tables need no VTK."""

from collections.abc import Mapping
from functools import cached_property
from pathlib import Path

import numpy as np

from .errors import FileError

_line, _triangle, _polygon, _quad = 3, 5, 7, 9  # VTK's numbers of these shapes
_meshio_names = {1: "vertex", _line: "line", 4: "line", _triangle: "triangle", _polygon: "polygon", _quad: "quad"}


def _arrays(data):
    """Name -> NumPy array of a VTK field; views of VTK's memory."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    named = (data.GetArray(k) for k in range(data.GetNumberOfArrays()))
    return {array.GetName(): vtk_to_numpy(array) for array in named if array is not None}


def read_vtk(path):
    """The vtkUnstructuredGrid of a .vtu or vtkPolyData of a .vtp or .stl file. Raises FileError when it is missing or
    damaged."""
    from vtkmodules import vtkIOGeometry, vtkIOXML

    path = Path(path)
    readers = {
        ".vtu": vtkIOXML.vtkXMLUnstructuredGridReader,
        ".vtp": vtkIOXML.vtkXMLPolyDataReader,
        ".stl": vtkIOGeometry.vtkSTLReader,
    }
    if path.suffix not in readers:
        raise FileError(f"{path}: no reader for '{path.suffix}'; there are {', '.join(readers)}")
    if not path.is_file():
        raise FileError(f"{path}: is not there; has the command that writes it been run, and to its end?")
    damaged = FileError(f"{path}: is damaged, or still being written; wait, or run again")
    if path.suffix != ".stl" and not path.read_bytes()[-64:].rstrip().endswith(b"</VTKFile>"):
        raise damaged  # only the closing tag proves that all of a file is there
    said = []
    listen = lambda _object, _event: said.append(True)  # noqa: E731  and VTK does not write to standard error
    reader = readers[path.suffix]()
    reader.AddObserver("ErrorEvent", listen)
    reader.GetExecutive().AddObserver("ErrorEvent", listen)
    reader.SetFileName(str(path))
    reader.Update()
    if said or reader.GetOutput().GetNumberOfPoints() == 0 and path.suffix != ".vtp":  # contours may be without lines
        raise damaged
    return reader.GetOutput()


class Fields(Mapping):
    """Arrays by name of one kind of place: points, yarns or cells. values.nodes says which points an element has (of
    points: None); len(values.nodes) is how many there are."""

    def __init__(self, what, arrays, nodes=None):
        self._what, self._arrays, self.nodes = what, arrays, nodes

    def __getitem__(self, name):
        if name not in self._arrays:
            raise KeyError(f"{self._what} have no array '{name}'; they have {', '.join(self._arrays) or 'none'}")
        return self._arrays[name]

    def __iter__(self):
        return iter(self._arrays)

    def __len__(self):
        return len(self._arrays)

    def __repr__(self):
        return f"<{self._what}: {', '.join(self._arrays)}>"


class Grid:
    """A mesh, or a frame of the motion: yarn elements (lines of two nodes) and shear cells (polygons).

    What the arrays mean, their signs and units: docs/results.md. Arrays are views of VTK's memory: copy one before
    changing it."""

    def __init__(self, path, time=None):
        self.path = Path(path)
        self.time = time  # s; None of what is no frame

    @cached_property
    def _grid(self):
        return read_vtk(self.path)

    def vtk(self):
        """vtkUnstructuredGrid; the one that the arrays are views of."""
        return self._grid

    @cached_property
    def positions(self):
        """(points, 3), mm; of a frame those of its moment, of drape.vtu on the tool, of mesh.vtu at the start."""
        from vtkmodules.util.numpy_support import vtk_to_numpy

        return vtk_to_numpy(self._grid.GetPoints().GetData())

    @cached_property
    def _shapes(self):
        """VTK's number of each element's shape, where each begins in the list of all their nodes, and that list."""
        from vtkmodules.util.numpy_support import vtk_to_numpy

        cells = self._grid.GetCells()
        begin = vtk_to_numpy(cells.GetOffsetsArray())
        return vtk_to_numpy(self._grid.GetCellTypesArray()), begin, vtk_to_numpy(cells.GetConnectivityArray())

    def _nodes(self, chosen):
        """(elements, most nodes of one), -1 beyond the nodes of an element with fewer."""
        _, begin, node = self._shapes
        first, count = begin[:-1][chosen], np.diff(begin)[chosen]
        nodes = np.full((len(first), count.max(initial=0)), -1, dtype=np.int64)
        for k in range(nodes.shape[1]):
            nodes[count > k, k] = node[first[count > k] + k]
        return nodes

    def _elements(self, what, chosen):
        arrays = {name: values[chosen] for name, values in self.elements.items()}
        return Fields(what, arrays, self._nodes(chosen))

    @cached_property
    def points(self):
        """Fields at the points."""
        return Fields("points", _arrays(self._grid.GetPointData()))

    @cached_property
    def elements(self):
        """Fields of all elements as the file has them: yarn elements first, then cells."""
        return Fields("elements", _arrays(self._grid.GetCellData()))

    @cached_property
    def fields(self):
        """All arrays by name, of points and of elements, as the file has them."""
        return Fields("points and elements", {**self.points, **self.elements})

    @cached_property
    def yarns(self):
        """Fields of the yarn elements; yarns.nodes is (yarns, 2); yarns["family"] is 1 for warp, 2 for weft."""
        return self._elements("yarns", self._shapes[0] == _line)

    @cached_property
    def cells(self):
        """Fields of the shear cells; cells.nodes is (cells, most nodes), -1 beyond those of a cell with fewer."""
        return self._elements("cells", self._shapes[0] != _line)

    @cached_property
    def info(self):
        """Arrays that belong to the whole, e.g. "TimeValue" (s) of a frame, "spacing_mm" of a mesh."""
        return _arrays(self._grid.GetFieldData())

    @property
    def tool_numbers(self):
        """Tool's name -> its number in the points' "contact_tool"; empty without tools."""
        return {name[len("tool_") :]: int(value[0]) for name, value in self.info.items() if name.startswith("tool_")}

    def pyvista(self):
        """pyvista.UnstructuredGrid over the same memory."""
        return to_pyvista(self._grid)

    def meshio(self):
        """meshio.Mesh with all arrays: a block for each run of elements of one shape, in the file's order."""
        try:
            import meshio
        except ImportError as error:
            raise ImportError("meshio is not installed: apt install python3-meshio, or pip install meshio") from error
        shape, begin, node = self._shapes
        count = np.diff(begin)
        changes = np.flatnonzero((np.diff(shape) != 0) | (np.diff(count) != 0)) + 1
        runs = [run for run in np.split(np.arange(len(shape)), changes) if len(run)]
        blocks = [
            (_meshio_names[int(shape[run[0]])], node[begin[run[0]] : begin[run[-1] + 1]].reshape(len(run), -1))
            for run in runs
        ]
        fields = {name: [values[run] for run in runs] for name, values in self.elements.items()}
        return meshio.Mesh(self.positions, blocks, dict(self.points), fields, dict(self.info))

    def picture(self, file, field=None, **options):
        """Draws it off-screen into a PNG file, coloured by an array (see picture.picture)."""
        from .picture import picture

        return picture(self, file, field, **options)

    def __repr__(self):
        return f"<{type(self).__name__} {self.path.name}" + ("" if self.time is None else f" at {self.time:.6g} s") + ">"


class Frame(Grid):
    """The fabric, and its tools, at one moment of the motion; `time` in s."""

    def __init__(self, path, time, result):
        super().__init__(path, time)
        self.result = result

    @property
    def displacement(self):
        """(points, 3), mm, from the flat blank."""
        return self.points["displacement_mm"]

    def tools(self, program=None):
        """Name -> Surface of each tool where it stands at this moment; empty without tools (see tools.py)."""
        from .tools import tools_at

        return tools_at(self.result, self.time, program)


def to_pyvista(data):
    """A VTK object as PyVista's. Raises ImportError, with what to do, where PyVista is not installed."""
    try:
        import pyvista
    except ImportError as error:
        raise ImportError("PyVista is not installed: pip install pyvista, or use .vtk()") from error
    return pyvista.wrap(data)
