"""The runs of a study: several at a time, each as a user would start it. What is done stays and is never repeated."""

import contextlib
import json
import os
import pathlib
import re
import signal
import sys
import time
from dataclasses import asdict, dataclass, field, replace

from toryu import PROGRAMS, counted, program, results
from toryu.folder_lock import FolderTaken, lock_folder
from toryu.processes import (BAD_INPUT, DONE, INTERRUPTED, LAST_PATIENCE, PATIENCE, PHYSICS_FAILED, own_pause, pauses,
                             requests_to_end, start)
from toryu.results_folder import newest_checkpoint, remove_former
from toryu.study import metrics, timing

RECORD = "run.json"  # in the folder of a run that is done: without it the run goes on or starts afresh
# of a Record, in its file
KEPT = {"exit_code": int, "cause": str, "elapsed": (int, float), "threads": int, "jobs": int, "loops": list, "files": dict}
LOCK = "study.lock"
WRITTEN = ("table.csv", "study.html", "edges.csv", "terms.csv", "recession.csv", "goals.csv", "table.md", "calibration.toml",
           "calibration.csv", "charts", "runs", "queue")  # by studies
OUTPUT = "output.txt"  # what the run printed
POLL = 0.05  # [s]
HUNG = 124  # in the place of an exit code: the run was ended because it took longer than it may


class Ended(Exception):
    """The study ends before its last run: exit code and words."""

    def __init__(self, code, words):
        super().__init__(words)
        self.code = code


@dataclass
class Record:
    """A run that is done."""

    setting: object
    folder: pathlib.Path
    exit_code: int
    cause: str  # why it failed, "" if it did not
    elapsed: float  # [s] of the launcher, the check included
    threads: int
    jobs: int  # that were allowed beside each other, itself included
    loops: list[dict] = field(default_factory=list)  # the reference loop before and after it, as timing.Loop
    files: dict[str, int] = field(default_factory=dict)  # that it left, with their sizes


def files_of(folder):
    """Name -> size of the files that the figures of a run are taken from."""
    patterns = ("*.csv", "*_summary.toml", "surface.h5", "used_case.toml")
    return {path.name: path.stat().st_size for pattern in patterns for path in sorted(folder.glob(pattern))}


def read_record(folder, setting):
    """The record of the run in `folder`, or None if there is none, or if the run's files are not as it left them."""
    try:
        content = json.loads((folder / RECORD).read_text(encoding="utf-8"))
        record = Record(setting, folder, **{name: content[name] for name in KEPT})
        whole = all(isinstance(content[name], kind) for name, kind in KEPT.items()) and record.files == files_of(folder)
        loops = [timing.Loop(**loop) for loop in record.loops]
    except (OSError, ValueError, RecursionError, KeyError, TypeError, AttributeError):
        return None
    faults = []
    results.read_summaries(folder, faults)
    for name in results.PARTICIPANTS:
        results.read_series(folder, name, faults)
    return record if whole and not faults and len(loops) == len(record.loops) else None


def write_record(record):
    setting = record.setting
    record.files = files_of(record.folder)
    content = {"values": setting.values, "set": setting.overrides} | {
        name: getattr(record, name) for name in KEPT}
    program.write_whole(record.folder / RECORD, json.dumps(content, indent=1, ensure_ascii=False) + "\n")


def refuse_others(study, out):
    """The folder of a study holds nothing of these names but what a study wrote."""
    for name in WRITTEN if out.is_dir() and not (out / LOCK).exists() else ():
        if (out / name).exists():
            raise Ended(BAD_INPUT, f"--out {out}: error: holds '{name}', which no study wrote, and a study would write over "
                                   "it; give another folder")
    for path in study.inputs:
        if path.resolve() in [(out / name).resolve() for name in WRITTEN]:
            raise Ended(BAD_INPUT, f"--out {out}: error: the study would write over its own input {path}; give another "
                                   "folder")


def hold(study, out):
    """Holds the study's folder: the same study is not run twice at once."""
    held = contextlib.ExitStack()
    try:
        refuse_others(study, out)
        if why := held.enter_context(lock_folder(out, LOCK)):
            print(f"warning: the file system of {out} has no locks ({why}): nothing keeps the same study from being run "
                  "there twice at once", file=sys.stderr)
        (out / "runs").mkdir(exist_ok=True)
    except FolderTaken:
        raise Ended(BAD_INPUT, f"{out}: error: this study is being run already; wait for it or give --out another folder")
    except OSError as error:
        if error.errno in program.SHORTAGES:
            raise
        raise Ended(BAD_INPUT, f"--out {out}: error: no results can be written there: {error.strerror}")
    return held


def prepare(folder, may_go_on):
    """Makes the folder of a run ready; returns whether a run that was left half done goes on there from a checkpoint,
    else removes it. Its launcher or its programs may still be ending: they hold the folder's locks."""
    patience = PATIENCE + LAST_PATIENCE
    try:
        with lock_folder(folder, "launch.lock", patience), lock_folder(folder, "run.lock", patience):
            if may_go_on and newest_checkpoint(folder):
                return True
            if (folder / RECORD).exists():
                print(f"{folder}: the files of the run are not as it left them: it runs again", file=sys.stderr)
            remove_former(folder)
            (folder / RECORD).unlink(missing_ok=True)
    except FolderTaken:
        raise Ended(BAD_INPUT, f"{folder}: error: another run writes its results here")
    return False


def cause_of(folder, code):
    """Why a run ended so: the reason that who failed gave, else the errors that were printed."""
    words = [s["end_reason"] for s in results.read_summaries(folder).values()
             if s.get("exit_code") == code and s.get("end_reason")]
    printed = (folder / OUTPUT).read_text(encoding="utf-8", errors="replace").splitlines()
    return "; ".join(dict.fromkeys(words or [line.strip() for line in printed if re.search(r"\berror\b", line)]
                                   or printed[-1:]))


def reached(folder):
    """The last time [s] in any series of a run, 0 if there is none."""
    series = [results.read_series(folder, name).get("time[s]", []) for name in results.PARTICIPANTS]
    return max((times[-1] for times in series if times), default=0.0)


@dataclass
class Running:
    """A run that has not ended yet."""

    setting: object
    folder: pathlib.Path
    began: float
    goes_on: bool  # from a checkpoint


class Runner:
    """Runs the settings that are not done yet, at most `jobs` at a time, each with the options `passed_on`."""

    def __init__(self, study, out, bin_folder, jobs, threads, progress, passed_on=()):
        self.study, self.out, self.bin, self.jobs, self.threads = study, out, bin_folder, jobs, threads
        self.passed_on = passed_on
        self.progress = progress
        self.time_limit = study.map.time_limit if study.map else None  # [s] by the clock
        self.verdicts = {DONE, PHYSICS_FAILED} | ({BAD_INPUT} if study.map else set())  # exit codes that are results
        self.running = {}  # process -> Running
        self.absent = set()  # metrics that were told of
        self.overdue = set()  # processes that were asked to end at the time limit
        self.loops = {}  # setting key -> the reference loop before its run
        self.interruptions = 0

    def folder(self, setting):
        return self.out / "runs" / setting.key

    def done(self, settings):
        """setting key -> record of those that are done."""
        records = {s.key: read_record(self.folder(s), s) for s in settings}
        return {key: record for key, record in records.items() if record}

    def __call__(self, settings):
        """All records, in the order of the settings; raises Ended if a run shows that the study cannot go on."""
        records = self.done(settings)
        waiting = list({s.key: s for s in settings if s.key not in records}.values())  # what sets the same runs once
        self.progress.begin(len(settings), [r.elapsed for r in records.values()], self.jobs)
        old = {n: signal.signal(n, self._interrupted) for n in requests_to_end()}
        old |= {n: signal.signal(n, self._pause) for n in pauses()}
        try:
            while waiting or self.running:
                if self.interruptions and not self.running:
                    break
                while waiting and len(self.running) < self.jobs and not self.interruptions:
                    self._start(waiting.pop(0))
                time.sleep(POLL)
                self._end_overdue()
                for record in self._ended():
                    records[record.setting.key] = record
                    self._tell_absent(record)
                self.progress.show(len(records), [time.monotonic() - r.began for r in self.running.values()])
        finally:
            self._end_all()
            for number, handler in old.items():
                signal.signal(number, handler)
            self.progress.end()
        if self.interruptions:
            raise Ended(INTERRUPTED, f"interrupted; {len(records)} of {counted(len(settings), 'run')} are done and kept: the same "
                                     "command goes on from there")
        return [replace(records[s.key], setting=s) for s in settings]

    def command(self, setting, *options):
        # On another machine the programs of an installation may be others.
        where = [] if self.bin == PROGRAMS else [f"--bin={self.bin}"]
        return program.python("launch", self.study.case, *where, *setting.options(), *self.passed_on, *options)

    def _whole_command(self, setting, goes_on):
        extra = ["--restart"] * goes_on + ["--no-report"] * (not self.study.keep_frames)
        return self.command(setting, f"--out={self.folder(setting)}", f"--threads={self.threads}", *extra)

    def _start(self, setting, may_go_on=True):
        """A run that was left half done goes on from its newest checkpoint; one whose time counts is run whole."""
        folder = self.folder(setting)
        goes_on = prepare(folder, may_go_on and not self.study.timing)
        if self.study.timing:
            self.loops[setting.key] = timing.run_loop(self.bin)
        with open(folder / OUTPUT, "wb") as output:
            self.running[start(self._whole_command(setting, goes_on), output)] = Running(setting, folder, time.monotonic(), goes_on)

    def _ended(self):
        """Records of the runs that ended since; a failure of physics is a result, any other ends the study."""
        for process in [p for p in self.running if p.poll() is not None]:
            run = self.running.pop(process)
            setting, folder = run.setting, run.folder
            if self.interruptions:
                continue  # how it ended says nothing
            code = HUNG if process in self.overdue else process.returncode
            if code == BAD_INPUT and run.goes_on:  # its checkpoint is of no use
                self._start(setting, may_go_on=False)
                continue
            record = self._judged(setting, folder, code, time.monotonic() - run.began)
            if self.study.timing:
                record.loops = [asdict(loop) for loop in (self.loops.pop(setting.key), timing.run_loop(self.bin))]
            write_record(record)
            yield record

    def _judged(self, setting, folder, code, age):
        """The record of a run that ended so after `age` [s]; raises Ended if that is no result."""
        cause = cause_of(folder, code) if code != DONE else ""
        if code == HUNG:
            cause = f"still running after {self.time_limit:g} s, at the time {reached(folder):.4g} s; ended"
        elif code not in self.verdicts:
            words = (folder / OUTPUT).read_text(encoding="utf-8", errors="replace").strip()
            raise Ended(code if code > 0 else 1, f"{words}\nthe run with {setting} ended with exit code {code}: the study "
                                                 f"stops; see {folder}")
        return Record(setting, folder, code, cause, age, self.threads, self.jobs)

    def _tell_absent(self, record):
        """That a metric is not to be had, as soon as a run shows it, and once: other runs may have it."""
        for metric in self.study.metrics:
            if metric.name not in self.absent and (fault := metrics.absent(metric, record)):
                self.absent.add(metric.name)
                self.progress.tell(f"warning: metric '{metric.name}': in {record.folder} {fault}")

    def _end_overdue(self):
        """A launcher that is asked to end kills its processes if they do not."""
        for process, run in self.running.items():
            if self.time_limit and process not in self.overdue and time.monotonic() - run.began > self.time_limit:
                self.overdue.add(process)
                with contextlib.suppress(ProcessLookupError):
                    os.kill(process.pid, signal.SIGINT)

    def _interrupted(self, *_):
        """The launchers pass the first request on and wait, the second makes them kill."""
        self.interruptions += 1
        self._ask()

    def _pause(self, *_):
        """Ctrl-Z stops all runs, and all go on together."""
        self._send(signal.SIGTSTP)
        away = own_pause()
        self._send(signal.SIGCONT)
        for run in self.running.values():
            run.began += away

    def _ask(self):
        self._send(signal.SIGINT)

    def _send(self, number):
        for process in self.running:
            with contextlib.suppress(ProcessLookupError):
                os.kill(process.pid, number)

    def _end_all(self):
        """Ends what still runs when the study stops early."""
        self._ask()
        for process in self.running:
            process.wait()
