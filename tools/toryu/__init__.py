"""Runs cases and studies of toryu, and reads what they leave."""

import pathlib

PROGRAMS = pathlib.Path(__file__).resolve().parents[2] / "build/release/bin"  # where a build leaves them


def counted(count, thing):
    """"1 run", "2 runs": `thing` takes an s unless there is one."""
    return f"{count} {thing}{'' if count == 1 else 's'}"
