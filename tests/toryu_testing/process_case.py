"""What the tests of three processes share: how to start them, and what to expect of their ends."""
import pathlib
import tomllib
import unittest

from toryu_testing import trio

LIMIT = 30  # seconds after which something that should have ended counts as hung
NAMES = {"coupler": "coupler", "fluid": "fake_fluid", "solid": "fake_solid"}
SOLVERS = {"fluid": "fluid_solver", "solid": "solid_solver"}


class ProcessCase(unittest.TestCase):
    bin = pathlib.Path()  # folder of the programs

    def run_of_three(self, fluid="fake_fluid", solid="fake_solid", coupler="coupler", **settings):
        names = {"coupler": coupler, "fluid": fluid, "solid": solid}
        return self.enterContext(trio.Trio({role: self.bin / name for role, name in names.items()}, **settings))

    def assert_ending(self, run, name, code, *words):
        found, text = run.ending_of(name, LIMIT)
        self.assertEqual(found, code, f"{name}: {text}")
        for word in words:
            self.assertIn(word, text, name)

    def assert_all_end(self, run, code, *words):
        for role in trio.ROLES:
            self.assert_ending(run, role, code, *words)

    def others(self, role):
        return [other for other in trio.ROLES if other != role]

    def summary(self, run):
        return tomllib.loads((run.out / "coupler_summary.toml").read_text())
