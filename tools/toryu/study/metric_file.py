"""What a [[metric]] of a study file says. README.md describes the keys."""

import math
from dataclasses import dataclass, field

from toryu import results
from toryu.study.document import did_you_mean, is_number, one_of
from toryu.study.formula import Formula, read_formula

OF_RUN = {"wall_time": "s", "processor_time": "s", "simulated_time": "s", "steps": ""}
SOURCES = ("series", "summary", "run", "reference", "formula")
TAKES = ("last", "first", "largest", "smallest", "peak", "peak_time", "mean", "rms", "middle", "amplitude", "period",
         "frequency", "amplitude_loss", "distance")
TAKE_UNITS = {"peak_time": "s", "period": "s", "frequency": "Hz", "amplitude_loss": "", "distance": ""}
SWINGING = ("period", "frequency", "amplitude_loss")  # these know a level
NEXT, LAST = "next", "last"  # of the values of an axis


@dataclass
class Metric:
    """A figure of a run. One of the sources is given."""

    name: str
    unit: str
    scale: float
    series: str | None = None  # "fluid.csv:front_x[m]"
    line: int | None = None  # of the file, where the series is named
    take: str = "last"
    shares: list[float] = field(default_factory=lambda: [0.0, 1.0])  # of the simulated time
    level: float | None = None  # about which the series swings
    summary: str | None = None  # "fluid.figures.largest_speed"
    run: str | None = None  # one of OF_RUN, or what fair timing adds
    reference: str | None = None  # label of a [[reference]] of the case: the distance to it
    of: str | None = None  # the series that is meant, where several references have the label
    formula: Formula | None = None  # of earlier metrics and axes
    against: float | dict | None = None  # the figure becomes its difference from this value, or from that run
    relative: bool = True  # the difference as a share of what it is taken from

    @property
    def needs_other_runs(self):
        return isinstance(self.against, dict)


def read(table, study, earlier):
    """`earlier`: the metrics before this one, which a formula may name."""
    name, scale = table.label(), table.get("scale", float, 1.0)
    given = [source for source in SOURCES if table.has(source)]
    if len(given) != 1:
        table.fault(f"{table.name} needs one of {one_of(SOURCES)}, found {one_of(given) if given else 'none'}")
    metric = Metric(name, table.unit(), scale)
    of_run = study.of_run()
    metric.run = table.get("run", str, None, allowed=of_run)
    if path := table.get("summary", str, None):
        _read_summary(table, metric, path)
    if table.has("reference"):
        _read_reference(table, study, metric)
    if series := table.get("series", str, None):
        _read_series(table, metric, series)
    if table.has("formula"):
        numbers = [axis.name for axis in study.axes if axis.name and all(is_number(v.name) for v in axis.values)]
        metric.formula = read_formula(table, "formula", [m.name for m in earlier if m.name] + numbers + list(of_run))
    metric.unit = metric.unit or of_run.get(metric.run, "")
    if table.has("against"):
        _read_against(table, study, metric)
    elif metric.take == "distance":
        table.fault("the take 'distance' needs 'against', the run from which the series is distant", "take")
    table.close()
    return metric


def _read_summary(table, metric, path):
    metric.summary = path
    side, *keys = path.split(".")
    numbers = [*results.SUMMARY, *results.VALUES]

    def hint(word, allowed):
        return "" if word in allowed else did_you_mean(word, allowed)

    if side not in results.PARTICIPANTS or not keys:
        table.fault(f"'summary' must be PARTICIPANT.KEY, such as 'fluid.figures.largest_speed', the participant one of "
                    f"{one_of(results.PARTICIPANTS)}, found '{path}'{hint(side, results.PARTICIPANTS)}", "summary")
    elif keys[0] not in numbers or (len(keys) == 2) != (keys[0] in results.VALUES):
        table.fault(f"a summary has no number '{'.'.join(keys)}'{hint(keys[0], numbers)}; there are "
                    f"{one_of([*results.SUMMARY, *(f'{key}.NAME' for key in results.VALUES)])}", "summary")


def _read_series(table, metric, series):
    metric.series, metric.line = series, table.document.line(table.path, "series")
    metric.take = table.get("take", str, "last", allowed=TAKES)
    metric.shares = table.numbers("shares", 2, [0.0, 1.0])
    if metric.shares[0] < 0 or metric.shares[1] > 1:
        table.fault(f"'shares' must be from 0 to 1, found {metric.shares}", "shares")
    if metric.take in SWINGING:
        metric.level = table.get("level", float, None)
    if ".csv:" not in series:
        table.fault(f"'series' must be FILE.csv:COLUMN, such as 'fluid.csv:front_x[m]', found '{series}'", "series")
    metric.unit = metric.unit or TAKE_UNITS.get(metric.take, results.unit_of(series))


def _read_reference(table, study, metric):
    metric.reference = table.get("reference", str, None, allowed=study.names_in_case("reference", "label"))
    metric.of = table.get("of", str, None, allowed=study.names_in_case("reference", "series"))


def _read_against(table, study, metric):
    """A number, or { AXIS = VALUE, "next" or "last", ... }: axes that are not named have the run's own value."""
    table.known.append("against")
    against, axes = table.content["against"], {axis.name: axis for axis in study.axes}
    metric.relative = table.get("relative", bool, True)
    if metric.relative and not table.has("unit"):
        metric.unit = ""
    if is_number(against):
        if metric.relative and against == 0:
            table.fault("'against' 0 has no relative difference; give relative = false", "against")
        if metric.take == "distance" or not math.isfinite(against):
            table.fault("'against' must name a run here, { AXIS = VALUE }", "against")
    elif isinstance(against, dict) and against:
        for name, value in against.items():
            if name not in axes:
                table.fault(f"'against' names no axis '{name}'{did_you_mean(name, axes)}; there are {one_of(axes)}",
                            "against")
            elif value not in (NEXT, LAST) and value not in (names := [v.name for v in axes[name].values]):
                table.fault(f"'against' must name a value of the axis '{name}', one of {names}, or '{NEXT}' or '{LAST}', "
                            f"found {value}", "against")
    else:
        table.fault(f"'against' must be a number, or a run, {{ AXIS = VALUE }}, found {against}", "against")
        return
    metric.against = against
