"""Runs cases and studies of toryu, and reads what they leave."""

import pathlib

PROGRAMS = pathlib.Path(__file__).resolve().parents[2] / "build/release/bin"  # where a build leaves them


def counted(count, thing):
    """"1 run", "2 runs": `thing` takes an s unless there is one."""
    return f"{count} {thing}{'' if count == 1 else 's'}"


def printable(text):
    """The text on one line, what a terminal would obey as an escape."""
    return "".join(c if c.isprintable() else repr(c)[1:-1] for c in text)
