"""A study of a case: the full one has no faults, its small version runs to the end and says something.

    case_study_test.py BUILD/bin STUDY.toml
"""

import csv
import math
import pathlib
import subprocess
import sys
import tempfile
import tomllib
import unittest

PROGRAMS, STUDY = map(pathlib.Path, sys.argv[1:3])
CONTENT = tomllib.loads(STUDY.read_text(encoding="utf-8"))


def number(text):
    try:
        return float(text)
    except ValueError:
        return math.nan


class CaseStudy(unittest.TestCase):
    def run_study(self, *options):
        done = subprocess.run([sys.executable, "-m", "toryu.launch", str(STUDY), "--bin", str(PROGRAMS), *options],
                              capture_output=True, text=True, stdin=subprocess.DEVNULL)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def test_no_faults(self):
        self.assertIn("no errors", self.run_study("--check"))

    @unittest.skipUnless("small" in CONTENT, "the study has no small version")
    def test_small_version(self):
        with tempfile.TemporaryDirectory() as folder:
            self.run_study("--small", "--out", folder)
            out = pathlib.Path(folder)
            with open(out / "table.csv", newline="", encoding="utf-8") as file:
                rows = list(csv.DictReader(file))
            self.assertTrue((out / "study.html").is_file())
            self.assertTrue(list(out.glob("charts/*.png")))
        for metric in CONTENT.get("metric", []):
            column = next(c for c in rows[0] if c.split("[")[0] == metric["name"])
            self.assertTrue(any(math.isfinite(number(row[column])) for row in rows), f"no run gives {metric['name']}")
        if "map" in CONTENT:
            verdicts = {row["verdict"] for row in rows}
            self.assertTrue("stable" in verdicts and len(verdicts) > 1, f"a map with {verdicts} only shows no edge")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
