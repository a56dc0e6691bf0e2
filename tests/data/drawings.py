"""Writes DXF drawings with ezdxf into the current folder, and prints each one's name, area (mm^2) and kind.

The areas are closed forms.
"""
import math

import ezdxf
from ezdxf import units


def rounded_plate(model):
    # one corner an arc of radius 20 (bulge tan(90 deg / 4)), and a hole
    model.add_lwpolyline(
        [(0, 0, 0, 0, 0), (120, 0, 0, 0, math.tan(math.pi / 8)), (140, 20, 0, 0, 0), (140, 80, 0, 0, 0), (0, 80, 0, 0, 0)],
        close=True,
    )
    model.add_circle((50, 40), 15)
    model.add_text("grain")
    model.add_hatch().paths.add_polyline_path([(0, 0), (1, 0), (1, 1)])
    return 140 * 80 - (1 - math.pi / 4) * 400 - math.pi * 225


def old_polyline(model):
    model.add_polyline2d([(0, 0), (100, 0), (100, 90), (0, 90)], close=True)
    return 9000


def half_ellipse(model):
    model.add_ellipse((0, 0), (80, 0), 0.75, 0, math.pi)
    model.add_line((-80, 0), (80, 0))
    return math.pi * 80 * 60 / 2


def rational_quarter(model):
    model.add_rational_spline([(90, 0), (90, 90), (0, 90)], [1, math.sqrt(0.5), 1], degree=2)
    model.add_line((0, 90), (0, 0))
    model.add_line((0, 0), (90, 0))
    return math.pi * 8100 / 4


def block(model):
    piece = model.doc.blocks.new("PIECE")
    piece.add_lwpolyline([(0, 0), (100, 0), (100, 50), (0, 50)], close=True)
    piece.add_circle((50, 25), 10)
    model.add_blockref("PIECE", (10, 10), dxfattribs={"rotation": 30, "xscale": 1.5, "yscale": 1.5})
    return 2.25 * (5000 - math.pi * 100)


for name, draw, version, unit, mm in [
    ("rounded", rounded_plate, "R2010", units.MM, 1.0),
    ("rounded_2000", rounded_plate, "R2000", units.MM, 1.0),
    ("old", old_polyline, "R12", 0, 1.0),
    ("ellipse", half_ellipse, "R2013", units.MM, 1.0),
    ("ellipse_inch", half_ellipse, "R2018", units.IN, 25.4),
    ("quarter_cm", rational_quarter, "R2007", units.CM, 10.0),
    ("block", block, "R2010", units.MM, 1.0),
]:
    document = ezdxf.new(version)
    if version != "R12":
        document.units = unit
    area = draw(document.modelspace()) * mm * mm
    document.saveas(name + ".dxf")
    print(name, area)
