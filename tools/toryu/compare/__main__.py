"""Compares the results of two runs.

    python3 -I -X utf8 tools/toryu compare OUT_A OUT_B [--out DIR]
"""

import argparse
import os
import pathlib
import sys

from toryu import PROGRAMS, counted, printable, program, results
from toryu.compare import motion, page, runs
from toryu.installation import COMMAND
from toryu.processes import BAD_INPUT, DONE
from toryu.report import data

PARTS = {"charts", "table.csv", "table.csv.part", "compare.html.part"}  # what a comparison that was ended leaves
MOST_TOLD = 12  # columns and settings on the terminal; the table has all


def folder(text):
    if not text:
        raise argparse.ArgumentTypeError("has an empty name; '.' is the current folder")
    return pathlib.Path(text)


def parse(arguments):
    parser = argparse.ArgumentParser(
        prog=f"{COMMAND.removeprefix('./')} --compare", allow_abbrev=False, description="Lays two runs over each other: what they set "
        "otherwise, how far their series lie apart over the times that both reached, charts of what differs most, "
        "a page.")
    parser.add_argument("first", metavar="OUT_A", type=folder, help="results folder of a run")
    parser.add_argument("second", metavar="OUT_B", type=folder, help="of the run that is held against it")
    parser.add_argument("--out", metavar="DIR", type=folder, help="where table, charts and page go; default "
                        "out/<A>_against_<B>")
    parser.add_argument("--bin", metavar="DIR", default=PROGRAMS, type=pathlib.Path, help=argparse.SUPPRESS)
    return parser.parse_args(arguments)


def names_of(folders):
    """The shortest last parts of the paths that tell them apart."""
    parts = [folder.resolve().parts for folder in folders]
    count = next((n for n in range(1, max(map(len, parts)) + 1) if parts[0][-n:] != parts[1][-n:]), 0)
    names = ["_".join(part.strip("/") for part in path[-count:]) for path in parts]
    return [printable(os.fsencode(name).decode("utf-8", "backslashreplace")) for name in names]


def say(text, file=None):
    """A line; what names hold that a terminal would obey, as an escape."""
    print(printable(text), file=file)


def fault_of(options):
    for run in (options.first, options.second):
        faults = []
        if not run.is_dir():
            return f"{run}: error: is no folder of results"
        if not any([results.read_series(run, name, faults) for name in runs.SERIES]):
            return f"{run}: error: holds no series" + (f" that is whole: {'; '.join(faults)}" if faults else
                                                       "; a run leaves fluid.csv, solid.csv or both")
    if options.first.samefile(options.second):
        return f"{options.second}: error: is the same run as {options.first}"
    return ""


def is_comparison(out):
    """Whether a folder holds nothing else than a comparison, or what one that was ended has left."""
    names = {path.name for path in out.iterdir()}
    return "compare.html" in names or names <= PARTS and ("table.csv" in names or not any((out / "charts").glob("*")))


def prepare(out):
    """Makes the folder of the comparison; returns what is wrong with it."""
    if out.is_dir() and not is_comparison(out):
        return f"{out}: error: holds something else than a comparison; give --out another folder"
    file = next((path for path in (out, *out.parents) if path.exists() and not path.is_dir()), None)
    if file:
        return f"{out}: error: no comparison can be written there: {file} is no folder"
    (out / "charts").mkdir(parents=True, exist_ok=True)
    for former in (out / "charts").glob("chart_[0-9][0-9].*"):
        former.unlink()
    return ""


def motion_of(options, names, faults):
    """Both runs for the player of the page, with what is damaged added to `faults`."""
    both = []
    for out in (options.first, options.second):
        used, _ = data.used_case(out / "used_case.toml", out, options.bin / "coupler")
        both.append((out, used, []))
    found = motion.collect(both, names)
    faults += [f"{out}: {fault}" for out, _, own in both for fault in own]
    return found


def listed(columns):
    return ", ".join(columns[:MOST_TOLD]) + (", ..." if len(columns) > MOST_TOLD else "")


def tell(comparison):
    for key, *values in comparison.settings[:MOST_TOLD]:
        say(f"{key}: {values[0]} | {values[1]}")
    if len(comparison.settings) > MOST_TOLD:
        say(f"and {counted(len(comparison.settings) - MOST_TOLD, 'setting')} more")
    if comparison.apart:
        say(f"without a number at the times that both reached: {listed(comparison.apart)}")
    if comparison.alone:
        say(f"in one run alone: {listed(comparison.alone)}")
    if not comparison.columns:
        say(f"no column that can be compared differs; {comparison.alike} the same in both")
        return
    shown = comparison.columns[:MOST_TOLD]
    width = max(len(column.place) for column in shown)
    say(f"{'':{width}}  {'first peak':>12}  {'second peak':>12}  {'change':>10}  distance")
    for column in shown:
        peaks = "  ".join(f"{peak:12.5g}" for peak in column.peaks)
        say(f"{column.place:{width}}  {peaks}  {runs.percent(column.change):>10}  {runs.percent(column.distance)}")
    if (rest := len(comparison.columns) - len(shown)) or comparison.alike:
        say((f"and {counted(rest, 'column')} more; " if rest else "") + f"{comparison.alike} the same in both")


def main(arguments):
    options = parse(arguments)
    if fault := fault_of(options):
        say(fault, sys.stderr)
        return BAD_INPUT
    names = names_of((options.first, options.second))
    out = options.out or pathlib.Path("out") / f"{names[0]}_against_{names[1]}"
    if fault := prepare(out):
        say(fault, sys.stderr)
        return BAD_INPUT
    comparison = runs.compare(options.first, options.second)
    moving = motion_of(options, names, comparison.faults)
    for fault in comparison.faults:
        say(f"warning: {fault}: left out", sys.stderr)
    runs.write_table(comparison, names, out / "table.csv")
    page.write(comparison, names, moving, out)
    tell(comparison)
    for name in ("table.csv", "charts", "compare.html"):
        say(f"{name.partition('.')[0]:7} {out / name}")
    program.must_be_printed()
    return DONE


if __name__ == "__main__":
    program.run(main)
