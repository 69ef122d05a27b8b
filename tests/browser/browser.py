"""Headless Chromium for the tests: Debian's chromium, chromium-driver and python3-selenium."""

from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service

QUIET = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
         "--disable-background-networking", "--disable-component-update", "--disable-sync"]

# Opaque pixels of the canvas, and a sum over them that changes with any pixel.
PICTURE = """
const canvas = document.getElementById(arguments[0]);
const pixels = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
let opaque = 0, sum = 0;
for (let i = 0; i < pixels.length; i += 4) {
  if (pixels[i + 3] > 200) ++opaque;
  sum = (sum * 31 + pixels[i] + 3 * pixels[i + 1] + 7 * pixels[i + 2] + pixels[i + 3]) % 2147483647;
}
return {opaque: opaque / (canvas.width * canvas.height), sum};
"""


def start_browser(folder):
    """A browser that keeps its files in `folder` and its console messages for get_log("browser")."""
    options = Options()
    for argument in QUIET + [f"--user-data-dir={folder / 'browser'}", "--window-size=1280,1000"]:
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)


def picture_of(browser, canvas):
    return browser.execute_script(PICTURE, canvas)
