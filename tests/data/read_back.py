"""Opens every file given with meshio, or with VTK, and prints what is in it: one line a file.

FILE points P cells C names NAME,NAME,...      or      FILE error WHAT
"""
import sys
import warnings

warnings.simplefilter("ignore")


def by_meshio(name):
    import meshio

    mesh = meshio.read(name)
    for blocks in mesh.cell_data.values():
        assert sum(len(block) for block in blocks) == sum(len(block.data) for block in mesh.cells)
    names = list(mesh.point_data) + list(mesh.cell_data) + list(mesh.field_data)
    return len(mesh.points), sum(len(block.data) for block in mesh.cells), names


def by_vtk(name):
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader
    from vtkmodules.vtkIOGeometry import vtkSTLReader

    reader = {"vtu": vtkXMLUnstructuredGridReader, "vtp": vtkXMLPolyDataReader, "stl": vtkSTLReader}[name[-3:]]()
    errors = []
    reader.AddObserver("ErrorEvent", lambda *_: errors.append(1))
    reader.SetFileName(name)
    reader.Update()
    grid = reader.GetOutput()
    assert not errors, "VTK complains"
    names = []
    for data in (grid.GetPointData(), grid.GetCellData(), grid.GetFieldData()):
        names += [data.GetAbstractArray(k).GetName() for k in range(data.GetNumberOfArrays())]
    return grid.GetNumberOfPoints(), grid.GetNumberOfCells(), names


for name in sys.argv[2:]:
    try:
        points, cells, names = {"meshio": by_meshio, "vtk": by_vtk}[sys.argv[1]](name)
        print(name, "points", points, "cells", cells, "names", ",".join(str(n).replace(" ", "_") for n in names) or "-")
    except BaseException as trouble:  # meshio leaves by sys.exit where it does not know what to do
        print(name, "error", type(trouble).__name__, str(trouble).replace("\n", " "))
