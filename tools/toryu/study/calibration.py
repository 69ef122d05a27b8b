"""Parameters of a case from measurements: what the table [calibration] of a study file says. README.md describes the
keys."""

import math
from dataclasses import dataclass, field

import numpy as np

from toryu.processes import DONE
from toryu.study import calibration_output, study_file
from toryu.study.calibration_depths import Coupon, read_coupon
from toryu.study.chart_file import conditions
from toryu.study.document import found
from toryu.study.least_squares import Fit
from toryu.study.removed_depth import LAWS

LOG_STEP, STEP = 0.1, 0.02  # for derivatives, by default: of the value with `log`, else of the range
EXACT_STEP = 1e-4  # the same for what needs no run


@dataclass
class Parameter:
    """Something of the case that is to be found."""

    axis: study_file.Axis  # its values are those that ran
    keys: list[str]  # of the case, which take its value
    start: float
    bounds: tuple[float, float]
    log: bool  # it is fitted by its logarithm
    step: float | None  # by how much it is changed for derivatives, as a share of the value if log
    law: str | None = None  # the depth in surface.h5 that is proportional to it while nothing else depends on it

    @property
    def name(self):
        return self.axis.name

    def scaled(self, value):
        return math.log(value) if self.log else value

    def value(self, scaled):
        """With as many digits as matter, so that every machine makes the same runs of it."""
        return float(f"{math.exp(scaled) if self.log else float(scaled):.8g}")

    def scaled_step(self):
        low, high = map(self.scaled, self.bounds)
        if self.law:
            return EXACT_STEP * (1 if self.log else high - low)
        return self.step or (LOG_STEP if self.log else STEP * (high - low))


@dataclass
class Datum:
    """A measured value."""

    name: str
    unit: str
    measured: float
    scatter: float  # its standard deviation
    at: dict  # value of each axis that is no parameter
    metric: str | None = None  # which computes it; else
    coupon: Coupon | None = None  # whose depth it is at
    place: float = math.nan  # along its face [m]


@dataclass
class Calibration:
    """The table [calibration]."""

    parameters: list[Parameter]
    data: list[Datum] = field(default_factory=list)
    fit: Fit | None = None
    computed: np.ndarray | None = None  # of each datum, by the fitted parameters
    failure: str = ""  # why there is no result
    failed_code: int = DONE

    def take_all_values(self, records):
        """Makes all that ran values of the axes."""
        for parameter in self.parameters:
            ran = sorted({record.setting.values[parameter.name] for record in records})
            parameter.axis.values = [parameter.axis.value_of(value) for value in ran or [parameter.start]]

    def units(self):
        return {}

    def is_new(self, _):
        return True

    def faults(self, case):
        """Of the coupons, whose tables are in the file."""
        return [(datum.coupon.line(key), words) for datum in self.data if datum.coupon
                for key, words in datum.coupon.faults(case, datum.place)]

    def figures(self, _study, _row):
        return {}

    def charts(self, _study, _table, folder):
        from toryu.study import calibration_charts

        return calibration_charts.draw(self, folder) if self.fit else []

    def answers(self, study, _table, out):
        return calibration_output.answers(self, study, out)


def add_axes(table, study):
    """An axis for each parameter."""
    parameters = [_parameter(inner) for inner in table.tables("parameter")]
    if not parameters:
        table.fault("[calibration] needs at least one [[calibration.parameter]]")
    for parameter in parameters:
        for key in parameter.keys:
            if key in study.overrides:
                table.fault(f"'{key}' is fitted, and 'set' of [study] gives it: it can have one value only")
    study.axes += [parameter.axis for parameter in parameters]
    study.calibration = Calibration(parameters)


def _parameter(table):
    line = table.document.line(table.path, "")
    name, unit, keys = table.label(), table.unit(), table.texts("keys")
    if table.has("keys") and not keys:
        table.fault("'keys' needs at least one key of the case", "keys")
    bounds, log = table.numbers("bounds", 2), table.get("log", bool, False)
    start, step = table.get("start", float), table.get("step", float, None)
    if not table.has("bounds"):
        table.fault(f"{table.name} needs 'bounds', 2 ascending numbers")
    if bounds and bounds[0] == bounds[1]:
        table.fault(f"'bounds' must differ, found {found(bounds)}", "bounds")
        bounds = None
    if bounds and log and bounds[0] <= 0:
        table.fault(f"'bounds' must be above 0 where 'log' is true, found {found(bounds)}", "bounds")
        bounds = None
    if bounds and start is not None and not bounds[0] <= start <= bounds[1]:
        table.fault(f"'start' must lie within the bounds {found(bounds)}, found {found(start)}", "start")
    if step is not None and not step > 0:
        table.fault(f"'step' must be above 0, found {found(step)}", "step")
    table.close()
    rule = study_file.Rule(keys, [])
    axis = study_file.Axis(name, unit, [] if start is None else [rule(float(start))], line, rule)
    return Parameter(axis, keys, float(start or 0), tuple(bounds or (0.0, 1.0)), log, step)


def read(table, study):
    made = study.calibration
    others = {axis.name: axis for axis in study.axes if axis not in [p.axis for p in made.parameters]}
    alone = {metric.name: metric for metric in study.metrics if not metric.needs_other_runs}
    for inner in table.tables("measured"):
        name, measured = inner.get("metric", str, allowed=alone), inner.get("value", float)
        scatter, at = _scatter(inner), _at(inner, others)
        inner.close()
        if name in alone and measured is not None and scatter:
            made.data.append(Datum(name, alone[name].unit, measured, scatter, at, metric=name))
    for inner in table.tables("depth"):
        at = _at(inner, others)
        coupon, rows = read_coupon(inner, study)
        inner.close()
        made.data += [Datum(f"depth at {place:g} m", "m", depth, scatter, at, coupon=coupon, place=place)
                      for place, depth, scatter in rows]
    for datum in made.data:
        if datum.at:
            datum.name += ", " + ", ".join(f"{name.replace('_', ' ')} {value}" for name, value in datum.at.items())
    if not (table.has("measured") or table.has("depth")):
        table.fault("[calibration] needs [[calibration.measured]] or [[calibration.depth]]: something that was measured")
    elif 0 < len(made.data) < len(made.parameters):
        table.fault(f"{len(made.parameters)} parameters cannot be found from {len(made.data)} measured "
                    f"value{'s' * (len(made.data) > 1)}")
    if study.timing or study.map:
        table.fault("[calibration] goes with neither [timing] nor [map]")
    if not any(tells_of_removal(study, alone[datum.metric]) for datum in made.data if datum.metric):
        for parameter in made.parameters:
            parameter.law = next((law for law, key in LAWS.items() if parameter.keys == [key]), None)
    table.close()
    return made


def tells_of_removal(study, metric):
    """Whether a metric hangs on what came off, so that a coefficient of removal acts on it in its own way."""
    if metric.formula:
        return any(tells_of_removal(study, m) for m in study.metrics if m.name in metric.formula.names)
    source = f"{metric.series or ''} {metric.summary or ''} {metric.of or ''}"
    return metric.reference is not None or any(word in source for word in ("removed_", "_depth_", "roughness"))


def _scatter(table):
    scatter = table.get("scatter", float)
    if scatter is not None and not scatter > 0:
        table.fault(f"'scatter' is the standard deviation of the measured value, above 0, found {found(scatter)}", "scatter")
        return None
    return scatter


def _at(table, others):
    """Under which conditions it was measured: a value of each axis that is no parameter."""
    at = conditions(table, others)
    if missing := [name for name in others if name not in at]:
        table.fault(f"{table.name} must say at which '{missing[0]}' it was measured, at = {{ {missing[0]} = ... }}", "at")
    return at
