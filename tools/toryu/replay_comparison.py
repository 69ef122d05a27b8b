"""How far what one side answers in a replay lies from the record, window by window."""

import csv
import pathlib
from dataclasses import dataclass

import h5py
import numpy as np

from toryu import program
from toryu.replay import FILE

ANSWERS = {"solid": ("position", "velocity"), "fluid": ("pressure", "force", "friction_force")}  # of each side
SPAN = {"solid": 1.0, "fluid": 0.5}  # where in a window its answers are: a motion at the end, a mean load in the middle
CHUNK = 256  # windows that are held at once


class BadRecord(Exception):
    """Why a record is of no use."""


@dataclass
class Difference:
    """How far one answer lies from the record."""

    name: str
    unit: str
    distance: np.ndarray  # window: root mean square over the interface
    largest: np.ndarray  # window: of all components
    scale: float  # largest root mean square of the record, of a position that of its displacement
    same: bool  # whether every bit is that of the record


def at(dataset, known, times):
    """What a dataset has at the times `known` [s], between these at `times`."""
    upper = np.clip(np.searchsorted(known, times), 1, len(known) - 1) if len(known) > 1 else np.zeros(len(times), int)
    lower = np.maximum(upper - 1, 0)
    first, last = lower.min(), upper.max() + 1
    values = dataset[first:last]
    width = np.where(upper > lower, known[upper] - known[lower], 1.0)
    share = np.clip((times - known[lower]) / width, 0, 1).reshape(-1, *[1] * (values.ndim - 1))
    return (1 - share) * values[lower - first] + share * values[upper - first]


def difference(record, run, name, known, times):
    """Compares one answer of all windows, whose answers are at `times` [s], with the record, which has them at `known`."""
    aligned = np.array_equal(known[:len(times)], times)
    distance, largest, same, scale = [], [], aligned, 0.0
    origin = record["start_position"][:] if name == "position" else 0.0
    for first in range(0, len(times), CHUNK):
        part = slice(first, first + CHUNK)
        found = run[name][part]
        expected = record[name][part] if aligned else at(record[name], known, times[part])
        apart = (found - expected).reshape(len(found), -1)
        same = same and bool((found == expected).all())
        distance.append(np.sqrt((apart**2).sum(axis=1) / max(found.shape[1], 1)))
        largest.append(np.abs(apart).max(axis=1, initial=0.0))
        size = (expected - origin).reshape(len(found), -1)
        scale = max(scale, float(np.sqrt((size**2).sum(axis=1) / max(found.shape[1], 1)).max(initial=0.0)))
    unit = run[name].attrs["unit"].decode()
    return Difference(name, unit, np.concatenate(distance), np.concatenate(largest), scale, same)


def compare(record, out, side):
    """Times [s] and the differences of all that the side `side` answers. Raises BadRecord if a file is of no use."""
    with open_record(record) as before, open_record(out) as now:
        try:
            known, times = (file["window_start"][:] + SPAN[side] * file["window_length"][:] for file in (before, now))
            if len(times) == 0:
                raise BadRecord(f"{out / FILE}: error: holds no window")
            ends = now["window_start"][:] + now["window_length"][:]
            return ends, [difference(before, now, name, known, times) for name in ANSWERS[side]]
        except (OSError, KeyError, ValueError, TypeError, RuntimeError) as error:
            raise BadRecord(f"{out / FILE}, {record / FILE}: error: cannot be compared: {error}") from None


def open_record(folder):
    try:
        return h5py.File(folder / FILE)
    except OSError as error:
        raise BadRecord(f"{folder / FILE}: error: cannot be read: {error}") from None


def tell(side, times, differences):
    """The differences as lines of text."""
    count = len(times)
    if all(d.same for d in differences):
        return f"replay, the {side} alone: in {count} windows every answer is that of the record, bit for bit"
    lines = [f"replay, the {side} alone, {count} windows; root mean square distance from the record over the interface:"]
    for d in differences:
        worst = int(np.argmax(d.distance))
        share = f", {100 * d.distance[worst] / d.scale:.2g} % of the record's largest" if d.scale > 0 else ""
        since = "the same in all" if not d.largest.any() else f"from window {int(np.argmax(d.largest > 0)) + 1} on"
        lines.append(f"  {d.name.replace('_', ' ')}: at most {d.distance[worst]:.3g} {d.unit} at t = {times[worst]:.4g} s"
                     f"{share}; {since}")
    return "\n".join(lines)


def write(path, times, differences):
    """`replay.csv`: a row a window."""
    with program.whole_file(path) as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["time[s]", *(f"{d.name}_{what}[{d.unit}]" for d in differences
                                      for what in ("distance", "largest_difference"))])
        for k, time in enumerate(times):
            writer.writerow(map(repr, [float(time), *(float(v[k]) for d in differences for v in (d.distance, d.largest))]))


def sum_up(options):
    """Compares the run in options.out with the record: writes replay.csv, returns what to say."""
    record, out = pathlib.Path(options.replay), pathlib.Path(options.out)
    times, differences = compare(record, out, options.only)
    write(out / "replay.csv", times, differences)
    return tell(options.only, times, differences)
