"""What does not belong to a run does not disturb it: datagrams of strangers, and those of another run, whole and
damaged, at the ports of a run, thousands a second. Its results must be the same bit by bit, and it must end well.

    hostile_test.py BIN [DATAGRAMS] [SEED]"""
import pathlib
import random
import socket
import sys
import unittest

from toryu_testing.process_case import LIMIT, SOLVERS, ProcessCase

ETH_P_ALL = 3
RECORDED = 400  # datagrams of the run itself that are mutated
BURST = 100  # between two looks at whether the run goes on
END_TIME = "0.1"  # [s] of the strip, some seconds of wall time


def ports_of(out):
    """The ports of the run: two for each process, from 7410 + 250 times its domain on (RTPS 2.5, 9.6.2.3)."""
    name = int((out / "run.secret").read_text()[:16], 16)
    return range(7410 + 250 * (1 + name % 100), 7410 + 250 * (1 + name % 100) + 12)


class Recorder:
    """Datagrams on the loopback device that go to `ports`, without their Ethernet, IP and UDP headers."""

    def __init__(self, ports):
        self.ports = ports
        self.socket = socket.socket(socket.AF_PACKET, socket.SOCK_RAW, socket.htons(ETH_P_ALL))
        self.socket.bind(("lo", 0))
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

    def results_of(self, disturb):
        run = self.run_of_three(**SOLVERS, end_time=END_TIME).start_all()
        run.wait_until_running()
        disturb(run)
        for name in ("coupler", "fluid", "solid"):
            self.assertEqual(run.ending_of(name, 4 * LIMIT)[0], 0, name)
        return run.results()

    def test_datagrams_of_strangers(self):
        seed = random.randrange(10**6) if self.seed is None else self.seed
        print(f"seed {seed}", file=sys.stderr)
        chance = random.Random(seed)
        sent = 0

        def disturb(run):
            nonlocal sent
            ports = ports_of(run.out)
            with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
                while sent < self.datagrams and run.processes["coupler"].poll() is None:
                    for _ in range(BURST):
                        sender.sendto(made_up(chance), ("127.0.0.1", chance.choice(ports)))
                    sent += BURST

        undisturbed = self.results_of(lambda run: None)
        while sent < self.datagrams:
            self.assertEqual(self.results_of(disturb), undisturbed, f"seed {seed}")

    def test_recorded_datagrams_of_another_run(self):
        seed = random.randrange(10**6) if self.seed is None else self.seed
        print(f"seed {seed}", file=sys.stderr)
        chance = random.Random(seed)
        recorded = []

        def record(run):
            try:
                recorder = Recorder(ports_of(run.out))
            except PermissionError:
                self.skipTest("only root can record datagrams")
            with recorder:
                recorded.extend(recorder.record(RECORDED))

        undisturbed = self.results_of(record)
        sent = 0

        def disturb(run):
            nonlocal sent
            ports = ports_of(run.out)
            with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
                while sent < self.datagrams and run.processes["coupler"].poll() is None:
                    for _ in range(BURST):
                        datagram = chance.choice(recorded)
                        if chance.random() < 0.8:
                            datagram = damaged(datagram, chance)
                        sender.sendto(datagram, ("127.0.0.1", chance.choice(ports)))
                    sent += BURST

        while sent < self.datagrams:
            self.assertEqual(self.results_of(disturb), undisturbed, f"seed {seed}")


if __name__ == "__main__":
    ProcessCase.bin = pathlib.Path(sys.argv.pop(1)).resolve()
    if len(sys.argv) > 1:
        Hostile.datagrams = int(sys.argv.pop(1))
    if len(sys.argv) > 1:
        Hostile.seed = int(sys.argv.pop(1))
    unittest.main(verbosity=2)
