"""The runs that a calibration asks for: where the next ones lie depends on those before. What is done is kept as of any
study, so a calibration that was stopped goes the same way again up to there."""

import numpy as np

from toryu.processes import BAD_INPUT, BUG, DONE, PHYSICS_FAILED
from toryu.study import least_squares, metrics
from toryu.study.calibration_depths import NoDepth

PROPORTIONAL_WITHIN = 1e-6  # the depth of the last run, by the fitted coefficient, is what was foreseen


class Failed(Exception):
    """The calibration cannot go on: words and exit code."""

    def __init__(self, words, code):
        super().__init__(words)
        self.code = code


class Model:
    """What the case computes for the measured values, from its runs."""

    def __init__(self, study, make):
        self.study, self.make, self.view = study, make, study.calibration
        self.conditions = list({tuple(d.at.items()): d.at for d in self.view.data}.values())
        self.records = {}  # setting key -> record, of all that ran
        self.told = {}  # setting key -> what it tells

    def values(self, point):
        """Of the parameters."""
        return [p.value(scaled) for p, scaled in zip(self.view.parameters, point)]

    def settings(self, values):
        """One for each condition under which something was measured."""
        number = dict(zip([p.name for p in self.view.parameters], values))
        return [self.make([axis.value_of(number[axis.name]) if axis.name in number else
                           next(v for v in axis.values if v.name == at[axis.name]) for axis in self.study.axes])
                for at in self.conditions]

    def ran_with(self, values):
        """A depth that is proportional to a parameter needs no run of its own: those of its start value serve."""
        return [p.start if p.law else value for p, value in zip(self.view.parameters, values)]

    def computed(self, values, records, ran_with):
        """Of each datum by parameters of these values, from the records of runs with others of the proportional ones."""
        factor = {p.law: value / other for p, value, other in zip(self.view.parameters, values, ran_with) if p.law}
        found = np.empty(len(self.view.data))
        for at, record in zip(self.conditions, records):
            if record.setting.key not in self.told:
                self.told[record.setting.key] = self.tell(at, record)
            for k, (value, law) in self.told[record.setting.key].items():
                found[k] = value * factor.get(law, 1.0)
        return found

    def tell(self, at, record):
        """Number of datum -> what the run computes for it, and which depth that is, None if it is none."""
        self.records[record.setting.key] = record
        if record.exit_code != DONE:
            raise Failed(f"the run with {record.setting} failed: {record.cause}; see {record.folder}", PHYSICS_FAILED)
        row = record.setting.values | {"record": record}
        metrics.fill(self.study, [row])
        wanted = [(k, datum) for k, datum in enumerate(self.view.data) if datum.at == at]
        told = {k: (row[datum.metric], None) for k, datum in wanted if datum.metric}
        for coupon in {id(d.coupon): d.coupon for _, d in wanted if d.coupon}.values():
            of = [(k, datum.place) for k, datum in wanted if datum.coupon is coupon]
            try:
                depths, law = coupon.depths(record.folder, [place for _, place in of])
            except NoDepth as why:
                raise Failed(f"the run with {record.setting} tells no depth: {why}; see {record.folder}",
                             BAD_INPUT) from None
            told |= {k: (depth, law) for (k, _), depth in zip(of, depths)}
        for k, (value, _) in told.items():
            if not np.isfinite(value):
                raise Failed(f"the run with {record.setting} gives no '{self.view.data[k].name}'; see {record.folder}",
                             BAD_INPUT)
        return told

    def laws(self):
        """Which depth each datum is, None if it is none, once all conditions have run."""
        found = {k: law for told in self.told.values() for k, (_, law) in told.items()}
        return [found[k] for k in range(len(self.view.data))]

    def residuals(self, computed):
        return np.array([(c - d.measured) / d.scatter for c, d in zip(computed, self.view.data)])


def search(study, make, run):
    """`run(settings)`: their records, or None to stop before this wave. Fills the view; returns all records."""
    model, view = Model(study, make), study.calibration
    view.fit, view.computed, view.failure, view.failed_code = None, None, "", DONE

    def run_once(settings):
        """What sets the same is one run."""
        every = {setting.key: setting for setting in settings}
        made = run(list(every.values()))
        return None if made is None else [{r.setting.key: r for r in made}[setting.key] for setting in settings]

    try:
        _fit(model, view, run_once)
    except Failed as why:
        view.failure, view.failed_code = str(why), why.code
    return list(model.records.values())


def _fit(model, view, run):
    start = _start(model, view, run)
    if start is None:
        return
    low, high = (np.array([p.scaled(p.bounds[side]) for p in view.parameters]) for side in (0, 1))
    fitting = least_squares.search(start, low, high, np.array([p.scaled_step() for p in view.parameters]))
    points = next(fitting)
    while True:
        found = _evaluate(model, points, run)
        if found is None:
            return
        try:
            points = fitting.send([model.residuals(computed) for computed in found])
        except StopIteration as end:
            fit = end.value
            break
    confirmed = _confirm(model, fit.point, run)
    if confirmed is not None:
        view.fit, view.computed = fit, confirmed


def _start(model, view, run):
    """The start values; of what a depth is proportional to the one that fits best with those of the others, by linear least
    squares. None to stop."""
    values = [p.start for p in view.parameters]
    made = run(model.settings(values))
    if made is None:
        return None
    computed, laws = model.computed(values, made, values), model.laws()
    for j, parameter in enumerate(view.parameters):
        of = [(c, d.measured, d.scatter) for c, d, law in zip(computed, view.data, laws) if law and law == parameter.law]
        c, m, s = np.array(of).reshape(-1, 3).T
        if (c != 0).any():
            best = parameter.start * ((c * m) @ s**-2) / ((c * c) @ s**-2)
            values[j] = float(np.clip(best, *parameter.bounds))
    return np.array([p.scaled(value) for p, value in zip(view.parameters, values)])


def _evaluate(model, points, run):
    """The computed values at each point, or None to stop. The points of a wave run side by side."""
    exact = [[p.value(s) if not p.law else float(np.exp(s) if p.log else s) for p, s in zip(model.view.parameters, point)]
             for point in points]
    ran_with = [model.ran_with(values) for values in exact]
    settings = [model.settings(values) for values in ran_with]
    made = run([setting for group in settings for setting in group])
    if made is None:
        return None
    count = len(model.conditions)
    return [model.computed(values, made[k * count:(k + 1) * count], other)
            for k, (values, other) in enumerate(zip(exact, ran_with))]


def _confirm(model, point, run):
    """The computed values by a run with all fitted parameters: where a depth was taken as proportional, that it is."""
    values = model.values(point)
    ran_with = model.ran_with(values)
    foreseen = run([*model.settings(ran_with), *model.settings(values)])
    if foreseen is None:
        return None
    count = len(model.conditions)
    expected = model.computed(values, foreseen[:count], ran_with)
    found = model.computed(values, foreseen[count:], values)
    off = np.abs(found - expected) > PROPORTIONAL_WITHIN * np.abs(expected)
    if off.any():
        k = int(np.argmax(off))
        datum = model.view.data[k]
        raise Failed(f"'{datum.name}' is not proportional to the coefficient of removal, as it must be: a run with the "
                     f"fitted one gives {found[k]:g} {datum.unit} where {expected[k]:g} was expected", BUG)
    return found
