"""The picture of a scene that `--check --picture` draws."""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import numpy as np

from toryu import PROGRAMS, picture
from toryu.case import Case, resolve

CASES = pathlib.Path(__file__).resolve().parents[3] / "cases"


class Picture(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def check(self, case, *options):
        return subprocess.run([sys.executable, "-m", "toryu.launch", CASES / case, "--check", *options], capture_output=True,
                              text=True, cwd=self.folder, timeout=60)

    def test_it_shows_all_bodies_with_their_names_and_counts(self):
        done = self.check("elastic_gate", "--picture", "scene.svg", "--set", "fluid.spacing=0.005")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"fluid: 560 particles, x 0\.0025 to 0\.0975 m, y 0\.0025 to 0\.1375 m\n")
        self.assertIn("picture scene.svg\n", done.stdout)
        text = (self.folder / "scene.svg").read_text()
        for words in ("Elastic gate", "floor", "left", "fluid, 560 particles", "solid, 276 particles", "clamp", "tip", "x [m]"):
            self.assertIn(f"{words}", text)
        again = self.check("elastic_gate", "--picture", "again.svg", "--set", "fluid.spacing=0.005")
        self.assertEqual(again.returncode, 0)
        without_name = [re.sub(r'(id|href|url)[="(#]+[^")]*', "", (self.folder / f"{name}.svg").read_text())
                        for name in ("scene", "again")]
        self.assertEqual(*without_name)

    def test_it_may_be_a_png_and_has_a_place_of_its_own(self):
        done = self.check("turek_hron_csm", "--picture", "deep/scene.png")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((self.folder / "deep/scene.png").read_bytes()[:4], b"\x89PNG")
        self.assertEqual(self.check("turek_hron_csm", "--picture").returncode, 0)
        self.assertTrue((self.folder / "out/turek_hron_csm_scene.svg").is_file())

    def test_it_shows_open_ends(self):
        done = self.check("open_channel", "--picture", "scene.svg", "--set", "fluid.spacing=0.1")
        self.assertEqual(done.returncode, 0, done.stderr)
        text = (self.folder / "scene.svg").read_text()
        self.assertEqual([text.count(f">{name}<") for name in ("inlet", "outlet")], [2, 2], "name and legend of each")

    def test_it_reaches_as_far_as_an_observer(self):
        for fluid, solid in (([], []), ([[9, -7]], []), ([[9, -7], [-3, 0.5]], [[0, 5]])):
            content = {side: {"observer": [{"point": point} for point in points]}
                       for side, points in (("fluid", fluid), ("solid", solid))}
            case = Case("coupled", pathlib.Path("case.toml"), "case", [], content)
            drawn = np.array([*fluid, *solid, [0.0, 0.0], [1.0, 1.0]])
            low, high = picture.bounds_of(case, [picture.Particles("fluid", drawn[-2:], 0.1)])
            self.assertTrue((low < drawn.min(axis=0)).all() and (high > drawn.max(axis=0)).all(), (low, high))

    def test_what_is_wrong_is_told(self):
        (self.folder / "folder.svg").mkdir()
        (self.folder / "file").touch()
        for options, words in [(["--picture=scene.gif"], "--picture scene.gif: error: must end in .svg or .png"),
                               (["--picture=folder.svg"], "--picture folder.svg: error: is a folder"),
                               (["--picture=file/scene.svg"], "--picture file/scene.svg: error: cannot be written")]:
            done = self.check("turek_hron_csm", *options)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(words, done.stderr)
        alone = subprocess.run([sys.executable, "-m", "toryu.launch", CASES / "elastic_gate", "--picture"], capture_output=True,
                               text=True, cwd=self.folder)
        self.assertEqual((alone.returncode, alone.stderr), (2, "--picture: error: goes with --check\n"))

    def test_what_turns_is_shown_where_it_comes(self):
        case = resolve(CASES / "sloshing_beam", PROGRAMS / "coupler")
        self.assertEqual(len(case.motions), sum(shape["list"] == "wall" for shape in case.shapes))
        motion = case.motions[0]
        # a rigid turn keeps lengths, and the first pose is that of the case
        ring = np.array(picture.rings_of(case, 0)[0])
        first, *_, last = motion["poses"]
        np.testing.assert_allclose(picture.placed(ring, motion, first), ring, atol=1e-12)
        sides = [np.linalg.norm(np.diff(picture.placed(ring, motion, pose), axis=0), axis=1) for pose in (first, last)]
        np.testing.assert_allclose(*sides, rtol=1e-9)
        angles = [pose[3] for pose in picture.ghosts(motion)]
        self.assertAlmostEqual(max(angles), max(pose[3] for pose in motion["poses"]))
        quarter = [0, 2.0, 3.0, np.pi / 2]
        np.testing.assert_allclose(picture.placed([[1.0, 0.0]], {"about": [0, 0]}, quarter), [[2, 4]], atol=1e-12)


if __name__ == "__main__":
    unittest.main()
