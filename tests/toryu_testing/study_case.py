"""A study in a folder of its own, with a stand-in for the program: what the tests of studies share."""

import csv
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

from toryu import PROGRAMS

HERE = pathlib.Path(__file__).resolve().parent
HEAD = '[study]\ntitle = "A made-up study & more"\ncase = "case.toml"\n'
TWO_AXES = """
[[axis]]
name = "x"
unit = "m/s"
values = [1, 2, 4]
keys = ["fluid.x"]
[[axis.derived]]
keys = ["fluid.y"]
scale = 8
power = -1

[[axis]]
name = "wait"
values = [0.0, 0.001]
keys = ["fluid.seconds"]
"""


def make_programs(folder):
    """A folder with stand-ins for all that a study of one side starts."""
    folder.mkdir()
    shutil.copy(HERE / "fake_study_solver.py", folder / "fluid_solver")
    # the real one reads the study and its case
    (folder / "coupler").write_text(f'#!/bin/sh\nexec "{PROGRAMS}/coupler" "$@"\n')
    (folder / "reference_loop").write_text("#!/bin/sh\necho 0.5 0.6\n")
    for path in folder.iterdir():
        path.chmod(0o755)


class Study(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.bin, self.case, self.out = (self.folder / name for name in ("bin", "flow", "out"))
        make_programs(self.bin)
        self.case.mkdir()
        (self.case / "case.toml").write_text('[case]\ntitle = "test"\n[[wall]]\nname = "piston"\n[fluid]\n')

    def write(self, text, head=HEAD):
        (self.case / "window.toml").write_text(head + text)

    def command(self, *options):
        return [sys.executable, "-m", "toryu.launch", str(self.case / "window.toml"), "--bin", str(self.bin), "--out",
                str(self.out), *options]

    def study(self, *options):
        return subprocess.run(self.command(*options), capture_output=True, text=True, timeout=120, cwd=self.folder)

    def done(self, *options):
        ended = self.study(*options)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        return ended

    def starts(self, kind="starts"):
        path = self.bin / f"{kind}.txt"
        return path.read_text().split() if path.exists() else []

    def table(self, name="table.csv"):
        with open(self.out / name, newline="") as file:
            return list(csv.DictReader(file))

    def wait_for(self, condition):
        end = time.monotonic() + 60
        while not condition():
            self.assertLess(time.monotonic(), end, "waited in vain")
            time.sleep(0.01)
