"""What the table [terms] of a study file says, and what comes of it: each alteration of the shipped case alone, its
effect measured against the case's own discretisation error. README.md describes the keys."""

import math
from dataclasses import dataclass

import study_file
import terms_output

AXIS = "alteration"
SHIPPED = "as shipped"
NOISE = 0.02  # share of the time below which two runs take the same; more if the repetitions differ by more
NEEDED, LEFT_OUT, FREE, SAVES = "needed", "below discretisation error: can be left out", "costs nothing", "saves time"
CHANGES, ADDS_NOTHING = "changes the result", "adds nothing beyond the discretisation error"


@dataclass
class Terms:
    """The table [terms]."""

    discretisation: str  # name of the run at another spacing
    ratio: float  # its spacing over the shipped one
    order: float  # error ~ spacing^order
    adds: set[str]  # alterations that add model rather than take away
    quantities: list[str] = ()  # metrics

    def units(self):
        return {}

    def figures(self, _study, _row):
        return {}

    def charts(self, study, table, folder):
        return terms_output.charts(study, effects(study, table), folder)

    def answers(self, study, table, out):
        return [terms_output.answer(study, effects(study, table), errors(study, table), out)]


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


def add_axes(table, study):
    """One axis: the case as shipped, at another spacing, and with each alteration alone."""
    line = table.document.line(table.path, "")
    values, adds = [study_file.Value(SHIPPED, {})], set()
    other = table.table("discretisation")
    if other is None:
        table.fault("[terms] needs [terms.discretisation], a run at another spacing")
        study.terms = Terms("", math.nan, 1.0, adds)
        return
    name = other.get("name", str, "at another spacing")
    values.append(study_file.Value(name, study_file.flat(other.get("set", dict))))
    ratio, order = other.get("ratio", float), other.get("order", float, 1.0)
    if ratio is not None and (not ratio > 0 or ratio == 1):
        other.fault(f"'ratio' is that run's spacing over the shipped one: above 0 and not 1, found {ratio}", "ratio")
    if not order > 0:
        other.fault(f"'order' must be above 0, found {order}", "order")
    other.close()
    for inner in table.tables("term"):
        value = study_file.Value(inner.get("name", str), study_file.flat(inner.get("set", dict)))
        if inner.get("adds", bool, False):
            adds.add(value.name)
        values.append(value)
        inner.close()
    names = [value.name for value in values]
    for twice in {n for n in names if names.count(n) > 1}:
        table.fault(f"[terms] has the name '{twice}' twice")
    if len(values) < 3:
        table.fault("[terms] needs at least one [[terms.term]]")
    if study.axes:
        table.fault("a study of terms has no other axis: each alteration runs alone")
    study.axes.append(study_file.Axis(AXIS, "", values, line))
    study.terms = Terms(name, ratio, order, adds)


def read(table, study):
    made = study.terms
    made.quantities = table.texts("quantities", allowed=[metric.name for metric in study.metrics])
    if table.has("quantities") and not made.quantities:
        table.fault("'quantities' needs at least one metric", "quantities")
    if study.timing is None:
        table.fault("a study of terms needs [timing]: it says what each costs")
    table.close()
    return made


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
