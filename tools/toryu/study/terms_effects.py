"""What each alteration of the shipped case does: its effect measured against the case's own discretisation error, and
the verdict on it."""

import math
from dataclasses import dataclass

AXIS = "alteration"
SHIPPED = "as shipped"
NOISE = 0.02  # share of the time below which two runs take the same; more if the repetitions differ by more
NEEDED, LEFT_OUT, FREE, SAVES = "needed", "below discretisation error: can be left out", "costs nothing", "saves time"
CHANGES, ADDS_NOTHING = "changes the result", "adds nothing beyond the discretisation error"


@dataclass
class Effect:
    """What one alteration does."""

    name: str
    changes: dict[str, float]  # quantity -> its change
    in_errors: dict[str, float]  # the same in units of the discretisation error, without sign
    time_saved: float  # share of the shipped case's processor time
    verdict: str
    row: dict

    @property
    def largest(self):
        """Of the changes in units of the discretisation error; nan if one has no value."""
        values = list(self.in_errors.values())
        return max(values) if values and all(map(math.isfinite, values)) else math.nan


def row_of(table, name):
    return next(row for row in table.rows if row[AXIS] == name)


def change(study, table, row, quantity):
    """From the case as shipped. A metric that is a difference from another run is a change already."""
    value = row.get(quantity, math.nan)
    metric = next(m for m in study.metrics if m.name == quantity)
    return value if metric.needs_other_runs else value - row_of(table, SHIPPED).get(quantity, math.nan)


def errors(study, table):
    """quantity -> discretisation error of the shipped case by the difference from the run at another spacing. With
    f(h) = f + C h^p that difference is C h^p (r^p - 1) (Richardson 1911)."""
    other, factor = row_of(table, study.terms.discretisation), abs(study.terms.ratio ** study.terms.order - 1)
    return {q: abs(change(study, table, other, q)) / factor for q in study.terms.quantities}


def effects(study, table):
    """Of every alteration, in the order of the file."""
    error, shipped = errors(study, table), row_of(table, SHIPPED)
    found = []
    for row in table.rows:
        if row[AXIS] in (SHIPPED, study.terms.discretisation):
            continue
        changes = {q: change(study, table, row, q) for q in study.terms.quantities}
        in_errors = {q: in_units(value, error[q]) for q, value in changes.items()}
        saved = math.nan if row["cause"] else 1 - row["processor_time"] / shipped["processor_time"]  # it ended early
        effect = Effect(row[AXIS], changes, in_errors, saved, "", row)
        effect.verdict = verdict(effect, noise(row, shipped), row[AXIS] in study.terms.adds)
        found.append(effect)
    return found


def in_units(value, error):
    """nan where there is a change but no error to measure it by."""
    return abs(value) / error if error > 0 else math.nan if value else 0.0


def noise(*rows):
    return max(NOISE, *(row["time_spread"] for row in rows if math.isfinite(row["time_spread"])))


def verdict(effect, noise_of_time, adds):
    if effect.row["cause"]:
        return f"fails: {effect.row['cause']}" if adds else f"{NEEDED}: without it the run fails"
    if not math.isfinite(effect.largest):
        return "cannot be told: a quantity or its discretisation error has no value"
    if effect.largest > 1:
        return CHANGES if adds else NEEDED
    if adds:
        return ADDS_NOTHING
    if effect.time_saved > noise_of_time:
        return LEFT_OUT
    return FREE if effect.time_saved >= -noise_of_time else SAVES
