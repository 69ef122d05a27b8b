"""What does not belong to a run does not disturb it: datagrams of strangers, and those of another run, whole and
damaged, at the ports of a run, thousands a second. Its results must be the same bit by bit, and it must end well.

    hostile_test.py BIN [DATAGRAMS] [SEED]"""
import pathlib
import random
import socket
import sys
import time
import unittest

from toryu_testing.process_case import LIMIT, SOLVERS, ProcessCase

ETH_P_ALL = 3
SECRET_SIZE = 33  # [bytes] of run.secret; before, its maker still writes it
RECORDED = 400  # datagrams of the run itself that are mutated
BURST = 100  # between two looks at whether the run goes on
END_TIME = "0.1"  # [s] of the strip, some seconds of wall time


def ports_of(out, count=12):
    """The first ports of the run: two for each process, from 7410 + 250 times its domain on (RTPS 2.5, 9.6.2.3)."""
    name = int((out / "run.secret").read_text()[:16], 16)
    first = 7410 + 250 * (1 + name % 100)
    return range(first, first + count)


class Recorder:
    """Datagrams on a network device that go to `ports`, without their Ethernet, IP and UDP headers."""

    def __init__(self, ports, device="lo"):
        self.ports = ports
        self.socket = socket.socket(socket.AF_PACKET, socket.SOCK_RAW, socket.htons(ETH_P_ALL))
        self.socket.bind((device, 0))
        self.socket.settimeout(1.0)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.socket.close()

    def record(self, count):
        found = []
        while len(found) < count:
            frame = self.socket.recv(1 << 16)
            header = 14 + 4 * (frame[14] & 15)
            if frame[23] == socket.IPPROTO_UDP and int.from_bytes(frame[header + 2:header + 4], "big") in self.ports:
                found.append(frame[header + 8:])
        return found


def made_up(chance):
    """An RTPS message of a process that there is not, with one submessage of random content."""
    prefix = chance.randbytes(12)
    body = chance.randbytes(chance.randrange(4, 200))
    submessage = bytes([chance.choice([1, 6, 7, 8, 9, 12, 14, 15, 19, 21, 22, 48, 128]), chance.choice([1, 3, 5, 7])])
    return b"RTPS\x02\x01\x01\x10" + prefix + submessage + len(body).to_bytes(2, "little") + body


def damaged(datagram, chance):
    """`datagram` with bits flipped, cut, or with bytes put in or repeated; never as it was."""
    changed = bytearray(datagram)
    for _ in range(chance.choice([1, 1, 2, 8])):
        place = chance.randrange(len(changed))
        match chance.randrange(5):
            case 0 | 1:
                changed[place] ^= 1 << chance.randrange(8)
            case 2:
                del changed[max(place, 1):]
            case 3:
                changed[place:place] = chance.randbytes(chance.randrange(1, 16))
            case 4:
                changed[place:place + 4] = chance.choice([b"\xff" * 4, b"\0" * 4, b"\x7f" + b"\xff" * 3])
    return bytes(changed)


class Hostile(ProcessCase):
    datagrams, seed = 20_000, None

    def setUp(self):
        seed = random.randrange(10**6) if self.seed is None else self.seed
        self.chance = random.Random(seed)
        self.words = f"seed {seed}"
        print(self.words, file=sys.stderr)

    def bombard(self, run, most, datagram):
        """Sends up to `most` datagrams to the ports of the run while it goes on; returns how many."""
        ports, sent = ports_of(run.out), 0
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
            while sent < most and all(process.poll() is None for process in run.processes.values()):
                for _ in range(BURST):
                    sender.sendto(datagram(), ("127.0.0.1", self.chance.choice(ports)))
                sent += BURST
        return sent

    def results_of(self, run):
        """Of a run that ends well."""
        for name in ("coupler", "fluid", "solid"):
            code, text = run.ending_of(name, 4 * LIMIT)
            self.assertEqual(code, 0, f"{self.words}, {name}: {text}")
        return run.results()

    def run_of_solvers(self):
        return self.run_of_three(**SOLVERS, end_time=END_TIME)

    def test_datagrams_of_strangers(self):
        undisturbed = self.results_of(self.run_of_solvers().start_all())
        sent = 0
        while sent < self.datagrams:
            run = self.run_of_solvers().start_all().wait_until_running()
            sent += self.bombard(run, self.datagrams - sent, lambda: made_up(self.chance))
            self.assertEqual(self.results_of(run), undisturbed, self.words)

    def test_recorded_datagrams_of_an_earlier_run_in_the_same_folder(self):
        """From the first on, in which its processes find each other; whole and damaged ones: while the fluid waits, to
        which they speak as its coupler did, and in the run."""
        run = self.run_of_solvers().start("fluid")
        self.wait_for_secret(run)
        try:
            recorder = Recorder(ports_of(run.out))
        except PermissionError:
            self.skipTest("only root can record datagrams")
        with recorder:
            run.start("coupler").start("solid")
            recorded = recorder.record(RECORDED)
        undisturbed = self.results_of(run)

        def datagram():
            found = self.chance.choice(recorded)
            return found if self.chance.random() < 0.5 else damaged(found, self.chance)

        sent = 0
        while sent < self.datagrams:
            run.start("fluid", extra=["--overwrite"])
            self.wait_for_secret(run)
            sent += self.bombard(run, self.datagrams // 2, datagram)
            run.start("coupler", extra=["--overwrite"]).start("solid", extra=["--overwrite"])
            sent += self.bombard(run, self.datagrams - sent, datagram)
            self.assertEqual(self.results_of(run), undisturbed, self.words)

    def wait_for_secret(self, run):
        secret, end = run.out / "run.secret", time.monotonic() + LIMIT
        while not secret.exists() or secret.stat().st_size < SECRET_SIZE:
            self.assertLess(time.monotonic(), end, "the fluid makes no secret")
            time.sleep(0.01)


if __name__ == "__main__":
    ProcessCase.bin = pathlib.Path(sys.argv.pop(1)).resolve()
    if len(sys.argv) > 1:
        Hostile.datagrams = int(sys.argv.pop(1))
    if len(sys.argv) > 1:
        Hostile.seed = int(sys.argv.pop(1))
    unittest.main(verbosity=2)
