"""The report page of made-up runs: what it says, and that its frames decode to the particles."""

import base64
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import unittest.mock
import zlib

import h5py
import numpy as np

from toryu import PROGRAMS
from toryu.case import resolve
from toryu.folder_lock import lock_folder
from toryu.report import data, frames, scene, tables
from toryu.report.__main__ import files
from toryu_testing import made_up_run


class Page(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.case, self.out = pathlib.Path(folder.name) / "gate", pathlib.Path(folder.name) / "out"

    def make(self, sides=("fluid", "solid"), **results):
        made_up_run.make_case(self.case, sides)
        made_up_run.make_results(self.out, sides, **results)

    def page(self, *options):
        subprocess.run([sys.executable, "-m", "toryu.report", self.out, "--case", self.case, *options], check=True,
                       stdout=subprocess.DEVNULL)
        return (self.out / "report.html").read_text()

    def content(self, page):
        return json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', page, re.S)[1])

    def test_it_needs_no_other_file_and_no_network(self):
        self.make(frames=2)
        page = self.page()
        self.assertEqual(re.findall(r'(?:src|href)="(?!data:)', page), [])
        self.assertEqual(re.findall(r"https?://(?!www\.w3\.org/2000/svg)", page), [])
        self.assertNotIn("$", re.sub(r"<script.*?</script>", "", page, flags=re.S))
        self.assertIn("<h1>A made-up gate &amp; its water</h1>", page)
        self.assertIn("Monaghan 1992, eq. 4.1", page)

    def test_a_failure_opens_at_its_end_with_what_was_warned_of(self):
        self.make(frames=2)
        with open(self.out / "log.txt", "a") as log:
            log.write("2026-01-01 10:00:01.000 fluid_solver warning: <fast> water\n" * 2 +
                      "2026-01-01 10:00:02.000 fluid_solver error: physics failed: density\n")
        for code, failed in ((0, False), (3, True), (4, True), (130, False)):
            page = self.page(f"--exit-code={code}", "--words=density -1")
            self.assertEqual(self.content(page)["telling"]["time"] is None, failed)
            shown = re.search('<div class="words stopped" id="warnings">(.*?)</div>', page)[1]
            self.assertEqual(shown, "<p>fluid_solver warning: &lt;fast&gt; water</p>")

    def telling(self, *options):
        return self.content(self.page(*options))["telling"]

    def test_it_opens_where_what_has_a_reference_is_largest(self):
        self.make(frames=11)
        told = self.telling()
        self.assertAlmostEqual(told["time"], 0.15, delta=0.01)  # tip: sin^2(pi t / 0.3)
        self.assertIsNone(told["mark"])
        case = self.out / "used_case.toml"
        text = case.read_text()
        case.write_text(text[:text.index("[[reference]]")])
        self.assertEqual(self.telling()["time"], 0, "nothing is observed")
        case.write_text(case.read_text().replace("[solid]\n", "[solid]\n[[solid.observer]]\nname = 'tip'\n"
                                                 "point = [0.1, 0.0]\n"))
        self.assertAlmostEqual(self.telling()["time"], 0.15, delta=0.01)

    def test_it_marks_the_particle_that_failed(self):
        self.make(frames=3)
        with h5py.File(self.out / "frames/fluid_000002.hdf") as frame:
            place = frame["VTKHDF/Points"][5]
        told = self.telling("--exit-code=3", "--words=x: fluid particle 5 at t = 0.4 s: speed = 9, limit 8")
        self.assertEqual(told["mark"], {"body": "fluid", "particle": 5, "time": 0.4, "x": place[0], "y": place[1]})
        for words in ("fluid particle 1000000 at t = 0.4 s", "ghost particle 5 at t = 0.4 s", "fluid body at t = 0.4 s"):
            self.assertIsNone(self.telling("--exit-code=3", f"--words={words}")["mark"], words)

    def test_it_tells_what_was_found_and_expected(self):
        self.make(frames=3)
        self.assertEqual(re.findall(r"; (largest [^<]*)<", self.page()), ["largest 39.56 mm, expected 43.52"])

    def test_frames_decode_to_the_particles(self):
        self.make(frames=3)
        fluid, solid = self.content(self.page())["bodies"]
        self.assertEqual((fluid["name"], solid["name"]), ("fluid", "solid"))
        self.assertEqual(fluid["times"], [0, 0.2, 0.4])
        self.assertEqual([q["label"] for q in fluid["quantities"]], ["pressure", "speed", "density"])
        planes = np.frombuffer(zlib.decompress(base64.b64decode(fluid["frames"][1])), np.uint8).reshape(2, -1)
        codes = (planes[0] + 256.0 * planes[1]).reshape(5, -1)
        with h5py.File(self.out / "frames/fluid_000001.hdf") as frame:
            points = frame["VTKHDF/Points"][:]
            pressure = frame["VTKHDF/PointData/pressure"][:]
        x0, _, x1, _ = fluid["box"]
        np.testing.assert_allclose(x0 + codes[0] / 65534 * (x1 - x0), points[:, 0], atol=(x1 - x0) / 65534)
        quantity = fluid["quantities"][0]
        self.assertEqual(quantity["unit"], "kPa")
        decoded = quantity["low"] + codes[2] / 65534 * (quantity["high"] - quantity["low"])
        inside = (1e-3 * pressure >= quantity["low"]) & (1e-3 * pressure <= quantity["high"])
        self.assertGreater(inside.mean(), 0.95)
        np.testing.assert_allclose(decoded[inside], 1e-3 * pressure[inside], atol=1e-4)

    def test_a_value_that_is_not_finite_and_a_lost_particle_keep_the_page_whole(self):
        self.make(frames=2)
        with h5py.File(self.out / "frames/fluid_000001.hdf", "a") as frame:
            frame["VTKHDF/Points"][0] = [np.nan, 0, 0]
            frame["VTKHDF/Points"][1] = [1e30, 0, 0]
            frame["VTKHDF/PointData/pressure"][2] = np.inf
        fluid = self.content(self.page())["bodies"][0]
        planes = np.frombuffer(zlib.decompress(base64.b64decode(fluid["frames"][1])), np.uint8).reshape(2, -1)
        codes = (planes[0] + 256 * planes[1].astype(int)).reshape(5, -1)
        self.assertEqual([codes[0, 0], codes[0, 1], codes[2, 2]], [65535, 65535, 65535])
        self.assertLessEqual(fluid["box"][2], 0.9)  # the case's domain

    def test_the_reference_is_drawn_over_the_run(self):
        self.make(frames=2)
        content = self.content(self.page())
        lines = content["compared"][0]["lines"]
        self.assertEqual([(line["label"], line["kind"]) for line in lines],
                         [("this run", "line"), ("Somebody 2007", "points")])
        self.assertEqual(content["compared"][0]["unit"], "mm")
        self.assertAlmostEqual(max(v for _, v in lines[0]["points"]), 40, places=3)
        self.assertEqual([chart["title"] for chart in content["others"]["solid"]],
                         ["energy and work", "momentum", "leaked mass", "displacement"])

    def test_a_failed_run_says_so_with_its_reason(self):
        self.make(end=0.2, frames=2)
        made_up_run.write_summary(self.out, "fluid", 3, "particle 7 left the <domain>")
        page = self.page()
        self.assertIn('<span class="badge bad">Physics failed</span>', page)
        self.assertIn("<p>particle 7 left the &lt;domain&gt;</p>", page)
        page = self.page("--exit-code=4", "--words=solid_solver was killed")
        self.assertIn('<span class="badge bad">A process was lost</span>', page)
        self.assertIn("<p>solid_solver was killed</p>", page)

    def test_damaged_files_are_passed_over_and_told(self):
        self.make(frames=3)
        frame = self.out / "frames/fluid_000001.hdf"
        frame.write_bytes(frame.read_bytes()[:4000])
        (self.out / "frames/solid_000002.hdf").write_bytes(b"")
        (self.out / "frames/solid_000001.hdf").unlink()
        (self.out / "solid.csv").write_text("")
        (self.out / "solid_summary.toml").write_text("")
        page = self.page()
        fluid, solid = self.content(page)["bodies"]
        self.assertEqual((fluid["times"], solid["times"]), ([0, 0.4], [0]))
        for words in ("fluid_000001.hdf cannot be read", "solid_000002.hdf cannot be read", "lists 1 frames that are not there",
                      "solid.csv is empty", "solid_summary.toml is damaged"):
            self.assertIn(words, page)

    def test_a_damaged_frame_that_can_be_read_and_holds_less_is_passed_over(self):
        self.make(frames=3)
        with h5py.File(self.out / "frames/fluid_000000.hdf", "a") as frame:
            del frame["VTKHDF/PointData"]
            frame.create_group("VTKHDF/PointData")
        page = self.page()
        fluid, solid = self.content(page)["bodies"]
        self.assertEqual((fluid["times"], solid["times"]), ([0.2, 0.4], [0, 0.2, 0.4]))
        self.assertEqual(len(fluid["quantities"]), 3)
        self.assertIn("fluid_000000.hdf cannot be read", page)

    def test_a_damaged_size_of_a_frame_asks_for_no_memory(self):
        self.make(frames=3)
        with h5py.File(self.out / "frames/fluid_000001.hdf", "a") as frame:
            del frame["VTKHDF/PointData/pressure"]
            frame.create_dataset("VTKHDF/PointData/pressure", shape=(1 << 54,), chunks=(1024,), dtype="f4")
        page = self.page()
        self.assertEqual(self.content(page)["bodies"][0]["times"], [0, 0.4])
        self.assertIn("fluid_000001.hdf cannot be read: Unable to allocate", page)

    def test_a_run_that_goes_on_is_no_bug(self):
        self.make(frames=2)
        for summary in self.out.glob("*_summary.toml"):
            summary.unlink()
        self.assertIn('<span class="badge stopped">Without an end</span>', self.page())
        with lock_folder(self.out, "run.lock"):
            self.assertIn('<span class="badge stopped">Still running</span>', self.page())

    def test_a_bad_reference_does_not_cost_the_good_one(self):
        self.make(frames=2)
        with open(self.out / "used_case.toml", "a") as case:
            case.write('[[reference]]\nlabel = "computed"\nfile = "other.csv"\nseries = "solid.csv:a"\ncolumn = "x"\n')
        (self.out / "other.csv").write_text("t;x\n0;1\n")
        page = self.page()
        self.assertEqual(len(self.content(page)["compared"]), 1)
        self.assertIn("reference &#x27;computed&#x27;: no column &#x27;x&#x27; in &#x27;other.csv&#x27;", page)

    def test_a_reference_to_a_series_that_is_not_there_is_told(self):
        self.make(frames=2)
        used = self.out / "used_case.toml"
        used.write_text(used.read_text().replace("tip_displacement_x", "tip_displacment_x"))
        self.assertIn("reference &#x27;Somebody 2007&#x27;: solid.csv has no column &#x27;tip_displacment_x[m]&#x27;; did you "
                      "mean &#x27;tip_displacement_x[m]&#x27;?", self.page())

    def test_a_name_cannot_end_or_hide_the_script(self):
        self.make(frames=2)
        used = self.out / "used_case.toml"
        used.write_text(used.read_text().replace('"piston"', '"<!--<script></script>"'))
        page = self.page()
        self.assertEqual(page.count("<!--<script>"), 0)
        self.assertEqual(self.content(page)["walls"][1]["name"], "<!--<script></script>")

    def test_a_round_wall_is_told_as_such(self):
        self.make(frames=2)
        used = self.out / "used_case.toml"
        used.write_text(used.read_text().replace("max = [0.0, 0.16] }", "max = [0.0, 0.16], round = true }"))
        self.assertEqual([wall["round"] for wall in self.content(self.page())["walls"]], [False, True])

    def test_runs_of_one_side(self):
        for side in ("fluid", "solid"):
            with self.subTest(side):
                self.setUp()
                self.make((side,), frames=2)
                content = self.content(self.page())
                self.assertEqual([body["name"] for body in content["bodies"]], [side])
                self.assertEqual(list(content["others"]), [side])

    def test_a_run_that_left_nothing(self):
        made_up_run.make_case(self.case)
        self.out.mkdir()
        page = self.page("--exit-code=1", "--words=coupler ended")
        self.assertEqual(self.content(page)["bodies"], [])
        self.assertIn("Ended by a bug", page)

    def test_without_a_used_case_the_coupler_prints_it(self):
        made_up_run.make_case(self.case)
        made_up_run.make_results(self.out, frames=2)
        (self.out / "used_case.toml").unlink()
        content = self.content(self.page())
        self.assertEqual([wall["name"] for wall in content["walls"]], ["floor", "piston"])
        self.assertEqual(len(content["compared"]), 1)

    def test_too_many_particles_are_shown_in_fewer_frames(self):
        self.make(frames=9)
        with unittest.mock.patch.object(frames, "SIZE_LIMIT", 1.2e5):
            page = files(self.case, self.out, coupler=PROGRAMS / "coupler", exit_code=None, words="")["report.html"]
        times = self.content(page)["bodies"][0]["times"]
        self.assertLess(len(times), 9)
        self.assertEqual((times[0], times[-1]), (0, 0.4))
        self.assertIn("th frame is shown", page)


class Pieces(unittest.TestCase):
    def test_units(self):
        self.assertEqual(data.pretty("kg/m3"), "kg/m³")
        self.assertEqual(data.pretty("N.s/m"), "N·s/m")
        self.assertEqual(data.scaled("m", 0.04), (1e3, "mm"))
        self.assertEqual(data.scaled("Pa", 2.5e6), (1e-6, "MPa"))
        self.assertEqual(data.scaled("kg/m3", 1000), (1.0, "kg/m³"))

    def test_formulas(self):
        self.assertEqual(tables.formula("-m_j Pi_ij gradW_ij < eta^2 in 3 m2/s"),
                         "-m<sub>j</sub> Π<sub>ij</sub> ∇W<sub>ij</sub> &lt; η<sup>2</sup> in 3 m<sup>2</sup>/s")

    def test_a_thinned_line_keeps_its_extremes(self):
        ys = [0.0] * 10000
        ys[4321], ys[7000] = 5.0, -3.0
        points = data.thinned(list(range(10000)), ys)
        self.assertLessEqual(len(points), data.MOST_POINTS + 2)
        self.assertIn((4321, 5.0), points)
        self.assertIn((7000, -3.0), points)

    def test_a_worn_wall_is_drawn_with_its_outline(self):
        box = {"min": [0, 0], "max": [2, 1]}
        wall, = scene.walls_of({"wall": [{"name": "floor", "box": box, "worn": [
            {"face": "upper", "depth": [[0.0, 0.1], [1.0, 0.3], [2.0, 0.1]]}, {"face": "left", "depth": [[0.5, 0.2]]}]}]})
        self.assertEqual(wall["rings"], [[[0, 0], [2, 0], [2, 0], [2, 1], [2, 0.9], [1, 0.7], [0, 0.9], [0.2, 1],
                                          [0.2, 0.5], [0.2, 0]]])
        wall, = scene.walls_of({"wall": [{"name": "floor", "box": box, "worn": [{"face": "upper", "depth": [[0, 0]]}]}]})
        self.assertEqual(wall["rings"], [])

    def test_a_wall_that_is_no_box_is_drawn_by_its_rings(self):
        frame = [[[0, 0], [4, 0], [4, 4], [0, 4]], [[1, 1], [1, 2], [2, 2]]]
        floor, part = scene.walls_of({"wall": [{"name": "floor", "box": {"min": [0, 0], "max": [1, 1]}},
                                                 {"name": "part", "file": "part.svg"}]}, {1: frame})
        self.assertEqual((floor["rings"], floor["box"]), ([], [0, 0, 1, 1]))
        self.assertEqual((part["rings"], part["box"], part["round"]), (frame, [0, 0, 4, 4], False))

    def charts_of(self, motion):
        """Title -> label -> value at a time, of the charts of a wall that moves so for 2 s."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        case = pathlib.Path(folder.name) / "case.toml"
        case.write_text('[case]\ntitle = "A"\nend_time = 2.0\ndomain = { min = [-9, -9], max = [9, 9] }\n[[wall]]\nname = "w"\n'
                        f"box = {{ min = [0, 0], max = [1, 1] }}\n{motion}\n[fluid]\n")
        resolved = resolve(case, PROGRAMS / "coupler")
        charts = scene.motion_charts(scene.walls_of(resolved.content, resolved.outlines, resolved.motions), 2.0)
        return {chart["title"]: {line["label"]: lambda t, points=line["points"]: np.interp(t, *zip(*points))
                                 for line in chart["lines"]} for chart in charts}

    def test_a_wall_moves_by_the_integral_of_its_velocity(self):
        moved = self.charts_of("motion = { velocity = [[0.0, 0.0, 0.0], [1.0, 2.0, 0.0]] }")["prescribed displacement"]
        self.assertEqual(list(moved), ["w, x"])
        for time, place in ((0.5, 0.25), (1.0, 1.0), (2.0, 3.0)):  # t^2; the last velocity goes on
            self.assertAlmostEqual(moved["w, x"](time), place)

    def test_a_wall_moves_faster_and_for_longer_by_its_multipliers(self):
        found = self.charts_of("motion = { velocity = [[0.0, 0.0, 0.0], [1.0, 2.0, 0.0]], speed = 3.0, time = 2.0 }")
        self.assertAlmostEqual(found["prescribed displacement"]["w, x"](1.0), 3 * 2 * 0.25)
        self.assertAlmostEqual(found["prescribed displacement"]["w, x"](2.0), 3 * 2 * 1.0)
        self.assertAlmostEqual(found["prescribed velocity"]["w, x"](1.0), 3.0)

    def test_a_wall_that_turns_has_a_chart_of_its_angle_alone(self):
        found = self.charts_of("motion.rotation = { about = [0.5, 0.5], angular_velocity = [[0.0, 2.0]] }")
        self.assertEqual(list(found), ["prescribed angle"])
        self.assertAlmostEqual(found["prescribed angle"]["w"](1.5), 3.0)

    def test_a_wall_without_motion_has_no_poses(self):
        wall, = scene.walls_of({"wall": [{"name": "w", "box": {"min": [0, 0], "max": [1, 1]}}]})
        self.assertEqual(wall["poses"], [])
        self.assertEqual(scene.motion_charts([wall], 2.0), [])

    def test_a_case_that_ends_before_it_starts_has_no_charts(self):
        wall = {"name": "w", "about": [0.0, 0.0], "poses": [[0.0, 0.0, 0.0, 0.0, 1.0, 0.0], [1.0, 1.0, 0.0, 0.0, 1.0, 0.0]]}
        self.assertEqual(len(scene.motion_charts([wall], 1.0)), 2)
        self.assertEqual(scene.motion_charts([wall], -1.0), [])


if __name__ == "__main__":
    unittest.main()
