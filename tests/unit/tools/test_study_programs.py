"""Studies with programs of a user, and with programs on other hosts."""

import unittest

from toryu_testing.study_case import Study

AXIS = '[[axis]]\nname = "x"\nvalues = [1, 2]\nkeys = ["fluid.x"]\n'
METRIC = '[[metric]]\nname = "end"\nseries = "fluid.csv:speed[m/s]"\n'  # which nobody can tell beforehand


class Programs(Study):
    def setUp(self):
        super().setUp()
        self.write(AXIS + METRIC)
        self.mine = self.folder / "mine.py"
        text = (self.bin / "fluid_solver").read_text()
        first, rest = text.split("\n", 1)
        self.mine.write_text(f'{first}\nimport sys\nif sys.argv[1] == "--can-checkpoint":\n    print("yes")\n    sys.exit()\n{rest}')
        self.mine.chmod(0o755)

    def started(self):
        path = self.folder / "starts.txt"  # beside the program
        return path.read_text().split() if path.exists() else []

    def test_a_program_takes_the_place_of_a_solver_in_every_run(self):
        (self.bin / "fluid_solver").unlink()
        self.done("--fluid", "mine.py")
        self.assertEqual(len(self.started()), 2)
        self.assertIn("mine.py", (self.out / "study.html").read_text())
        self.done("--fluid", "mine.py")
        self.assertEqual(len(self.started()), 2)
        with open(self.mine, "a") as program:
            program.write("# another program\n")
        self.done("--fluid", "mine.py")
        self.assertEqual(len(self.started()), 4)

    def test_what_cannot_take_one(self):
        for options, words in ((("--fluid", "yours.py"), "yours.py: error: no such program, needed as fluid_solver"),
                               (("--solid", "mine.py"), "--solid ./mine.py: error: the case has no solid"),
                               (("--peers", "10.0.0.1"), "--peers 10.0.0.1: error: goes with --host; programs that are started by "
                                                         "hand take it themselves"),
                               (("--host", "solid=node"), "--host solid=node: error: the case has no solid; it takes fluid")):
            with self.subTest(options):
                ended = self.study(*options)
                self.assertEqual((ended.returncode, ended.stderr), (2, words + "\n"))
                self.assertEqual(self.starts() + self.started(), [])

    def test_a_program_of_every_run_is_on_a_host(self):
        reach = self.folder / "reach"
        reach.write_text(f'#!/bin/sh\necho "$1" >>"{self.folder}/reached.txt"\nshift\nexec "$@"\n')
        reach.chmod(0o755)
        self.done("--host", "fluid=127.0.0.1", "--launcher", str(reach), "--remote-folder", str(self.folder))
        self.assertEqual(len(self.table()), 2)
        self.assertGreaterEqual((self.folder / "reached.txt").read_text().count("127.0.0.1"), 2)
        self.assertEqual({row["exit_code"] for row in self.table()}, {"0"})

    def test_identities_are_handed_to_every_run(self):
        self.mine.write_text(self.mine.read_text().replace("import sys\n", "import sys\nprint(*sys.argv)\n", 1))
        self.done("--fluid", "mine.py", "--secure", "nowhere")
        told = [path.read_text() for path in self.out.glob("runs/*/output.txt")]
        self.assertEqual([f"--secure={self.folder}/nowhere" in text for text in told], [True] * 2)

    def test_times_are_those_of_one_machine(self):
        self.write(AXIS + "[timing]\nrepeat = 1\n")
        ended = self.study("--host", "fluid=127.0.0.1")
        self.assertEqual((ended.returncode, ended.stderr), (
            2, "--host fluid=127.0.0.1: error: a study with [timing] compares times of one machine\n"))


if __name__ == "__main__":
    unittest.main()
