"""What is new in a results folder: rows of the series, the newest frame, how far the run is, what it warned of. All is read
from files, so that the run never waits for who watches."""

import csv
import functools
import json
import math
import os
import time

from toryu import results
from toryu.case import Case
from toryu.folder_lock import is_held
from toryu.report import data, frames, scene, tables
from toryu.study.progress import duration

MOST_BYTES = 1 << 16  # of rows in one event


def of_running(out):
    """Whether programs or a launcher hold the folder."""
    return any(is_held(out, name) for name in ("run.lock", "launch.lock"))


def end_of_rows(out, name):
    """Bytes of NAME.csv up to the end of its last whole row; 0 without the file."""
    return 0 if (found := opened(out, name)) is None else len(whole(found[1]))


def opened(out, name, start=0, most=-1):
    """(first bytes, bytes from `start`, or below 0 so many last ones) of NAME.csv; None without the file."""
    path = out / f"{name}.csv"
    try:
        with open(results.newest(path) or path, "rb") as file:
            head = file.read(MOST_BYTES)
            file.seek(start if start >= 0 else max(0, file.seek(0, os.SEEK_END) + start))
            return head, file.read(most)
    except OSError:
        return None


def whole(piece):
    return piece[:piece.rfind(b"\n") + 1]


def lines_of(piece):
    return [line for line in whole(piece).decode(errors="replace").splitlines() if line and not line.startswith("#")]


def number(text):
    try:
        value = float(text)
    except ValueError:
        return None
    return value if math.isfinite(value) else None


def new_rows(out, name, start):
    """(rows for the page, where the next ones start) of NAME.csv from byte `start`, the start of a row; None for the rows
    if there is no whole one."""
    found = opened(out, name, start, MOST_BYTES)
    if found is None:
        return None, start
    head, piece = found
    columns = next(csv.reader(lines_of(head)), None)
    rows = [row for row in csv.reader(lines_of(piece)) if columns and len(row) == len(columns) and row != columns]
    content = {"name": name, "columns": columns, "rows": [[*map(number, row)] for row in rows]} if rows else None
    return content, start + len(whole(piece))


def last_time(out, name):
    """Time [s] of the last whole row of NAME.csv; None without one."""
    if (found := opened(out, name, -MOST_BYTES)) is None:
        return None
    columns = next(csv.reader(lines_of(found[0])), [])
    row = next(csv.reader(lines_of(found[1])[-1:]), [])
    return number(row[columns.index("time[s]")]) if "time[s]" in columns and len(row) == len(columns) else None


class Feed:
    """What a results folder tells of its run. `case`: the path of the case."""

    def __init__(self, out, case, coupler):
        self.out, self.case_path, self.coupler = out, case, coupler
        self.first = None  # (time [s], clock [s]) when this was first asked how far the run is
        self.last_frame = None, {}  # what newest_frames was, and the bodies there: several pages ask alike

    def case(self):
        """The case as it is run; read once the run has written it down."""
        path = self.out / "used_case.toml"
        return read_case(self.case_path, self.out, self.coupler, path.stat().st_mtime_ns if path.is_file() else 0)

    def cursor(self):
        """Where the rows begin that are not there yet."""
        return {name: end_of_rows(self.out, name) for name in results.PARTICIPANTS}

    def newest_frames(self):
        """The file of the newest frame of each body, as one text: what tells that there is a new one."""
        names = sorted(path.name.removesuffix(".hdf.series") for path in self.out.glob("*.hdf.series"))
        return json.dumps([str(files[-1][1]) for name in names if name != "walls"
                           and (files := results.list_frames(self.out, name))])

    def frame(self, newest):
        """The bodies of the newest frame as the page's player takes them. One page at a time may ask."""
        if self.last_frame[0] != newest:
            bodies, boxes, _ = frames.collect(frames.read_bodies(self.out, newest=True), self.case().content)
            self.last_frame = newest, {"bodies": bodies, "view": scene.view_of(boxes)}
        return self.last_frame[1]

    def progress(self):
        """How far the run is, for people: as far as the participant that is least far."""
        end = data.table(self.case().content, "case").get("end_time")
        times = [last_time(self.out, name) for name in results.PARTICIPANTS]
        reached = min([t for t in times if t is not None], default=None)
        if reached is None:
            return "no results yet"
        now = time.monotonic()
        self.first = self.first or (reached, now)
        if not data.is_number(end) or end <= 0:
            return f"{tables.number(reached)} s simulated"
        words = f"{tables.number(reached)} of {tables.number(end)} s simulated ({100 * reached / end:.0f} %)"
        passed = reached - self.first[0]
        if passed > 0 and now - self.first[1] > 2:
            words += f", {duration((end - reached) * (now - self.first[1]) / passed)} left"
        return words

    def warnings(self):
        path = self.out / "log.txt"
        return read_warnings(self.out, path.stat().st_size if path.is_file() else 0)


# A result is kept for as long as what it was read from is the same: several pages ask alike.

@functools.lru_cache(maxsize=1)
def read_case(path, out, coupler, changed):
    case, _ = data.used_case(path, out, coupler)
    return case if isinstance(case.content, dict) else Case("empty", path, "", [], {})


@functools.lru_cache(maxsize=1)
def read_warnings(out, size):
    return tables.warning_lines(out)
