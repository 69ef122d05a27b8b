"""A run over hosts by one command: the same bits as on one host, hosts that cannot be used, and what is left when a run, a
connection or a host's disk ends.

    launched_hosts_test.py BIN [GROUP]"""
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import unittest

import toryu
from toryu import identities
from toryu.processes import BAD_INPUT, DONE, INTERRUPTED, MACHINE, PEER_LOST
from toryu_testing import three_hosts
from toryu_testing.launched_hosts import Launched
from toryu_testing.trio import ROLES, results_of

ON_ONE, ON_THREE = (), ("fluid", "solid")  # the launcher is on the coupler's host
SHORT, LONG = "--end-time=0.004", "--end-time=1000"
# As a browser on the launcher's host: reads the series of a watched run, then presses its stop button.
WATCHER = """
import json, sys, urllib.request
page, parts = sys.argv[1], set(sys.argv[2:])
with urllib.request.urlopen(page + "events", timeout=60) as events:
    for line in events:
        if line.startswith(b"data:") and b'"rows"' in line:
            parts.discard(json.loads(line[5:])["name"])
        if not parts:
            break
urllib.request.urlopen(urllib.request.Request(page + "stop", method="POST", headers={"X-Toryu": "stop"}), timeout=60)
"""


class HostsCase(unittest.TestCase):
    bin = pathlib.Path()

    def hosts(self):
        return self.enterContext(Launched(self.bin))

    def assert_end(self, run, code, *words, without=()):
        found, said = run.end()
        self.assertEqual(found, code, said)
        for word in words:
            self.assertIn(word, said)
        for word in ("Traceback", *without):
            self.assertNotIn(word, said)
        self.assertEqual(run.left_behind(), [])

    def assert_same(self, out, reference):
        found, wanted = results_of(out), results_of(reference)
        self.assertIn("interface.h5:position", wanted)
        self.assertEqual(found.keys(), wanted.keys())
        for name, content in wanted.items():
            self.assertEqual(found[name], content, name)

    def names(self, folder):
        """Of its files and folders, but for the coupler's lock, which stays on its host."""
        return sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.name != "run.lock")


class Results(HostsCase):
    def test_are_in_one_folder_and_bit_for_bit_those_of_one_host(self):
        run = self.hosts()
        one = run.base / "one"
        self.assert_end(run.start(ON_ONE, SHORT, out=one), DONE)
        for roles, *network in ((ON_THREE,), (("coupler", "fluid"), "--interface=eth0", "--domain=7", "--lost-after=4")):
            with self.subTest(roles=roles):
                self.assert_end(run.start(roles, SHORT, "--overwrite", *network), DONE, "round trip")
                self.assert_same(run.out, one)
                self.assertEqual(self.names(run.out), self.names(one))
                for part in ("fluid", "solid"):
                    name = f"checkpoint/000001/{part}.state"
                    self.assertEqual((run.out / name).stat().st_size, (one / name).stat().st_size)
                log = (run.out / "log.txt").read_text()
                for name in ("coupler", "fluid_solver", "solid_solver"):
                    self.assertIn(f" {name} info: toryu ", log)

    def test_are_the_same_secured_by_a_folder_that_each_host_has(self):
        run = self.hosts()
        one = run.base / "one"
        self.assert_end(run.start(ON_ONE, SHORT, out=one), DONE)
        folder = run.base / "identities"
        identities.make(folder)
        secure = f"--secure={folder}"
        self.assert_end(run.start(ON_THREE, SHORT, secure), BAD_INPUT, "_solver on 10.77.0.",  # whichever looks first
                        f"--secure {folder}: error: is no folder; './run.sh --make-identities FOLDER' makes one")
        for role in ON_THREE:  # whose /tmp is a folder of its own
            there = run.disk(role) / folder.relative_to("/tmp")
            there.mkdir(parents=True)
            for name in ("ca.pem", "governance.p7s", f"{role}.pem", f"{role}.key", f"{role}.p7s"):
                shutil.copy(folder / name, there)
        code, said = run.start(ON_THREE, SHORT, secure, "--overwrite").end()
        self.assertEqual(code, DONE, said)
        self.assert_same(run.out, one)

    def test_are_watched_while_the_run_lasts_and_end_by_the_stop_button(self):
        run = self.hosts()
        run.start(ON_THREE, LONG, "--watch")
        page = run.wait_for_word(r"watch +(\S+)")
        done = subprocess.run(["nsenter", "--net=/run/netns/coupler", sys.executable, "-I", "-c", WATCHER, page, *ROLES],
                              capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assert_end(run, INTERRUPTED)
        self.assertTrue(list(run.out.glob("checkpoint/*/manifest.toml")))

    def test_of_a_fluid_alone_come_from_its_host(self):
        run = self.hosts()
        file = run.case / "case.toml"
        text = file.read_text()
        file.write_text(text[:text.index("[solid]")])
        self.assert_end(run.start(("fluid",), SHORT), DONE)
        self.assertTrue((run.out / "fluid.csv").exists())
        self.assertTrue((run.out / "checkpoint/000001/manifest.toml").exists())

    def test_a_program_in_python_finds_toryu_on_its_host(self):
        run = self.hosts()
        guest = run.disk("solid") / "my_solid.py"
        guest.write_text("#!/usr/bin/python3\nimport toryu\nprint('found', toryu.__file__)\n")
        guest.chmod(0o755)
        code, said = run.start(("solid",), SHORT, "--solid=/tmp/my_solid.py").end()
        self.assertEqual(code, PEER_LOST, said)
        self.assertIn(f"found {toryu.__file__}", said)
        self.assertIn("solid_solver on 10.77.0.3 ended with exit code 0 before it had joined the run", said)


class Restart(HostsCase):
    def test_goes_on_over_hosts_from_what_was_interrupted_there(self):
        run = self.hosts()
        every = "--set=case.checkpoint_interval=0.001"
        one = run.base / "one"
        for roles in (ON_THREE, ("coupler", "solid")):
            with self.subTest(roles=roles):
                run.start(roles, LONG, every, "--overwrite").wait_for("checkpoint/000003/manifest.toml")
                if "coupler" in roles:
                    (run.out / "stop").touch()
                else:
                    run.interrupt()
                self.assert_end(run, INTERRUPTED, "go on with: ./run.sh")
                newest = max(run.out.glob("checkpoint/*/manifest.toml")).parent
                self.assertEqual(self.names(newest),
                                 ["case.toml", "coupler.state", "fluid.state", "manifest.toml", "solid.state"])
                self.assertEqual(len(list((run.out / "checkpoint").iterdir())), 2)
                for part in ("fluid", "solid"):
                    self.add_frames_beyond(run.out, part)
                time = float((newest / "manifest.toml").read_text().split()[2])
                self.assert_end(run.start(roles, f"--end-time={time + 0.002}", every, "--restart"), DONE)
                self.assert_end(run.start(ON_ONE, f"--end-time={time + 0.002}", every, "--overwrite", out=one), DONE)
                self.assert_same(run.out, one)

    def add_frames_beyond(self, out, part):
        """As of a run that was killed well after its last checkpoint."""
        last = max(out.glob(f"frames/{part}_*.hdf"))
        for beyond in range(1, 5):
            shutil.copy(last, last.with_name(f"{part}_{int(last.stem[-6:]) + beyond:06}.hdf"))


class Refusal(HostsCase):
    def test_of_a_host_that_is_not_there(self):
        run = self.hosts()
        self.assert_end(run.start((), SHORT, "--host=fluid=10.77.0.99", f"--peers=10.77.0.1,10.77.0.99",
                                  f"--launcher={run.launcher}"), MACHINE,
                        "fluid_solver: error: the machine: 10.77.0.99 cannot be reached: it ended: connect to host 10.77.0.99 "
                        f"port 22: No route to host; '{run.launcher} 10.77.0.99 /usr/bin/python3 --version' must work")
        self.assertFalse(run.out.exists())

    def test_of_a_host_without_the_programs_and_of_another_version(self):
        run = self.hosts()
        self.assert_end(run.start(ON_THREE, SHORT, "--remote-bin=/nowhere"), BAD_INPUT,
                        "fluid_solver: error: 10.77.0.2: has no program /nowhere/fluid_solver",
                        "solid_solver: error: 10.77.0.3: has no program /nowhere/solid_solver")
        self.assert_end(run.start(("fluid",), SHORT, "--fluid=/nowhere/mine.py"), BAD_INPUT,
                        "fluid_solver: error: 10.77.0.2: has no program /nowhere/mine.py: copy it there: --fluid and --solid "
                        "are paths of their hosts")
        other = run.disk("fluid") / "fluid_solver"
        other.write_text("#!/bin/sh\necho 'fluid_solver of toryu 0.0.1 (commit 1234567, GCC 1)'\n")
        other.chmod(0o755)
        code, said = run.start(("fluid",), SHORT, "--remote-bin=/tmp").end()
        self.assertEqual(code, BAD_INPUT, said)
        self.assertIn("10.77.0.2: /tmp/fluid_solver is another version (fluid_solver of toryu 0.0.1 (commit 1234567, GCC 1)) "
                      "than here (fluid_solver of toryu ", said)
        self.assertIn("build the same commit there", said)
        self.assertFalse(run.out.exists())

    def test_of_what_is_no_host_of_the_case(self):
        run = self.hosts()
        for option, words in (
                ("--host=flud=10.77.0.2", "--host flud=10.77.0.2: error: must begin with the program and '=', as "
                 "fluid=ADDRESS; did you mean 'fluid'?"),
                ("--host=fluid", "--host fluid: error: must have the name or address of a host after '='"),
                ("--host=fluid=-oProxyCommand=x", "must have the name or address of a host"),
                ("--launcher=ssh", "--launcher ssh: error: goes with --host"),
                ("--remote-bin=x", "--remote-bin x: error: goes with --host")):
            self.assert_end(run.start((), SHORT, option), BAD_INPUT, words)
        self.assert_end(run.start(("fluid",), SHORT, "--launcher=no_such_launcher"), BAD_INPUT,
                        "--launcher no_such_launcher: error: no such program")
        self.assert_end(run.start(("fluid",), SHORT, "--host=fluid=10.77.0.3"), BAD_INPUT,
                        "--host fluid=10.77.0.3: error: fluid has a host already: 10.77.0.2")


class Failure(HostsCase):
    def test_of_the_connection_leaves_nothing_there(self):
        run = self.hosts()
        run.start(ON_THREE, LONG).wait_for("coupler.csv.part")
        run.wait_for("fluid.csv.part")  # copied as the run goes on
        there = run.processes_on("fluid")
        os.kill(there["fluid_solver"], signal.SIGSTOP)  # it cannot end by itself
        os.kill(there["agent"], signal.SIGKILL)
        code, said = run.end()
        self.assertEqual(code, PEER_LOST, said)
        self.assertIn("fluid_solver: error: peer lost: the connection to 10.77.0.2 is gone: it was closed", said)
        self.assertEqual([words for words in run.left_behind() if "/disk/fluid/" not in words], [])

    def test_of_the_launcher_ends_the_programs_there(self):
        run = self.hosts()
        run.start(ON_THREE, LONG).wait_for("coupler.csv.part")
        run.run.kill()
        run.run.wait()
        self.assertEqual(run.left_behind(10), [])

    def test_of_what_stands_for_a_program_ends_it(self):
        run = self.hosts()
        run.start(ON_THREE, LONG).wait_for("coupler.csv.part")
        stands = subprocess.run(["pgrep", "-f", 'toryu remote .*"address": "10.77.0.3"'], capture_output=True, text=True)
        os.kill(int(stands.stdout), signal.SIGKILL)
        self.assert_end(run, PEER_LOST, "solid_solver on 10.77.0.3 was killed by signal 9")

    def test_of_a_program_is_told_with_its_host(self):
        run = self.hosts()
        run.start(ON_THREE, LONG).wait_for("coupler.csv.part")
        os.kill(run.processes_on("fluid")["fluid_solver"], signal.SIGKILL)
        self.assert_end(run, PEER_LOST, "fluid_solver on 10.77.0.2 was killed by signal 9")

    def test_of_physics_is_told_once(self):
        run = self.hosts()
        self.assert_end(run.start(ON_THREE, LONG, "--set=fluid.sound_speed=0.3"), 3, "fluid_solver on 10.77.0.2 ended with "
                        "exit code 3 (physics failed)")

    def test_of_a_disk_there_is_told(self):
        run = self.hosts()
        subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64k", "none", run.disk("fluid")], check=True)
        self.addCleanup(subprocess.run, ["umount", run.disk("fluid")])
        self.assert_end(run.start(ON_THREE, LONG), MACHINE, "No space left on device", "10.77.0.2")


if __name__ == "__main__":
    three_hosts.enter()
    HostsCase.bin = pathlib.Path(sys.argv.pop(1)).resolve()
    three_hosts.lay_cables()
    unittest.main()
