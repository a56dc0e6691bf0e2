"""Where to cut: the trim curve of the formed part, and the same curve on the flat blank (docs/tutorial.md).

    python3 examples/tutorial/trim.py RESULT HEIGHT NAME

cuts the last frame of the result folder RESULT by the plane z = HEIGHT (mm) and writes the longest closed curve twice,
point by point, the first again at the end: NAME_formed.csv (x_mm,y_mm,z_mm, on the formed fabric) and NAME_flat.csv
(x_mm,y_mm, on the flat blank: `blank.outline` of a scene reads it). Needs the package in python/ and VTK. Ends with a
message when the plane cuts no closed curve.
"""
import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPlane
from vtkmodules.vtkFiltersCore import vtkCutter, vtkStripper
from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter

import weaveform as wf


def shells_only(frame):
    """The frame's shear cells without its yarns (which a plane would cut into points)."""
    surface = vtkGeometryFilter()
    surface.SetInputData(frame.vtk())
    surface.Update()
    cells = surface.GetOutput()
    cells.SetLines(None)
    cells.GetCellData().Initialize()
    return cells


def closed_curves(cells, height):
    """Closed curves of z = height: for each its points where they are, and the displacement that brought them there (mm)."""
    plane = vtkPlane()
    plane.SetOrigin(0.0, 0.0, height)
    plane.SetNormal(0.0, 0.0, 1.0)
    cutter = vtkCutter()
    cutter.SetInputData(cells)
    cutter.SetCutFunction(plane)
    joined = vtkStripper()
    joined.SetInputConnection(cutter.GetOutputPort())
    joined.JoinContiguousSegmentsOn()
    joined.SetMaximumLength(1_000_000)
    joined.Update()
    curves = joined.GetOutput()
    if not curves.GetNumberOfPoints():
        return []
    positions = vtk_to_numpy(curves.GetPoints().GetData())
    displacement = vtk_to_numpy(curves.GetPointData().GetArray("displacement_mm"))
    offsets = vtk_to_numpy(curves.GetLines().GetOffsetsArray())
    nodes = vtk_to_numpy(curves.GetLines().GetConnectivityArray())
    lines = [nodes[begin:end] for begin, end in zip(offsets[:-1], offsets[1:])]
    return [(positions[line], displacement[line]) for line in lines if len(line) > 3 and line[0] == line[-1]]


def length(points):
    return np.linalg.norm(np.diff(points, axis=0), axis=1).sum()


def write(file, heading, points):
    np.savetxt(file, points, delimiter=",", header=heading, comments="", fmt="%.4f")


def main(result, height, name):
    curves = closed_curves(shells_only(wf.open(result).frames[-1]), float(height))
    if not curves:
        sys.exit(f"{result}: the plane z = {height} mm cuts no closed curve out of the formed fabric")
    formed, displacement = max(curves, key=lambda curve: length(curve[0]))
    flat = (formed - displacement)[:, :2]
    write(f"{name}_formed.csv", "x_mm,y_mm,z_mm", formed)
    write(f"{name}_flat.csv", "x_mm,y_mm", flat)
    size = np.ptp(flat, axis=0)
    print(f"trim at z = {height} mm: {length(formed):.1f} mm around the part, "
          f"{length(flat):.1f} mm on the flat blank, {size[0]:.1f} x {size[1]:.1f} mm there")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
