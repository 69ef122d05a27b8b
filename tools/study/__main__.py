"""Runs a study: all its runs, then table, charts and page.

    /usr/bin/python3 tools/study STUDY.toml [options]
"""

import argparse
import math
import os
import pathlib
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
sys.path.insert(0, str(HERE.parent / "report"))

import charts  # noqa: E402
import checks  # noqa: E402
import page  # noqa: E402
import removal  # noqa: E402
import results  # noqa: E402
import runner  # noqa: E402
import study_file  # noqa: E402
import table  # noqa: E402
from document import BadStudy  # noqa: E402
from processes import BAD_INPUT, DONE  # noqa: E402
from progress import Progress, duration  # noqa: E402
from settings import settings  # noqa: E402

VIEWS = [("removal", removal.read)]


def parse(arguments):
    parser = argparse.ArgumentParser(
        prog="run.sh", allow_abbrev=False, description="Runs a study: a case over the axes that its file names. Runs "
        "that are done are kept, so the same command goes on where it was stopped.",
        epilog="Exit codes: 0 done (runs whose physics failed are results), 2 bad input, 130 interrupted, else that of "
               "the run that ended the study.")
    parser.add_argument("study", metavar="STUDY.toml", type=pathlib.Path)
    parser.add_argument("--out", metavar="DIR", type=pathlib.Path, help="results folder; default out/<case>_<study>")
    parser.add_argument("--set", metavar="KEY=VALUE", action="append", default=[],
                        help="another value for a key of the case in every run; repeatable")
    parser.add_argument("--jobs", metavar="N", type=int, help="runs at a time; default: as many as fit the cores")
    parser.add_argument("--threads", metavar="N", type=int, default=1, help="threads of each run; default 1")
    parser.add_argument("--check", action="store_true", help="only check the study and what it sets in the case")
    parser.add_argument("--list", action="store_true", help="list the runs, and which are done")
    parser.add_argument("--bin", metavar="DIR", default=HERE.parents[1] / "build/release/bin", type=pathlib.Path,
                        help=argparse.SUPPRESS)
    options = parser.parse_args(arguments)
    cores = len(os.sched_getaffinity(0))
    for name, value in (("jobs", options.jobs), ("threads", options.threads)):
        if value is not None and value < 1:
            raise BadStudy(f"--{name} {value}: error: must be an integer of at least 1")
    for pair in options.set:
        if "=" not in pair:
            raise BadStudy(f"--set {pair}: error: expected section.key=value")
    options.jobs = options.jobs or max(1, cores // options.threads)
    return options


def list_runs(all_settings, done):
    for setting in all_settings:
        record = done.get(setting.key)
        state = "to do" if record is None else "done" if record.exit_code == DONE else "physics failed"
        print(f"{setting.key}  {state:14}  {setting}")


def run(options):
    study = study_file.read(options.study, VIEWS)
    out = options.out or pathlib.Path("out") / study.name
    programs = checks.programs(study, options.bin)
    all_settings = settings(study, options.set, checks.identity(programs))
    runs = runner.Runner(study, out, options.bin, options.jobs, options.threads, Progress())
    done = runs.done(all_settings)
    if options.list:
        list_runs(all_settings, done)
        return DONE
    checks.settings(study, runs, [s for s in all_settings if s.key not in done], options.set)
    if options.check:
        print(f"{study.path}: no errors; {len(all_settings)} runs, {len(done)} of them done")
        return DONE
    begin = time.monotonic()
    with runner.sole_user(out):
        records = runs(all_settings)
        finish(study, records, out, len(done), time.monotonic() - begin, checks.versions(programs))
    return DONE


def finish(study, records, out, kept, elapsed, versions):
    """Table, charts, page and the last words."""
    views = [view for name, _ in VIEWS if (view := getattr(study, name))]
    made = table.build(study, records, views)
    table.write(made, out / "table.csv")
    folder = out / "charts"
    folder.mkdir(exist_ok=True)
    drawn = charts.draw(study, made, folder)
    drawn = [chart for view in views for chart in view.charts(study, made, folder)] + drawn
    answers = [answer for view in views if (answer := view.answer(study, made))]
    page.write(out / "study.html", study, made, drawn, answers, versions)
    failed = sum(record.exit_code != DONE for record in records)
    print(f"{len(records)} runs" + (f", {failed} of them ended by their physics" if failed else "") +
          (f"; {kept} were done before" if kept else "") + f"; {duration(elapsed)}")
    for metric in study.metrics:
        if not any(math.isfinite(value) for value in made.column(metric.name)):
            print(f"no run gives '{metric.name}'")
    for answer in answers:
        print(answer.sentence)
    for name in ("table.csv", "charts", "study.html"):
        print(f"{name.partition('.')[0]:7} {out / name}")


def main(arguments):
    try:
        return run(parse(arguments))
    except BadStudy as error:
        print(error, file=sys.stderr)
        return BAD_INPUT
    except runner.Ended as end:
        print(end, file=sys.stderr)
        return end.code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
