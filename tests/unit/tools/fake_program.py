#!/usr/bin/python3 -IXutf8
"""Stands for fluid_solver, solid_solver and coupler in the launcher's tests. What it does is written in the file
`NAME.plan` beside it, a word a line: each line is a method of Plan with its arguments."""

import contextlib
import os
import pathlib
import signal
import sys
import time

me = pathlib.Path(sys.argv[0])
case, arguments = sys.argv[1], sys.argv[2:]
plan = me.with_suffix(".plan").read_text(encoding="utf-8", errors="surrogateescape").splitlines()
sys.stderr.reconfigure(encoding="utf-8", errors="surrogateescape")


class Plan:
    def say(self, text):
        with contextlib.suppress(OSError):  # nobody need read it
            os.write(2, f"{text}\n".encode(errors="surrogateescape"))

    def wait(self, seconds):
        time.sleep(float(seconds))

    def write(self, name, *text):
        (out / name).write_text(" ".join(text))

    def environment(self, name):
        (out / f"{me.name}_{name}").write_text(os.environ.get(name, ""))

    def ignore_requests(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, signal.SIG_IGN)

    def end_when_asked(self, code):
        for number in (signal.SIGINT, signal.SIGTERM):
            if signal.getsignal(number) != signal.SIG_IGN:
                signal.signal(number, lambda *_: sys.exit(int(code)))

    def checkpoint_when_asked(self, seconds):
        """Takes so long for a last checkpoint, then ends."""
        def write_and_end(*_):
            time.sleep(float(seconds))
            self.checkpoint("000007")
            sys.exit(130)

        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, write_and_end)

    def checkpoint(self, number):
        (out / "checkpoint" / number).mkdir(parents=True, exist_ok=True)
        (out / "checkpoint" / number / "manifest.toml").touch()

    def ready(self):
        (out / f"{me.name}.ready").touch()

    def end(self, code):
        sys.exit(int(code))

    def kill(self, number):
        os.kill(os.getpid(), int(number))

    def link_to(self, target, name):
        (out / name).symlink_to(target)

    def check_takes(self, seconds):
        """How long `--check` takes; it says that it has begun by a file."""

    def describes(self, *lines):
        """What `--describe` prints; lines are parted by |."""

    def check_fails(self, code, *lines):
        """How `--check` ends; lines are parted by |."""

    def print_fails(self, code, *lines):
        """How `--print-case` and `--resolved` end."""

    def answers(self, seconds, code, text):
        """What `--can-checkpoint` says, after a while."""


def end_as_planned(method):
    """Ends as the plan's line `METHOD CODE LINES` says, else well."""
    for line in plan:
        word, *rest = line.split(" ", 2)
        if word == method:
            print(rest[1].replace("|", "\n"), file=sys.stderr)
            sys.exit(int(rest[0]))
    sys.exit(0)


if case == "--can-checkpoint":
    (me.parent / "asked").touch()
    for seconds, code, text in (line.split(" ")[1:] for line in plan if line.startswith("answers ")):
        time.sleep(float(seconds))
        print(text)
        sys.exit(int(code))
    sys.exit(2)
if "--print-case" in arguments or "--resolved" in arguments:
    if not any(line.startswith("print_fails") for line in plan):
        os.execv(me.parent / "real_coupler", ["coupler", case, *arguments])
    end_as_planned("print_fails")
if "--describe" in arguments:
    for line in plan:
        if line.startswith("describes "):
            print(line.removeprefix("describes ").replace("|", "\n"))
    sys.exit(0)
if "--check" in arguments:
    for seconds in (line.split(" ")[1] for line in plan if line.startswith("check_takes ")):
        (me.parents[1] / "checking").touch()
        time.sleep(float(seconds))
    end_as_planned("check_fails")

out = pathlib.Path(next(a.removeprefix("--out=") for a in arguments if a.startswith("--out=")))
(out / f"{me.name}.pid").write_text(str(os.getpid()))
(out / f"{me.name}.arguments").write_text("\n".join([case, *arguments]), errors="surrogateescape")
for line in plan:
    word, *rest = line.split(" ", 1)
    rest = rest[0].split(" ") if rest and word not in ("say",) else rest
    getattr(Plan(), word)(*rest)
