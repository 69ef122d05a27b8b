"""The page of a made-up study in headless Chromium: charts are drawn, headings sort, a row picks out its lines."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

from selenium.webdriver.common.by import By

from browser import start_browser
from toryu_testing.study_case import make_programs

STUDY = """
[study]
title = "Window"
case = "case.toml"
[removal]
pistons = ["piston"]
piston_area = 0.5
cycle = 2.0
answer = { wanted_depth = 20e-6, pressure_at_most = 2000 }
[[axis]]
name = "speed"
values = [2, 10, 1]
keys = ["fluid.x"]
[[axis]]
name = "depth"
values = [1e-6, 4e-6]
keys = ["fluid.removes"]
[[chart]]
x = "speed"
y = "removed_per_cycle"
lines = "depth"
"""


class StudyInBrowser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.make_study()
        cls.browser = start_browser(cls.folder)
        cls.addClassCleanup(cls.browser.quit)

    @classmethod
    def make_study(cls):
        programs, case = cls.folder / "bin", cls.folder / "flow"
        make_programs(programs)
        case.mkdir()
        (case / "case.toml").write_text('[case]\ntitle = "test"\n[[wall]]\nname = "piston"\n[fluid]\n')
        (case / "window.toml").write_text(STUDY)
        subprocess.run([sys.executable, "-m", "toryu.study", case / "window.toml", "--bin", programs, "--out",
                        cls.folder / "out"], check=True, capture_output=True)

    def setUp(self):
        self.browser.get((self.folder / "out/study.html").as_uri())

    def tearDown(self):
        self.assertEqual(self.browser.get_log("browser"), [])

    def all(self, selector):
        return self.browser.find_elements(By.CSS_SELECTOR, selector)

    def test_charts_are_drawn(self):
        self.assertEqual(len(self.all("figure.drawn svg")), 3)
        for picture in self.all("figure.drawn svg"):
            self.assertGreater(picture.size["width"], 300)
            self.assertGreater(picture.size["height"], 150)
        self.assertIn("20 µm come off", self.all("p.answer")[0].text)

    def test_a_heading_sorts_by_number_up_and_down(self):
        heading = self.all("main > section:not(#answer) table.sortable th")[0]
        column = lambda: [cell.text for cell in self.all("main > section:not(#answer) table.sortable td:first-child")]
        self.assertEqual(column(), ["2", "2", "10", "10", "1", "1"])
        heading.click()
        self.assertEqual(column(), ["1", "1", "2", "2", "10", "10"])
        heading.click()
        self.assertEqual(column(), ["10", "10", "2", "2", "1", "1"])

    def test_a_row_picks_out_its_lines(self):
        row = self.all("main > section:not(#answer) table.sortable tbody tr")[0]
        row.find_element(By.CSS_SELECTOR, "td").click()
        picked = self.all("figure.drawn g.picked")
        self.assertEqual(len(picked), 3)  # two work pieces and the window
        self.assertEqual({line.get_attribute("id") for line in picked}, {"run-" + row.get_attribute("data-run")})
        self.assertEqual(len(self.all("figure.drawn.picking")), 2)


if __name__ == "__main__":
    unittest.main()
