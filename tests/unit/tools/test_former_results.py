"""What becomes of results that are in the folder of a new run: kept beside it, or removed."""

import argparse
import errno
import subprocess
import sys
import unittest
import unittest.mock

from launch_case import Launch

from toryu import PROGRAMS, launch, results_folder

OURS = ["fluid.csv", "solid.csv.part", "frames/fluid_000003.hdf", "fluid.hdf.series", "report.html", "frames.py", "log.txt",
        "walls.hdf.series", "frames/walls_000000.hdf", "exchange.h5", "coupler_summary.toml", "interface.h5.rows.part", "checkpoint/000001/fluid.h5",
        "checkpoint/000001/manifest.toml"]
OTHERS = ["notes.txt", "measured.csv", "frames/picture.png"]


class FormerResults(Launch):
    def leave_results(self, text="old"):
        for name in OURS + OTHERS:
            (self.out / name).parent.mkdir(parents=True, exist_ok=True)
            (self.out / name).write_text(text)

    def former(self, number):
        return self.folder / f"out.{number}"

    def test_they_are_kept_beside_the_new_ones(self):
        self.leave_results()
        done = self.launch()
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in OURS:
            self.assertEqual((self.former(1) / name).read_text(), "old", name)
            self.assertFalse((self.out / name).exists() and (self.out / name).read_text() == "old", name)
        for name in OTHERS:
            self.assertEqual((self.out / name).read_text(), "old")
            self.assertFalse((self.former(1) / name).exists(), name)
        self.assertEqual(done.stderr.splitlines()[0], f"kept the former results in {self.former(1)} (42 B)")

    def test_they_are_numbered_and_their_room_is_told(self):
        for number, size in ((2, 5_000_000), (10, 20_000_000)):
            (self.former(number) / "frames").mkdir(parents=True)
            (self.former(number) / "frames/fluid_000000.hdf").write_bytes(b"x" * size)
        (self.folder / "out.other").mkdir()
        (self.out / "fluid.csv").write_bytes(b"x" * 12_400_000)
        self.assertIn(f"kept the former results in {self.former(11)} (12 MB; 3 former results take 37 MB)\n",
                      self.launch().stderr)
        self.assertEqual((self.former(11) / "fluid.csv").stat().st_size, 12_400_000)

    def test_the_same_command_typed_twice_just_runs(self):
        self.plan(fluid="write fluid.csv time[s]")
        self.assertNotIn("kept", self.launch().stderr)
        for number in (1, 2):
            self.assertIn(f"kept the former results in {self.former(number)} (", self.launch().stderr)
        self.assertEqual((self.former(2) / "fluid.csv").read_text(), "time[s]")
        self.assertEqual((self.out / "fluid.csv").read_text(), "time[s]")

    def test_what_the_machine_lacks_is_no_fault_of_the_input(self):
        options = argparse.Namespace(out=self.out, overwrite=False, bin=PROGRAMS)
        lack = OSError(errno.EMFILE, "Too many open files")
        with unittest.mock.patch.object(launch, "keep_former", side_effect=lack), self.assertRaises(OSError):
            launch.set_former_aside(options)

    def test_they_are_removed_if_that_is_asked_for(self):
        self.leave_results()
        done = self.launch("--overwrite")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("kept", done.stderr)
        self.assertFalse(self.former(1).exists())
        self.assertFalse((self.out / "checkpoint").exists())
        self.assertFalse((self.out / "fluid.csv").exists())
        for name in OTHERS:
            self.assertEqual((self.out / name).read_text(), "old")
        self.assertNotIn("--overwrite", (self.out / "fluid_solver.arguments").read_text())

    def test_a_case_that_a_run_would_write_over_is_refused(self):
        used = self.out / "used_case.toml"
        used.write_text("[case]\n[fluid]\n")
        self.case = used
        for path in self.bin.glob("*_solver"):  # the real one judges
            path.write_text(f'#!/bin/sh\nexec "{PROGRAMS}/{path.name}" "$@"\n')
        done = self.launch()
        self.assertEqual(done.returncode, 2)
        self.assertIn(f"{used}: error: a run with its results in '{self.out}' would write over this file", done.stderr)
        self.assertEqual(used.read_text(), "[case]\n[fluid]\n")

    def test_a_case_in_a_linked_folder_has_results_of_its_own(self):
        (self.folder / "link").symlink_to(self.case)
        for name in ("gate", "link"):
            done = subprocess.run([sys.executable, "-m", "toryu.launch", name, "--bin", self.bin], cwd=self.folder,
                                  capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertTrue((self.folder / "out" / name / "coupler.pid").exists())

    def test_a_check_leaves_them_alone(self):
        self.leave_results()
        self.launch("--check")
        self.assertEqual((self.out / "fluid.csv").read_text(), "old")
        self.assertFalse(self.former(1).exists())

    def test_nothing_runs_or_moves_if_they_cannot_be_kept(self):
        self.out = self.folder / ("x" * 254)  # a name that can take no number
        self.out.mkdir()
        self.leave_results()
        done = self.launch()
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, "x{254}: error: the former results cannot be kept beside it: .*File name too long.*"
                                      "; --overwrite removes them")
        for name in OURS:
            self.assertEqual((self.out / name).read_text(), "old")
        self.assertEqual(self.pids(), [])
        self.assertEqual(self.launch("--overwrite").returncode, 0)

    def test_a_move_that_fails_half_way_is_undone(self):
        self.leave_results()
        target = self.former(1)
        target.mkdir()
        (target / "report.html").mkdir()  # in the way
        (target / "report.html/something").touch()
        with self.assertRaises(OSError):
            results_folder.move(results_folder.written(self.out), self.out, target)
        for name in OURS:
            self.assertEqual((self.out / name).read_text(), "old", name)

    def test_the_references_of_the_used_case_go_along_as_copies(self):
        (self.out / "reference").mkdir()
        (self.out / "reference/tip.csv").write_text("t,x")
        (self.folder / "secret.csv").touch()
        (self.out / "used_case.toml").write_text('[[reference]]\nfile = "reference/tip.csv"\n'
                                                 '[[reference]]\nfile = "../secret.csv"\n')
        self.launch()
        for folder in (self.out, self.former(1)):
            self.assertEqual((folder / "reference/tip.csv").read_text(), "t,x")

    def test_of_a_link_they_stay_beside_what_it_leads_to(self):
        (self.folder / "disk").mkdir()
        self.out.rename(self.folder / "disk/out")
        self.out.symlink_to(self.folder / "disk/out")
        self.leave_results()
        self.launch()
        self.assertEqual((self.folder / "disk/out.1/fluid.csv").read_text(), "old")

    def test_they_are_left_alone_while_another_run_holds_the_folder(self):
        self.plan(*["wait 30"] * 3)
        first = subprocess.Popen(self.command(), stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
        try:
            self.wait_for(lambda: (self.out / "coupler.pid").exists())
            self.leave_results()
            for options in ((), ("--overwrite",)):
                self.assertEqual(self.launch(*options).returncode, 2)
                self.assertEqual((self.out / "fluid.csv").read_text(), "old")
        finally:
            first.terminate()
            first.wait(30)

    def test_sizes(self):
        for size, text in ((0, "0 B"), (999, "999 B"), (1500, "1.5 kB"), (12_345_678, "12 MB"), (999_600_000, "1 GB"),
                           (3e15, "3000 TB")):
            self.assertEqual(results_folder.readable_size(size), text)


if __name__ == "__main__":
    unittest.main()
