"""Who reads what a run says does not matter to it: standard streams that are closed, full, slow or broken off, a terminal
that hangs up, a user who logs out. The run must end with 0 and have all its results, the same as undisturbed.

    streams_test.py BUILD/bin CASES COUNT [SEED]
"""
import collections
import contextlib
import os
import pathlib
import pty
import random
import shlex
import signal
import subprocess
import sys
import tempfile
import time

from toryu import program
from toryu.processes import DONE
from toryu_testing import trio

LIMIT = 120  # [s] of a run
# case, options: short, with frames and series
RUNS = [("elastic_gate", ["--end-time=0.005", "--set=case.frame_interval=1e-3", "--log-level=debug"]),
        ("dam_break", ["--end-time=0.01", "--set=case.frame_interval=2e-3", "--log-level=debug"])]
# What bash puts behind the command; {} is a number of bytes, or a time [s].
REDIRECTIONS = {
    "closed": [">&-", "2>&-", "0<&- >&- 2>&-"],
    "full": [">/dev/full", "2>/dev/full", ">/dev/full 2>&1"],
    "broken off": ["2>&1 | head -c {bytes}", "| true", "2> >(head -c {bytes} >&2)", "2>&1 | (sleep {seconds})"],
    "slow": ["2>&1 | while read -rn 200; do sleep 0.02; done", "2>&1 | (sleep {seconds}; cat)"],
}
BASH = "exit ${PIPESTATUS[0]}"


def command(programs, cases, case, options, out):
    return program.python("launch", cases / case, f"--bin={programs}", f"--out={out}", *options)


def redirected(words, chance, kind):
    """Runs under bash; returns the exit code of the run."""
    redirection = chance.choice(REDIRECTIONS[kind]).format(bytes=chance.randrange(300), seconds=chance.uniform(0, 4))
    script = f"{shlex.join(words)} {redirection}; {BASH}"
    return subprocess.run(["bash", "-c", script], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                          timeout=LIMIT).returncode, redirection


def on_a_terminal(folder, script, options, seconds, number=None):
    """Runs a script by bash in `folder` on a terminal of its own, until it ends or the terminal hangs up after `seconds`; a signal
    `number` goes to all that it started before."""
    child, terminal = pty.fork()
    if child == 0:
        os.chdir(folder)  # where nohup puts what is said
        os.execvp("bash", ["bash", "--norc", options, script])
    end = time.monotonic() + seconds
    os.set_blocking(terminal, False)
    with contextlib.suppress(OSError):  # all of its side is closed
        while time.monotonic() < end:
            with contextlib.suppress(BlockingIOError):
                os.read(terminal, 1 << 16)
            time.sleep(0.02)
    if number:
        os.killpg(child, number)
    os.close(terminal)
    os.waitpid(child, 0)


def left(words, chance, folder):
    """A run in the background of a terminal that hangs up, or whose user logs out."""
    told = folder / "code"
    inner = shlex.join(["bash", "-c", f"{shlex.join(words)}; echo $? > {shlex.quote(str(told))}.part; mv {told}.part {told}"])
    moment, way = chance.uniform(0.2, 3), chance.choice(("hang-up", "hang-up signal", "log-out"))
    if way == "hang-up":
        on_a_terminal(folder, f"nohup {inner} & wait", "-ic", moment)
    elif way == "hang-up signal":
        on_a_terminal(folder, f"nohup {inner}", "-c", moment, signal.SIGHUP)
    else:
        on_a_terminal(folder, f"{inner} & sleep {moment}; exit", "-ic", LIMIT)
    end = time.monotonic() + LIMIT
    while not told.exists():
        assert time.monotonic() < end, f"{way}: the run has not ended well"
        time.sleep(0.05)
    return int(told.read_text()), way


def results(out):
    """What a run has left, but for wall times."""
    run = trio.Trio({})
    empty, run.out = run.out, out
    empty.rmdir()
    return run.results()


def main(programs, cases, count, seed=None):
    seed = int(seed) if seed else random.randrange(10**6)
    print(f"seed {seed}", flush=True)
    chance, programs, cases = random.Random(seed), pathlib.Path(programs).resolve(), pathlib.Path(cases).resolve()
    expected, tally = {}, collections.Counter()
    for number in range(int(count)):
        case, options = RUNS[number % len(RUNS)]
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            words = command(programs, cases, case, options, folder / "out")
            if case not in expected:
                assert subprocess.run(words, capture_output=True).returncode == DONE
                expected[case] = results(folder / "out")
                assert len(expected[case]) > 20, sorted(expected[case])
                words += ["--overwrite"]
            kind = chance.choice([*REDIRECTIONS, "left", "left"])
            code, way = redirected(words, chance, kind) if kind in REDIRECTIONS else left(words, chance, folder)
            assert code == DONE, f"{case}, {way}: {code}"
            assert (folder / "out/report.html").stat().st_size > 1000, way
            assert results(folder / "out") == expected[case], f"{case}, {way}: other results"
        tally[kind] += 1
        print(f"{case}: {way}", flush=True)
    print(", ".join(f"{kind} {n}" for kind, n in tally.items()) + ": each ended with 0, with all its results")


if __name__ == "__main__":
    main(*sys.argv[1:])
