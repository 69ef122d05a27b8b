"""What a study file says: the case, the axes, the metrics, the charts. README.md describes the keys."""

import math
import pathlib
from dataclasses import dataclass, field

import results
from document import BadStudy, Document, did_you_mean, is_number, one_of
from settings import content_of

TAKES = ("last", "largest", "smallest", "peak", "mean", "rms")
OF_RUN = {"wall_time": "s", "processor_time": "s", "simulated_time": "s", "steps": ""}
SOURCES = ("series", "summary", "run", "reference")


@dataclass(frozen=True)
class Value:
    """One value of an axis and what it sets in the case."""

    name: float | str
    overrides: dict[str, object]


@dataclass
class Axis:
    name: str
    unit: str
    values: list[Value]
    line: int | None  # of the file, for faults that the programs find


@dataclass
class Metric:
    """A figure of a run. One of the sources is given."""

    name: str
    unit: str
    scale: float
    series: str | None = None  # "fluid.csv:front_x[m]"
    take: str = "last"
    shares: list[float] = field(default_factory=lambda: [0.0, 1.0])  # of the simulated time
    summary: str | None = None  # "fluid.figures.largest_speed"
    run: str | None = None  # one of OF_RUN
    reference: str | None = None  # label of a [[reference]] of the case: the distance to it


@dataclass
class Chart:
    title: str
    x: str
    y: str
    colour: str | None  # the metric of a heat map
    lines: str | None
    panels: str | None
    at: dict[str, float | str]  # the other axes
    log: list[str]


@dataclass
class Study:
    path: pathlib.Path
    text: str
    title: str
    case: pathlib.Path
    overrides: dict[str, object]
    set_line: int | None  # where the file gives them
    keep_frames: bool
    axes: list[Axis]
    metrics: list[Metric]
    charts: list[Chart]
    removal: object = None  # the table [removal], read by removal.py

    @property
    def name(self):
        return results.case_name(self.path)

    def names_in_case(self, table, key):
        """What the [[table]] of the case have under `key`; none if the case is no TOML, which the programs will tell."""
        content = content_of(self.case) if self.case.is_file() else {}
        items = content.get(table, []) if isinstance(content, dict) else []
        return [item[key] for item in items if key in item] if isinstance(items, list) else []

    def units(self):
        return {thing.name: thing.unit for thing in [*self.axes, *self.metrics]} | OF_RUN


def flat(content, prefix=""):
    """{"a": {"b": 1}} and {"a.b": 1} -> {"a.b": 1}: a dotted key may be quoted or not."""
    pairs = {}
    for key, value in content.items():
        if isinstance(value, dict) and value:
            pairs |= flat(value, f"{prefix}{key}.")
        else:
            pairs[prefix + key] = value
    return pairs


def read(path, views=()):
    """The study in `path`. `views`: (key, reader) of the tables that special views declare; a reader takes the table and
    the study."""
    document = Document(path)
    root = document.root()
    head = root.table("study")
    if head is None:
        raise BadStudy(f"{path}: error: no table [study]")
    case = path.parent / (head.get("case", str) or "")
    if head.has("case") and not case.is_file():
        head.fault(f"'case' must be a case file beside the study, found '{case}', which is no file", "case")
    study = Study(path, document.text, head.get("title", str), case, flat(head.get("set", dict, {})),
                  document.line(head.path, "set"), head.get("keep_frames", bool, False), [], [], [])
    head.close()
    study.axes = [_axis(table) for table in root.tables("axis")]
    study.metrics = [_metric(table, study) for table in root.tables("metric")]
    _check_names(document, study)
    extra = {}
    for key, reader in views:
        if (table := root.table(key)) is not None:
            setattr(study, key, reader(table, study))
            extra |= getattr(study, key).units()
            for name in sorted(study.units().keys() & extra.keys()):
                document.fault(f"[{key}] has a figure '{name}' of its own: the axis or metric needs another name")
    study.charts = [_chart(table, study, extra) for table in root.tables("chart")]
    root.close()
    document.end()
    return study


def _axis(table):
    line = table.document.line(table.path, "")
    name, unit = table.get("name", str), table.get("unit", str, "")
    if table.has("choice"):
        values = [_choice(choice) for choice in table.tables("choice")]
    else:
        values = _values(table)
    if not values:
        table.fault(f"{table.name} needs 'values' with 'keys', or [[axis.choice]]")
    names = [value.name for value in values]
    for twice in {n for n in names if names.count(n) > 1}:
        table.fault(f"{table.name} has the value {twice} twice", "values")
    table.close()
    return Axis(name, unit, values, line)


def _choice(table):
    value = Value(table.get("name", str), flat(table.get("set", dict, {})))
    table.close()
    return value


def _values(table):
    """Every key takes the value, every derived key scale * value^power."""
    values, keys = table.get("values", list, []), table.texts("keys", [])
    if values and not keys:
        table.fault(f"{table.name} needs 'keys', the keys of the case that take its values")
    derived = []
    for rule in table.tables("derived"):
        derived.append((rule.texts("keys"), rule.get("scale", float, 1.0), rule.get("power", float, 1.0)))
        rule.close()
    for value in values:
        if not (is_number(value) and math.isfinite(value)) and (derived or not isinstance(value, str)):
            table.fault(f"'values' must be {'' if derived else 'texts or '}finite numbers, found {value}", "values")
            return []
        if derived and not value > 0:
            table.fault(f"'values' must be above 0 where other keys derive from them, found {value}", "values")
            return []
    return [Value(value, {key: value for key in keys} |
                  {key: scale * value ** power for inner, scale, power in derived for key in inner})
            for value in values]


def _metric(table, study):
    name, scale = table.get("name", str), table.get("scale", float, 1.0)
    given = [source for source in SOURCES if table.has(source)]
    if len(given) != 1:
        table.fault(f"{table.name} needs one of {one_of(SOURCES)}, found {one_of(given) if given else 'none'}")
    metric = Metric(name, table.get("unit", str, ""), scale)
    metric.summary, metric.reference = table.get("summary", str, None), table.get(
        "reference", str, None, allowed=study.names_in_case("reference", "label"))
    metric.run = table.get("run", str, None, allowed=OF_RUN)
    if series := table.get("series", str, None):
        metric.series = series
        metric.take = table.get("take", str, "last", allowed=TAKES)
        metric.shares = table.numbers("shares", 2, [0.0, 1.0])
        if metric.shares[0] < 0 or metric.shares[1] > 1:
            table.fault(f"'shares' must be from 0 to 1, found {metric.shares}", "shares")
        if ".csv:" not in series:
            table.fault(f"'series' must be FILE.csv:COLUMN, such as 'fluid.csv:front_x[m]', found '{series}'", "series")
        metric.unit = metric.unit or results.unit_of(series)
    metric.unit = metric.unit or OF_RUN.get(metric.run, "")
    table.close()
    return metric


def _check_names(document, study):
    names = [thing.name for thing in [*study.axes, *study.metrics] if thing.name is not None]
    if "" in names:
        document.fault("the name of an axis or metric must not be empty")
    for name in sorted({n for n in names if names.count(n) > 1 or n in OF_RUN}):
        document.fault(f"the name '{name}' is taken twice by axes and metrics ({one_of(OF_RUN)} are always there)")
    taken = {}
    for axis in study.axes:
        for key in {key for value in axis.values for key in value.overrides}:
            if taken.setdefault(key, axis) is not axis:
                document.fault(f"'{key}' is set by the axes '{taken[key].name}' and '{axis.name}': a run can have one "
                               "value only")
    if not study.axes:
        document.fault("a study needs at least one [[axis]]")


def _chart(table, study, extra):
    """`extra`: name -> unit of the metrics that special views add."""
    axes = {axis.name: axis for axis in study.axes}
    all_names = [*study.units(), *extra]
    figures = [name for name in all_names if name not in axes]
    colour = table.get("colour", str, None, allowed=figures)
    x = table.get("x", str, allowed=axes if colour else all_names)
    y = table.get("y", str, allowed=axes if colour else figures)
    chart = Chart(table.get("title", str, None), x, y, colour,
                  None if colour else table.get("lines", str, None, allowed=axes),
                  table.get("panels", str, None, allowed=axes), table.get("at", dict, {}),
                  table.texts("log", [], allowed=["x", "y", "colour"] if colour else ["x", "y"]))
    for name, value in chart.at.items():
        if name not in axes:
            table.fault(f"'at' names no axis '{name}'{did_you_mean(name, axes)}; there are {one_of(axes)}", "at")
        elif value not in (names := [v.name for v in axes[name].values]):
            table.fault(f"'at' must name a value of the axis '{name}', one of {names}, found {value}", "at")
    free = [name for name in axes if name not in (x, y, chart.lines, chart.panels, *chart.at)]
    if x in axes and free:
        table.fault(f"the chart leaves the axis '{free[0]}' open: draw it as 'lines' or 'panels', or choose one value, "
                    f"at = {{ {free[0]} = ... }}")
    chart.title = chart.title or results.readable(colour or y or "")
    table.close()
    return chart
