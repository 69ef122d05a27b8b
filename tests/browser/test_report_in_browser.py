"""The report of a made-up run in headless Chromium: it draws, the slider and the colours change the picture, the
console stays empty."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import Select, WebDriverWait

from browser import picture_of, start_browser
from toryu_testing import made_up_channel, made_up_run

PEAK = 4  # the frame in which the made-up tip is farthest, of 11
# Keeps what would be saved: the size and kind of each file, and its name.
KEEP = """
window.saved = [];
URL.createObjectURL = (blob) => { window.saved.push({size: blob.size, type: blob.type}); return "data:,"; };
HTMLAnchorElement.prototype.click = function () { window.saved.at(-1).name = this.download; };
"""


class ReportInBrowser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.browser = start_browser(cls.folder)
        cls.addClassCleanup(cls.browser.quit)

    def open(self, name, sides=("fluid", "solid"), exit_code=0, frame=None, words=""):
        """The page of a made-up run, once it shows the frame at which it opens: with a solid the 4th, where its tip is
        farthest."""
        case, out = self.folder / name / "gate", self.folder / name / "out"
        if not out.exists():
            made_up_run.make_case(case, sides)
            made_up_run.make_results(out, sides, frames=11)
            subprocess.run([sys.executable, "-m", "toryu.report", out, "--case", case, f"--exit-code={exit_code}",
                            f"--words={words}"], check=True, stdout=subprocess.DEVNULL)
        self.browser.get((out / "report.html").as_uri())
        self.wait_for_frame(frame if frame is not None else PEAK if "solid" in sides else 0)

    def open_channel(self, elastic=False):
        name = "elastic" if elastic else "rigid"
        case, out = self.folder / name / "channel", self.folder / name / "out"
        if not out.exists():
            made_up_channel.make_case(case, elastic)
            made_up_channel.make_results(out, elastic)
            subprocess.run([sys.executable, "-m", "toryu.report", out, "--case", case], check=True,
                           stdout=subprocess.DEVNULL)
        self.browser.get((out / "report.html").as_uri())
        self.wait_for_frame(0)
        WebDriverWait(self.browser, 60).until(lambda _: "Band" in self.browser.find_element(By.ID, "drawn").text)

    def wait_for_frame(self, index):
        canvas = self.browser.find_element(By.ID, "particles")
        WebDriverWait(self.browser, 60).until(lambda _: canvas.get_attribute("data-frame") == str(index))

    def go_to(self, index):
        self.browser.find_element(By.ID, "time").send_keys(Keys.HOME, *[Keys.ARROW_RIGHT] * index)
        self.wait_for_frame(index)

    def picture(self, canvas="particles"):
        return picture_of(self.browser, canvas)

    def attribute(self, selector, name):
        return self.browser.find_element(By.CSS_SELECTOR, selector).get_attribute(name)

    def tearDown(self):
        self.assertEqual(self.browser.get_log("browser"), [])

    def test_it_draws(self):
        self.open("coupled")
        # The walls and the water cover a part of the canvas, not all of it.
        self.assertGreater(self.picture()["opaque"], 0.2)
        self.assertLess(self.picture()["opaque"], 0.9)
        self.assertGreater(len(self.browser.find_elements(By.CSS_SELECTOR, "figure svg path.line")), 6)

    def test_a_failure_opens_at_its_end(self):
        self.open("failed", exit_code=3, frame=10)
        self.assertEqual(self.browser.find_element(By.ID, "now").text, "0.4000 s")

    def test_a_particle_that_failed_is_marked(self):
        self.open("failed", exit_code=3, frame=10)
        without = self.picture()
        self.open("marked", exit_code=3, frame=10, words="error: physics failed: fluid particle 7 at t = 0.4 s: speed = 9, limit 8")
        self.assertNotEqual(self.picture(), without)
        self.go_to(9)
        before = self.picture()
        self.open("failed", exit_code=3, frame=10)
        self.go_to(9)
        self.assertEqual(self.picture(), before, "the mark is in the last frame alone")

    def saved(self, count):
        WebDriverWait(self.browser, 60).until(
            lambda _: len(self.browser.execute_script("return window.saved.filter(({name}) => name)")) == count)
        return self.browser.execute_script("return window.saved")

    def test_a_picture_is_saved(self):
        self.open("coupled")
        self.browser.execute_script(KEEP)
        self.browser.find_element(By.ID, "picture").click()
        (file,) = self.saved(1)
        self.assertEqual((file["type"], file["name"]), ("image/png", "A made-up gate _ its water 0.1600 s.png"))
        self.assertGreater(file["size"], 5000)

    def test_a_video_is_saved(self):
        self.open("coupled")
        self.browser.execute_script(KEEP)
        Select(self.browser.find_element(By.ID, "speed")).select_by_value("2")
        button = self.browser.find_element(By.ID, "video")
        button.click()
        self.assertEqual(button.text, "Stop")
        (file,) = self.saved(1)
        self.assertEqual((file["type"], file["name"]), ("video/webm", "A made-up gate _ its water.webm"))
        self.assertGreater(file["size"], 5000)
        self.assertEqual(button.text, "Save video")
        self.wait_for_frame(10)

    def test_audits_are_folded(self):
        self.open("coupled")
        audits = self.browser.find_element(By.CSS_SELECTOR, "#audits h3")
        self.assertFalse(audits.is_displayed())
        self.browser.find_element(By.CSS_SELECTOR, "#audits summary").click()
        self.assertTrue(audits.is_displayed())

    def test_the_slider_moves_the_picture(self):
        self.open("coupled")
        self.go_to(0)
        before = self.picture()
        slider = self.browser.find_element(By.ID, "time")
        for _ in range(5):
            slider.send_keys(Keys.ARROW_RIGHT)
        self.wait_for_frame(5)
        self.assertEqual(self.browser.find_element(By.ID, "now").text, "0.2000 s")
        self.assertNotEqual(self.picture(), before)
        slider.send_keys(Keys.HOME)
        self.wait_for_frame(0)
        self.assertEqual(self.picture(), before)

    def test_the_choice_of_colour_changes_the_picture(self):
        self.open("coupled")  # where the plate is bent
        for body in ("fluid", "solid"):
            before = self.picture()
            select = Select(self.browser.find_element(By.CSS_SELECTOR, f"select[data-body={body}]"))
            self.assertGreaterEqual(len(select.options), 3)
            select.select_by_index(1)
            WebDriverWait(self.browser, 60).until(lambda _: self.picture() != before)

    def test_marks_of_a_narrow_range_differ(self):
        self.open("coupled")

        def marks(low, high):
            return self.browser.execute_script("return marksBetween(arguments[0], arguments[1])", low, high)

        self.assertEqual(marks(0, 100), ["0", "25", "50", "75", "100"])
        self.assertEqual(marks(0.99932, 1.00252), ["0.99932", "1.0001", "1.0009", "1.0017", "1.0025"])
        self.assertEqual(marks(2.5, 2.5), ["2.5"] * 5)

    def test_play_runs_to_the_end_and_stops(self):
        self.open("coupled")
        Select(self.browser.find_element(By.ID, "speed")).select_by_value("2")
        play = self.browser.find_element(By.ID, "play")
        play.click()
        self.assertEqual(play.text, "Pause")
        self.wait_for_frame(10)
        WebDriverWait(self.browser, 60).until(lambda _: play.text == "Play")

    def test_the_wheel_zooms_and_the_button_returns(self):
        self.open("coupled")
        before = self.picture()
        canvas = self.browser.find_element(By.ID, "particles")
        self.browser.execute_script(
            "arguments[0].dispatchEvent(new WheelEvent('wheel', {deltaY: -400, clientX: 400, clientY: 500}))", canvas)
        WebDriverWait(self.browser, 60).until(lambda _: self.picture() != before)
        self.browser.find_element(By.ID, "whole").click()
        WebDriverWait(self.browser, 60).until(lambda _: self.picture() == before)

    def test_a_run_of_one_side(self):
        for side in ("fluid", "solid"):
            with self.subTest(side):
                self.open(side, (side,))
                self.assertGreater(self.picture()["opaque"], 0.02)
                self.assertEqual(len(self.browser.find_elements(By.CSS_SELECTOR, "select[data-body]")), 1)

    def test_a_tall_scene_has_its_charts_beside_it(self):
        self.open_channel()
        picture, near, charts = (self.browser.find_element(By.ID, name).rect
                                 for name in ("particles", "enlarged", "beside"))
        self.assertLess(picture["x"] + picture["width"], near["x"])
        self.assertLess(near["x"] + near["width"], charts["x"])
        self.assertAlmostEqual(picture["y"], charts["y"], delta=3)
        self.assertGreater(picture["height"], 2 * picture["width"])
        self.assertEqual(picture["height"], near["height"])

    def test_the_mark_of_the_piston_cycle_follows_the_time(self):
        self.open_channel()
        before = self.attribute("#beside .dot", "cx"), self.attribute("#beside .dot", "cy")
        self.go_to(4)
        after = self.attribute("#beside .dot", "cx"), self.attribute("#beside .dot", "cy")
        self.assertGreater(float(after[0]), float(before[0]))
        self.assertNotEqual(after[1], before[1])
        self.assertEqual(self.attribute("#beside .now", "x1"), after[0])

    def test_the_choice_along_the_surface_changes_chart_and_band(self):
        self.open_channel()
        self.go_to(6)
        figures = self.browser.find_elements(By.CSS_SELECTOR, "#beside figure")
        line, near, words = (figures[-1].get_attribute("innerHTML"), self.picture("enlarged"),
                             self.browser.find_element(By.ID, "drawn").text)
        self.assertRegex(words, r"removed depth \(Preston\), drawn .* times as deep")
        Select(self.browser.find_element(By.ID, "along")).select_by_value("2")
        WebDriverWait(self.browser, 60).until(lambda _: self.picture("enlarged") != near)
        self.assertNotEqual(figures[-1].get_attribute("innerHTML"), line)
        self.assertIn("contact pressure, at its widest", self.browser.find_element(By.ID, "drawn").text)

    def test_a_displacement_too_small_to_see_is_exaggerated_if_wished(self):
        self.open_channel(elastic=True)
        self.go_to(3)
        before = self.picture("enlarged")
        select = Select(self.browser.find_element(By.ID, "factor"))
        self.assertIn("10⁴", select.first_selected_option.text)
        self.assertIn("Displacement of the solid: drawn 1·10⁴ times as large.",
                      self.browser.find_element(By.ID, "drawn").text)
        select.select_by_index(0)
        WebDriverWait(self.browser, 60).until(lambda _: self.picture("enlarged") != before)
        self.assertEqual(select.first_selected_option.text, "as it is")
        self.assertNotIn("Displacement", self.browser.find_element(By.ID, "drawn").text)


if __name__ == "__main__":
    unittest.main()
