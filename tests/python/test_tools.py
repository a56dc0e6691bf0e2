"""Tools stand where the program had them: its own gaps between nodes and tools say so."""

import numpy as np
import pytest

import weaveform as wf

pytest.importorskip("vtkmodules.vtkFiltersCore")


def nearest_distance(surface, points):
    """mm, of points to a surface, by VTK."""
    from vtkmodules.vtkFiltersCore import vtkImplicitPolyDataDistance

    distance = vtkImplicitPolyDataDistance()
    distance.SetInput(surface.vtk())
    return np.abs([distance.EvaluateFunction(*point) for point in points])


def test_gaps_to_the_moved_tools_are_the_programs(hemisphere):
    offset = hemisphere.mesh.info["thickness_mm"][0] / 2
    close = 0
    for frame in hemisphere.frames:
        tools = frame.tools()
        assert set(tools) == {"binder", "die", "punch"} == set(frame.tool_numbers)
        gap = frame.points["contact_gap_mm"]
        out_of_it = gap > -offset  # the fabric's middle plane is
        distance = np.min([nearest_distance(tool, frame.positions) for tool in tools.values()], axis=0)
        assert np.abs(distance - offset - gap)[out_of_it].max(initial=0) < 0.2  # mm; chords of 0.1, in two ways on a sphere
        close += out_of_it.sum()
    assert close > 50


def test_a_punch_moves_by_its_travel_against_its_axis(hemisphere):
    first, last = (hemisphere.frames[k].tools()["punch"] for k in (0, -1))
    way = last.positions - first.positions
    assert np.allclose(way, way[0])
    assert way[0] == pytest.approx([0, 0, -hemisphere.history["punch.displacement_mm"][-1]], abs=1e-6)
    assert np.array_equal(first.faces, last.faces)


def test_without_tools_there_are_none(bias):
    assert bias.frames[-1].tools() == {} == bias.frames[-1].tool_numbers


def test_a_surface_is_the_same_in_vtk(hemisphere):
    from vtkmodules.util.numpy_support import vtk_to_numpy

    surface = hemisphere.frames[0].tools()["die"]
    data = surface.vtk()
    assert np.array_equal(vtk_to_numpy(data.GetPoints().GetData()), surface.positions)
    nodes = vtk_to_numpy(data.GetPolys().GetConnectivityArray())
    assert np.array_equal(nodes, surface.faces[surface.faces >= 0])


def test_triangles_of_cad_are_tools_too(examples, tmp_path):
    overrides = {"blank.coarsening": 6}
    meshed = wf.mesh(examples / "cad_box.toml", overrides, output=tmp_path / "box", progress=False, yes=True)
    tools = meshed.tools_at_start()
    assert set(tools) == set(meshed.scene["tools"])
    for tool in tools.values():
        assert len(tool.faces) > 0 and np.isfinite(tool.positions).all()
        assert tool.faces.max() == len(tool.positions) - 1


def test_a_draped_blank_lies_on_its_tool(examples, tmp_path):
    draped = wf.drape(examples / "drape_hemisphere.toml", {"blank.coarsening": 2}, output=tmp_path / "d", progress=False)
    dome = draped.tools_at_start()["dome"]
    distance = nearest_distance(dome, draped.drape.positions[::20])
    assert distance.min() > 0.05 and distance.max() < 0.5  # half a thickness of 0.5 mm, facets within 0.2


def test_a_decks_triangles_have_three_nodes_and_its_quads_four():
    from weaveform.tools import surfaces_of_deck

    nodes = [(7, 0, 0, 0), (3, 1, 0, 0), (4, 1, 1, 0), (9, 0, 1, 0), (5, 9, 9, 9)]
    deck = ["/BEGIN", "# a comment", "/NODE", *("%10d%20g%20g%20g" % node for node in nodes)]
    deck += [
        "/SHELL/12", "%10d" * 5 % (1, 7, 3, 4, 9), "/SH3N/12", "%10d" * 4 % (2, 4, 9, 7),
        "/SHELL/1", "%10d" * 5 % (3, 5, 3, 4, 9),
    ]
    deck += ["/PART/12", "tool_punch", "        12         6         0", "/PART/1", "warp", "/END"]
    found = surfaces_of_deck("\n".join(deck))
    assert list(found) == ["punch"]
    punch = found["punch"]
    assert punch.positions[punch.faces[0]].tolist() == [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    assert punch.positions[punch.faces[1][:3]].tolist() == [[1, 1, 0], [0, 1, 0], [0, 0, 0]] and punch.faces[1][3] == -1
    assert len(punch.positions) == 4  # the fabric's own node is not the tool's
    assert punch.vtk().GetNumberOfCells() == 2 and punch.vtk().GetCell(1).GetNumberOfPoints() == 3
