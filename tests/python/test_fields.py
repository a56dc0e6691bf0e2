"""Every array of a small run is the file's, read by another reader: meshio, which shares nothing with VTK."""

import gc
import sys
import types

import numpy as np
import pytest

import weaveform as wf

meshio = pytest.importorskip("meshio")
pytest.importorskip("vtkmodules.vtkIOXML")


def grids(result):
    """All files of yarns and cells, with what the package makes of them."""
    yield result.path / "mesh.vtu", result.mesh
    for frame, file in zip(result.frames, sorted((result.path / "frames").glob("*.vtu"))):
        yield file, frame


def same(one, other):
    return one.dtype == other.dtype and one.shape == other.shape and np.array_equal(one, other, equal_nan=True)


@pytest.fixture(params=["bias", "hemisphere"])
def result(request):
    return request.getfixturevalue(request.param)


def test_every_array_of_every_file_is_the_one_another_reader_finds(result):
    compared = 0
    for file, grid in grids(result):
        other = meshio.read(file)
        assert same(grid.positions, other.points)
        assert set(grid.points) == set(other.point_data)
        for name, values in other.point_data.items():
            assert same(grid.points[name], values), (file, name)
        assert set(grid.elements) == set(other.cell_data)
        for name, blocks in other.cell_data.items():
            assert same(grid.elements[name], np.concatenate(blocks)), (file, name)
        assert set(grid.info) == set(other.field_data)
        for name, values in other.field_data.items():
            assert np.array_equal(grid.info[name].ravel(), np.ravel(values)), (file, name)
        assert all(grid.fields[name] is grid.points[name] for name in grid.points)
        assert all(grid.fields[name] is grid.elements[name] for name in grid.elements)
        compared += len(grid.points) + len(grid.elements) + len(grid.info)
    assert compared > 50


def test_yarns_and_cells_are_the_files_lines_and_polygons(result):
    for file, grid in grids(result):
        other = meshio.read(file)
        lines = [block.data for block in other.cells if block.type == "line"]
        rings = [row.tolist() for block in other.cells if block.type != "line" for row in block.data]
        assert np.array_equal(grid.yarns.nodes, np.concatenate(lines))
        assert [[int(n) for n in row if n >= 0] for row in grid.cells.nodes] == rings
        for name in grid.elements:
            split = np.concatenate([grid.yarns[name], grid.cells[name]])
            assert np.array_equal(split, grid.elements[name]), name
        assert set(np.unique(grid.yarns["family"])) == {1, 2} and not grid.cells["family"].any()


def test_meshio_objects_written_and_read_again_are_the_same(result, tmp_path):
    for _, grid in grids(result):
        grid.meshio().write(tmp_path / "again.vtu")
        other = meshio.read(tmp_path / "again.vtu")
        assert same(other.points, grid.positions)
        for name, values in grid.elements.items():
            assert np.array_equal(np.concatenate(other.cell_data[name]), values), name
        for name, values in grid.points.items():
            assert np.array_equal(other.point_data[name], values), name
        assert sum(len(block.data) for block in other.cells) == len(grid.yarns.nodes) + len(grid.cells.nodes)


def test_polygons_of_more_than_four_nodes_keep_their_nodes(tmp_path):
    vtk = pytest.importorskip("vtkmodules.vtkCommonDataModel")
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

    points, grid, writer = vtkPoints(), vtk.vtkUnstructuredGrid(), vtkXMLUnstructuredGridWriter()
    for k in range(7):
        points.InsertNextPoint(np.cos(k), np.sin(k), k)
    grid.SetPoints(points)
    for shape, nodes in ((3, (0, 1)), (7, (0, 1, 2, 3, 4)), (5, (4, 5, 6)), (7, (1, 2, 3, 4, 5, 6))):
        grid.InsertNextCell(shape, len(nodes), nodes)
    writer.SetFileName(str(tmp_path / "mixed.vtu"))
    writer.SetInputData(grid)
    writer.Write()
    read = wf.Grid(tmp_path / "mixed.vtu")
    assert read.yarns.nodes.tolist() == [[0, 1]]
    assert read.cells.nodes.tolist() == [[0, 1, 2, 3, 4, -1], [4, 5, 6, -1, -1, -1], [1, 2, 3, 4, 5, 6]]
    blocks = [(block.type, block.data.tolist()) for block in read.meshio().cells]
    assert blocks == [("line", [[0, 1]]), ("polygon", [[0, 1, 2, 3, 4]]), ("triangle", [[4, 5, 6]]),
                      ("polygon", [[1, 2, 3, 4, 5, 6]])]


def test_vtk_objects_share_the_arrays_memory(bias):
    from vtkmodules.util.numpy_support import vtk_to_numpy

    frame = wf.open(bias.path).frames[-1]
    ours = frame.elements["shear_angle_deg"]
    assert np.shares_memory(ours, vtk_to_numpy(frame.vtk().GetCellData().GetArray("shear_angle_deg")))


def test_pyvista_objects_have_the_same_arrays(bias):
    pytest.importorskip("pyvista")
    frame = bias.frames[-1]
    grid = frame.pyvista()
    assert np.array_equal(grid.points, frame.positions)
    for name in frame.elements:
        assert np.array_equal(grid.cell_data[name], frame.elements[name]), name


def test_pyvista_is_given_the_vtk_object_itself(bias, monkeypatch):
    """Where PyVista is not installed: what it would be asked."""
    given = []
    monkeypatch.setitem(sys.modules, "pyvista", types.SimpleNamespace(wrap=lambda data: given.append(data) or "wrapped"))
    frame = bias.frames[-1]
    assert frame.pyvista() == "wrapped" and given == [frame.vtk()]


def test_without_pyvista_it_says_what_to_do(bias, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyvista", None)
    with pytest.raises(ImportError, match="pip install pyvista, or use .vtk"):
        bias.frames[-1].pyvista()


def test_frames_are_in_the_order_of_time_and_agree_with_the_history(result):
    times = result.frames.times
    assert (np.diff(times) > 0).all() and len(times) == len(result.frames) >= 5
    for frame in result.frames:
        assert frame.info["TimeValue"][0] == pytest.approx(frame.time, rel=1e-12)
    assert result.frames.at(times[2] + 1e-9).time == times[2]
    assert times[-1] == pytest.approx(result.history["time_s"][-1])
    summary = result.summary["max_shear_angle_deg"]
    assert np.abs(result.frames[-1].cells["shear_angle_deg"]).max() == pytest.approx(summary, rel=1e-9)


def test_frames_are_let_go_and_their_arrays_live_on(bias):
    frames = wf.open(bias.path).frames
    angles = [frame.elements["shear_angle_deg"] for frame in frames]
    gc.collect()
    assert len(frames._held) == 1  # the last one asked for
    for frame, kept in zip(frames, angles):
        assert np.array_equal(frame.elements["shear_angle_deg"], kept)
    first = frames[0]
    assert frames[-1] is frames[-1] and frames[0] is first and [*frames[1:3]] == [frames[1], frames[2]]
    with pytest.raises(IndexError):
        frames[len(frames)]


def test_positions_are_the_flat_blank_and_the_displacement(result):
    for frame in result.frames:
        assert np.allclose(frame.positions - frame.displacement, result.mesh.positions, atol=1e-9)


def test_a_drape_is_opened_like_a_result(examples, tmp_path):
    draped = wf.drape(examples / "drape_hemisphere.toml", {"blank.coarsening": 2}, output=tmp_path / "d", progress=False)
    assert len(draped.drape.cells.nodes) == draped.drape_summary["cells"]
    greatest = np.abs(draped.drape.cells["shear_angle_deg"]).max()
    assert greatest == pytest.approx(draped.drape_summary["max_shear_angle_deg"], rel=1e-6)
    assert set(draped.table("flat_pattern.csv")) == {"loop", "x_mm", "y_mm"}
    assert draped.scene["drape"]["tool"] == "dome"


def test_what_has_not_been_written_says_so(bias, tmp_path):
    with pytest.raises(wf.FileError, match="drape.vtu: is not there"):
        bias.drape.positions
    with pytest.raises(wf.FileError, match="is no folder"):
        wf.open(tmp_path / "nothing")
    empty = wf.open(tmp_path)
    for ask in (lambda: empty.history, lambda: empty.summary, lambda: empty.frames, lambda: empty.scene):
        with pytest.raises(wf.FileError, match="cannot be read"):
            ask()


def test_an_unknown_array_names_those_there_are(bias):
    with pytest.raises(KeyError, match="cells have no array 'shear'; they have .*shear_angle_deg"):
        bias.frames[0].cells["shear"]


@pytest.mark.parametrize("share", [0.3, 0.8, 0.999])
def test_a_damaged_frame_is_a_file_error_and_no_half_grid(bias, tmp_path, share, capfd):
    whole = (bias.path / "frames" / "frame_0001.vtu").read_bytes()
    (tmp_path / "frame.vtu").write_bytes(whole[: int(share * len(whole))])
    with pytest.raises(wf.FileError, match="frame.vtu: is damaged"):
        wf.Grid(tmp_path / "frame.vtu").positions
    assert capfd.readouterr().err == ""


def test_a_frame_damaged_inside_is_a_file_error(bias, tmp_path):
    whole = (bias.path / "frames" / "frame_0001.vtu").read_bytes()
    for share in (0.1, 0.3, 0.5, 0.7, 0.9):
        at = int(share * len(whole))
        (tmp_path / "frame.vtu").write_bytes(whole[:at] + b"<" + whole[at + 1 :])
        with pytest.raises(wf.FileError, match="frame.vtu: is damaged"):
            wf.Grid(tmp_path / "frame.vtu").positions


def test_damaged_json_and_index_are_file_errors(bias, tmp_path):
    (tmp_path / "summary.json").write_text('{"a": 1,\n "b"')
    (tmp_path / "result.pvd").write_text("<VTKFile><Coll")
    (tmp_path / "scene.toml").write_text("[a\n")
    folder = wf.open(tmp_path)
    for ask, said in ((lambda: folder.summary, r"summary\.json:2:\d+: is damaged"), (lambda: folder.frames, "result.pvd"),
                      (lambda: folder.scene, "scene.toml")):
        with pytest.raises(wf.FileError, match=said):
            ask()
