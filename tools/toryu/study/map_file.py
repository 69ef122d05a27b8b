"""What the table [map] of a study file says: a map of where runs fail. README.md describes the keys."""

import math
from dataclasses import dataclass, field

from toryu.study import map_results, study_file, verdicts
from toryu.study.document import found, is_number, one_of
from toryu.study.formula import Formula, read_formula

TIME_LIMIT = 600.0  # [s]


@dataclass
class Bisected:
    """The axis along which the edge of failure is looked for."""

    axis: study_file.Axis  # its values are the two sides and the grid; in the end all that ran
    stable: float
    unstable: float
    resolution: float  # the bracket ends at this share of its larger side, on a linear axis of the whole range
    grid: list[float]
    log: bool

    def first_values(self):
        return list(dict.fromkeys([self.stable, self.unstable, *self.grid]))

    def take_all_values(self, records):
        """Makes all that ran values of the axis."""
        self.axis.values = [self.axis.value_of(v) for v in sorted({r.setting.values[self.axis.name] for r in records})]


@dataclass
class Wrong:
    """A metric beyond what it may be: the run ended well, its result is wrong."""

    metric: str
    at_most: float
    at_least: float


@dataclass
class Theory:
    """A curve of the edge by theory."""

    label: str
    y: Formula  # of x and of the constants
    constants: dict[str, float]
    edge: object  # the value of the axis `edges` that it is for; None: for all
    source: str

    def __call__(self, x):
        return self.y(x=x, **self.constants) if is_number(x) else math.nan


@dataclass
class Map:
    """The table [map]."""

    y: Bisected | None  # None: a map over two axes with listed values
    x_name: str = ""
    y_name: str = ""
    edges: str | None = None  # the axis of choices, an edge each; of a map over two axes its panels
    log: list[str] = field(default_factory=list)
    time_limit: float = TIME_LIMIT
    wrong: list[Wrong] = field(default_factory=list)
    theories: list[Theory] = field(default_factory=list)
    explanation: str = ""
    figure: str | None = None  # a metric that is written into the cells of a map over two axes

    def units(self):
        return {"verdict": "", "detected_at": "s"}

    def figures(self, study, row):
        verdict = verdicts.judge(study, row)
        row["cause"] = verdict.why
        return {"verdict": verdict.kind, "detected_at": verdict.detected_at}

    def charts(self, study, table, folder):
        from toryu.study import map_charts

        return map_charts.draw(study, table, folder)

    def answers(self, study, table, out):
        return map_results.answers(study, table, out)


def add_axes(table, study):
    """`y` is a table of an axis to bisect, or names an axis with listed values."""
    if not isinstance(table.content.get("y"), dict):
        study.map = Map(None)
        return
    inner = table.table("y")
    line = table.document.line(inner.path, "")
    name, unit, rule = inner.label(), inner.unit(), study_file.read_rule(inner)
    stable, unstable = inner.get("stable", float), inner.get("unstable", float)
    resolution, grid = inner.get("resolution", float, 0.05), inner.get("grid", list, [])
    given = [v for v in (stable, unstable) if v is not None]
    study_file.check_values(inner, rule, given, "stable")
    if not all(map(is_number, grid)):
        inner.fault(f"'grid' must be finite numbers, found {found(grid)}", "grid")
        grid = []
    elif not study_file.check_values(inner, rule, grid, "grid"):
        grid = []
    if len(given) == 2 and stable == unstable:
        inner.fault(f"'stable' and 'unstable' must differ, both are {stable}", "unstable")
    if not 0 < resolution < 1:
        inner.fault(f"'resolution' must be between 0 and 1, found {resolution}", "resolution")
    log = inner.get("log", bool, len(given) == 2 and min(given) > 0)
    if log and len(given) == 2 and min(given) <= 0:
        inner.fault("'log' needs both sides above 0", "log")
    for value in grid if len(given) == 2 else []:
        if not min(given) <= value <= max(given):
            inner.fault(f"'grid' must lie between 'stable' and 'unstable', found {value}", "grid")
    inner.close()
    first = dict.fromkeys([*given, *grid])
    axis = study_file.Axis(name, unit, [rule(v) for v in first] if rule.keys or rule.derived else [], line, rule)
    study.axes.append(axis)
    study.map = Map(Bisected(axis, stable, unstable, resolution, grid, log), y_name=name)


def read(table, study):
    made, y = study.map, study.map.y
    axes = {axis.name: axis for axis in study.axes if y is None or axis is not y.axis}
    made.x_name = table.get("x", str, allowed=axes)
    if y is None:
        made.y_name = table.get("y", str, allowed=axes)
        made.figure = table.get("figure", str, None, allowed=[m.name for m in study.metrics])
    made.edges = table.get("edges", str, None, allowed=axes)
    made.log = table.texts("log", [], allowed=["x"] if y else [])
    made.time_limit = table.get("time_limit", float, TIME_LIMIT)
    made.explanation = (table.get("explanation", str) or "").strip()
    if not made.time_limit > 0:
        table.fault(f"'time_limit' must be above 0 s, found {made.time_limit}", "time_limit")
    if y and made.x_name in axes and not all(is_number(v.name) for v in axes[made.x_name].values):
        table.fault(f"'x' must be an axis of numbers where y is bisected, found '{made.x_name}'; choices go to 'edges'",
                    "x")
    if study.timing:
        table.fault("a map cannot be timed: leave [timing] out")
    free = [name for name in axes if name not in (made.x_name, made.y_name, made.edges)]
    if free:
        table.fault(f"the map leaves the axis '{free[0]}' open: give it as 'x', {'' if y else repr('y') + ' '}or 'edges'")
    made.wrong = [_wrong(inner, study) for inner in table.tables("wrong")]
    made.theories = [_theory(inner, made, axes) for inner in table.tables("theory")]
    table.close()
    return made


def _wrong(table, study):
    alone = [m.name for m in study.metrics if not m.needs_other_runs]
    rule = Wrong(table.get("metric", str, allowed=alone), table.get("at_most", float, math.inf),
                 table.get("at_least", float, -math.inf))
    if not (table.has("at_most") or table.has("at_least")):
        table.fault(f"{table.name} needs 'at_most' or 'at_least'")
    table.close()
    return rule


def _theory(table, made, axes):
    constants = table.get("constants", dict, {})
    for name, value in constants.items():
        if not is_number(value):
            table.fault(f"'constants' must be numbers, found {name} = {value}", "constants")
    label, source = table.label("label"), table.get("source", str, "")
    text = read_formula(table, "y", ["x", *constants])
    edge = None
    if table.has("edge"):
        names = [v.name for v in axes[made.edges].values] if made.edges in axes else []
        edge = table.content["edge"]
        table.known.append("edge")
        if edge not in names:
            table.fault(f"'edge' must be a value of the axis that 'edges' names, {one_of(names)}, found {edge}", "edge")
    table.close()
    return Theory(label, text, constants, edge, source)
