"""Runs a study: all its runs, then table, charts and page.

    python3 -I -X utf8 tools/toryu study STUDY.toml [options]
"""

import argparse
import math
import os
import pathlib
import shutil
import sys
import time

from toryu import PROGRAMS, counted, program
from toryu.installation import COMMAND
from toryu.processes import BAD_INPUT, BUG, DONE, PHYSICS_FAILED
from toryu.remote import placement
from toryu.study import (bisection, calibration, calibration_search, checks, elsewhere, hosts, map_file, metrics, page,
                         recession, recession_search, removal, runner, slurm, study_file, table, terms, timing, verdicts)
from toryu.study.document import BadStudy
from toryu.study.progress import Progress, duration
from toryu.study.settings import Maker, settings

VIEWS = [study_file.View("removal", removal.read, removal.add_axes),
         study_file.View("map", map_file.read, map_file.add_axes), study_file.View("terms", terms.read, terms.add_axes),
         study_file.View("recession", recession.read, recession.add_axes),
         study_file.View("calibration", calibration.read, calibration.add_axes)]
SBATCH = {"partition": "where the jobs go", "account": "who pays for them", "time": "longest time of a run, as sbatch takes it; "
          "one that takes longer goes on from its checkpoint in a new job"}


def parse(arguments):
    parser = argparse.ArgumentParser(
        prog=COMMAND.removeprefix("./"), allow_abbrev=False, description="Runs a study: a case over the axes that its file names. Runs "
        "that are done are kept, so the same command goes on where it was stopped.",
        epilog="Exit codes: 0 done (runs whose physics failed are results), 1 done but a run of a map hung, 2 bad input, "
               "5 a fault of the machine, 130 interrupted, else that of the run that ended the study.")
    parser.add_argument("study", metavar="STUDY.toml", type=pathlib.Path)
    parser.add_argument("--out", metavar="DIR", type=program.path, help="results folder; default out/<case>_<study>")
    parser.add_argument("--set", metavar="KEY=VALUE", action="append", default=[],
                        help="another value for a key of the case in every run; repeatable")
    parser.add_argument("--jobs", metavar="N", type=int, help="runs at a time; default: as many as fit the cores, one if "
                        "the study has [timing]")
    parser.add_argument("--threads", metavar="N", type=int, default=1, help="threads of each run; default 1")
    parser.add_argument("--secure", type=program.given, metavar="FOLDER", help="the identities of the programs of every run")
    for side in ("fluid", "solid"):
        parser.add_argument(f"--{side}", type=program.given, metavar="EXE", help=f"another program in the place of {side}_solver "
                            "in every run")
    parser.add_argument("--on", metavar="WHERE", help="run elsewhere, where this folder is too: 'slurm', or hosts that ssh "
                        "reaches, with commas between or one a line in a file, for GNU parallel; --jobs is then the most at "
                        "a time, on each host")
    for name, meaning in SBATCH.items():
        parser.add_argument(f"--{name}", metavar=name.upper(), help=f"{meaning}, for Slurm")
    parser.add_argument("--sbatch", metavar="OPTION", action="append", default=[],
                        help="any other option of sbatch, as --sbatch=--mem=2G; repeatable")
    parser.add_argument("--small", action="store_true", help="the small version that the study's table [small] describes")
    parser.add_argument("--check", action="store_true", help="only check the study and what it sets in the case")
    parser.add_argument("--list", action="store_true", help="list the runs, and which are done")
    parser.add_argument("--bin", metavar="DIR", default=PROGRAMS, type=program.path, help=argparse.SUPPRESS)
    placement.add_options(parser)
    options = parser.parse_args(arguments)
    cores = len(os.sched_getaffinity(0))
    for name, value in (("jobs", options.jobs), ("threads", options.threads)):
        if value is not None and value < 1:
            raise BadStudy(f"--{name} {value}: error: must be an integer of at least 1")
    for pair in options.set:
        if "=" not in pair:
            raise BadStudy(f"--set {pair}: error: expected section.key=value")
    options.cores = cores
    return options


def queue_of(study, options):
    """Where else the runs are made; None if here."""
    given = [f"--{name}={value}" for name in SBATCH if (value := getattr(options, name)) is not None] + options.sbatch
    if given and options.on != "slurm":
        raise BadStudy(f"{given[0]}: error: is an option of --on slurm")
    if study.timing and (where := options.on or options.host):
        raise BadStudy(f"{f'--on {where}' if options.on else f'--host {where[0]}'}: error: a study with [timing] compares times "
                       "of one machine")
    if options.on is None:
        return None
    if not options.on.strip():
        raise BadStudy(f"--on '{options.on}': error: expected 'slurm' or hosts")
    if options.host:
        raise BadStudy(f"--host {options.host[0]}: error: puts a program of every run on a host, --on whole runs; give one of them")
    kind = slurm if options.on == "slurm" else hosts
    if missing := [name for name in kind.PROGRAMS if not shutil.which(name)]:
        raise BadStudy(f"--on {options.on}: error: needs the program '{missing[0]}', which is not here")
    if kind is slurm:
        return slurm.Slurm(study.name, options.jobs, options.threads, given)
    return hosts.Hosts(options.on, options.jobs, options.threads)


def passed_on(options):
    """What every run is told of its programs."""
    given = [f"--{side}={path}" for side, path in checks.others(options).items()]
    given += [f"--host={place}" for place in options.host]
    given += [] if options.secure is None else [f"--secure={os.path.abspath(options.secure)}"]
    return given + [f"--{name.replace('_', '-')}={value}" for name in ("launcher", "remote_bin", "remote_folder", "peers")
                    if (value := getattr(options, name)) not in (None, placement.SSH)]


def runner_of(study, out, options):
    if queue := queue_of(study, options):
        return elsewhere.Elsewhere(study, out, options.bin, options.threads, Progress(), queue, passed_on(options))
    return runner.Runner(study, out, options.bin, jobs_at_a_time(study, options), options.threads, Progress(), passed_on(options))


def jobs_at_a_time(study, options):
    if study.timing is None:
        return options.jobs or max(1, options.cores // options.threads)
    if options.jobs not in (None, 1):
        raise BadStudy(f"--jobs {options.jobs}: error: a study with [timing] runs one run at a time")
    return 1


def list_runs(all_settings, done):
    for setting in all_settings:
        record = done.get(setting.key)
        state = "to do" if record is None else "done" if record.exit_code == DONE else "physics failed"
        print(f"{setting.key}  {state:14}  {setting}")


def run(options):
    study = study_file.read(options.study, options.bin / "coupler", VIEWS, options.small)
    out = options.out or pathlib.Path("out") / study.name
    programs = checks.programs(study, options)
    make = Maker(study, options.set, checks.identity(programs), f"{options.threads} threads" if study.timing else None)
    runs = runner_of(study, out, options)
    known, done = known_runs(study, make, runs)
    if options.list:
        list_runs(known, done)
        if study.searched:
            print(f"{number_of_runs(study, make, known)}: where the next ones lie depends on these")
        program.must_be_printed()
        return DONE
    checks.settings(study, runs, [s for s in known if s.key not in done], done.values(), options.set)
    if study.recession and known:
        study.recession.longest = checks.longest(study, runs, known[0], recession.LONGEST)
    if options.check:
        print(f"{study.path}: no errors; {number_of_runs(study, make, known)}, {len(done)} of them done")
        return DONE
    begin = time.monotonic()
    with runner.hold(study, out):
        records = search(study, make, runs) if study.searched else all_runs(study, known, runs)
        finish(study, records, out, len(done), time.monotonic() - begin, checks.versions(programs))
    if study.recession and (failed := [chain for chain in study.recession.chains if chain.failure]):
        raise runner.Ended(failed[0].failed_code or PHYSICS_FAILED, "\n".join(
            f"{study.path}: error: {chain.label}{': ' if chain.label else ''}{chain.failure}" for chain in failed))
    if study.calibration and study.calibration.failure:
        raise runner.Ended(study.calibration.failed_code, f"{study.path}: error: {study.calibration.failure}")
    return BUG if any(record.exit_code == runner.HUNG for record in records) else DONE


def number_of_runs(study, make, known):
    if study.recession or study.calibration and study.calibration.fit is None:
        return f"{counted(len(known), 'run')} and more"
    if study.searched and not study.calibration:
        return f"at most {counted(bisection.most_runs(study, make), 'run')}"
    return counted(len(known), "run")


def search(study, make, run):
    if study.recession:
        return recession_search.search(study, make, run)
    if study.calibration:
        return calibration_search.search(study, make, run)
    return bisection.search(study, make, lambda record: verdicts.judge_alone(study, record), run)


def all_runs(study, every, run):
    """The records of a study whose settings are known beforehand, but for the repetitions that a slow run is spared."""
    if study.timing is None or math.isinf(study.timing.repeat_below):
        return run(every)
    first = run([setting for setting in every if setting.repetition == 0])
    chosen = timing.repeated(study.timing, every, {record.setting.key: record for record in first})
    again = [setting for setting in chosen if setting.repetition > 0]
    return first + (run(again) if again else [])


def known_runs(study, make, runs):
    """The settings that are known before anything runs, and the records of those that are done."""
    if not study.searched:
        every = settings(study, make)
        done = runs.done(every)
        chosen = timing.repeated(study.timing, every, done) if study.timing else every
        return chosen, {s.key: done[s.key] for s in chosen if s.key in done}
    seen, done = [], {}

    def look(wave):
        seen.extend(wave)
        records = runs.done(wave)
        done.update(records)
        return [records[s.key] for s in wave] if len(records) == len(wave) else None

    search(study, make, look)
    return seen, done


def finish(study, records, out, kept, elapsed, versions):
    """Table, charts, page and the last words."""
    from toryu.study import charts  # matplotlib takes longer than all that a check needs

    views = [view for kind in VIEWS if (view := getattr(study, kind.key))]
    if study.searched:
        study.searched.take_all_values(records)
    made = table.build(study, records, views)
    table.write(made, out / "table.csv")
    folder = out / "charts"
    folder.mkdir(exist_ok=True)
    drawn = charts.draw(study, made, folder)
    drawn = [chart for view in views for chart in view.charts(study, made, folder)] + drawn
    answers = [answer for view in views for answer in view.answers(study, made, out)] + charts.answers(study, made)
    page.write(out / "study.html", study, made, records, drawn, answers, versions)
    failed = sum(record.exit_code != DONE for record in records)
    print(counted(len(records), "run") + (f", {failed} of them ended by their physics" if failed else "") +
          (f"; {kept} were done before" if kept else "") + f"; {duration(elapsed)}")
    if study.timing:
        print(timing.sentence(study.timing, records))
    for metric in study.metrics:
        if not any(math.isfinite(value) for value in made.column(metric.name)):
            causes = {metrics.absent(metric, record) for record in records} - {""}
            print(f"no run gives '{metric.name}'" + (f": {causes.pop()}" if len(causes) == 1 else ""))
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
    program.run(main)
