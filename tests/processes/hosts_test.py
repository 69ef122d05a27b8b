"""A coupled run whose three programs are on three hosts: the same bits as on one, a cable that is cut, a program that dies.

    hosts_test.py BIN [GROUP]"""
import pathlib
import sys
import tempfile
import time
import unittest

from toryu import identities
from toryu.processes import BAD_INPUT, DONE, PEER_LOST
from toryu_testing import three_hosts
from toryu_testing.process_case import LIMIT, NAMES, SOLVERS, ProcessCase
from toryu_testing.three_hosts import RunOverHosts, set_cable
from toryu_testing.trio import ROLES

NO_CHECKPOINTS = ["case.checkpoint_interval=0", "case.checkpoint_every=0"]  # they need a folder that all hosts share
ELSEWHERE = "is gone, or its host or network is: no sign of life"
SURVIVED, LOST = 2, 20  # [s] for which a cable is cut
NOTICED = 4  # [s] after a death


class HostsCase(ProcessCase):
    def run_over_hosts(self, names=NAMES, **settings):
        programs = {role: self.bin / (names | {"coupler": "coupler"})[role] for role in ROLES}
        return self.enterContext(RunOverHosts(programs, **settings))

    def assert_lost(self, run, lost, roles, limit):
        """The programs of `roles` end as lost peers within `limit` [s], and tell of `lost` what they can know."""
        end = time.monotonic() + limit
        for role in roles:
            code, text = run.ending_of(role, max(0.01, end - time.monotonic()))
            self.assertEqual(code, PEER_LOST, f"{role}: {text}")
            self.assertIn(f"{lost} {ELSEWHERE}", text, role)
            self.assertNotIn("killed", text, role)


class Results(HostsCase):
    def test_are_bit_for_bit_those_of_one_host(self):
        settings = {"end_time": "0.01", "settings": NO_CHECKPOINTS}
        one = self.run_of_three(**SOLVERS, **settings).start_all()
        self.assert_all_end(one, DONE)
        with tempfile.TemporaryDirectory(prefix="toryu_identities_") as folder:
            identities.make(pathlib.Path(folder) / "own", encrypt=True)
            for extra in ([], [f"--secure={folder}/own"]):
                with self.subTest(extra=extra):
                    run = self.run_over_hosts(SOLVERS, **settings).start_all(extra)
                    self.assert_all_end(run, DONE)
                    self.assert_same(run, one)

    def assert_same(self, run, one):
        over_hosts = {}
        for role in ROLES:
            run.out = run.folder(role)
            over_hosts |= run.results()
            self.assertFalse((run.out / "run.secret").exists(), role)
        self.assertIn("coupler.csv", over_hosts)
        self.assertIn("solid.csv", over_hosts)
        self.assertEqual(over_hosts.keys(), one.results().keys())
        for name, content in one.results().items():
            self.assertEqual(over_hosts[name], content, name)


class Cable(HostsCase):
    def test_may_be_cut_for_a_moment_but_not_for_long(self):
        run = self.run_over_hosts().start_all().wait_until_running()
        set_cable("fluid", "down")
        time.sleep(SURVIVED)
        before = run.windows()
        set_cable("fluid", "up")
        run.wait_until_running(beyond=before + 10)
        set_cable("fluid", "down")
        self.addCleanup(set_cable, "fluid", "up")
        self.assert_lost(run, "fake_fluid", ["coupler", "solid"], LOST)
        self.assert_lost(run, "coupler", ["fluid"], LOST)

    def test_may_be_cut_for_longer_if_that_is_asked_for(self):
        run = self.run_over_hosts().start_all(["--lost-after", "8"]).wait_until_running()
        set_cable("solid", "down")
        time.sleep(5)
        before = run.windows()
        set_cable("solid", "up")
        run.wait_until_running(beyond=before + 10)


class Death(HostsCase):
    def test_of_any_ends_the_others(self):
        for dead in ROLES:
            with self.subTest(dead=dead):
                run = self.run_over_hosts().start_all().wait_until_running()
                run.kill(dead)
                self.assert_lost(run, NAMES[dead], self.others(dead), NOTICED)


class Settings(HostsCase):
    def test_a_participant_without_the_secret_is_told_where_it_is(self):
        run = self.run_over_hosts().start("fluid")
        self.assert_ending(run, "fluid", BAD_INPUT, "--peers: error: the secret of the run is not in",
                           "copy that file here for its owner alone ('scp -p')")

    def test_a_host_that_cannot_be_reached_is_named(self):
        run = self.run_over_hosts()
        run.peers = "192.0.2.1"
        run.start("coupler")
        self.assert_ending(run, "coupler", 5, "no way leads to the host 192.0.2.1 of --peers: Network is unreachable")

    def test_the_own_name_of_a_host_may_mean_loopback(self):
        run = self.run_over_hosts(end_time="0.01")
        run.peers = f"127.0.1.1,{run.peers}"
        self.assert_all_end(run.start_all(), DONE)

    def test_interface_and_ports_can_be_given(self):
        run = self.run_over_hosts(end_time="0.01").start_all(["--interface", "eth0", "--domain", "7"])
        self.assert_all_end(run, DONE)


if __name__ == "__main__":
    three_hosts.enter()
    HostsCase.bin = pathlib.Path(sys.argv.pop(1)).resolve()
    three_hosts.lay_cables()
    unittest.main()
