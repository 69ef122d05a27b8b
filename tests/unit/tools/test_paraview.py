"""frames.py as ParaView runs it: in its window, where a script does not know its place, and in pvpython."""

import contextlib
import os
import pathlib
import runpy
import shutil
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

import h5py
import numpy as np

from toryu_testing import made_up_run
from toryu_testing.fake_paraview import Session


class Frames(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.case, self.out = pathlib.Path(folder.name) / "gate", pathlib.Path(folder.name) / "out"

    def make(self, sides=("fluid", "solid"), walls=True):
        made_up_run.make_case(self.case, sides)
        made_up_run.make_results(self.out, sides, frames=3)
        if walls:
            corners = made_up_run.lattice(-0.01, -0.01, 0.3, 0, 0.0025)
            made_up_run.write_frames(self.out, "walls", lambda _: (corners, {}), [0.0])
        self.report()

    def report(self):
        subprocess.run([sys.executable, "-m", "toryu.report", self.out, "--case", self.case], check=True,
                       stdout=subprocess.DEVNULL)

    @contextlib.contextmanager
    def paraview(self, argv, place):
        session, former = Session(), os.getcwd()
        with unittest.mock.patch.dict(sys.modules, session.modules()), unittest.mock.patch.object(sys, "argv", argv):
            os.chdir(place)
            try:
                yield session
            finally:
                os.chdir(former)

    def in_the_window(self, text=None, place="/"):
        with self.paraview([""], place) as session:
            exec(text or (self.out / "frames.py").read_text(), {"__name__": "__main__"})
        return session

    def in_pvpython(self, *arguments):
        script = str(self.out / "frames.py")
        with self.paraview([script, *arguments], "/") as session:
            runpy.run_path(script, run_name="__main__")
        return session

    def range_of(self, body, field):
        """All values but for 1 % at either end, of all frames."""
        values = []
        for frame in sorted((self.out / "frames").glob(f"{body}_*.hdf")):
            with h5py.File(frame) as file:
                values.append(file[f"VTKHDF/PointData/{field}"][:])
        return tuple(np.percentile(np.concatenate(values), [1, 99]))

    def test_bodies_are_coloured_over_the_range_of_all_frames_and_walls_are_grey(self):
        self.make()
        fluid, solid, walls = self.in_the_window().sources
        for source, name, field, preset, title in (
                (fluid, "fluid", "pressure", "Viridis (matplotlib)", "pressure [Pa]"),
                (solid, "solid", "von_mises_stress", "Inferno (matplotlib)", "von mises stress [Pa]")):
            display = source.display
            self.assertEqual((source.name, source.times), (name, [0, 0.2, 0.4]))
            self.assertEqual((display.field, display.colours.preset, display.colours.bar.Title), (field, preset, title))
            np.testing.assert_allclose(display.colours.range, self.range_of(name, field), rtol=1e-6)
            self.assertEqual((display.colours.AutomaticRescaleRangeMode, display.bar_shown), ("Never", True))
            self.assertEqual(display.representation, "Point Gaussian")
            self.assertEqual(2 * display.GaussianRadius, made_up_run.SPACING[name])
        self.assertEqual((walls.name, walls.display.colours, walls.display.ColorArrayName), ("walls", None, [None, ""]))
        self.assertEqual(2 * walls.display.GaussianRadius, made_up_run.SPACING["fluid"])
        self.assertEqual(len(set(walls.display.DiffuseColor)), 3)

    def test_it_looks_at_all_that_happens(self):
        self.make()
        view = self.in_the_window().view
        width, height = np.array(view.ViewSize) / view.ViewSize[1] * 2 * view.CameraParallelScale
        self.assertEqual((view.CameraParallelProjection, view.InteractionMode), (1, "2D"))
        low, high = np.array(view.CameraFocalPoint[:2]) - [width / 2, height / 2], view.CameraFocalPoint[:2] + np.array(
            [(0.5 - 0.14) * width, height / 2])  # beside the bars
        for frame in (self.out / "frames").glob("[fs]*.hdf"):
            with h5py.File(frame) as file:
                points = file["VTKHDF/Points"][:, :2]
            self.assertTrue((points > low).all() and (points < high).all(), frame)

    def test_quantities_of_either_sign_show_where_they_are_zero(self):
        self.make(("fluid",))
        for frame in (self.out / "frames").glob("fluid*.hdf"):
            with h5py.File(frame, "a") as file:
                file["VTKHDF/PointData/pressure"][...] -= 400
        self.report()
        colours = self.in_the_window().sources[0].display.colours
        self.assertEqual((colours.preset, colours.range[0]), ("Cool to Warm", -colours.range[1]))

    def test_a_vector_is_shown_by_its_magnitude(self):
        self.make(("fluid",))
        for frame in (self.out / "frames").glob("fluid*.hdf"):
            with h5py.File(frame, "a") as file:
                del file["VTKHDF/PointData/pressure"]
        self.report()
        display = self.in_the_window().sources[0].display
        self.assertEqual((display.field, display.colours.bar.Title), ("velocity", "speed [m/s]"))

    def test_pvpython_saves_a_picture(self):
        self.make(walls=False)
        self.assertEqual(self.in_pvpython("picture.png", "0.2").saved, [("picture.png", [1600, 900], 0.2)])
        self.assertEqual(self.in_pvpython("picture.png").saved, [("picture.png", [1600, 900], 0.4)])
        self.assertEqual(self.in_pvpython().saved, [])
        with self.assertRaisesRegex(SystemExit, "TIME is a number of seconds, found '0,2'"):
            self.in_pvpython("picture.png", "0,2")

    def test_results_that_were_moved_are_found(self):
        self.make(("fluid",))
        self.assertEqual(self.in_the_window().sources[0].path, self.out / "fluid.hdf.series")
        moved = self.out.rename(self.out.with_name("moved"))
        text = (moved / "frames.py").read_text()
        self.assertEqual(self.in_the_window(text, place=moved).sources[0].path, moved / "fluid.hdf.series")
        with self.assertRaisesRegex(RuntimeError, "no more in .*/out; change into their folder"):
            self.in_the_window(text)
        # another run in the place of this one, or where ParaView was started, is not taken for it
        shutil.copytree(moved, self.out)
        (self.out / "frames.py").write_text(text.replace("pressure", "density"))
        with self.assertRaisesRegex(RuntimeError, "no more in"):
            self.in_the_window(text, place=self.out)
        self.out = moved
        self.assertEqual(self.in_pvpython().sources[0].path, moved / "fluid.hdf.series")

    def test_a_run_without_frames_has_none(self):
        made_up_run.make_case(self.case)
        self.out.mkdir()
        self.report()
        self.assertFalse((self.out / "frames.py").exists())


if __name__ == "__main__":
    unittest.main()
