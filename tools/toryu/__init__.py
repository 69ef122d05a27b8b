"""Runs cases and studies of toryu, and reads what they leave. For scripts: `run`, `results.read`, and `participant` for a fluid
or a solid of one's own."""

import difflib
import importlib

from toryu.installation import folder_of_programs

PROGRAMS = folder_of_programs()


def nearest(word, words):
    near = difflib.get_close_matches(word, words, n=1)
    return f"; did you mean '{near[0]}'?" if near else f"; there are {', '.join(map(repr, words))}" if words else ""


def counted(count, thing):
    """"1 run", "2 runs": `thing` takes an s unless there is one."""
    return f"{count} {thing}{'' if count == 1 else 's'}"


def __getattr__(name):
    """What is for scripts is loaded where it is asked for: the programs here do without."""
    if name in ("participant", "results"):
        return importlib.import_module(f"toryu.{name}")
    if name in ("run", "RunFailed"):
        return getattr(importlib.import_module("toryu.running"), name)
    raise AttributeError(f"module 'toryu' has no attribute '{name}'")


def printable(text):
    """The text on one line, what a terminal would obey as an escape."""
    return "".join(c if c.isprintable() else repr(c)[1:-1] for c in text)
