#!/usr/bin/python3
"""Stands for fluid_solver, solid_solver and coupler in the launcher's tests. What it does is written in the file
`NAME.plan` beside it, a word a line: each line is a method of Plan with its arguments."""

import os
import pathlib
import signal
import sys
import time

me = pathlib.Path(sys.argv[0])
case, arguments = sys.argv[1], sys.argv[2:]
out = pathlib.Path(next(a.removeprefix("--out=") for a in arguments if a.startswith("--out=")))
plan = me.with_suffix(".plan").read_text().splitlines()


class Plan:
    def say(self, text):
        print(text, file=sys.stderr, flush=True)

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
            signal.signal(number, lambda *_: sys.exit(int(code)))

    def ready(self):
        (out / f"{me.name}.ready").touch()

    def end(self, code):
        sys.exit(int(code))

    def kill(self, number):
        os.kill(os.getpid(), int(number))

    def check_fails(self, code, *lines):
        pass


if "--check" in arguments:
    for line in plan:
        word, *rest = line.split(" ", 2)
        if word == "check_fails":
            print(rest[1].replace("|", "\n"), file=sys.stderr)
            sys.exit(int(rest[0]))
    sys.exit(0)

(out / f"{me.name}.pid").write_text(str(os.getpid()))
(out / f"{me.name}.arguments").write_text("\n".join([case, *arguments]))
for line in plan:
    word, *rest = line.split(" ", 1)
    rest = rest[0].split(" ") if rest and word not in ("say",) else rest
    getattr(Plan(), word)(*rest)
