"""A case or a study as a program reads it: no Python here reads such a file itself."""

import functools
import json
import os
import pathlib
import subprocess
from dataclasses import dataclass, field

from toryu.processes import DONE
from toryu.program import SHORTAGES

PROGRAMS_OF = {"coupled": ["coupler", "fluid_solver", "solid_solver"], "fluid": ["fluid_solver"],
               "solid": ["solid_solver"]}  # of each kind of case, the lead first


class BadCase(Exception):
    """What the program says is wrong with a file, a line each."""


@dataclass
class Case:
    """A file as `--resolved` tells it."""

    kind: str  # "study", "coupled", "fluid", "solid", or "empty" if there is nothing to compute
    file: pathlib.Path
    name: str  # of its results
    inputs: list[pathlib.Path]  # the files that were read: its own, its base, those that it names
    content: dict  # what it says, with its base merged and overrides applied
    references: list[dict] = field(default_factory=list)  # what is said of each, and its "points" or its "fault"
    files: list[str] = field(default_factory=list)  # that it names, relative to its folder
    shapes: list[dict] = field(default_factory=list)  # of all bodies: "list", "number", "name", "is_outline", "rings" [m]
    motions: dict = field(default_factory=dict)  # number of a wall -> the point "about" and "poses": time, x, y, angle, v_x, v_y
    places: list = field(default_factory=list)  # (path of a key, line, column)

    @property
    def outlines(self):
        """Number of a wall that is an outline -> its rings of corners [m]."""
        return {shape["number"]: shape["rings"] for shape in self.shapes if shape["list"] == "wall" and shape["is_outline"]}


@functools.cache
def resolve(path, program, overrides=()):
    """The file that `path` means, with `overrides` ("key=value") applied, as `program` reads it. Raises BadCase."""
    try:
        done = subprocess.run([program, path, "--resolved", *(f"--set={pair}" for pair in overrides)],
                              capture_output=True, encoding="utf-8", errors="surrogateescape", stdin=subprocess.DEVNULL)
    except (OSError, ValueError) as error:
        if getattr(error, "errno", None) in SHORTAGES:
            raise
        raise BadCase(f"{program}: error: cannot be started: {getattr(error, 'strerror', error)}") from None
    if done.returncode != DONE:
        raise BadCase((done.stdout + done.stderr).strip() or f"{program} --resolved ended with {done.returncode}")
    try:
        told = json.loads(done.stdout)
        case, references, files = told["case"], told["references"], told["files"]
        shapes, motions = told["shapes"], {motion.pop("wall"): motion for motion in told["motions"]}
    except (ValueError, RecursionError, KeyError, TypeError) as error:
        raise BadCase(f"{program}: error: --resolved gave no case: {error!r}") from None
    # as it was given: JSON does not carry a name that is no text
    file = pathlib.Path(path) / "case.toml" if os.path.isdir(path) else pathlib.Path(path)
    inputs = [*map(pathlib.Path, case["inputs"]), *(file.parent / name for name in files)]
    return Case(case["kind"], file, case["name"], inputs, case["content"], references, files, shapes, motions, case["places"])
