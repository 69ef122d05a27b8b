"""How far two paths lie apart, by hand, and what is said of runs that have none."""

import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

import path_difference

HEADER = "time[s],tip_displacement_x[m],tip_displacement_y[m]\n"


class PathDifference(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.gate, self.slanted = (pathlib.Path(folder.name) / name for name in ("gate", "slanted"))
        self.leave(self.gate, HEADER + "0,0,0\n0.1,3,4\n")
        # (3, 4) turned by 30 degrees anticlockwise, and made 1.1 times as long; a time that the gate has not
        x, y = (3 * math.cos(math.pi / 6) - 4 * 0.5, 3 * 0.5 + 4 * math.cos(math.pi / 6))
        self.leave(self.slanted, HEADER + f"0,0,0\n0.1,{1.1 * x},{1.1 * y}\n0.2,90,90\n")

    def leave(self, out, text):
        out.mkdir(exist_ok=True)
        (out / "solid.csv").write_text(text)

    def command(self):
        return subprocess.run([sys.executable, path_difference.__file__, self.gate, self.slanted], text=True,
                              capture_output=True, timeout=60)

    def test_figures_are_those_by_hand(self):
        found = path_difference.difference(self.gate, self.slanted)
        self.assertAlmostEqual(found.peak, 0.1)
        self.assertAlmostEqual(found.path, math.sqrt(0.5**2 / 2) / 5)
        self.assertEqual(self.command().stdout, "peak +10.00 %, path 7.07 % of the peak, root mean square\n")

    def test_what_a_run_lacks_is_said_in_a_line(self):
        path = self.slanted / "solid.csv"
        for text, said in ((HEADER.replace("_y", "_z") + "0,0,0\n", f"{path}: error: has no column 'tip_displacement_y[m]'"),
                           (HEADER + "0,0\n", f"{path}: error: holds a row that is no row of numbers"),
                           (HEADER + "0,0,x\n", f"{path}: error: holds a row that is no row of numbers"),
                           ("", f"{self.gate}: error: its tip does not move at a time that {self.slanted} has too"),
                           (HEADER + "0.05,1,1\n", f"{self.gate}: error: its tip does not move at a time"),
                           (None, f"{path}: error: cannot be read: No such file or directory")):
            with self.subTest(said):
                path.unlink() if text is None else path.write_text(text)
                ended = self.command()
                self.assertEqual((ended.returncode, ended.stdout, ended.stderr.count("\n")), (2, "", 1), ended.stderr)
                self.assertIn(said, ended.stderr)


if __name__ == "__main__":
    unittest.main()
