"""Compares the results of two runs.

    python3 -I -X utf8 tools/toryu compare OUT_A OUT_B [--out DIR]
"""

import argparse
import os
import pathlib
import sys

from toryu import counted, program, results
from toryu.compare import page, runs
from toryu.installation import COMMAND
from toryu.processes import BAD_INPUT, DONE

MOST_TOLD = 12  # columns and settings on the terminal; the table has all


def parse(arguments):
    parser = argparse.ArgumentParser(
        prog=f"{COMMAND.removeprefix('./')} --compare", allow_abbrev=False, description="Lays two runs over each other: what they set "
        "otherwise, how far their series lie apart over the times that both reached, charts of what differs most, "
        "a page.")
    parser.add_argument("first", metavar="OUT_A", type=pathlib.Path, help="results folder of a run")
    parser.add_argument("second", metavar="OUT_B", type=pathlib.Path, help="of the run that is held against it")
    parser.add_argument("--out", metavar="DIR", type=pathlib.Path, help="where table, charts and page go; default "
                        "out/<A>_against_<B>")
    return parser.parse_args(arguments)


def names_of(folders):
    """The shortest last parts of the paths that tell them apart."""
    parts = [folder.resolve().parts for folder in folders]
    count = next((n for n in range(1, max(map(len, parts)) + 1) if parts[0][-n:] != parts[1][-n:]), 0)
    names = ["_".join(part.strip("/") for part in path[-count:]) for path in parts]
    return [os.fsencode(name).decode("utf-8", "backslashreplace") for name in names]


def fault_of(options):
    for folder in (options.first, options.second):
        if not folder.is_dir():
            return f"{folder}: error: is no folder of results"
        if not any(results.read_series(folder, name) for name in runs.SERIES):
            return f"{folder}: error: holds no series; a run leaves fluid.csv, solid.csv or both"
    if options.first.samefile(options.second):
        return f"{options.second}: error: is the same run as {options.first}"
    return ""


def tell(comparison):
    for key, *values in comparison.settings[:MOST_TOLD]:
        print(f"{key}: {values[0]} | {values[1]}")
    if len(comparison.settings) > MOST_TOLD:
        print(f"and {counted(len(comparison.settings) - MOST_TOLD, 'setting')} more")
    if comparison.apart:
        print(f"without a number at the times that both reached: {', '.join(comparison.apart[:MOST_TOLD])}"
              + (", ..." if len(comparison.apart) > MOST_TOLD else ""))
    if not comparison.columns:
        print(f"no column that can be compared differs; {comparison.alike} the same in both")
        return
    shown = comparison.columns[:MOST_TOLD]
    width = max(len(column.place) for column in shown)
    print(f"{'':{width}}  {'first peak':>12}  {'second peak':>12}  {'change':>10}  distance")
    for column in shown:
        peaks = "  ".join(f"{peak:12.5g}" for peak in column.peaks)
        print(f"{column.place:{width}}  {peaks}  {runs.percent(column.change):>10}  {runs.percent(column.distance)}")
    if (rest := len(comparison.columns) - len(shown)) or comparison.alike:
        print((f"and {counted(rest, 'column')} more; " if rest else "") + f"{comparison.alike} the same in both")


def main(arguments):
    options = parse(arguments)
    if fault := fault_of(options):
        print(fault, file=sys.stderr)
        return BAD_INPUT
    names = names_of((options.first, options.second))
    out = options.out or pathlib.Path("out") / f"{names[0]}_against_{names[1]}"
    if out.is_dir() and any(out.iterdir()) and not (out / "compare.html").is_file():
        print(f"{out}: error: holds something else than a comparison; give --out another folder", file=sys.stderr)
        return BAD_INPUT
    comparison = runs.compare(options.first, options.second)
    (out / "charts").mkdir(parents=True, exist_ok=True)
    for former in (out / "charts").glob("chart_[0-9][0-9].*"):
        former.unlink()
    runs.write_table(comparison, names, out / "table.csv")
    page.write(comparison, names, out)
    tell(comparison)
    for name in ("table.csv", "charts", "compare.html"):
        print(f"{name.partition('.')[0]:7} {out / name}")
    program.must_be_printed()
    return DONE


if __name__ == "__main__":
    program.run(main)
