"""The runs of a study on other machines, which share its folder: a queue takes all that are to do at once, and they are
followed by the files that they leave. A study that went away finds its runs in the queue again."""

import contextlib
import itertools
import json
import signal
import time
from dataclasses import dataclass, replace

from toryu import counted, program
from toryu.processes import BAD_INPUT, INTERRUPTED, MACHINE, PATIENCE, requests_to_end
from toryu.results_folder import newest_checkpoint
from toryu.study import runner
from toryu.study.one_run import ENDED, read_ended

QUEUE = "queue"  # folder of what was given to the queue: a table a submission
POLL = 0.5  # [s] between two looks for files of runs that ended
ASK = 3.0  # [s] between two questions to the queue
LATE = 10.0  # [s] after which the files of a run that left the queue are there, on a file system over a network too
MOST_LOSSES = 1  # of a run, after which it is given to the queue again


@dataclass
class Queued:
    """A run that the queue has."""

    setting: object
    folder: object
    job: str  # as the queue calls it
    output: object  # file of what the queue and its programs print about it
    goes_on: bool
    reached: float = 0.0  # [s] of the simulated time when it was given to the queue
    losses: int = 0
    gone_since: float | None = None  # when the queue was first heard not to know it
    first_seen: float | None = None  # when it was first seen to run


class Elsewhere(runner.Runner):
    """Runs the settings that are not done yet in `queue`, which has submit, output, alive, drop and kill, and tells whether
    it outlives the study (slurm.py, hosts.py)."""

    def __init__(self, study, out, bin_folder, threads, progress, queue, passed_on=()):
        super().__init__(study, out, bin_folder, 1, threads, progress, passed_on)
        self.queue = queue
        self.left = False  # whether the study goes away and its runs go on
        self.asked = 0.0  # when the queue was asked last

    def __call__(self, settings):
        records = self.done(settings)
        waiting = {s.key: s for s in settings if s.key not in records}
        self.progress.begin(len(settings), [r.elapsed for r in records.values()], self.queue.jobs or max(1, len(waiting)))
        old = {n: signal.signal(n, self._interrupted) for n in requests_to_end()}
        try:
            self.running = self._found_again(waiting)
            self._submit([s for key, s in waiting.items() if key not in self.running])
            while self.running and not self.interruptions and not self.left:
                for record in self._ended():
                    records[record.setting.key] = record
                    self._tell_absent(record)
                self.progress.show(len(records), self._ages())
                time.sleep(POLL)
        finally:
            if not self.left:
                self._end_all()
            for number, handler in old.items():
                signal.signal(number, handler)
            self.progress.end()
        if self.interruptions or self.left:
            rest = f"; {counted(len(self.running), 'run')} go on in the queue" if self.left else ""
            raise runner.Ended(INTERRUPTED, f"interrupted; {len(records)} of {counted(len(settings), 'run')} are done and kept"
                                            f"{rest}: the same command goes on from there")
        return [replace(records[s.key], setting=s) for s in settings]

    def _submit(self, settings, may_go_on=True, losses=0):
        """Gives runs to the queue, each going on from its checkpoint if it has one."""
        runs = []
        for setting in settings:
            folder = self.folder(setting)
            goes_on = runner.prepare(folder, may_go_on)
            for name in (ENDED, runner.OUTPUT, "stop"):
                (folder / name).unlink(missing_ok=True)
            runs.append(Queued(setting, folder, "", None, goes_on, runner.reached(folder), losses))
        jobs = []
        for part in batches(runs, self.queue.largest):
            table = {"runs": [{"key": run.setting.key, "folder": str(run.folder.resolve()), "time_limit": self.time_limit,
                               "command": self._whole_command(run.setting, run.goes_on)} for run in part]}
            path = self._next_table()
            program.write_whole(path, json.dumps(table, indent=1))
            jobs = self.queue.submit(path, len(part), jobs)
            program.write_whole(path, json.dumps(table | {"jobs": jobs}, indent=1))
            for index, (run, job) in enumerate(zip(part, jobs)):
                run.job, run.output = job, self.queue.output(path, index)
                self.running[run.setting.key] = run

    def _next_table(self):
        folder = self.out / QUEUE
        folder.mkdir(exist_ok=True)
        numbers = [int(path.stem) for path in folder.glob("*.json") if path.stem.isdigit()]
        return folder.resolve() / f"{max(numbers, default=0) + 1:04}.json"

    def _found_again(self, waiting):
        """Of the runs that wait, those that the queue still has, and those that came to a result while nobody looked."""
        found = {}
        for path in sorted((self.out / QUEUE).glob("*.json")):
            with contextlib.suppress(OSError, ValueError, KeyError, TypeError):
                table = json.loads(path.read_text(encoding="utf-8"))
                for index, (run, job) in enumerate(zip(table["runs"], table["jobs"])):
                    if setting := waiting.get(run["key"]):
                        found[setting.key] = Queued(setting, self.folder(setting), job, self.queue.output(path, index),
                                                    "--restart" in run["command"])
        alive = self.queue.alive([run.job for run in found.values()]) if found else set()
        return {key: run for key, run in found.items() if self._is_of_use(run, alive)}

    def _is_of_use(self, run, alive):
        """One that ended without a result, or whose result was taken and is no longer whole, has to run again."""
        if ended := read_ended(run.folder):
            return ended[0] in self.verdicts | {runner.HUNG} and not (run.folder / runner.RECORD).exists()
        return run.job in alive

    def _ages(self):
        now, ages = time.monotonic(), []
        for run in self.running.values():
            if run.first_seen is None and (run.folder / runner.OUTPUT).exists():
                run.first_seen = now
            if run.first_seen is not None:
                ages.append(now - run.first_seen)
        return ages

    def _ended(self):
        """Records of the runs that ended since."""
        for run in list(self.running.values()):
            if ended := read_ended(run.folder):
                del self.running[run.setting.key]
                if record := self._record_of(run, *ended):
                    yield record
        self._look_for_losses()

    def _record_of(self, run, code, elapsed):
        """Its record; None if it is given to the queue once more."""
        if code == BAD_INPUT and run.goes_on:  # its checkpoint is of no use
            return self._submit([run.setting], may_go_on=False)
        if code == INTERRUPTED:  # the queue's limit of time, as a rule
            if not newest_checkpoint(run.folder) or runner.reached(run.folder) <= run.reached:
                raise runner.Ended(MACHINE, f"the run with {run.setting} was ended by the queue before it had come any "
                                            f"further: give it more time; see {run.folder}")
            return self._submit([run.setting])
        record = self._judged(run.setting, run.folder, code, elapsed)
        runner.write_record(record)
        return record

    def _look_for_losses(self):
        """A run that the queue no longer has, and that left nothing, was cancelled or lost with its machine."""
        now = time.monotonic()
        if not self.running or now - self.asked < ASK:
            return
        self.asked = now
        alive = self.queue.alive([run.job for run in self.running.values()])
        for run in list(self.running.values()):
            if run.job in alive or read_ended(run.folder):
                run.gone_since = None
            elif run.gone_since is None:
                run.gone_since = now
            elif now - run.gone_since > LATE:
                if run.losses == MOST_LOSSES:
                    raise runner.Ended(MACHINE, f"{last_line(run.output)}the run with {run.setting} was lost {MOST_LOSSES + 1} "
                                                f"times: it left the queue as {run.job} without a word of how it ended; see "
                                                f"{run.folder} and {run.output}")
                self.progress.tell(f"{last_line(run.output)}warning: the run with {run.setting} left the queue as {run.job} "
                                   "without a word of how it ended: it runs again")
                del self.running[run.setting.key]
                self._submit([run.setting], losses=run.losses + 1)

    def _interrupted(self, number, _):
        """A terminal that goes away leaves the runs to a queue that stays."""
        if number == signal.SIGHUP and self.queue.outlives_study:
            self.left = True
        else:
            self.interruptions += 1

    def _end_all(self):
        """What waits is taken back, what runs is asked to write a checkpoint and to end, then killed."""
        jobs = [run.job for run in self.running.values()]
        if not jobs:
            return
        self.queue.drop(jobs)
        for run in self.running.values():
            if (run.folder / runner.OUTPUT).exists() and not read_ended(run.folder):
                (run.folder / "stop").touch()
        end = time.monotonic() + PATIENCE
        while self.queue.alive(jobs) and time.monotonic() < end and self.interruptions < 2:
            time.sleep(POLL)
        self.queue.kill(jobs)


def last_line(path):
    """The last line of a file with its end, "" if there is none."""
    with contextlib.suppress(OSError):
        lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
        return next((f"{line.strip()}\n" for line in reversed(lines) if line.strip()), "")
    return ""


def batches(items, size):
    items = iter(items)
    while batch := list(itertools.islice(items, size)):
        yield batch
