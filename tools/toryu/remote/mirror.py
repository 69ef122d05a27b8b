"""Copies of files on both sides of a channel, kept alike: what grows is sent from where it grew, all else whole."""

import contextlib
import os
import pathlib
import zlib
from dataclasses import dataclass

from toryu.remote.channel import PIECE

CHECKPOINTS, FRAMES = "checkpoint", "frames"
# Of one host alone; the log is passed on line by line.
KEPT = {"run.lock", "run.secret", "launch.lock", "log.txt", "stop"}


def check_sum(path, size):
    """Of the first bytes of a file."""
    total = 0
    with open(path, "rb") as file:
        while size > 0 and (piece := file.read(min(size, PIECE))):
            total = zlib.crc32(piece, total)
            size -= len(piece)
    return total


def send_file(channel, path, name, start=0, total=0, **content):
    """Sends what a file holds from byte `start` on, as `name`, `total` the check sum of what is before; returns its size and
    check sum as they were sent."""
    with open(path, "rb") as file:
        facts = os.fstat(file.fileno())
        file.seek(start)
        at = start
        while True:
            piece = file.read(min(PIECE, facts.st_size - at)) if at < facts.st_size else b""
            total = zlib.crc32(piece, total)
            last = at + len(piece) >= facts.st_size or not piece
            channel.send("file", piece, name=name, at=at, last=last, mode=facts.st_mode & 0o777, **content)
            at += len(piece)
            if last:
                return at, total


class Receiver:
    """Writes files below `root` as they come. A file that is sent whole gets its name when it is whole."""

    def __init__(self, root):
        self.root = pathlib.Path(root)
        self.file, self.part, self.whole, self.has_failed = None, None, True, False

    def take(self, message, data):
        """Returns the path of a file that is complete now, else None. Once an OSError was raised the rest of that file is
        passed over."""
        if self.has_failed:
            self.has_failed = not message["last"]
            return None
        try:
            return self._write(message, data)
        except OSError as error:
            self.has_failed = not message["last"]
            self.give_up()
            raise OSError(error.errno, error.strerror, str(self.root / message["name"])) from error

    def give_up(self):
        """What has not come whole does not stay."""
        if self.file is None:
            return
        with contextlib.suppress(OSError):  # what it held back cannot be written either
            self.file.close()
        self.file = None
        if self.whole:
            self.part.unlink(missing_ok=True)

    def _write(self, message, data):
        path = self.root / safe(message["name"])
        if self.file is None:
            self.whole, self.part = message["at"] == 0, path.with_name(path.name + ".incoming")
            path.parent.mkdir(parents=True, exist_ok=True)
            flags = os.O_CREAT | os.O_TRUNC if self.whole else 0
            self.file = open(os.open(self.part if self.whole else path, os.O_WRONLY | flags, message["mode"] | 0o200), "wb")
            self.file.seek(message["at"])
        self.file.write(data)
        if not message["last"]:
            return None
        self.file.close()
        self.file = None
        if self.whole:
            self.part.replace(path)
        return path


def safe(name):
    """A path that stays below its root. Raises ValueError."""
    if os.path.isabs(name) or ".." in pathlib.PurePath(name).parts:
        raise ValueError(f"{name}: leads out of its folder")
    return name


def remove(root, name):
    path = pathlib.Path(root) / safe(name)
    path.unlink(missing_ok=True)
    with contextlib.suppress(OSError):
        if path.parts[-3:-2] == (CHECKPOINTS,):
            path.parent.rmdir()


@dataclass
class Known:
    """A file as the other side has it."""

    size: int
    changed: int  # [ns]
    check_sum: int


class Mirror:
    """What a program writes into `root`, for the other side of `channel`."""

    def __init__(self, root, channel, keeps_checkpoints):
        """Frames are needed here no more once they were sent, nor are parts of checkpoints but on the lead's host."""
        self.root, self.channel, self.keeps_checkpoints = pathlib.Path(root), channel, keeps_checkpoints
        self.known = {}

    def note(self, path):
        """The other side has this file."""
        facts = path.stat()
        self.known[self._name(path)] = Known(facts.st_size, facts.st_mtime_ns, check_sum(path, facts.st_size))

    def has_news(self):
        """Whether there is what the run waits for: a part of a checkpoint, or the sign that it has begun."""
        waited_for = [path for path in self.root.glob(f"{CHECKPOINTS}/*/*") if is_whole(path.name)]
        with contextlib.suppress(FileNotFoundError):
            return any(map(self._has_changed, [*waited_for, *self.root.glob("used_case.toml")]))
        return False

    def bring_up_to_date(self):
        """Sends what is new and what has changed, checkpoints after the files that they belong to and the manifests last of
        all; then what is gone."""
        found = [path for folder, _, names in os.walk(self.root) for name in names
                 if is_whole(name) and (path := pathlib.Path(folder, name)).relative_to(self.root).as_posix() not in KEPT]
        for path in sorted(found, key=self._turn):
            with contextlib.suppress(FileNotFoundError):  # it got its last name just now, or is no longer needed
                self._send(path)
        for name in self.known.keys() - set(map(self._name, found)):
            self.channel.send("gone", name=name)
            del self.known[name]

    def _name(self, path):
        return path.relative_to(self.root).as_posix()

    def _has_changed(self, path):
        known, facts = self.known.get(self._name(path)), path.stat()
        return not known or (known.size, known.changed) != (facts.st_size, facts.st_mtime_ns)

    def _turn(self, path):
        name = self._name(path)
        return name.startswith(CHECKPOINTS), path.name == "manifest.toml", name

    def _send(self, path):
        if not self._has_changed(path):
            return
        name, facts = self._name(path), path.stat()
        known = self.known.get(name)
        grown = known and 0 < known.size <= facts.st_size and check_sum(path, known.size) == known.check_sum
        size, total = send_file(self.channel, path, name, *((known.size, known.check_sum) if grown else ()))
        self.known[name] = Known(size, facts.st_mtime_ns, total)
        if name.startswith(FRAMES) or name.startswith(CHECKPOINTS) and not self.keeps_checkpoints:
            path.unlink()
            del self.known[name]


def is_whole(name):
    """Series grow under the name that they have until the end; no other file is of use before it has its own name."""
    return not name.endswith((".part", ".incoming")) or name.endswith(".csv.part")
