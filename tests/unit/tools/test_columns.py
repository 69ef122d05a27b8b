"""The columns that `--check --columns` lists are those that a run writes."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

CASES = pathlib.Path(__file__).resolve().parents[3] / "cases"
SLIDING = ["--set=fluid.wall_model={slip='free_slip'}", "--set=fluid.friction={coefficient=0.1}"]
WEARING = [*SLIDING, "--set=fluid.removal={preston_coefficient=1e-12}", "--set=coupling.scheme='serial_implicit'"]


class Columns(unittest.TestCase):
    def launch(self, case, *options):
        return subprocess.run([sys.executable, "-m", "toryu.launch", CASES / case, *options], capture_output=True, text=True,
                              cwd=self.folder, timeout=120)

    def test_are_those_of_the_run(self):
        for case, files, options in (("elastic_gate", 3, []), ("elastic_gate", 3, SLIDING), ("elastic_gate", 3, WEARING),
                                     ("dam_break", 1, ["--set=fluid.spacing=0.02"])):
            with self.subTest(f"{case} {options}"), tempfile.TemporaryDirectory() as self.folder:
                told = self.launch(case, "--check", "--columns", *options)
                self.assertEqual(told.returncode, 0, told.stderr)
                done = self.launch(case, "--end-time=1e-4", "--no-report", "--out=out", *options)
                self.assertEqual(done.returncode, 0, done.stderr)
                written = {path.name: path.read_text().partition("\n")[0].split(",")
                           for path in pathlib.Path(self.folder, "out").glob("*.csv")}
                self.assertEqual(len(written), files)
                lines = told.stdout.splitlines()
                for name, columns in written.items():
                    self.assertEqual([line.removeprefix(f"{name}:") for line in lines if line.startswith(f"{name}:")], columns)

    def test_go_with_a_check(self):
        with tempfile.TemporaryDirectory() as self.folder:
            refused = self.launch("elastic_gate", "--columns")
        self.assertEqual((refused.returncode, refused.stderr), (2, "--columns: error: goes with --check\n"))


if __name__ == "__main__":
    unittest.main()
