"""Headless Chromium for the tests: Debian's chromium, chromium-driver and python3-selenium."""

from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service

QUIET = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
         "--disable-background-networking", "--disable-component-update", "--disable-sync"]


def start_browser(folder):
    """A browser that keeps its files in `folder` and its console messages for get_log("browser")."""
    options = Options()
    for argument in QUIET + [f"--user-data-dir={folder / 'browser'}", "--window-size=1280,1000"]:
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
