"""The launcher in a folder of its own, with stand-ins for the three programs: what its tests share."""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

from toryu import PROGRAMS

HERE = pathlib.Path(__file__).resolve().parent
CASE = '[case]\ntitle = "test"\n'
NAMES = ("coupler", "fluid_solver", "solid_solver")


class Launch(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.bin = self.folder / "bin"
        self.case = self.folder / "gate"
        self.out = self.folder / "out"
        for path in (self.bin, self.case, self.out):
            path.mkdir()
        self.write_case("[fluid]\n[solid]\n")
        self.plan()

    def write_case(self, sections):
        (self.case / "case.toml").write_text(CASE + sections)

    def plan(self, coupler="", fluid="", solid=""):
        if not (self.bin / "real_coupler").exists():
            (self.bin / "real_coupler").symlink_to(PROGRAMS / "coupler")  # it reads the case
        for name, plan in zip(NAMES, (coupler, fluid, solid)):
            self.fake(self.bin / name)
            (self.bin / f"{name}.plan").write_text(plan.replace("; ", "\n"), encoding="utf-8", errors="surrogateescape")

    def fake(self, path):
        shutil.copy(HERE / "fake_program.py", path)
        path.chmod(0o755)

    def command(self, *options):
        return [sys.executable, "-m", "toryu.launch", str(self.case), "--bin", str(self.bin), "--out",
                str(self.out), *options]

    def launch(self, *options):
        return subprocess.run(self.command(*options), capture_output=True, text=True, timeout=60, cwd=self.folder)

    def pids(self):
        return [int(path.read_text()) for path in self.out.glob("*.pid")]

    def assert_nothing_left(self):
        for pid in self.pids():
            self.assertFalse(pathlib.Path(f"/proc/{pid}").exists(), f"process {pid} is left")

    def wait_for(self, condition):
        end = time.monotonic() + 30
        while not condition():
            self.assertLess(time.monotonic(), end, "waited in vain")
            time.sleep(0.01)

    def started(self):
        return len(list(self.out.glob("*.ready"))) == 3
