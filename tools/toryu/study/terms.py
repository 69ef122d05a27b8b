"""What the table [terms] of a study file says: each alteration of the shipped case runs alone. README.md describes the
keys."""

import math
from dataclasses import dataclass

from toryu.study import study_file, terms_output
from toryu.study.terms_effects import AXIS, SHIPPED, effects, errors


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


def add_axes(table, study):
    """One axis: the case as shipped, at another spacing, and with each alteration alone."""
    line = table.document.line(table.path, "")
    values, adds = [study_file.Value(SHIPPED, {})], set()
    other = table.table("discretisation")
    if other is None:
        table.fault("[terms] needs [terms.discretisation], a run at another spacing")
        study.terms = Terms("", math.nan, 1.0, adds)
        return
    name = other.label() if other.has("name") else "at another spacing"
    values.append(study_file.Value(name, study_file.flat(other.get("set", dict))))
    ratio, order = other.get("ratio", float), other.get("order", float, 1.0)
    if ratio is not None and (not ratio > 0 or ratio == 1):
        other.fault(f"'ratio' is that run's spacing over the shipped one: above 0 and not 1, found {ratio}", "ratio")
    other.known.append("name")
    if not order > 0:
        other.fault(f"'order' must be above 0, found {order}", "order")
    other.close()
    for inner in table.tables("term"):
        value = study_file.Value(inner.label(), study_file.flat(inner.get("set", dict)))
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
