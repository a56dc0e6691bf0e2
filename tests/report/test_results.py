"""Reports of results, as a reader uses them: the numbers on the page are those of the result's files."""

import csv
import json
import re

import pytest
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import WebDriverWait


def summary(folder):
    return json.loads((folder / "summary.json").read_text())


def number(text):
    return float(re.search(r"[−-]?[\d.]+(e[−-]?\d+)?", text).group().replace("−", "-"))


@pytest.mark.parametrize("result", ["bias", "hemisphere", "stack", "compared", "study"])
def test_opens_without_complaint_and_asks_for_nothing_else(result, opened, request):
    file = request.getfixturevalue(result) / "report.html"
    page = opened(file)
    assert page.script("report.ready") is True
    assert page.script("report.troubles") == []
    for field in page.script("report.fields ? report.fields() : []"):
        page.script("report.setField(arguments[0])", field)
        page.script("report.set({isolines: '5', warp: true, weft: true, edges: true}) ?? 0")
        page.script("report.picture().length")
    assert page.complaints() == []
    assert page.requests() == [file.as_uri()]
    assert file.stat().st_size < 15e6


def test_verdict_comes_first_with_the_greatest_angle(hemisphere, opened):
    page = opened(hemisphere / "report.html")
    assert page.find("#report > section").get_attribute("id") == "verdict"
    values = {each.text.split("\n")[0]: each.text.split("\n")[1] for each in page.browser.find_elements("css selector", ".number")}
    assert number(values["greatest shear angle"]) == pytest.approx(summary(hemisphere)["max_shear_angle_deg"], abs=0.051)


def test_dragging_turns_the_view(hemisphere, opened):
    page = opened(hemisphere / "report.html")
    page.show(".canvas-box")
    before = page.script("report.camera()")
    page.drag(".canvas-box", 120, 40)
    after = page.script("report.camera()")
    assert after["focal_point"] == pytest.approx(before["focal_point"])
    moved = sum((a - b) ** 2 for a, b in zip(after["position"], before["position"])) ** 0.5
    assert moved > 50  # mm
    assert after["position"][2] > before["position"][2], "dragging down shows more of the top"
    distance = lambda view: sum((a - b) ** 2 for a, b in zip(view["position"], view["focal_point"])) ** 0.5
    assert distance(after) == pytest.approx(distance(before)), "turning comes no nearer"


def test_keys_turn_the_view_and_the_wheel_comes_nearer_only_after_a_click(hemisphere, opened):
    page = opened(hemisphere / "report.html")
    page.show(".canvas-box")
    position = lambda: page.script("report.camera().position")
    wheel = "document.querySelector('.canvas-box').dispatchEvent(new WheelEvent('wheel', {deltaY: -200, cancelable: true}))"
    first = position()
    assert page.script(wheel) is True, "the page may scroll"
    assert position() == first
    page.find(".canvas-box").send_keys(Keys.ARROW_LEFT)
    turned = position()
    assert turned != first
    assert page.script(wheel) is False
    assert position() != turned


def test_slider_moves_time_and_with_it_the_values(hemisphere, opened):
    page = opened(hemisphere / "report.html")
    last = page.script("report.frame()")
    assert last == len(page.script("report.frames()")) - 1
    page.script("report.pickCell(0) && 0")
    end = page.text(".frame-label")
    slider = page.find("#time")
    slider.send_keys(Keys.HOME)
    assert page.script("report.frame()") == 0
    assert page.text(".frame-label") != end
    flat = {value["name"]: value["value"] for value in page.script("report.picked().values")}
    assert abs(flat["shear_angle"]) < 0.01  # deg, the flat blank; a step of what is stored
    lowest = "Math.min(...Array.from({length: report.cellCount()}, (_, cell) => report.cell(cell).centre[2]))"
    before = page.script(lowest)
    slider.send_keys(Keys.END)
    assert page.script(lowest) == pytest.approx(before - 90, abs=15), "by the punch's 90 mm, at the middle of a cell of 20 mm"


def test_two_plies_have_their_numbers_their_slip_and_are_hidden_by_name(stack, opened):
    page = opened(stack / "report.html")
    found = summary(stack)
    verdict = page.text("#verdict")
    values = {each.text.split("\n")[0]: each.text.split("\n")[1] for each in page.browser.find_elements("css selector", ".number")}
    for ply in ("lower", "upper"):
        assert number(values[f"ply {ply}"]) == pytest.approx(found["plies"][ply]["max_shear_angle_deg"], abs=0.051), verdict
    slip = found["pairs"]["lower/upper"]["max_slip_mm"]
    assert number(values["slip of upper on lower"]) == pytest.approx(slip, rel=0.01)

    page.script("report.setField('slip_path')")
    page.find("#time").send_keys(Keys.END)
    cells = page.script("Array.from({length: report.cellCount()}, (_, cell) => report.cell(cell))")
    assert {cell["ply"] for cell in cells} == {"lower", "upper"}
    slipped = [value["value"] for cell in cells for value in cell["values"] if value["name"] == "slip_path" and value["value"] is not None]
    assert 0.5 * slip < max(slipped) < 1.01 * slip, "the mean of a cell's nodes"
    page.find("#time").send_keys(Keys.HOME)
    cell = page.script("report.cell(0).values")
    assert next(value for value in cell if value["name"] == "slip_path")["value"] == pytest.approx(0, abs=0.01)

    [label] = [each for each in page.browser.find_elements("css selector", "[aria-label=Plies] label") if each.text.strip() == "upper"]
    label.click()
    page.script("report.look('top') ?? 0")
    page.show(".canvas-box")
    lower = next(index for index, cell in enumerate(cells) if cell["ply"] == "lower" and abs(cell["centre"][0]) > 60 and abs(cell["centre"][1]) > 60)
    page.mouse_to(page.script("report.cellOnScreen(arguments[0])", lower), click=True)
    assert page.script("report.picked().ply") == "lower"
    assert page.complaints() == []


def test_a_click_on_the_greatest_cell_reads_the_greatest_angle(hemisphere, opened):
    page = opened(hemisphere / "report.html")
    page.script("report.look('top') ?? 0")
    cell = int(re.search(r"cell (\d+)", page.text("#verdict")).group(1))
    page.show(".canvas-box")
    page.mouse_to(page.script("report.cellOnScreen(arguments[0])", cell), click=True)
    picked = page.script("report.picked()")
    assert picked["cell"] == cell
    angle = summary(hemisphere)["max_shear_angle_deg"]
    assert picked["values"][0]["value"] == pytest.approx(angle, abs=0.01)
    panel = page.text(".pick")
    assert f"Cell {cell}" in panel
    assert number(re.search(r"^shear angle.*$", panel, re.M).group()) == pytest.approx(angle, abs=0.01)
    assert "°" in panel and "mm" in panel


def test_the_greatest_value_has_the_colour_at_the_bars_end(hemisphere, opened):
    page = opened(hemisphere / "report.html")
    cell = int(re.search(r"cell (\d+)", page.text("#verdict")).group(1))
    page.script("report.look('top') ?? 0")
    page.script("report.set({isolines: '0'}) ?? 0")
    place = page.script("report.cellOnScreen(arguments[0])", cell)
    red, green, blue = page.colour_at(place)
    assert red > 150 and green > 140 and blue < 80, "yellow"
    greatest = page.script("report.range().to")
    page.script("report.setRange({from: 0, to: 10 * arguments[0]}) ?? 0", greatest)
    red, green, blue = page.colour_at(place)
    assert red < 90 and green < 80 and blue > 60, "a tenth of the range is violet"


def test_tools_are_glass_that_can_be_switched_on(hemisphere, opened):
    page = opened(hemisphere / "report.html")
    page.script("report.look('front') ?? 0")
    without = page.script("report.picture()")
    label = [each for each in page.browser.find_elements("css selector", ".controls label") if each.text.strip() == "punch"][0]
    label.click()
    assert page.script("report.picture()") != without
    label.click()
    assert page.script("report.picture()") == without


def test_hovering_over_a_chart_reads_the_history(bias, opened):
    page = opened(bias / "report.html")
    with open(bias / "history.csv") as file:
        rows = list(csv.DictReader(file))
    page.show("#chart-force")
    chart = page.script("report.chart('force').series")
    index = len(chart[0]["x"]) * 3 // 4
    page.mouse_to(page.script("report.chart('force').onScreen(0, arguments[0])", index))
    words = page.script("report.chart('force').hover()")
    travel, force = words.split("\n")[0], [line for line in words.split("\n") if line.startswith(chart[0]["name"] + ":")][0]
    shown = number(force.split(":")[1])
    at = number(travel.split(":")[1])
    column = "top.force_N"
    nearest = min(rows, key=lambda row: abs(float(row["top.displacement_mm"]) - at))
    assert float(nearest["top.displacement_mm"]) == pytest.approx(at, rel=1e-3)
    assert shown == pytest.approx(float(nearest[column]), rel=1e-3)
    assert "(N)" in words and "(mm)" in words


@pytest.mark.parametrize("result", ["bias", "hemisphere", "compared", "study"])
def test_labels_of_charts_neither_overlap_nor_are_cut_off(result, opened, request):
    page = opened(request.getfixturevalue(result) / "report.html")
    drawn = "[...document.querySelectorAll('.chart-box')].every((box) => box.clientWidth === Number(box.querySelector('svg').getAttribute('width')))"
    try:
        for width in (1100, 600):
            page.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": width, "height": 800, "deviceScaleFactor": 1, "mobile": False})
            WebDriverWait(page.browser, 3).until(lambda _: page.script(drawn))
            for chart in page.script("report.charts()"):
                assert page.labels_in_the_way(chart) == [], (chart, width)
    finally:
        page.browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})


def test_the_wheel_over_a_chart_scrolls_the_page_and_with_ctrl_zooms(bias, opened):
    page = opened(bias / "report.html")
    page.show("#chart-force")
    place = page.script("report.chart('force').onScreen(0, 3)")
    box = page.script("document.querySelector('#chart-force .chart-box').getBoundingClientRect().toJSON()")
    middle = {"x": box["left"] + box["width"] / 2, "y": box["top"] + box["height"] / 2}

    def turn(modifiers):
        page.browser.execute_cdp_cmd("Input.dispatchMouseEvent", {
            "type": "mouseWheel", **middle, "deltaX": 0, "deltaY": -120, "modifiers": modifiers})

    top = page.script("scrollY")
    turn(2)  # Ctrl
    WebDriverWait(page.browser, 3).until(lambda _: page.script("report.chart('force').onScreen(0, 3)")["x"] < place["x"])
    assert page.script("scrollY") == top
    turn(0)
    WebDriverWait(page.browser, 3).until(lambda _: page.script("scrollY") < top)


def test_measured_stands_beside_simulated_in_the_same_colours(compared, opened):
    page = opened(compared / "report.html")
    assert page.text(".viewport-label.left") == "simulated"
    assert "measured" in page.text(".viewport-label.right")
    page.script("report.look('top') ?? 0")
    page.script("report.set({isolines: '0'}) ?? 0")
    page.show(".canvas-box")
    box = page.script("document.querySelector('.canvas-box').getBoundingClientRect().toJSON()")
    middle = {"y": box["top"] + box["height"] / 2}
    left = page.colour_at({**middle, "x": box["left"] + box["width"] / 4})
    right = page.colour_at({**middle, "x": box["left"] + 3 * box["width"] / 4})
    # both middles lie in the sheared region; the instrument's noise is a few degrees of some forty
    assert max(abs(a - b) for a, b in zip(left, right)) < 60, (left, right)
    assert min(left) < 90, "not white"


def test_a_studys_cases_are_sorted_and_lead_to_their_reports(study, opened):
    page = opened(study / "report.html")
    assert page.script("report.charts().length") >= 1
    column = lambda: [row.find_elements("css selector", "td")[0].text for row in page.browser.find_elements("css selector", "#table-0 tbody tr")]
    before = column()
    head = page.find("#table-0 th button")
    head.click()
    rising = column()
    head.click()
    assert column() == rising[::-1]
    assert sorted(before) == sorted(rising)
    page.find("#table-0 td a").click()
    assert page.script("report.webgl") is True
    assert page.script("report.troubles") == []


def test_prints_with_the_picture_and_no_buttons(hemisphere, opened):
    page = opened(hemisphere / "report.html")
    page.script("dispatchEvent(new Event('beforeprint'))")
    page.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
    try:
        assert page.script("document.querySelector('.still').naturalWidth") > 300
        assert not page.find(".controls").is_displayed()
        assert page.find(".still").is_displayed()
        assert page.find(".colour-bar").is_displayed()
    finally:
        page.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})
