"""What one program of a run does on another host."""

import dataclasses
import json
import os
from dataclasses import dataclass, field


@dataclass
class Job:
    name: str  # of the program: "fluid_solver"
    address: str
    launcher: list[str]
    program: str  # its path there
    packages: str = ""  # where a program in Python finds toryu there
    version: str = ""  # that it must have, as this machine's program tells it; "": any
    folder: str | None = None  # there, in which it gets a folder for what it writes
    lost_after: float = 3.0  # [s]
    case: str = ""
    out: str = ""
    arguments: list[str] = field(default_factory=list)  # of the program, but for the case and the results
    files: list[str] = field(default_factory=list)  # that it reads
    is_lead: bool = False
    is_coupled: bool = False
    restarts: bool = False

    def as_text(self):
        return json.dumps(dataclasses.asdict(self))

    @staticmethod
    def of_text(text):
        return Job(**json.loads(text))


def place(path):
    """Where a file of this machine lies below the work folder of a host: all paths there are those of here."""
    return os.path.relpath(os.path.abspath(path), "/")


def argument(path, work):
    """`path` as the program there is to be given it, which runs in the place of this working directory."""
    return os.path.join(work, place(path)) if os.path.isabs(path) else path


def restart_files(out, checkpoint, participant, is_lead):
    """What a program needs to go on: path -> whether its content is needed; of frames the name alone, which it removes if
    the frame comes after the checkpoint. The lead removes old checkpoints, so it has all."""
    others = tuple({"fluid", "solid", "coupler"} - {participant})
    found = {path: True for path in out.iterdir() if path.suffix in CUT_OFF and not path.name.startswith(others)}
    found |= {path: False for path in out.glob("frames/*.hdf") if not path.name.startswith(others)}
    parts = checkpoint.parent.glob("*/*") if is_lead else checkpoint.glob(f"{participant}.state")
    return found | {path: True for path in parts if path.is_file()}


CUT_OFF = {".csv", ".part", ".series", ".h5", ".rows", ".toml"}  # endings of what a restart cuts off, or reads
