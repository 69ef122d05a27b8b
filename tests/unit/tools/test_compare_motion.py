"""The frames of two runs laid over each other: at which times, in which colours, and what is said where there are none."""

import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

import h5py
import numpy as np

from toryu import PROGRAMS
from toryu.compare import motion
from toryu.report import data, frames
from toryu_testing import made_up_run

NAMES = ("long", "short")


class Motion(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.outs = [self.folder / name for name in NAMES]
        made_up_run.make_results(self.outs[0], end=0.4, frames=11)  # every 0.04 s
        made_up_run.make_results(self.outs[1], end=0.3, frames=7)  # every 0.05 s

    def collect(self):
        self.faults = [[], []]
        runs = [(out, data.used_case(out / "used_case.toml", out, PROGRAMS / "coupler")[0], faults)
                for out, faults in zip(self.outs, self.faults)]
        return motion.collect(runs, NAMES)

    def bodies(self, content):
        return [{body["name"]: body for body in run["bodies"]} for run in content["runs"]]

    def test_the_times_are_those_of_the_first_that_both_reached(self):
        content, note = self.collect()
        # the last frame of the second stands for half an interval more, until 0.325 s
        np.testing.assert_allclose(content["times"], [0.04 * k for k in range(9)])
        self.assertEqual(note, "")
        for (first, second) in (self.bodies(content),):
            self.assertEqual((len(first["fluid"]["frames"]), len(second["fluid"]["frames"])), (9, 7))
        self.outs.reverse()
        content, _ = self.collect()
        np.testing.assert_allclose(content["times"], [0.05 * k for k in range(7)])
        # nor is a body shown at a time that another one of its run has not reached
        for k in (3, 4, 5, 6):
            (self.outs[0] / f"frames/solid_{k:06}.hdf").unlink()
        np.testing.assert_allclose(self.collect()[0]["times"], [0, 0.05, 0.1])

    def test_both_are_coloured_over_one_range(self):
        for frame in (self.outs[1] / "frames").glob("fluid*.hdf"):
            with h5py.File(frame, "a") as file:
                file["VTKHDF/PointData/pressure"][...] *= 3
        first, second = self.bodies(self.collect()[0])
        for name in ("fluid", "solid"):
            self.assertEqual(first[name]["quantities"], second[name]["quantities"])
        alone = frames.Body(self.outs[1], "fluid")
        frames.measure(alone, frames.domain_of({}))
        self.assertEqual(first["fluid"]["quantities"][0], alone.quantities[0].described())

    def test_quantities_of_one_run_alone_are_no_choice(self):
        for frame in (self.outs[0] / "frames").glob("fluid*.hdf"):
            with h5py.File(frame, "a") as file:
                del file["VTKHDF/PointData/pressure"]
        for k in (0, 1):
            fluids = [bodies["fluid"] for bodies in self.bodies(self.collect()[0])]
            self.assertEqual([[q["label"] for q in fluid["quantities"]] for fluid in fluids], 2 * [["speed", "density"]])
            self.outs.reverse()

    def test_each_has_its_walls_and_all_are_in_view(self):
        used = self.outs[1] / "used_case.toml"
        used.write_text(used.read_text().replace("max = [0.3, 0.0]", "max = [0.5, 0.0]"))
        for frame in (self.outs[1] / "frames").glob("fluid*.hdf"):
            with h5py.File(frame, "a") as file:
                file["VTKHDF/Points"][0] = [0.8, 0.2, 0]
        content, _ = self.collect()
        self.assertEqual([run["walls"][0]["box"][2] for run in content["runs"]], [0.3, 0.5])
        self.assertEqual([run["name"] for run in content["runs"]], ["long", "short"])
        self.assertGreater(content["view"][2], 0.8)

    def test_a_run_without_frames_is_told(self):
        for path in self.outs[1].glob("*.series"):
            path.unlink()
        self.assertEqual(self.collect(), ({}, "Nothing is drawn: short left no frames."))
        self.assertEqual(self.faults, [[], []])

    def test_frames_that_are_damaged_are_told(self):
        (self.outs[1] / "frames/fluid_000002.hdf").write_bytes(b"")
        content, _ = self.collect()
        self.assertEqual(len(self.bodies(content)[1]["fluid"]["times"]), 6)
        self.assertEqual(self.faults[0], [])
        self.assertRegex(self.faults[1][0], "^fluid_000002.hdf cannot be read")

    def test_too_many_frames_are_thinned_alike(self):
        with unittest.mock.patch.object(frames, "SIZE_LIMIT", 2.5e5):
            content, note = self.collect()
        step = int(re.fullmatch("every ([0-9])th frame is shown", note)[1])
        self.assertGreater(step, 1)
        for bodies, count in zip(self.bodies(content), (9, 7)):
            self.assertEqual(len(bodies["fluid"]["times"]), len(range(0, count - 1, step)) + 1)

    def test_the_page_plays_them_from_where_they_differ_most(self):
        made_up_run.write_series(self.outs[1], "solid", {"time[s]": [0, 0.1, 0.2, 0.3], "tip[m]": [0, 0, 5, 0]})
        made_up_run.write_series(self.outs[0], "solid", {"time[s]": [0, 0.1, 0.2, 0.3], "tip[m]": [0, 0, 1, 1]})
        for out in self.outs:
            (out / "fluid.csv").unlink()
        for withheld in (False, True):
            if withheld:
                (self.outs[1] / "fluid.hdf.series").unlink()
                (self.outs[1] / "solid.hdf.series").unlink()
            subprocess.run([sys.executable, "-m", "toryu.compare", *self.outs, "--out", self.folder / "c"], check=True,
                           stdout=subprocess.DEVNULL)
            page = (self.folder / "c/compare.html").read_text()
            content = json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', page, re.S)[1])
            self.assertEqual(re.findall(r'(?:src|href)="(?!data:|charts/|#)', page), [])
            self.assertEqual(('id="particles"' in page, "runs" in content), 2 * (not withheld,))
            self.assertEqual("Nothing is drawn: short left no frames." in page, withheld)
            self.assertEqual(content["telling"], {"time": 0.2})


if __name__ == "__main__":
    unittest.main()
