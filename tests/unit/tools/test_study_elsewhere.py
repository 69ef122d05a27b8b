"""Studies whose runs a queue makes: a stand-in for Slurm, GNU parallel, and with the argument `slurm` a real Slurm of this
machine alone (tools/install.sh cluster).

    test_study_elsewhere.py [slurm | names of groups]
"""

import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import unittest
import unittest.mock

from toryu.study import slurm as slurm_queue
from toryu_testing import study_case
from toryu_testing.one_node_slurm import CannotStart, OneNodeSlurm
from toryu_testing.study_case import TWO_AXES, Study

REAL = "slurm" in sys.argv[1:]
NOT_RUN = 77  # what CTest takes for it
slurm = None
ONE_AXIS = '[[axis]]\nname = "x"\nvalues = [1, 2, 4]\nkeys = ["fluid.x"]\n'
# the time that each run of the stand-in takes
HEAD_SLOW = study_case.HEAD + '[[axis]]\nname = "wait"\nvalues = [2.0]\nkeys = ["fluid.seconds"]\n'


class Elsewhere(Study):
    where = "slurm"
    results = "out, of 100 %"

    def setUp(self):
        super().setUp()
        self.out = self.folder / self.results
        self.environment = dict(os.environ)
        if REAL:
            self.environment = dict(slurm.environment)
        else:
            self.queue = self.folder / "queue"
            self.queue.mkdir()
            for name in ("sbatch", "squeue", "scancel"):
                shutil.copy(pathlib.Path(study_case.HERE) / "fake_slurm.py", self.queue / name)
            self.environment["PATH"] = f"{self.queue}:{self.environment['PATH']}"

    def start(self, *options):
        return subprocess.Popen(self.command(f"--on={self.where}", *options), stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                text=True, cwd=self.folder, env=self.environment)

    def study(self, *options):
        process = self.start(*options)
        try:
            out, err = process.communicate(timeout=120)
        finally:
            process.kill()
        return subprocess.CompletedProcess([], process.returncode, out, err)

    def asked(self, name):
        text = (self.queue / "asked.txt").read_text() if (self.queue / "asked.txt").exists() else ""
        return [line for line in text.splitlines() if line.startswith(name)]


class Runs(Elsewhere):
    def test_every_combination_runs_once_and_a_second_time_none(self):
        self.write(TWO_AXES)
        self.done()
        self.assertEqual(len(self.starts()), 6)
        self.assertEqual(len(set(self.starts())), 6)
        rows = self.table()
        self.assertEqual(len(rows), 6)
        self.assertEqual({row["run"] for row in rows}, {f"runs/{name}" for name in self.starts()})
        again = self.done()
        self.assertIn("6 were done before", again.stdout)
        self.assertEqual(len(self.starts()), 6)

    def test_a_run_that_fails_by_its_physics_is_a_result_and_another_failure_ends_the_study(self):
        self.write('[[axis]]\nname = "code"\nvalues = [0, 3]\nkeys = ["fluid.fails"]\n')
        self.assertIn("1 of them ended by their physics", self.done().stdout)
        self.write('[[axis]]\nname = "code"\nvalues = [0, 4]\nkeys = ["fluid.fails"]\n')
        ended = self.study()
        self.assertEqual(ended.returncode, 4)
        self.assertIn("ended with exit code 4: the study stops", ended.stderr)
        self.assertNotIn("Traceback", ended.stderr)

    def test_interrupted_it_ends_its_runs_and_goes_on_later(self):
        self.write('[[axis]]\nname = "hangs"\nvalues = [0, 1]\nkeys = ["fluid.hangs"]\n')
        process = self.start()
        self.wait_for(lambda: len(self.starts()) == 2 and list(self.out.glob("runs/*/run.json")))
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, err)
        self.assertIn("interrupted; 1 of 2 runs are done and kept: the same command goes on from there", err)
        ended = [json.loads(path.read_text()) for path in self.out.glob("runs/*/ended.json")]
        self.assertEqual(sorted(one["exit_code"] for one in ended), [0, 130])
        process = self.start()
        self.wait_for(lambda: len(self.starts()) == 3)  # the one that was ended
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=60)

    def test_killed_it_finds_its_runs_again(self):
        self.write(ONE_AXIS, HEAD_SLOW)
        process = self.start()
        self.wait_for(lambda: len(self.starts()) >= 1)
        process.kill()
        process.communicate()
        self.assertIn("3 runs", self.done().stdout)
        self.assertEqual(sorted(self.starts()), sorted(set(self.starts())), "none ran twice")

    def test_left_by_its_terminal_it_leaves_the_runs_alone(self):
        self.write(ONE_AXIS, HEAD_SLOW)
        process = self.start()
        self.wait_for(lambda: len(self.starts()) >= 1)
        process.send_signal(signal.SIGHUP)
        _, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130)
        self.assertRegex(err, "[123] runs? go on in the queue: the same command goes on from there")
        self.done()
        self.assertEqual(len(self.starts()), 3)


class Asked(Elsewhere):
    def test_options_go_to_sbatch(self):
        self.write(ONE_AXIS)
        self.done("--partition=short", "--account=ours", "--time=1:00:00", "--sbatch=--mem=2G", "--jobs=2", "--threads=3")
        (line,) = self.asked("sbatch")
        for word in ("--array=0-2%2", "--cpus-per-task=3", "--partition=short", "--account=ours", "--time=1:00:00", "--mem=2G",
                     "--signal=B:TERM@60", "--no-requeue"):
            self.assertIn(f" {word}", line)

    def test_a_run_that_the_queue_ends_goes_on_in_a_new_job_if_it_came_further(self):
        self.write('[[axis]]\nname = "x"\nvalues = [1]\nkeys = ["fluid.x"]\n', study_case.HEAD
                   + '[[axis]]\nname = "c"\nvalues = [1]\nkeys = ["fluid.checkpoints"]\n'
                   + '[[axis]]\nname = "wait"\nvalues = [60]\nkeys = ["fluid.seconds"]\n')
        process = self.start()
        self.wait_for(lambda: list(self.out.glob("runs/*/checkpoint/*/manifest.toml")))
        folder = next(self.out.glob("runs/*"))
        (folder / "fluid.csv.part").write_text("time[s],speed[m/s]\n0,1\n0.5,2\n")
        os.kill(int((self.queue / "jobs/1_0").read_text()), signal.SIGTERM)  # as Slurm does before the limit
        _, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 0, err)
        self.assertEqual(len(self.starts("restarts")), 1)
        self.assertEqual(len(self.asked("sbatch")), 2)

    def test_a_run_that_the_queue_ends_too_soon_ends_the_study(self):
        self.write('[[axis]]\nname = "hangs"\nvalues = [1]\nkeys = ["fluid.hangs"]\n')
        process = self.start()
        self.wait_for(lambda: self.starts())
        os.kill(int((self.queue / "jobs/1_0").read_text()), signal.SIGTERM)
        _, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 5, err)
        self.assertIn("ended by the queue before it had come any further: give it more time", err)
        process = self.start()
        self.wait_for(lambda: len(self.starts()) == 2)  # it is given more time
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=60)

    def test_a_run_whose_files_changed_since_runs_again(self):
        self.write('[[axis]]\nname = "x"\nvalues = [1]\nkeys = ["fluid.x"]\n')
        self.done()
        next(self.out.glob("runs/*/fluid.csv")).unlink()
        again = self.done()
        self.assertIn("the files of the run are not as it left them: it runs again", again.stderr)
        self.assertEqual(len(self.starts()), 2)

    def test_more_runs_than_an_array_takes_run_no_more_at_a_time(self):
        asked = []

        def answer(command):
            asked.append(command)
            return subprocess.CompletedProcess(command, 0, f"{len(asked)}\n", "")

        with unittest.mock.patch.object(slurm_queue, "ask", answer):
            for jobs in (2, None):
                queue = slurm_queue.Slurm("a study", jobs, 1, [])
                former = queue.submit(self.folder / "0001.json", 1000, [])
                queue.submit(self.folder / "0002.json", 1, former)
        waits = [[word for word in command if word.startswith("--dependency")] for command in asked]
        self.assertEqual(waits, [[], ["--dependency=afterany:1"], [], []])

    def test_what_sbatch_refuses_is_told(self):
        self.write(ONE_AXIS)
        (self.queue / "refuse").touch()
        ended = self.study("--partition=nowhere")
        self.assertEqual(ended.returncode, 5)
        self.assertIn("sbatch refused the runs: sbatch: error: invalid partition specified: nowhere", ended.stderr)

    def test_options_that_are_of_no_use_are_refused(self):
        self.write(ONE_AXIS)
        nowhere = subprocess.run(self.command("--on="), capture_output=True, text=True, cwd=self.folder)
        self.assertEqual((nowhere.returncode, nowhere.stderr), (2, "--on '': error: expected 'slurm' or hosts\n"))
        here = subprocess.run(self.command("--partition=short"), capture_output=True, text=True, cwd=self.folder)
        self.assertEqual((here.returncode, here.stderr), (2, "--partition=short: error: is an option of --on slurm\n"))
        for name in ("sbatch", "squeue", "scancel"):
            (self.queue / name).unlink()
        self.environment["PATH"] = "/usr/bin:/bin" if not shutil.which("sbatch") else str(self.queue)
        ended = self.study()
        self.assertEqual(ended.returncode, 2)
        self.assertIn("--on slurm: error: needs the program 'sbatch', which is not here", ended.stderr)


class Lost(Elsewhere):
    def test_a_lost_run_runs_again_once(self):
        self.write(ONE_AXIS)
        (self.queue / "lose").touch()
        done = self.done()
        self.assertIn("without a word of how it ended: it runs again", done.stderr)
        self.assertEqual(len(self.starts()), 3)
        self.assertEqual(len(self.asked("sbatch")), 2)

    def test_what_keeps_the_runs_from_a_host_is_told(self):
        self.write('[[axis]]\nname = "x"\nvalues = [1]\nkeys = ["fluid.x"]\n')
        ssh = self.folder / "ssh"
        ssh.write_text('#!/bin/sh\necho "ssh: Could not resolve hostname nowhere" >&2\nexit 255\n')
        ssh.chmod(0o755)
        self.environment["PARALLEL_SSH"] = str(ssh)
        self.where = "2/nowhere"
        ended = self.study("--jobs=1")
        self.assertEqual(ended.returncode, 5)
        self.assertIn("ssh: Could not resolve hostname nowhere", ended.stderr)


class Hosts(Elsewhere):
    where = ":"  # this machine, without ssh

    def test_gnu_parallel_makes_the_runs(self):
        self.write(TWO_AXES)
        self.done("--jobs=2")
        self.assertEqual(len(self.starts()), 6)
        self.assertIn("6 were done before", self.done().stdout)

    def test_a_host_is_reached_by_ssh(self):
        self.write(ONE_AXIS)
        ssh = self.folder / "ssh"
        ssh.write_text(f'#!/bin/bash\necho "$@" >> {self.folder}/ssh.txt\nshift\n[[ $1 == -- ]] && shift\n'
                       'export SHELL=/bin/bash\nexec /bin/bash -c "$*"\n')  # sshd sets the login's shell
        ssh.chmod(0o755)
        self.environment["PARALLEL_SSH"] = str(ssh)
        self.where = "some_host,2/another_host"
        self.done("--jobs=1")
        self.assertEqual(len(self.starts()), 3)
        text = (self.folder / "ssh.txt").read_text()
        self.assertIn("some_host", text)
        self.assertIn("another_host", text)

    def test_interrupted_it_ends_its_runs(self):
        self.write('[[axis]]\nname = "hangs"\nvalues = [0, 1]\nkeys = ["fluid.hangs"]\n')
        process = self.start("--jobs=2")
        self.wait_for(lambda: len(self.starts()) == 2)
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, err)
        self.assertIn("the same command goes on from there", err)

    def test_left_by_its_terminal_it_ends_its_runs(self):
        self.write('[[axis]]\nname = "hangs"\nvalues = [0, 1]\nkeys = ["fluid.hangs"]\n')
        process = self.start("--jobs=2")
        self.wait_for(lambda: len(self.starts()) == 2)
        process.send_signal(signal.SIGHUP)
        _, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, err)
        self.assertNotIn("in the queue", err)
        self.assertTrue(all((folder / "ended.json").exists() for folder in self.out.glob("runs/*")))


if __name__ == "__main__":
    if REAL:
        sys.argv[sys.argv.index("slurm")] = "Runs"  # the others ask the stand-in
        try:
            slurm = OneNodeSlurm()
        except CannotStart as reason:
            print(f"not run: {reason}")
            sys.exit(NOT_RUN)
    try:
        outcome = unittest.main(exit=False).result
    finally:
        if slurm:
            slurm.close()
    sys.exit(not outcome.wasSuccessful())
