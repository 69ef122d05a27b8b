"""A live run in headless Chromium: its charts grow, the stop button ends it with a checkpoint, and the page becomes the
report, which stays when the server is gone."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import WebDriverWait

from browser import picture_of, start_browser
from toryu.installation import ROOT
from toryu.results_folder import newest_checkpoint

POINTS = "return Math.max(...charts.flatMap((c) => c.content.lines.map((l) => l.points.length)));"


class WatchInBrowser(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.out = self.folder / "out"
        self.browser = start_browser(self.folder)
        self.addCleanup(self.browser.quit)

    def wait(self, condition):
        return WebDriverWait(self.browser, 60, 0.1, [Exception]).until(lambda _: condition())

    def badge(self):
        return self.browser.find_element(By.CLASS_NAME, "badge").text

    def test_a_run_is_watched_and_stopped(self):
        run = subprocess.Popen([sys.executable, "-m", "toryu.launch", str(ROOT / "cases/dam_break"), f"--out={self.out}",
                                "--watch", "--end-time=100", "--threads=1"], stdout=subprocess.PIPE, text=True)
        self.addCleanup(run.stdout.close)
        self.addCleanup(run.wait)
        self.addCleanup(run.terminate)
        self.browser.get(run.stdout.readline().split()[1])
        self.assertEqual(self.badge(), "Still running")
        points = self.wait(lambda: self.browser.execute_script(POINTS))
        self.wait(lambda: self.browser.execute_script(POINTS) > points)
        self.wait(lambda: picture_of(self.browser, "particles")["opaque"] > 0.05)
        first = self.browser.execute_script("return player.time;")
        self.wait(lambda: self.browser.execute_script("return player.time;") > first)
        self.assertIn("of 100 s simulated", self.browser.find_element(By.ID, "progress").text)
        self.browser.find_element(By.ID, "stop").click()
        self.assertEqual(run.wait(60), 130)
        self.assertTrue(newest_checkpoint(self.out))
        self.wait(lambda: self.badge() == "Interrupted")
        self.assertFalse(self.browser.find_elements(By.ID, "live"))
        self.wait(lambda: picture_of(self.browser, "particles")["opaque"] > 0.05)
        self.assertEqual(self.browser.get_log("browser"), [])


if __name__ == "__main__":
    unittest.main()
