"""What became of a run of a map: stable, or how it was not."""

import math
from dataclasses import dataclass

from toryu import results
from toryu.processes import BAD_INPUT, PHYSICS_FAILED
from toryu.study import metrics
from toryu.study.runner import HUNG

STABLE, UNSTABLE, WRONG, REFUSED, HANGS = "stable", "unstable", "wrong", "refused", "hung"
WORDS = {STABLE: "ran to its end, nothing is wrong", UNSTABLE: "ended by the program, which says why (exit code 3)",
         WRONG: "ran to its end, and a figure is not as it must be", REFUSED: "refused at the start (exit code 2)",
         HANGS: "had not ended at the time limit"}


@dataclass
class Verdict:
    kind: str
    why: str
    detected_at: float  # simulated time [s] at which the program saw the failure


def judge(study, row):
    """`row`: of a table, with its metrics."""
    record = row["record"]
    if record.exit_code == HUNG:
        return Verdict(HANGS, record.cause, math.nan)
    if record.exit_code == BAD_INPUT:
        return Verdict(REFUSED, record.cause, 0.0)
    if record.exit_code == PHYSICS_FAILED:
        return Verdict(UNSTABLE, record.cause, detected_at(record))
    wrong = "; ".join(filter(None, [*(broken(rule, row) for rule in study.map.wrong), no_number(study, record)]))
    return Verdict(WRONG, wrong, math.nan) if wrong else Verdict(STABLE, "", math.nan)


def judge_alone(study, record):
    """Whether a run is stable, before the other rows of the table are there."""
    row = record.setting.values | {"record": record, "cause": record.cause}
    metrics.fill(study, [row])
    return judge(study, row).kind == STABLE


def broken(rule, row):
    """How the metric breaks the rule, "" if it does not."""
    value = row.get(rule.metric, math.nan)
    if not math.isfinite(value):
        return f"{rule.metric} has no value"
    if value > rule.at_most:
        return f"{rule.metric} is {value:.4g}, more than {rule.at_most:g}"
    return f"{rule.metric} is {value:.4g}, less than {rule.at_least:g}" if value < rule.at_least else ""


def no_number(study, record):
    series = metrics.non_finite(study, record)
    return f"{series} holds values that are no numbers" if series else ""


def detected_at(record):
    summaries = results.read_summaries(record.folder).values()
    return min((s["simulated_time"] for s in summaries if s.get("exit_code") == PHYSICS_FAILED), default=math.nan)
