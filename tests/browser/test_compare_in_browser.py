"""Two made-up runs laid over each other in headless Chromium: the second one's outline lies where its particles are."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import Select, WebDriverWait

from browser import picture_of, start_browser
from toryu_testing import made_up_run

SHIFT = 0.15  # [m] of the second run's solid
# The box of what has the outline's colour, in metres, as the stage lays its view into the canvas.
OUTLINED = """
const canvas = document.getElementById("particles"), {width, height} = canvas, [x0, y0, x1, y1] = arguments[0];
const pixels = canvas.getContext("2d").getImageData(0, 0, width, height).data;
const scale = 0.97 * Math.min(width / (x1 - x0), height / (y1 - y0)), box = [Infinity, Infinity, -Infinity, -Infinity];
for (let i = 0; i < width * height; ++i) {
  if (pixels[4 * i] !== 230 || pixels[4 * i + 1] !== 0 || pixels[4 * i + 2] !== 122) continue;
  const x = (x0 + x1) / 2 + (i % width + 0.5 - width / 2) / scale, y = (y0 + y1) / 2 - (Math.floor(i / width) + 0.5 - height / 2) / scale;
  box[0] = Math.min(box[0], x); box[1] = Math.min(box[1], y); box[2] = Math.max(box[2], x); box[3] = Math.max(box[3], y);
}
return Number.isFinite(box[0]) ? box : null;
"""


class CompareInBrowser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.make_runs()
        cls.browser = start_browser(cls.folder)
        cls.addClassCleanup(cls.browser.quit)

    @classmethod
    def make_runs(cls):
        """Of the second one the solid is elsewhere, its frames lie at other times, and in 'walled' its floor is longer."""
        first, second, walled = (cls.folder / name for name in ("first", "second", "walled"))
        made_up_run.make_results(first, end=0.4, frames=5)
        for out in (second, walled):
            made_up_run.make_results(out, end=0.402, frames=5)
            for frame in (out / "frames").glob("solid*.hdf"):
                with h5py.File(frame, "a") as file:
                    file["VTKHDF/Points"][:] += [SHIFT, 0, 0]
        for out in (first, second, walled):
            (out / "fluid.csv").unlink()
            made_up_run.write_series(out, "solid", {"time[s]": [0, 0.2, 0.4], "tip[m]": [0, int(out == first), 0]})
        used = walled / "used_case.toml"
        used.write_text(used.read_text().replace("max = [0.3, 0.0]", "max = [0.42, 0.0]"))
        for out in (second, walled):
            subprocess.run([sys.executable, "-m", "toryu.compare", first, out, "--out", cls.folder / f"to_{out.name}"],
                           check=True, stdout=subprocess.DEVNULL)

    def open(self, name="second"):
        self.browser.get((self.folder / f"to_{name}/compare.html").as_uri())
        self.wait_for_frame(2)  # where the tips are farthest apart

    def wait_for_frame(self, index):
        canvas = self.browser.find_element(By.ID, "particles")
        WebDriverWait(self.browser, 60).until(lambda _: canvas.get_attribute("data-frame") == str(index))

    def picture(self):
        return picture_of(self.browser, "particles")

    def outlined(self):
        view = self.browser.execute_script("return content.view")
        return self.browser.execute_script(OUTLINED, view)

    def show(self, which):
        before = self.picture()
        Select(self.browser.find_element(By.ID, "shown")).select_by_value(which)
        WebDriverWait(self.browser, 60).until(lambda _: self.picture() != before)

    def drawn(self):
        return self.browser.find_element(By.ID, "drawn").text.splitlines()

    def box_of_second(self, frame):
        points = []
        for body in ("fluid", "solid"):
            with h5py.File(self.folder / f"second/frames/{body}_{frame:06}.hdf") as file:
                points.append(file["VTKHDF/Points"][:, :2])
        return [*np.concatenate(points).min(axis=0), *np.concatenate(points).max(axis=0)]

    def tearDown(self):
        self.assertEqual(self.browser.get_log("browser"), [])

    def test_the_outline_is_that_of_the_second_run_at_the_same_time(self):
        self.open()
        self.assertEqual(self.drawn(), ["first, coloured, at 0.2000 s", "second, outlined, at 0.2010 s"])
        boxes = []
        for index in (2, 3):
            self.wait_for_frame(index)
            boxes.append(self.outlined())
            # a disc reaches 0.7 spacings beyond its particle; the solid is what lies farthest to the right
            reach = [0.7 * made_up_run.SPACING[body] for body in ("fluid", "fluid", "solid", "fluid")]
            np.testing.assert_allclose(np.subtract(boxes[-1], self.box_of_second(index)) * [-1, -1, 1, 1], reach, atol=6e-4)
            self.browser.find_element(By.ID, "time").send_keys(Keys.ARROW_RIGHT)
        self.assertNotEqual(*boxes)

    def test_either_run_is_shown_alone(self):
        self.open()
        both = self.picture()
        alone = []
        for which, name in (("0", "first, coloured, at 0.2000 s"), ("1", "second, coloured, at 0.2010 s")):
            self.show(which)
            self.assertIsNone(self.outlined())
            self.assertEqual(self.drawn(), [name])
            alone.append(self.picture())
        self.assertNotEqual(*alone)
        self.show("both")
        self.assertEqual(self.picture(), both)

    def test_the_choice_of_colour_is_one_for_both(self):
        self.open()
        pictures = []
        for chosen in (0, 1):
            before = self.picture()
            select = Select(self.browser.find_element(By.CSS_SELECTOR, "select[data-body=fluid]"))
            if chosen:
                select.select_by_index(chosen)
                WebDriverWait(self.browser, 60).until(lambda _: self.picture() != before)
            for which in ("0", "1", "both"):
                self.show(which)
                pictures.append(self.picture())
        self.assertEqual(len({picture["sum"] for picture in pictures}), 6)
        self.assertEqual(len(self.browser.find_elements(By.CSS_SELECTOR, "select[data-body]")), 2)

    def test_walls_that_differ_are_outlined_too(self):
        lows, alone = [], []
        for name in ("second", "walled"):
            self.open(name)
            lows.append(self.outlined()[1])
            self.show("1")
            self.assertIsNone(self.outlined())
            alone.append(self.picture()["sum"])
        np.testing.assert_allclose(lows, [-0.7 * made_up_run.SPACING["fluid"] / 2, -0.01], atol=1e-3)
        self.assertNotEqual(*alone)  # each has its own floor


if __name__ == "__main__":
    unittest.main()
