"""What a study file says: the case, the axes, what is taken and drawn. README.md describes the keys."""

import math
import os
import pathlib
from collections.abc import Callable
from dataclasses import dataclass, field

from toryu.case import BadCase, resolve
from toryu.study import chart_file, metric_file, timing
from toryu.study.document import BadStudy, Document, did_you_mean, found, is_label, is_number, one_of
from toryu.study.metric_file import OF_RUN
from toryu.study.timing import Timing


MOST_RUNS = 100_000  # of a study


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
    value_of: Callable | None = None  # number -> Value, of an axis of numbers
    default: str | None = None  # the value of charts that leave the axis open; not said of a setting that has it


@dataclass
class Study:
    path: pathlib.Path
    file_name: str  # what its results are called by
    text: str
    title: str
    case: pathlib.Path
    kind: str  # of the case, as
    content: dict  # what it says
    references: list[dict]  # and its references are resolved
    inputs: list[pathlib.Path]  # files that were read
    coupler: pathlib.Path  # what reads a case
    overrides: dict[str, object]
    set_line: int | None  # where the file gives them
    keep_frames: bool
    axes: list[Axis]
    metrics: list[metric_file.Metric]
    charts: list[chart_file.Chart]
    leave_out: list[dict[str, list]] = field(default_factory=list)  # combinations of axes' values that do not run
    timing: Timing | None = None
    small: bool = False  # the small version that [small] describes
    removal: object = None  # the tables of special views: removal.py,
    map: object = None  # map_file.py,
    terms: object = None  # terms.py,
    recession: object = None  # recession.py
    calibration: object = None  # calibration.py

    @property
    def name(self):
        return self.file_name + ("_small" if self.small else "")

    @property
    def about_axis(self):
        """Whether the scene of the case is axisymmetric."""
        said = self.content.get("case", {})
        return self.overrides.get("case.geometry", said.get("geometry") if isinstance(said, dict) else None) == "axisymmetric"

    def names_in_case(self, table, key):
        """What the [[table]] of the case have under `key`."""
        items = self.content.get(table, [])
        tables = [item for item in items if isinstance(item, dict)] if isinstance(items, list) else []
        return [item[key] for item in tables if isinstance(item.get(key), str)]

    def of_run(self):
        """Name -> unit of the times that every run has."""
        return OF_RUN | (timing.UNITS if self.timing else {})

    @property
    def searched(self):
        """What looks for the next runs where these depend on how others ended, else None."""
        return self.recession or self.calibration or (self.map and self.map.y)

    def units(self):
        return {thing.name: thing.unit for thing in [*self.axes, *self.metrics]} | self.of_run()


def flat(content, prefix=""):
    """{"a": {"b": 1}} and {"a.b": 1} -> {"a.b": 1}: a dotted key may be quoted or not. None, of a fault, is empty."""
    pairs = {}
    for key, value in (content or {}).items():
        if isinstance(value, dict) and value:
            pairs |= flat(value, f"{prefix}{key}.")
        else:
            pairs[prefix + key] = value
    return pairs


@dataclass(frozen=True)
class View:
    """A kind of study, declared by the table `key` of the file. `read` takes the table and the study and returns an object
    with `units()`, `figures(study, row)`, `charts(study, table, folder)` and `answers(study, table, out)`."""

    key: str
    read: Callable
    add_axes: Callable | None = None  # takes the same; adds the axes that the view brings along


def read(path, coupler, views=(), small=False):
    """The study in `path`, or its small version; `coupler` reads it and its case."""
    document = Document(path, coupler)
    try:
        study = _read(document, coupler, views, small)
    except Exception:
        document.end()  # a fault that is told may leave what follows without sense
        raise
    document.end()
    return study


def _read_case(head, folder, coupler):
    """The case of the study, None after a fault."""
    name = head.get("case", str)
    if name is None:
        return None
    case = folder / name
    if not os.path.isfile(case):
        head.fault(f"'case' must be a case file beside the study, found '{case}', which is no file", "case")
        return None
    try:
        resolved = resolve(case, coupler)
    except BadCase as error:
        raise BadStudy(str(error)) from None
    if resolved.kind in ("study", "empty"):
        head.fault(f"'case' must be a case file beside the study, found '{case}', which " + (
            "is a study" if resolved.kind == "study" else "has no section [fluid] and no section [solid]"), "case")
        return None
    return resolved


def _read(document, coupler, views, small):
    root, path = document.root(), document.path
    head = root.table("study")
    if head is None:
        document.end()
        raise BadStudy(f"{path}: error: no table [study]")
    case = _read_case(head, path.parent, coupler)
    told = (case.file, case.kind, case.content, case.references, case.inputs) if case else (path, "empty", {}, [], [])
    study = Study(path, document.name, document.text, head.get("title", str), *told, coupler,
                  flat(head.get("set", dict, {})), document.line(head.path, "set"), head.get("keep_frames", bool, False),
                  [], [], [], small=small)
    study.inputs = [path, *study.inputs]
    head.close()
    study.axes = [_axis(table) for table in root.tables("axis")]
    study.leave_out = [_leave_out(table, study.axes) for table in root.tables("leave_out")]
    study.timing = timing.read(root.table("timing"))
    tables = {view: table for view in views if (table := root.table(view.key)) is not None}
    for view, table in tables.items():
        if view.add_axes:
            view.add_axes(table, study)
    for table in root.tables("metric"):
        study.metrics.append(metric_file.read(table, study, study.metrics))
    _check_names(document, study)
    extra = {}
    for view, table in tables.items():
        made = view.read(table, study)
        setattr(study, view.key, made)
        extra |= made.units()
        for name in sorted(study.units().keys() & made.units().keys()):
            document.fault(f"[{view.key}] has a figure '{name}' of its own: the axis or metric needs another name")
    study.charts = [chart_file.read(table, study, extra) for table in root.tables("chart")]
    _read_small(root.table("small"), study)
    root.close()
    _check_size(document, study)
    return study


def _axis(table):
    line = table.document.line(table.path, "")
    name, unit = table.label(), table.unit()
    value_of, given = None, []
    if table.has("choice"):
        values = [_choice(choice) for choice in table.tables("choice")]
    else:
        value_of, given = read_rule(table), table.get("values", list, [])
        values = [value_of(v) for v in given] if check_values(table, value_of, given) else []
    if not values and not given:
        table.fault(f"{table.name} needs 'values' with 'keys', or [[axis.choice]]")
    names = [value.name for value in values]
    for twice in {n for n in names if names.count(n) > 1}:
        table.fault(f"{table.name} has the value {twice} twice", "values")
    table.close()
    return Axis(name, unit, values, line, value_of)


def _leave_out(table, axes):
    """Axis -> values: a combination that matches all of them does not run."""
    rule = {}
    for axis in axes:
        if table.has(axis.name):
            table.known.append(axis.name)
            given = table.content[axis.name]
            rule[axis.name] = given if isinstance(given, list) else [given]
            for value in rule[axis.name]:
                if value not in (names := [v.name for v in axis.values]):
                    table.fault(f"'{axis.name}' must be one or some of {names}, found {value}", axis.name)
    if not rule:
        table.fault(f"{table.name} names no axis; there are {one_of(axis.name for axis in axes)}")
    table.close()
    return rule


def _choice(table):
    value = Value(table.label(), flat(table.get("set", dict, {})))
    table.close()
    return value


@dataclass
class Rule:
    """How a number is set in the case: every key takes it, every derived key scale * number^power."""

    keys: list[str]
    derived: list[tuple[list[str], float, float]]  # keys, scale, power

    def __call__(self, value):
        return Value(value, {key: value for key in self.keys} |
                     {key: scale * value ** power for inner, scale, power in self.derived for key in inner})


    def reaches(self, value):
        """Whether all that derives from the value is finite."""
        try:
            return all(map(math.isfinite, (scale * value ** power for _, scale, power in self.derived)))
        except ArithmeticError:
            return False


def read_rule(table):
    keys, derived = table.texts("keys", []), []
    for rule in table.tables("derived"):
        derived.append((rule.texts("keys"), rule.get("scale", float, 1.0), rule.get("power", float, 1.0)))
        rule.close()
    return Rule(keys, derived)


def check_values(table, rule, values, key="values"):
    """Whether the rule can take the values; tells what it cannot."""
    if values and not (rule.keys or rule.derived):
        table.fault(f"{table.name} needs 'keys', the keys of the case that take its values")
    for value in values:
        text = isinstance(value, str) and is_label(value) and not rule.derived
        if not is_number(value) and not text:
            table.fault(f"'{key}' must be {'' if rule.derived else 'texts or '}finite numbers, found {found(value)}", key)
            return False
        if rule.derived and not value > 0:
            table.fault(f"'{key}' must be above 0 where other keys derive from them, found {value}", key)
            return False
        if not rule.reaches(value):
            table.fault(f"the keys that derive from '{key}' get no finite number from {value}", key)
            return False
    return True


def _check_size(document, study):
    """Each key can be given to a program, and the runs can be counted."""
    keys = set(study.overrides).union(*(value.overrides for axis in study.axes for value in axis.values))
    for key in sorted(keys):
        if not is_label(key) or "=" in key:
            document.fault(f"{key!r:.100} is no key of a case")
    runs = math.prod([study.timing.repeat if study.timing else 1, *(len(axis.values) for axis in study.axes)])
    if runs > MOST_RUNS:
        document.fault(f"the axes give {runs} runs; at most {MOST_RUNS} can be done")


def _check_names(document, study):
    names = [thing.name for thing in [*study.axes, *study.metrics] if thing.name is not None]
    of_run = study.of_run()
    for name in sorted({n for n in names if names.count(n) > 1 or n in of_run}):
        document.fault(f"the name '{name}' is taken twice by axes and metrics ({one_of(of_run)} are always there)")
    taken = {}
    for axis in study.axes:
        for key in {key for value in axis.values for key in value.overrides}:
            if taken.setdefault(key, axis) is not axis:
                document.fault(f"'{key}' is set by the axes '{taken[key].name}' and '{axis.name}': a run can have one "
                               "value only")
    if not study.axes:
        document.fault("a study needs at least one [[axis]]")


def names_of(axis):
    return [value.name for value in axis.values]


def _read_small(table, study):
    """[small]: what makes the study small enough for a test. It takes effect if the small version was asked for."""
    if table is None:
        if study.small:
            raise BadStudy(f"{study.path}: error: no table [small], which says what --small runs")
        return
    axes = {axis.name: axis for axis in study.axes}
    overrides, chosen = flat(table.get("set", dict, {})), table.get("values", dict, {})
    repeat, resolution = table.get("repeat", int, None), table.get("resolution", float, None)
    if repeat is not None and repeat < 1:
        table.fault(f"'repeat' must be at least 1, found {repeat}", "repeat")
    if resolution is not None and not 0 < resolution < 1:
        table.fault(f"'resolution' must be between 0 and 1, found {resolution}", "resolution")
    for name, values in chosen.items():
        if name not in axes:
            table.fault(f"'values' names no axis '{name}'{did_you_mean(name, axes)}; there are {one_of(axes)}", "values")
        elif not isinstance(values, list) or not values or any(v not in names_of(axes[name]) for v in values):
            table.fault(f"'values' must list some values of the axis '{name}', {names_of(axes[name])}, found {values}",
                        "values")
        elif study.small:
            axes[name].values = [v for v in axes[name].values if v.name in values]
    table.close()
    if study.small:
        study.overrides |= overrides
        if study.timing and repeat:
            study.timing.repeat = repeat
        if study.map and study.map.y and resolution:
            study.map.y.resolution = resolution
