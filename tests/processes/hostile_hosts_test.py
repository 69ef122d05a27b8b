"""A host that belongs to no run sends to those of one: datagrams of strangers, and what it has heard on the network, whole and
damaged. Without --secure, of an earlier run; with it, of the run itself, which it can listen to. The results must be the same
bit by bit, and each run must end well.

    hostile_hosts_test.py BIN [DATAGRAMS] [SEED]"""
import pathlib
import random
import socket
import sys
import tempfile
import time
import unittest

import hostile_test
from toryu import identities
from toryu_testing import three_hosts
from toryu_testing.process_case import LIMIT, SOLVERS
from toryu_testing.three_hosts import ADDRESSES, RunOverHosts
from toryu_testing.trio import ROLES, results_of
from hosts_test import NO_CHECKPOINTS, HostsCase

STRANGER = "10.77.0.66"
PORTS = 20  # of a domain over hosts
END_TIME = "0.02"  # [s] of the strip


class Hostile(HostsCase):
    datagrams, seed = 4000, None

    def setUp(self):
        seed = random.randrange(10**6) if self.seed is None else self.seed
        self.chance = random.Random(seed)
        self.words = f"seed {seed}"
        folder = tempfile.TemporaryDirectory(prefix="toryu_identities_")
        self.addCleanup(folder.cleanup)
        self.identities = pathlib.Path(folder.name) / "own"
        identities.make(self.identities)

    def started(self, extra):
        return self.run_over_hosts(SOLVERS, end_time=END_TIME, settings=NO_CHECKPOINTS).start_all(extra)

    def recorder(self, run):
        return hostile_test.Recorder(hostile_test.ports_of(run.folder("coupler"), PORTS), "to_coupler")

    def results_of(self, run):
        found = {}
        for role in ROLES:
            code, text = run.ending_of(role, 8 * LIMIT)
            self.assertEqual(code, 0, f"{self.words}, {role}: {text}")
            found |= results_of(run.folder(role))
        return found

    def bombard(self, run, most, datagram):
        """Sends up to `most` datagrams to the ports of the run while it goes on; returns how many."""
        ports, sent = hostile_test.ports_of(run.folder("coupler"), PORTS), 0
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
            sender.bind((STRANGER, 0))
            while sent < most and all(process.poll() is None for process in run.processes.values()):
                for _ in range(hostile_test.BURST):
                    place = self.chance.choice(list(ADDRESSES.values())), self.chance.choice(ports)
                    sender.sendto(datagram(), place)
                sent += hostile_test.BURST
                time.sleep(0.001)  # the run needs the cores too
        return sent

    def datagram_of(self, recorded):
        match self.chance.randrange(4):
            case 0:
                return hostile_test.made_up(self.chance)
            case 1:
                return self.chance.choice(recorded)
        return hostile_test.damaged(self.chance.choice(recorded), self.chance)

    def hold_out(self, extra, of_itself):
        run = self.started(extra)
        with self.recorder(run) as recorder:
            recorded = recorder.record(hostile_test.RECORDED)
        undisturbed, sent, runs = self.results_of(run), 0, 0
        self.assertIn("coupler.csv", undisturbed)
        while sent < self.datagrams:
            run = self.started(extra)
            if of_itself:
                with self.recorder(run) as recorder:
                    recorded = recorder.record(hostile_test.RECORDED)
            sent += self.bombard(run, self.datagrams - sent, lambda: self.datagram_of(recorded))
            self.assertEqual(self.results_of(run), undisturbed, self.words)
            runs += 1
        print(f"{self.words}: {sent} datagrams into {runs} runs", file=sys.stderr)

    def test_what_was_heard_of_an_earlier_run_changes_nothing(self):
        self.hold_out([], of_itself=False)

    def test_what_was_heard_of_the_run_itself_changes_nothing_in_a_secured_one(self):
        self.hold_out([f"--secure={self.identities}"], of_itself=True)


if __name__ == "__main__":
    three_hosts.enter()
    Hostile.bin = pathlib.Path(sys.argv.pop(1)).resolve()
    if len(sys.argv) > 1 and sys.argv[1].isdigit():
        Hostile.datagrams = int(sys.argv.pop(1))
    if len(sys.argv) > 1 and sys.argv[1].isdigit():
        Hostile.seed = int(sys.argv.pop(1))
    three_hosts.lay_cables()
    three_hosts.shell("ip", "address", "add", f"{STRANGER}/24", "dev", "bridge")
    unittest.main()
