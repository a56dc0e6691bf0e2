"""A report opened in headless Chromium, with what the browser complained about and asked for."""

import json

from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.actions.action_builder import ActionBuilder
from selenium.webdriver.common.by import By
from shutil import which

drawing = ["--enable-unsafe-swiftshader", "--use-angle=swiftshader"]  # WebGL without a graphics card
no_drawing = ["--disable-gpu", "--disable-3d-apis"]


def start_browser(switches=drawing, size=(1100, 800)):
    options = Options()
    options.binary_location = which("chromium")
    for switch in ["--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--hide-scrollbars", "--no-first-run",
                   "--window-size={},{}".format(*size), *switches]:
        options.add_argument(switch)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    return webdriver.Chrome(service=Service(which("chromedriver")), options=options)


class Page:
    """A file in the browser. `script` returns a JavaScript expression's value, with `report` as the page's own handle."""

    def __init__(self, browser, file):
        self.browser, self.file = browser, file
        for log in ("browser", "performance"):
            browser.get_log(log)  # of the page before
        browser.get(file.as_uri())

    def script(self, expression, *arguments):
        return self.browser.execute_script(f"const report = window.weaveformReport; return {expression};", *arguments)

    def complaints(self):
        return [entry["message"] for entry in self.browser.get_log("browser")]

    def requests(self):
        messages = [json.loads(entry["message"])["message"] for entry in self.browser.get_log("performance")]
        return [each["params"]["request"]["url"] for each in messages if each["method"] == "Network.requestWillBeSent"]

    def find(self, selector):
        return self.browser.find_element(By.CSS_SELECTOR, selector)

    def text(self, selector):
        return self.find(selector).text

    def show(self, selector):
        self.browser.execute_script("arguments[0].scrollIntoView({block: 'center', behavior: 'instant'})", self.find(selector))

    def mouse_to(self, place, click=False):
        """Moves the mouse to a place {x, y} of the window, in two steps as a hand does; then maybe clicks."""
        actions = ActionBuilder(self.browser)
        actions.pointer_action.move_to_location(int(place["x"]) - 3, int(place["y"]))
        actions.pointer_action.move_to_location(round(place["x"]), round(place["y"]))
        if click:
            actions.pointer_action.click()
        actions.perform()

    def drag(self, selector, dx, dy):
        ActionChains(self.browser).drag_and_drop_by_offset(self.find(selector), dx, dy).perform()

    def labels_in_the_way(self, chart):
        """Labels of a chart that lie on another or are cut off, with what is in their way."""
        drawn = self.script('''(() => {
          const box = document.querySelector('#chart-' + arguments[0] + ' svg');
          const place = (each) => each.getBoundingClientRect().toJSON();
          return {box: place(box), texts: [...box.querySelectorAll('text')].map((each) => ({...place(each), words: each.textContent}))};
        })()''', chart)
        box, texts = drawn["box"], drawn["texts"]
        assert len(texts) > 4, texts
        found = [(one["words"], "the chart's edge") for one in texts
                 if one["left"] < box["left"] - 1 or one["right"] > box["right"] + 1
                 or one["top"] < box["top"] - 1 or one["bottom"] > box["bottom"] + 1]
        for i, one in enumerate(texts):
            for other in texts[:i]:
                across = min(one["right"], other["right"]) - max(one["left"], other["left"])
                down = min(one["bottom"], other["bottom"]) - max(one["top"], other["top"])
                if across >= 1 and down >= 4:  # pixels; the boxes of letters have some air above and below
                    found.append((one["words"], other["words"]))
        return found

    def colour_at(self, place):
        """Red, green, blue of the 3-D picture at a place of the window."""
        return self.browser.execute_async_script(
            """const [place, done] = arguments;
            const box = document.querySelector('.canvas-box').getBoundingClientRect();
            const image = new Image();
            image.onload = () => {
              const canvas = document.createElement('canvas');
              [canvas.width, canvas.height] = [image.width, image.height];
              const pen = canvas.getContext('2d');
              pen.drawImage(image, 0, 0);
              const scale = image.width / box.width;
              done([...pen.getImageData(Math.round((place.x - box.left) * scale), Math.round((place.y - box.top) * scale), 1, 1).data].slice(0, 3));
            };
            image.src = window.weaveformReport.picture();""", place)
