"""What --ranks is refused for, and how the end of ranks becomes that of a program."""
import argparse
import pathlib
import tempfile
import unittest
from unittest import mock

from toryu import ranks
from toryu.processes import BUG, PEER_LOST

KILLED = b"""--------------------------------------------------------------------------
mpirun noticed that process rank 1 with PID 0 on node here exited on signal %d (%s).
--------------------------------------------------------------------------
"""


def options(**given):
    return argparse.Namespace(**{"ranks": "2", "fluid": None, "host": [], "only": None, "threads": None} | given)


class Refusal(unittest.TestCase):
    def expect(self, words, names=("coupler", "fluid_solver", "solid_solver"), built=True, **given):
        with tempfile.TemporaryDirectory() as folder, mock.patch.object(ranks, "BIN", pathlib.Path(folder)):
            if built:
                (ranks.BIN / "fluid_solver").touch()
            fault = ranks.fault_of(options(**given), names)
        self.assertIn(words, fault)
        self.assertEqual(bool(fault), bool(words), fault)

    def test_takes_a_number_and_a_fluid(self):
        self.expect("")
        self.expect("", ranks=None, names=["solid_solver"])
        for wrong in ("0", "-1", "two", "1.5", ""):
            self.expect(f"--ranks {wrong}: error: must be a number of processes, 1 or more", ranks=wrong)
        self.expect("the case has no fluid", names=["solid_solver"])

    def test_takes_the_fluid_of_toryu_here(self):
        self.expect("my_fluid in the place of fluid_solver", fluid="my_fluid")
        self.expect("leave --host fluid=ADDRESS out", host=["solid=a", "fluid=b"])
        self.expect("", host=["solid=a"])
        self.expect("with --only solid no fluid is computed", only="solid")

    def test_needs_its_build(self):
        self.expect("is not built: 'tools/build.sh ranks fluid_solver' builds it", built=False)


class Command(unittest.TestCase):
    def test_shares_the_cores(self):
        with mock.patch.object(ranks.os, "sched_getaffinity", return_value=set(range(9))):
            command = ranks.over_ranks(options(), {"fluid_solver": ["bin/fluid_solver", "case.toml"]})["fluid_solver"]
        self.assertEqual(command[-5:], ["ranks", "2", str(ranks.BIN / "fluid_solver"), "case.toml", "--threads=4"])

    def test_leaves_a_run_without_them_as_it_is(self):
        commands = {"fluid_solver": ["bin/fluid_solver", "case.toml"]}
        self.assertIs(ranks.over_ranks(options(ranks=None), commands), commands)


class Death(unittest.TestCase):
    def death(self, said):
        listener = ranks.Listener()
        with mock.patch("builtins.print") as told:
            listener.hear(said[:100])
            listener.hear(said[100:])
        return listener.death(3), [call.args[0] for call in told.call_args_list]

    def test_a_killed_rank_is_a_lost_peer(self):
        (code, words), told = self.death(b"a line\n" + KILLED % (9, b"Killed") + b"another\n")
        self.assertEqual(code, PEER_LOST)
        self.assertEqual(words, "fluid_solver: error: peer lost: rank 1 of 3 was ended by signal 9 (Killed); mpirun has ended "
                                "the others")
        self.assertEqual(told, ["a line", "another"])

    def test_a_crash_is_a_bug(self):
        self.assertEqual(self.death(KILLED % (11, b"Segmentation fault"))[0][0], BUG)

    def test_an_end_in_order_is_none(self):
        self.assertIsNone(self.death(b"all is well\n")[0])


if __name__ == "__main__":
    unittest.main()
