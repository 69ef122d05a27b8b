"""What a run left, as arrays with units; and a case that a script runs."""

import pathlib
import tempfile
import unittest

import h5py
import numpy as np

import toryu
from toryu_testing import made_up_run
from toryu_testing.trio import CASE


class Arrays(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.out = pathlib.Path(folder.name)

    def read(self):
        return toryu.results.read(self.out)

    def test_a_series(self):
        made_up_run.write_series(self.out, "solid", {"time[s]": [0, 0.1], "tip_displacement_x[m]": [0, 0.02], "n[1]": [1, 2]})
        series = self.read().series("solid")
        self.assertEqual(list(series), ["time", "tip_displacement_x", "n"])
        tip = series["tip_displacement_x"]
        self.assertEqual((tip.unit, tip.tolist()), ("m", [0, 0.02]))
        self.assertEqual([series["time"].unit, series["n"].unit], ["s", "1"])

    def test_parts_keep_the_unit_and_what_is_computed_has_none(self):
        made_up_run.write_series(self.out, "solid", {"time[s]": [0, 1, 2], "x[m]": [1, 2, 3]})
        x = self.read().series("solid")["x"]
        self.assertEqual([x[1:].unit, x[x > 1].unit], ["m", "m"])
        self.assertIs(type(x * x), np.ndarray)
        self.assertIs(type(np.sqrt(x)), np.ndarray)
        self.assertEqual(repr(x[:2]), "array([1., 2.]) [m]")
        self.assertEqual(float(abs(x).max()), 3)

    def test_frames(self):
        made_up_run.write_frames(self.out, "solid", made_up_run.solid, [0.0, 0.15])
        frames = self.read().frames("solid")
        points, fields = made_up_run.solid(0.15)
        self.assertEqual([frame.time for frame in frames], [0.0, 0.15])
        self.assertEqual(sorted(frames[1].fields()), ["displacement", "stress", "von_mises_stress"])
        self.assertEqual(frames[1].position.unit, "m")
        np.testing.assert_array_equal(frames[1].position, points)
        displacement, stress = frames[1]["displacement"], frames[1]["stress"]
        np.testing.assert_array_equal(displacement, fields["displacement"][1].astype("f4"))
        self.assertEqual((displacement.unit, stress.unit, stress.shape), ("m", "Pa", (len(points), 2, 2)))
        np.testing.assert_array_equal(stress[:, 1, 1], fields["stress"][1][:, 3].astype("f4"))

    def test_the_interface(self):
        with h5py.File(self.out / "interface.h5", "w") as file:
            for name, unit, shape in (("time", "s", (2,)), ("force", "N/m", (2, 3, 2))):
                file[name] = np.arange(np.prod(shape), dtype=float).reshape(shape)
                file[name].attrs["unit"] = np.bytes_(unit)
        interface = self.read().interface()
        self.assertEqual([interface["time"].unit, interface["force"].unit], ["s", "N/m"])
        self.assertEqual(interface["force"][1, 2].tolist(), [10, 11])

    def test_summaries(self):
        made_up_run.write_summary(self.out, "fluid")
        self.assertEqual(self.read().summaries()["fluid"]["steps"], 12800)

    def test_what_is_not_there(self):
        with self.assertRaisesRegex(FileNotFoundError, "absent: no such folder of results"):
            toryu.results.read(self.out / "absent")
        for name, ask in {"fluid.csv": lambda run: run.series("fluid"), "walls.hdf.series": lambda run: run.frames("walls"),
                          "interface.h5": lambda run: run.interface(), r"\*_summary.toml": lambda run: run.summaries()}.items():
            with self.assertRaisesRegex(FileNotFoundError, f"{name}: the run left none"):
                ask(self.read())

    def test_a_name_that_is_not_there_is_told_with_the_nearest(self):
        made_up_run.write_series(self.out, "fluid", {"time[s]": [0, 1], "gauge_level[m]": [1, 2]})
        with self.assertRaisesRegex(KeyError, "no 'guage_level'; did you mean 'gauge_level'?"):
            self.read().series("fluid")["guage_level"]
        made_up_run.write_frames(self.out, "fluid", lambda time: (np.zeros((1, 2)), {"pressure": ("Pa", np.zeros(1))}), [0, 1])
        with self.assertRaisesRegex(KeyError, "no 'presure'; did you mean 'pressure'?"):
            self.read().frames("fluid")[0]["presure"]

    def test_what_is_damaged(self):
        for name in ("fluid.csv", "fluid.hdf.series", "fluid_summary.toml", "interface.h5"):
            (self.out / name).write_text("nothing,of\n\x00use")
        for ask, words in ((lambda run: run.series("fluid"), r"fluid.csv has no column time\[s\]"),
                           (lambda run: run.frames("fluid"), "fluid.hdf.series cannot be read"),
                           (lambda run: run.summaries(), "fluid_summary.toml cannot be read"),
                           (lambda run: run.interface(), "interface.h5 cannot be read")):
            with self.assertRaisesRegex(ValueError, words):
                ask(self.read())


class Running(unittest.TestCase):
    def test_a_case_is_run_and_its_results_come_back(self):
        with tempfile.TemporaryDirectory() as folder:
            run = toryu.run(CASE, set={"case.end_time": 0.002, "case.title": "Mine", "fluid.region.water.box.max": (0.1, 0.02)},
                            out=pathlib.Path(folder) / "out", options=["--no-report"])
            self.assertAlmostEqual(run.series("fluid")["time"][-1], 0.002)
            self.assertEqual(run.series("coupler")["time"].unit, "s")
            self.assertEqual(run.summaries()["solid"]["exit_code"], 0)
            self.assertEqual(len(run.frames("fluid")[0].position), 40 * 8)
            self.assertIn('title = "Mine"', (run.out / "used_case.toml").read_text())

    def test_a_run_that_fails_says_why(self):
        with tempfile.TemporaryDirectory() as folder, self.assertRaisesRegex(toryu.RunFailed, "did you mean 'density'") as failed:
            toryu.run(CASE, set={"fluid.densty": 1000}, out=folder)
        self.assertEqual(failed.exception.exit_code, 2)

    def test_a_case_that_is_not_there_fails_alike_without_a_folder_for_results(self):
        with self.assertRaisesRegex(toryu.RunFailed, "/nowhere: error: no such file or folder") as failed:
            toryu.run("/nowhere")
        self.assertEqual(failed.exception.exit_code, 2)

    def test_one_option_may_be_a_text(self):
        with tempfile.TemporaryDirectory() as folder, self.assertRaisesRegex(toryu.RunFailed, "--no-such: error: unknown"):
            toryu.run(CASE, out=folder, options="--no-such")


if __name__ == "__main__":
    unittest.main()
