"""Writes a .msh file of ours again with meshio, in its own words: Abaqus, and MSH 2.2 in text and binary.

Its writer of MSH 4.1 takes no entity with both triangles and quadrilaterals.
"""
import sys

import meshio
import numpy as np

mesh = meshio.read(sys.argv[1])
groups = {name: tag for name, (tag, dimension) in mesh.field_data.items() if dimension == 0}
flat = [k for k, block in enumerate(mesh.cells) if block.type != "vertex"]
points = {
    name: np.unique(
        np.concatenate(
            [
                block.data.ravel()
                for block, physical in zip(mesh.cells, mesh.cell_data["gmsh:physical"])
                if block.type == "vertex" and physical[0] == tag
            ]
        )
    )
    for name, tag in groups.items()
    if any(b.type == "vertex" and p[0] == tag for b, p in zip(mesh.cells, mesh.cell_data["gmsh:physical"]))
}
meshio.write("meshio.inp", meshio.Mesh(mesh.points, [mesh.cells[k] for k in flat], point_sets=points), file_format="abaqus")
for suffix, binary in (("", False), ("_binary", True)):
    meshio.write(f"meshio_22{suffix}.msh", mesh, file_format="gmsh22", binary=binary)
