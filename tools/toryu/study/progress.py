"""One line on standard error: how many runs are done, how many run, how much time is left."""

import sys
import time

from toryu import counted


def duration(seconds):
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    return f"{whole // 60} min {whole % 60} s" if whole < 3600 else f"{whole // 3600} h {whole % 3600 // 60} min"


class Progress:
    """Rewritten in place on a terminal; otherwise a line for each run that ends."""

    def __init__(self, stream=None):
        self.stream = stream or sys.stderr
        self.terminal = self.stream.isatty()
        self.last = 0.0

    def begin(self, total, known, jobs):
        """`known`: what the runs that are done took [s]."""
        self.total, self.jobs = total, jobs
        self.kept, self.known_before = len(known), sum(known)
        self.done, self.began, self.spent = len(known), time.monotonic(), 0.0
        kept = f", {self.kept} of them done before" if self.kept else ""
        if total > self.kept:
            print(f"{counted(total, 'run')}{kept}; {jobs} at a time", file=self.stream)

    def left(self, running):
        """Time left [s] if the others take as long as those that are done, or None. `running`: ages [s]."""
        here = self.done - self.kept
        if not self.done:
            return None
        mean = (self.known_before + self.spent) / self.done
        if here:  # this session's pace knows what else the machine does
            mean = self.spent / here
        rest = (self.total - self.done) * mean - sum(min(age, mean) for age in running)
        return max(0.0, rest) / min(self.jobs, max(1, self.total - self.done))

    def show(self, done, running):
        now = time.monotonic()
        news = done > self.done
        if news:
            self.done = done
            self.spent = (now - self.began) * self.jobs - sum(running)
        if not (news or (self.terminal and now - self.last > 0.2)):
            return
        self.last = now
        left = self.left(running)
        text = (f"{done} of {counted(self.total, 'run')} done, {len(running)} running, "
                f"{'unknown time' if left is None else duration(left)} left")
        print(f"\r{text}\x1b[K" if self.terminal else text, end="" if self.terminal else "\n", file=self.stream,
              flush=True)

    def tell(self, sentence):
        """A line of its own."""
        print(f"\r\x1b[K{sentence}" if self.terminal else sentence, file=self.stream, flush=True)

    def end(self):
        if self.terminal and self.last:
            print(file=self.stream)
