"""Pages made by hand: what the results at hand do not have (two cells one above the other, words on an axis), broken data, a browser without WebGL."""

import base64
import hashlib
import json
import os
import struct
from pathlib import Path

import pytest
from selenium.webdriver.support.ui import WebDriverWait

from page import Page, no_drawing, start_browser

root = Path(__file__).resolve().parents[2]
viewer = root / "post" / "report" / "viewer"
drawing = root / "core" / "chart" / "echarts"
packed = viewer / "packed"


def coded(form, values):
    return base64.b64encode(struct.pack(f"<{len(values)}{form}", *values)).decode()


def two_plies():
    """Two squares of 100 mm, 10 mm apart, the upper (ply 2) turned by nothing: fields on cells, on nodes, and of names."""
    corners = [(0, 0), (100, 0), (100, 100), (0, 100)]
    position = [int(v) for z in (0, 10) for x, y in corners for v in (x, y, z)]
    return {
        "format": 1, "kind": "result", "title": "two plies", "subtitle": "",
        "verdict": {"headline": "By hand.", "rows": [{"name": "<b>x</b>", "value": "1", "note": "", "cell": 1}], "warnings": [], "trust": []},
        "part": {
            "node_count": 8, "cell_count": 2, "thinned": "", "cells": coded("I", range(8)), "plies": coded("B", [0, 1]), "ply_names": ["lower", "upper"],
            "yarns": {"warp": coded("I", [0, 1, 4, 5]), "weft": coded("I", [1, 2])},
            "position": {"origin": [0, 0, 0], "step": 1.0},
            "fields": [
                {"name": "shear_angle", "title": "shear angle", "unit": "°", "scale": "sequential", "from": 0, "to": 50, "limit": 40, "association": "cells"},
                {"name": "slip", "title": "slip between plies", "unit": "mm", "scale": "diverging", "from": -2, "to": 6, "limit": None, "association": "nodes"},
                {"name": "friction", "title": "friction", "unit": "", "scale": "categories", "from": 0, "to": 2, "category_names": ["no contact", "sticks", "slips"], "limit": None, "association": "cells"},
            ],
            "frames": [{"label": "the end", "position": coded("h", position), "fields": {
                "shear_angle": coded("H", [0, 65535]), "slip": coded("H", [0] * 4 + [65534] * 4), "friction": coded("H", [32767, 65534])}}],
        },
        "tools": [], "measured": None, "tables": [], "texts": [{"title": "Scene", "text": "</script><b>not bold</b>"}], "facts": [],
        "charts": [{"id": "cases", "title": "Cases", "x": {"title": "case", "log": False}, "y": {"title": "force (N)", "log": False},
                    "series": [{"name": "force", "x": ["fine", "coarse"], "y": [1.0, None], "style": "bars"}], "marks": []}],
    }


def glue(data, file):
    text = data if isinstance(data, str) else json.dumps(data).replace("</", "<\\/")
    file.write_text(
        f'<!doctype html><meta charset="utf-8"><title>by hand</title><style>{(packed / "report.css").read_text()}</style>'
        f'<main id="report"></main><script type="application/json" id="weaveform-data">{text}</script>'
        f'<script>{(packed / "report.js").read_text()}</script>')
    return file


def test_the_ray_meets_the_upper_ply_and_with_it_hidden_the_lower(opened, tmp_path):
    page = opened(glue(two_plies(), tmp_path / "page.html"))
    page.script("report.look('top') ?? 0")
    page.show(".canvas-box")
    place = page.script("report.cellOnScreen(1)")
    page.mouse_to(place, click=True)
    assert page.script("report.picked().cell") == 1
    assert "no value" not in page.text(".pick") and "–" in page.text(".pick"), "no shear angle there"
    [label] = [each for each in page.browser.find_elements("css selector", "[aria-label=Plies] label") if each.text.strip() == "upper"]
    label.click()
    page.show(".canvas-box")
    page.mouse_to(page.script("report.cellOnScreen(0)"), click=True)
    picked = page.script("report.picked()")
    assert (picked["cell"], picked["ply"]) == (0, "lower")
    assert picked["centre"] == pytest.approx([50, 50, 0])
    assert [value["text"] for value in picked["values"]] == ["0°", "−2 mm", "sticks"]
    assert page.complaints() == []


def test_of_two_signs_zero_has_the_middle_of_the_colours(opened, tmp_path):
    page = opened(glue(two_plies(), tmp_path / "page.html"))
    page.script("report.setField('slip')")
    assert page.script("report.range()") == {"from": -6, "to": 6}


def test_labels_of_a_crowded_chart_are_apart(opened, tmp_path):
    data = two_plies()
    names = [f"a series with quite a long name, number {k}" for k in range(6)]
    data["charts"] = [
        {"id": "crowded", "title": "", "x": {"title": "shear angle (°)", "log": False}, "y": {"title": "force (N)", "log": False},
         "series": [{"name": name, "x": [0, 60], "y": [-1234567, 0.5], "style": "line"} for name in names],
         "marks": [{"x": 50, "label": "greatest angle"}, {"x": 52, "label": "card's range ends"}, {"x": 53, "label": "locking angle"}]},
        {"id": "log", "title": "", "x": {"title": "time (s)", "log": True}, "y": {"title": "error (%)", "log": True},
         "series": [{"name": "a", "x": [0.02, 0.03, None], "y": [1e-5, 2e4, 1], "style": "points"}, {"name": "b", "x": [0.02], "y": [0], "style": "dashed"}],
         "marks": [{"x": 0.021, "label": "first"}],
         "notes": [{"x": 0.022, "y": 3.0, "text": "coarsening 4"}, {"x": 0.0221, "y": 3.1, "text": "coarsening 2, beams"}]},
    ]
    page = opened(glue(data, tmp_path / "page.html"))
    assert page.script("report.troubles") == []
    assert page.labels_in_the_way("crowded") == []
    assert page.labels_in_the_way("log") == []
    words = page.script("[...document.querySelectorAll('#chart-log svg text')]"
                        ".filter((text) => text.getAttribute('fill-opacity') !== '0').map((text) => text.textContent)")
    assert "coarsening 4" in words and "coarsening 2, beams" in words


def test_names_on_nodes_are_not_mixed_within_a_cell(opened, tmp_path):
    data = two_plies()
    data["part"]["fields"][2]["association"] = "nodes"
    data["part"]["frames"][0]["fields"]["friction"] = coded("H", [0] * 4 + [32767, 32767, 32767, 65534])
    page = opened(glue(data, tmp_path / "page.html"))
    page.script("report.setField('friction')")
    page.script("report.look('top') ?? 0")
    assert page.script("report.cell(1).values[2].text") == "sticks"
    page.show(".canvas-box")
    place = page.script("report.cellOnScreen(1)")
    towards_last_node = {"x": place["x"] - 40, "y": place["y"] - 40}
    assert page.colour_at(place) == page.colour_at(towards_last_node)


def test_bands_and_error_bars_are_drawn_and_told(opened, tmp_path):
    data = two_plies()
    data["charts"] = [{"id": "border", "title": "", "x": {"title": "mass (t)", "log": True}, "y": {"title": "force (N)", "log": True},
                       "bands": [{"name": "within", "x": [1, 2, 4, 8], "low": [0, 1, None, 1], "high": [4, 4, 4, 4]}],
                       "series": [{"name": "measured", "x": [1, 2, 4, 8], "y": [1, 2, 3, 4], "y_low": [0.5, 1.5, None, 3.5], "y_high": [2, 3, None, 5], "style": "points"},
                                  {"name": "law", "x": [1, 8], "y": [1, 4], "style": "line"}]}]
    page = opened(glue(data, tmp_path / "page.html"))
    assert page.script("report.troubles") == []
    assert page.script("document.querySelectorAll('#chart-border svg path[fill=\"#0072b2\"]').length") == 2, "one area, for a single place has none, and the legend's"
    page.show("#chart-border")
    page.mouse_to(page.script("report.chart('border').onScreen(0, 1)"))
    WebDriverWait(page.browser, 5).until(lambda _: page.script("report.chart('border').hover()"))
    words = page.script("report.chart('border').hover()")
    assert "measured: 2 (1.5 … 3)" in words and "within: 1 … 4" in words and "law" not in words, words
    assert page.labels_in_the_way("border") == []
    assert page.complaints() == []


def test_charts_are_drawn_anew_for_paper(opened, tmp_path):
    page = opened(glue(two_plies(), tmp_path / "page.html"))
    box = "document.querySelector('#chart-cases svg').getAttribute('viewBox')"
    page.script("window.dispatchEvent(new Event('beforeprint'))")
    assert page.script(box) == "0 0 430 290"
    page.script("window.dispatchEvent(new Event('afterprint'))")
    assert page.script(box) is None


@pytest.mark.parametrize("folder", [viewer, drawing])
def test_packed_is_of_these_sources(folder):
    listed = dict(reversed(line.split("  ")) for line in (folder / "packed" / "SOURCES").read_text().splitlines())
    there = [viewer / "build.mjs", viewer / "package-lock.json", *drawing.glob("*.js")]
    if folder == viewer:
        there += [each for each in (viewer / "src").rglob("*") if each.is_file()]
    found = {os.path.relpath(each, folder): hashlib.sha256(each.read_bytes()).hexdigest() for each in there}
    assert found == listed, "run ./dev viewer and commit both folders packed/"


def test_text_of_a_result_is_never_markup(opened, tmp_path):
    page = opened(glue(two_plies(), tmp_path / "page.html"))
    assert page.text(".number dt") == "<b>x</b>"
    page.find("summary").click()
    assert page.text("pre") == "</script><b>not bold</b>"


def spoil(change):
    data = two_plies()
    change(data)
    return data


@pytest.mark.parametrize("data, words", [
    ('{"format": 1, "title":', "damaged or cut off"),
    (spoil(lambda data: data.update(format=7)), "format 7"),
    (spoil(lambda data: data["part"].update(cells=coded("I", [0, 1, 2]))), "cells of the part: 3 values where 8 belong"),
    (spoil(lambda data: data["part"].update(cells=coded("I", [0, 1, 2, 9] * 2))), "index 9 where there are 8"),
    (spoil(lambda data: data["part"]["frames"][0].update(position="!")), "positions of frame 0: not base64"),
])
def test_broken_data_is_told_in_words_and_leaves_the_rest(data, words, opened, tmp_path):
    page = opened(glue(data, tmp_path / "page.html"))
    assert words in page.text(".trouble")
    assert page.complaints() == []
    if isinstance(data, dict) and data["format"] == 1:
        assert page.text("#verdict .headline") == "By hand."
        assert page.script("report.charts()") == ["cases"]


def test_without_webgl_says_so_and_shows_the_rest(tmp_path):
    browser = start_browser(no_drawing)
    try:
        page = Page(browser, glue(two_plies(), tmp_path / "page.html"))
        assert "WebGL" in page.text("#part .trouble")
        assert page.script("report.charts()") == ["cases"]
        assert page.find("#chart-cases svg").is_displayed()
        assert page.complaints() == []
    finally:
        browser.quit()


@pytest.mark.parametrize("width", [420, 1400])
def test_nothing_is_wider_than_the_window(width, opened, tmp_path):
    page = opened(glue(two_plies(), tmp_path / "page.html"))
    page.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": width, "height": 800, "deviceScaleFactor": 1, "mobile": False})
    try:
        WebDriverWait(page.browser, 3).until(lambda _: page.script("document.documentElement.scrollWidth") <= width)
    finally:
        page.browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
