"""Pictures of meshes and frames, and charts of tables, drawn into files without a screen (display.py)."""

from pathlib import Path

import numpy as np

from .display import display
from .table import words_of

# Even to the eye and for the colour-blind: viridis (van der Walt and Smith 2015) of one sign, red to blue of both
# (Brewer's RdBu), whose middle, white, is zero.
_of_one_sign = ["440154", "482878", "3e4989", "31688e", "26828e", "1f9e89", "35b779", "6ece58", "b5de2b", "fde725"]
_of_both_signs = [
    *("053061", "2166ac", "4393c3", "92c5de", "d1e5f0", "f7f7f7", "fddbc7", "f4a582", "d6604d", "b2182b", "67001f"),
]
_ink = (0.15, 0.15, 0.18)
_views = {"top": (0, 0, 1), "bottom": (0, 0, -1), "front": (0, -1, 0), "side": (1, 0, 0), "oblique": (0.7, -1.1, 0.8)}
_strip = 0.13  # of the height, for the colour bar
_margin = 1.06  # around what is drawn
_flat = 0.02  # of its diagonal: what is lower is seen from above


def _colours(low, high):
    from vtkmodules.vtkRenderingCore import vtkColorTransferFunction

    ramp = vtkColorTransferFunction()
    both = low < 0 < high
    if both:
        low, high = -max(-low, high), max(-low, high)
    names = _of_both_signs if both else _of_one_sign
    for place, name in zip(np.linspace(low, high, len(names)), names):
        ramp.AddRGBPoint(place, *(int(name[k : k + 2], 16) / 255 for k in (0, 2, 4)))
    ramp.SetVectorModeToMagnitude()
    return ramp


def _part(grid, lines):
    """The yarns or the cells of a grid, by its array "family"."""
    from vtkmodules.vtkFiltersCore import vtkThreshold

    part = vtkThreshold()
    part.SetInputData(grid)
    part.SetInputArrayToProcess(0, 0, 0, 1, "family")  # 1: an array of the elements
    part.SetLowerThreshold(1 if lines else 0)
    part.SetUpperThreshold(2 if lines else 0)
    part.SetThresholdFunction(vtkThreshold.THRESHOLD_BETWEEN)
    part.Update()
    return part.GetOutput()


def _actor(data):
    from vtkmodules.vtkRenderingCore import vtkActor, vtkDataSetMapper

    mapper, actor = vtkDataSetMapper(), vtkActor()
    mapper.SetInputData(data)
    mapper.ScalarVisibilityOff()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(*_ink)
    return actor


def _range_of(mesh, field):
    """(least, greatest) of an array, of what it belongs to: an array of the yarns' has only means on the cells."""
    if field in mesh.points:
        values = mesh.points[field]
    elif field in mesh.elements:
        values = (mesh.yarns if field.startswith("yarn") else mesh.cells)[field]
    else:
        names = ", ".join([*mesh.points, *mesh.elements])
        raise KeyError(f"{mesh.path.name} has no array '{field}'; it has {names}")
    size = np.linalg.norm(values, axis=1) if values.ndim > 1 else values
    finite = size[np.isfinite(size)].astype(float)
    low, high = (finite.min(), finite.max()) if len(finite) else (0.0, 1.0)
    return (low, high) if high > low else (low, low + 1.0)


def _coloured(actor, mesh, field, ramp):
    mapper = actor.GetMapper()
    mapper.ScalarVisibilityOn()
    if field in mesh.points:
        mapper.SetScalarModeToUsePointFieldData()
    else:
        mapper.SetScalarModeToUseCellFieldData()
    mapper.SelectColorArray(field)
    mapper.SetLookupTable(ramp)
    mapper.UseLookupTableScalarRangeOn()
    actor.GetProperty().SetAmbient(0.35)
    actor.GetProperty().SetDiffuse(0.65)


def _words(size):
    from vtkmodules.vtkRenderingCore import vtkTextProperty

    words = vtkTextProperty()
    words.SetColor(*_ink)
    words.SetFontSize(size)
    words.SetJustificationToCentered()
    return words


def _colour_bar(ramp, field, size):
    """A strip below the picture with the bar and, above it, what it shows. Letters grow with the picture."""
    from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
    from vtkmodules.vtkRenderingCore import vtkRenderer, vtkTextActor

    letters = max(int(0.022 * min(size)), 9)
    bar, title, strip = vtkScalarBarActor(), vtkTextActor(), vtkRenderer()
    bar.SetLookupTable(ramp)
    bar.SetNumberOfLabels(6)
    bar.SetLabelFormat("%.3g")
    bar.UnconstrainedFontSizeOn()
    bar.SetLabelTextProperty(_words(letters))
    bar.SetOrientationToHorizontal()
    bar.SetTextPositionToPrecedeScalarBar()
    bar.SetPosition(0.15, 0.05)
    bar.SetWidth(0.7)
    bar.SetHeight(0.55)
    title.SetInput(words_of(field))
    title.SetTextProperty(_words(int(1.15 * letters)))
    title.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
    title.SetPosition(0.5, 0.72)
    strip.AddActor2D(bar)
    strip.AddActor2D(title)
    strip.SetBackground(1, 1, 1)
    strip.SetViewport(0, 0, 1, _strip)
    return strip


def _glass(surface, bounds):
    """A tool as glass, as far as a seventh of the fabric's extent around it."""
    from vtkmodules.vtkCommonDataModel import vtkBox
    from vtkmodules.vtkFiltersCore import vtkClipPolyData

    reach = 0.15 * max(bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4])
    box, clip = vtkBox(), vtkClipPolyData()
    box.SetBounds(*(bound + (reach if k % 2 else -reach) for k, bound in enumerate(bounds)))
    clip.SetInputData(surface.vtk())
    clip.SetClipFunction(box)
    clip.InsideOutOn()
    clip.Update()
    actor = _actor(clip.GetOutput())
    actor.GetProperty().SetColor(0.45, 0.55, 0.65)
    actor.GetProperty().SetOpacity(0.25)
    return actor


def _direction(bounds, view):
    """From what is looked at to the eye."""
    extent = np.diff(np.reshape(bounds, (3, 2)), axis=1).ravel()
    if view is None:
        view = "top" if extent[2] < _flat * np.linalg.norm(extent) else "oblique"
    if isinstance(view, str) and view not in _views:
        raise ValueError(f"view '{view}': give a direction (x, y, z) to look from, or one of {', '.join(_views)}")
    way = np.array(_views[view] if isinstance(view, str) else view, dtype=float)
    return way / np.linalg.norm(way)


def _look(renderer, bounds, view, aspect):
    """In parallel projection, so near that the box of `bounds` just fits; `aspect` is width over height."""
    way = _direction(bounds, view)
    up = np.array((0.0, 1.0, 0.0) if np.hypot(way[0], way[1]) < 1e-9 else (0.0, 0.0, 1.0))
    right = np.cross(up, way) / np.linalg.norm(np.cross(up, way))
    ends = np.reshape(bounds, (3, 2))
    corners = np.array(np.meshgrid(*ends)).reshape(3, -1).T - ends.mean(axis=1)
    half_width, half_height = np.abs(corners @ right).max(), np.abs(corners @ np.cross(way, right)).max()
    camera = renderer.GetActiveCamera()
    camera.SetFocalPoint(*ends.mean(axis=1))
    camera.SetPosition(*(ends.mean(axis=1) + way))
    camera.SetViewUp(*up)
    camera.ParallelProjectionOn()
    renderer.ResetCamera()
    camera.SetParallelScale(_margin * max(half_height, half_width / aspect))


def _write(window, file):
    """Into a PNG file, and the window is gone."""
    from vtkmodules.vtkIOImage import vtkPNGWriter
    from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter

    window.Render()
    image, writer = vtkWindowToImageFilter(), vtkPNGWriter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    writer.SetInputConnection(image.GetOutputPort())
    writer.SetFileName(str(file))
    writer.Write()
    window.Finalize()
    if writer.GetErrorCode() != 0:
        raise OSError(f"{file}: the picture cannot be written; check that the folder is there and has room")


def _png(file):
    if Path(file).suffix.lower() != ".png":
        raise ValueError(f"{file}: VTK draws PNG; give a name that ends in .png")
    return Path(file)


def picture(mesh, file, field=None, *, range=None, view=None, size=(1200, 900), yarns=True, tools=False, program=None):
    """Draws a Grid or Frame off-screen into a PNG file, and returns its path.

    `field`: an array to colour by, with its bar (None: plain); `range`: (least, greatest) of the colours; `view`: a
    direction to look from, or "top", "bottom", "front", "side", "oblique"; None: from above what is flat, else
    obliquely. `size` in pixels. `yarns`: draws them as lines. `tools`: draws a frame's tools as glass (`program` as in
    Frame.tools). Raises KeyError (no such array), ValueError, OSError, display.NoDisplay."""
    from vtkmodules import vtkRenderingFreeType, vtkRenderingOpenGL2  # noqa: F401  bring their classes in
    from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow

    file, bounds, renderer = _png(file), mesh.vtk().GetBounds(), vtkRenderer()
    renderers = [renderer]
    cells, lines = _actor(_part(mesh.vtk(), lines=False)), _actor(_part(mesh.vtk(), lines=True))
    cells.GetProperty().SetColor(0.82, 0.80, 0.74)
    shown = [cells, lines] if yarns else [cells]
    if field is not None:
        ramp = _colours(*(range or _range_of(mesh, field)))
        of_yarns = field.startswith("yarn")
        _coloured(lines if of_yarns else cells, mesh, field, ramp)
        shown = [lines] if of_yarns else shown
        renderers.append(_colour_bar(ramp, field, size))
    lines.GetProperty().SetLineWidth(3 if shown == [lines] else 1)
    if tools:
        shown += [_glass(surface, bounds) for surface in mesh.tools(program).values()]
    for actor in shown:
        renderer.AddActor(actor)
    renderer.SetBackground(1, 1, 1)
    bottom = 0.0 if field is None else _strip
    renderer.SetViewport(0, bottom, 1, 1)
    _look(renderer, bounds, view, size[0] / (size[1] * (1 - bottom)))
    with display():
        window = vtkRenderWindow()
        window.SetOffScreenRendering(1)
        window.SetMultiSamples(8)
        window.SetSize(*size)
        for one in renderers:
            window.AddRenderer(one)
        _write(window, file)
        del window
    return file


def _axis_words(names):
    """One axis' title: the column in words, of several their common unit."""
    units = {words_of(name).rpartition("(")[2].rstrip(")") for name in names if words_of(name).endswith(")")}
    return words_of(names[0]) if len(names) == 1 else f"({units.pop()})" if len(units) == 1 else ""


def _chart_by_matplotlib(table, x, names, file, size, title):
    from matplotlib.figure import Figure  # not pyplot, which would ask for a screen

    figure = Figure(figsize=(size[0] / 150, size[1] / 150), dpi=150, layout="constrained")
    axes = figure.subplots()
    for name in names:
        axes.plot(table[x], table[name], label=words_of(name))
    axes.set_xlabel(words_of(x))
    axes.set_ylabel(_axis_words(names))
    axes.set_title(title or "")
    axes.grid(alpha=0.3)
    if len(names) > 1:
        axes.legend()
    figure.savefig(file)


def _chart_by_vtk(table, x, names, file, size, title):
    from vtkmodules import vtkRenderingContext2D, vtkRenderingContextOpenGL2, vtkRenderingFreeType  # noqa: F401  as above
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkChartsCore import vtkAxis, vtkChart, vtkChartLegend, vtkChartXY
    from vtkmodules.vtkCommonDataModel import vtkTable
    from vtkmodules.vtkViewsContext2D import vtkContextView

    columns = vtkTable()
    for name in (x, *names):
        array = numpy_to_vtk(np.asarray(table[name], dtype=float), deep=True)
        array.SetName(words_of(name) + ("" if name != x else " "))  # the same column may be both
        columns.AddColumn(array)
    chart = vtkChartXY()
    for k, colour in zip(np.arange(1, len(names) + 1), ["31688e", "d6604d", "35b779", "440154", "b8860b"] * len(names)):
        line = chart.AddPlot(vtkChart.LINE)
        line.SetInputData(columns, 0, int(k))
        line.GetPen().SetColorF(*(int(colour[c : c + 2], 16) / 255 for c in (0, 2, 4)))
        line.GetPen().SetWidth(2.0)
    for side, words in ((vtkAxis.BOTTOM, words_of(x)), (vtkAxis.LEFT, _axis_words(names))):
        axis = chart.GetAxis(side)
        axis.SetTitle(words)
        axis.GetTitleProperties().SetFontSize(18)
        axis.GetTitleProperties().BoldOff()
        axis.GetLabelProperties().SetFontSize(16)
    chart.SetTitle(title or "")
    chart.SetShowLegend(len(names) > 1)
    chart.GetLegend().SetLabelSize(16)
    chart.GetLegend().SetHorizontalAlignment(vtkChartLegend.LEFT)
    with display():
        view = vtkContextView()
        view.GetRenderWindow().SetOffScreenRendering(1)
        view.GetRenderWindow().SetSize(*size)
        view.GetRenderer().SetBackground(1, 1, 1)
        view.GetScene().AddItem(chart)
        _write(view.GetRenderWindow(), file)
        del view


def chart(table, x, y, file, *, size=(1200, 800), title=None, library=None):
    """Draws column `y`, or several, over column `x` of a Table into a file, and returns its path.

    `library`: "matplotlib" (PNG, SVG, PDF) or "vtk" (PNG); None: matplotlib where it is installed, else VTK. `size` in
    pixels. Raises KeyError (no such column), ValueError, OSError, ImportError, display.NoDisplay."""
    names = [y] if isinstance(y, str) else list(y)
    for name in (x, *names):
        table[name]  # says which there are
    if library not in (None, "matplotlib", "vtk"):
        raise ValueError(f"library '{library}': there are matplotlib and vtk")
    if library is None:
        from importlib.util import find_spec

        library = "matplotlib" if find_spec("matplotlib") else "vtk"
    if library == "matplotlib":
        _chart_by_matplotlib(table, x, names, Path(file), size, title)
    else:
        _chart_by_vtk(table, x, names, _png(file), size, title)
    return Path(file)
