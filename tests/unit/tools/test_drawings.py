"""Drawings that a case names, as the programs read them: by Debian's Python, from the user's cache, several at once."""

import importlib.util
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

from toryu import PROGRAMS

DRAWING = ('<svg xmlns="http://www.w3.org/2000/svg" width="40mm" height="30mm" viewBox="0 0 40 30">'
           '<path id="part" d="M 10 20 h 20 v -10 z"/></svg>')
CASE = """[case]
title = "part"
end_time = 1
domain = { min = [-1, -1], max = [1, 1] }
[fluid]
[solid]
[[wall]]
name = "part"
file = "part.svg"
id = "part"
"""


@unittest.skipUnless(importlib.util.find_spec("svgelements"), "tools/install.sh import")
class Drawings(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.case, self.cache = pathlib.Path(folder.name) / "case", pathlib.Path(folder.name) / "cache"
        self.case.mkdir()
        (self.case / "case.toml").write_text(CASE)
        (self.case / "part.svg").write_text(DRAWING)
        self.environment = os.environ | {"XDG_CACHE_HOME": str(self.cache)}

    def start(self, *options):
        return subprocess.Popen([PROGRAMS / "coupler", self.case, *options], env=self.environment, text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def told(self):
        return json.loads(self.start("--resolved").communicate()[0])

    def kept(self):
        return sorted(path.name for path in self.cache.glob("toryu/*"))

    def check(self):
        return self.start("--check").communicate()[1]

    def test_an_answer_is_kept_by_what_it_was_asked_for(self):
        told = self.told()
        outline, = [shape for shape in told["shapes"] if shape["is_outline"]]
        self.assertEqual((outline["list"], outline["number"]), ("wall", 0))
        self.assertEqual([[round(x, 12) for x in corner] for corner in outline["rings"][0]],
                         [[0.01, 0.01], [0.03, 0.01], [0.03, 0.02]])
        self.assertEqual(told["files"], ["part.svg"])
        first, = self.kept()
        self.assertEqual(self.told(), told)
        self.assertEqual(self.kept(), [first])
        (self.case / "part.svg").write_text(DRAWING.replace("-10", "-5"))
        self.assertEqual(round(self.told()["shapes"][0]["rings"][0][2][1], 12), 0.015)
        self.assertEqual(len(self.kept()), 2)

    def test_nothing_is_written_beside_the_case(self):
        self.told()
        self.assertEqual(sorted(path.name for path in self.case.iterdir()), ["case.toml", "part.svg"])

    def test_several_programs_at_once_read_the_same(self):
        answers = {process.communicate()[0] for process in [self.start("--resolved") for _ in range(4)]}
        self.assertEqual(len(answers), 1)
        self.assertEqual(len(json.loads(answers.pop())["shapes"]), 1)
        self.assertEqual(len(self.kept()), 1)

    def test_a_cache_that_cannot_be_written_costs_time_alone(self):
        self.cache.write_text("no folder")
        self.assertEqual(len(self.told()["shapes"]), 1)

    def test_a_kept_answer_that_is_damaged_is_asked_for_again(self):
        told = self.told()
        kept = self.cache / "toryu" / self.kept()[0]
        kept.write_text(kept.read_text()[:40])
        self.assertEqual(self.told(), told)
        self.assertEqual(self.told(), told)

    def test_another_python_that_is_first_on_the_path_does_not_matter(self):
        other = self.case.parent / "other"
        other.mkdir()
        (other / "python3").write_text("#!/bin/sh\nexit 1\n")
        (other / "python3").chmod(0o755)
        self.environment["PATH"] = f"{other}:{self.environment['PATH']}"
        self.environment["PYTHONPATH"] = str(other)
        self.assertEqual(len(self.told()["shapes"]), 1)

    def test_what_is_wrong_stands_at_the_key_that_mends_it(self):
        place = f"{self.case}/case.toml"
        (self.case / "case.toml").write_text(CASE.replace('id = "part"', 'id = "prat"'))
        self.assertIn(f"{place}:10:1: error: no element 'prat' in the file; did you mean 'part'?", self.check())
        (self.case / "case.toml").write_text(CASE)
        (self.case / "part.svg").write_text(DRAWING.replace("mm", ""))
        self.assertIn(f"{place}:9:1: error: 'part.svg': the file does not say its unit", self.check())
        (self.case / "part.svg").write_text(DRAWING.replace(" z", ""))
        self.assertIn(f"{place}:9:1: error: 'part.svg': the outline of 'part' is open", self.check())
        (self.case / "part.svg").write_text(DRAWING.replace("h 20 v -10 z", "L 30 20 L 30 10 L 12 25 z"))
        self.assertIn(f"{place}:9:1: error: the outline crosses or touches itself at (", self.check())
        self.assertEqual(self.kept(), self.kept()[:1])  # a drawing that could not be read leaves nothing


if __name__ == "__main__":
    unittest.main()
