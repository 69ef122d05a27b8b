"""The report page of made-up abrasive flow runs: what moves, the enlargement, what happened along the surface."""

import base64
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import zlib

import h5py
import numpy as np

from toryu.report import along, data, scene
from toryu_testing import made_up_channel as channel


def decoded(text):
    planes = np.frombuffer(zlib.decompress(base64.b64decode(text)), np.uint8).reshape(2, -1)
    return planes[0] + 256.0 * planes[1]


class Page(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.case, self.out = pathlib.Path(folder.name) / "channel", pathlib.Path(folder.name) / "out"

    def make(self, elastic=False):
        channel.make_case(self.case, elastic)
        channel.make_results(self.out, elastic, frames=5)

    def page(self):
        subprocess.run([sys.executable, "-m", "toryu.report", self.out, "--case", self.case], check=True,
                       stdout=subprocess.DEVNULL)
        return (self.out / "report.html").read_text()

    def content(self):
        return json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', self.page(), re.S)[1])

    def values(self, content, label):
        quantity = next(q for q in content["along"]["quantities"] if q["label"] == label)
        values = quantity["low"] + decoded(quantity["codes"]) / 65534 * (quantity["high"] - quantity["low"])
        return quantity, values.reshape(len(content["along"]["times"]), -1)

    def test_pistons_that_move_alike_are_one_line(self):
        self.make()
        velocity, displacement = self.content()["motions"]
        self.assertEqual([line["label"] for line in velocity["lines"]], ["lower piston and upper piston, y"])
        self.assertEqual((velocity["unit"], displacement["unit"]), ("mm/s", "mm"))
        self.assertAlmostEqual(max(v for _, v in velocity["lines"][0]["points"]), 50)
        self.assertAlmostEqual(max(v for _, v in displacement["lines"][0]["points"]), 35, places=2)  # 0.7 s of 50 mm/s

    def test_the_removed_depth_decodes_in_the_order_of_the_contour(self):
        self.make()
        content = self.content()
        left, right = content["along"]["contours"]
        self.assertEqual([left["label"], right["label"]], ["left work piece", "right work piece"])
        self.assertEqual(content["along"]["unit"], "mm")
        self.assertAlmostEqual(left["arc"][-1], 29)
        np.testing.assert_allclose(left["point"][left["corners"][0]], [0.004, -0.012])
        quantity, values = self.values(content, "removed depth (Preston)")
        self.assertEqual(quantity["unit"], "nm")
        with h5py.File(self.out / "surface.h5") as file:
            last, position = file["preston_depth"][-1], file["start_position"][:]
        places = np.array(left["point"] + right["point"]) - np.array(left["offset"] + right["offset"])
        rows = [np.linalg.norm(position - place, axis=1).argmin() for place in places]
        np.testing.assert_allclose(values[-1], 1e9 * last[rows], atol=2e-5)
        self.assertTrue((values[0] < 1e-3).all())

    def test_a_rate_is_the_growth_of_its_sum_between_frames(self):
        self.make()
        content = self.content()
        times = np.array(content["along"]["times"])
        quantity, rate = self.values(content, "contact pressure × sliding speed")
        _, depth = self.values(content, "removed depth (Preston)")
        factor = {"W/m²": 1, "mW/m²": 1e3}[quantity["unit"]]
        grown = np.diff(depth, axis=0) * 1e-9 / 1e-11 / np.diff(times)[:, None] * factor
        self.assertGreater(quantity["high"], 0.9 * grown.max())
        # The rows lie up to 10 ms before the frames.
        np.testing.assert_allclose(rate[1:], np.minimum(grown, quantity["high"]), atol=0.02 * quantity["high"])

    def test_the_enlargement_holds_the_first_work_piece(self):
        self.make()
        content = self.content()
        x0, y0, x1, y1 = content["near"]
        self.assertTrue(x0 < 0 and x1 > 0.004 and y0 < -0.012 and y1 > 0.012)
        self.assertLess(y1 - y0, 0.4 * (content["view"][3] - content["view"][1]))

    def test_the_band_follows_the_particles_of_an_elastic_work_piece(self):
        self.make(elastic=True)
        content = self.content()
        contours = content["along"]["contours"]
        self.assertEqual(sorted(c["label"] for c in contours), ["interface 1", "interface 2"])
        start = channel.solid(0)[0]
        for contour in contours:
            np.testing.assert_allclose(start[contour["particle"]] + contour["offset"], contour["point"], atol=1e-9)
        solid = next(body for body in content["bodies"] if body["name"] == "solid")
        self.assertAlmostEqual(solid["displacement"]["high"][1], 0.875e-7, delta=0.13e-7)

    def test_forces_from_the_boundaries_share_a_chart_for_each_direction(self):
        self.make()
        charts = {chart["title"]: chart["lines"] for chart in self.content()["others"]["fluid"]}
        self.assertEqual([line["label"] for line in charts["force, y"]],
                         [f"from {name}" for name in ("lower piston", "upper piston", "left wall", "right wall",
                                                      "left work piece", "right work piece")])
        self.assertEqual(len(charts["removed depth"]), 2)

    def test_removed_depth_and_evenness_are_key_figures(self):
        self.make()
        self.assertRegex(self.page(), r"evenness</div><div class=\"value\">1\.\d+</div>")

    def test_a_surface_that_a_killed_run_left_broken_is_passed_over(self):
        self.make()
        (self.out / "surface.h5").write_bytes(b"\x89HDF half")
        content = self.content()
        self.assertEqual(content["along"], {})
        self.assertEqual(len(content["motions"]), 2)


class Pieces(unittest.TestCase):
    def test_means_and_rates_are_over_the_time_since_the_frame_before(self):
        time, values = np.arange(5.0), np.array([0.0, 1, 3, 6, 10])[:, None]
        ends = np.array([1, 3, 5])
        self.assertEqual(along.taken(values, time, ends, "sum").ravel().tolist(), [0, 3, 10])
        self.assertEqual(along.taken(values, time, ends, "mean").ravel().tolist(), [0, 2, 8])
        self.assertEqual(along.taken(values, time, ends, "rate").ravel().tolist(), [0, 1.5, 3.5])

    def test_an_endless_run_ends_where_it_came(self):
        self.assertEqual(scene.end_of({"case": {"end_time": float("inf")}}, [{"times": [0, 3.5]}]), 3.5)
        self.assertEqual(scene.end_of({"case": {"end_time": 2.0}}, [{"times": [0, 3.5]}]), 2.0)

    def test_a_wall_at_rest_has_no_chart(self):
        walls = scene.walls_of({"wall": [{"name": "floor", "box": {"min": [0, 0], "max": [1, 1]}}]})
        self.assertEqual(scene.motion_charts(walls, 1.0), [])

    def test_lines_are_named_by_their_boundary(self):
        self.assertEqual(data.label_of("friction_impulse_from_upper_piston_y[N.s/m]"), "from upper piston")
        self.assertEqual(data.group_of("friction_impulse_from_upper_piston_y[N.s/m]"), "friction impulse, y")
        self.assertEqual(data.label_of("removed_depth_mean[m]"), "removed depth mean")


if __name__ == "__main__":
    unittest.main()
