"""Fair timing: one run at a time, each repeated, the median, beside a reference loop that is timed before and after."""

import math
import statistics
import subprocess
from dataclasses import dataclass

from toryu.study.document import BadStudy

UNITS = {"relative_time": "", "time_spread": "", "reference_loop": "s"}
PROGRAM = "reference_loop"  # built with the others; see reference_loop.cpp
BUSY = 1.1  # wall over processor time of the loop from which on other programs took a share of its core


@dataclass
class Timing:
    """The table [timing]."""

    repeat: int
    repeat_below: float  # [s]: a run that took longer is not repeated, its own length evens out what disturbs it


@dataclass
class Loop:
    """What the reference loop took [s]."""

    processor_time: float
    wall_time: float


def read(table):
    if table is None:
        return None
    timing = Timing(table.get("repeat", int, 3), table.get("repeat_below", float, math.inf))
    if not timing.repeat_below > 0:
        table.fault(f"'repeat_below' must be above 0 s, found {timing.repeat_below}", "repeat_below")
    if not 1 <= timing.repeat <= 100:
        table.fault(f"'repeat' must be from 1 to 100, found {timing.repeat}", "repeat")
    table.close()
    return timing


def run_loop(folder):
    """Runs the reference loop once."""
    program = folder / PROGRAM
    try:
        done = subprocess.run([program], capture_output=True, text=True, stdin=subprocess.DEVNULL)
        return Loop(*map(float, done.stdout.split()))
    except (OSError, ValueError, TypeError):
        raise BadStudy(f"{program}: error: the reference loop, needed by [timing], cannot be run") from None


def repeated(timing, settings, done):
    """Of the settings those that are to run: no repetition of a run that took too long. `done`: key -> record."""
    slow = [r.setting.values for r in done.values() if r.setting.repetition == 0 and r.elapsed > timing.repeat_below]
    return [s for s in settings if s.repetition == 0 or s.values not in slow]


def figures(records, times):
    """Medians over the repetitions of one setting. `times`: of each record, as metrics.times gives them. A repetition's
    relative time is its processor time over the mean of the loops before and after it; the spread is the distance of the
    largest from the smallest processor time, over the median."""
    medians = {name: statistics.median(t[name] for t in times) for name in times[0]}
    loops = [[loop["processor_time"] for loop in record.loops] for record in records]
    ratios = [t["processor_time"] / statistics.mean(loop) if loop else math.nan for t, loop in zip(times, loops)]
    busy = [t["processor_time"] for t in times]
    spread = (max(busy) - min(busy)) / medians["processor_time"] if medians["processor_time"] > 0 else math.nan
    every = [value for loop in loops for value in loop]
    return medians | {"relative_time": statistics.median(ratios), "time_spread": spread,
                      "reference_loop": statistics.median(every) if every else math.nan}


def how_often(timing):
    if timing.repeat == 1:
        return "Each setting ran once"
    spared = f" (runs above {timing.repeat_below:g} s once)" if math.isfinite(timing.repeat_below) else ""
    return f"Times are medians of {timing.repeat} repetitions{spared}"


def sentence(timing, records):
    """How the times were measured, and whether the machine was left alone."""
    every = [loop for record in records for loop in record.loops]
    if not every:
        return ""
    loops = [loop["processor_time"] for loop in every]
    text = (f"{how_often(timing)}, one run at a time; beside them the reference loop took "
            f"{statistics.median(loops):.3f} s of processor time ({min(loops):.3f} to {max(loops):.3f} s).")
    busy = statistics.median(loop["wall_time"] / loop["processor_time"] for loop in every)
    if busy > BUSY:
        text += (f" Other programs were running: the loop took {busy:.2f} times as long by the clock as by the "
                 "processor, so wall times say little; processor times, and more so times relative to the loop, are less "
                 "affected.")
    return text
