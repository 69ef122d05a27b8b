"""The solutions of the flow that a receding surface asks for, one after the other: where the surface is next depends on
the ones before. What is done is kept as of any study, so a study that was stopped goes the same way again up to there."""

import itertools
from dataclasses import dataclass

import numpy as np

from toryu.processes import DONE
from toryu.study import calibrated, page, recession_surface
from toryu.study.recession_steps import State
from toryu.study.removed_depth import law_of
from toryu.study.settings import left_out
from toryu.study.study_file import Value

LONGEST = 8  # times the case's end time, within which a flow must become steady


@dataclass
class Solved:
    """A state with its flow."""

    state: State
    name: str
    record: object
    chain: object
    unsteadiness: float
    balance_error: float  # of the area that the solver finds removed

    def mean_rate(self):
        return self.chain.surface.mean(self.state.rate)

    def figures(self):
        rate = {"removal_rate": self.mean_rate(), "unsteadiness": self.unsteadiness}
        if self.state.predicted:
            return rate
        surface, depth, view = self.chain.surface, self.state.depth, self.chain.view
        figures = {"machining_time": self.state.time, "depth_largest": float(depth.max()),
                   "taper": taper(surface, depth, view), "balance_error": self.balance_error,
                   "jump_error": self.state.jump_error} | rate | shape_figures(surface, depth, view)
        if view.cycle:
            figures["cycles"] = self.state.time / view.cycle
        return {name: figures[name] for name in view.units() if name in figures}


def shape_figures(surface, depth, view):
    """What a shape alone tells."""
    counts = view.counts(surface)
    removed = float(surface.removed(depth)[counts].sum())
    figures = {"depth_mean": surface.mean(depth), view.removed: removed, "removed_mass": removed * (view.density or 0.0)}
    diameters, lengths = surface.diameters(depth, counts)
    if view.about_axis and len(diameters):
        figures |= {"diameter_mean": float(np.average(diameters, weights=lengths)),
                    "diameter_smallest": float(diameters.min()), "diameter_largest": float(diameters.max())}
    return figures


def taper(surface, depth, view):
    """By how much a straight line through the depth falls along the flow, over the mean depth: 2 where it falls to 0."""
    counts = view.counts(surface)
    mean = surface.mean(depth)
    s, w, depth = surface.place[counts, view.along], surface.length[counts], depth[counts]
    s = s - np.average(s, weights=w)
    slope = np.average(s * depth, weights=w) / np.average(s * s, weights=w)
    return float(-slope * (s.max() - s.min() + np.median(w)) / mean) if mean > 0 else 0.0


def label(chosen):
    """Of axes and their values."""
    return ", ".join(f"{axis.name.replace('_', ' ')} {page.text(value.name)} {axis.unit}".strip() for axis, value in chosen)


class Failed(Exception):
    """The surface cannot be taken further."""


class Chain:
    """One combination of the study's other axes over machining time."""

    def __init__(self, study, make, others):
        self.view, self.make, self.others = study.recession, make, others
        chosen = list(zip([a for a in study.axes if a is not self.view.axis], others))
        self.calibration = next((v.name for axis, v in chosen if axis.name == calibrated.AXIS), calibrated.FITTED)
        self.line = label([(axis, value) for axis, value in chosen if axis.name != calibrated.AXIS])
        self.label = self.line if self.is_fitted() else label(chosen)
        self.end_time = study.overrides.get("case.end_time", study.content.get("case", {}).get("end_time"))
        self.longer = 1  # times that
        self.surface, self.failure, self.failed_code = None, "", DONE
        self.law = None  # the depth that counts
        self.solved = {}  # folder of the run -> Solved, in the order of time; of two directions the first
        self.records = {}  # name of the solution -> record
        self.place = study.axes.index(self.view.axis)

    def is_fitted(self):
        return self.calibration == calibrated.FITTED

    def states(self):
        """Those at the end of jumps."""
        return [solved for solved in self.solved.values() if not solved.state.predicted]

    def solutions(self):
        """A generator of lists of settings; it is sent their records."""
        march = self.view.march(lambda: self.surface)()
        state = next(march)
        try:
            while True:
                rate = yield from self.solution(state)
                state = march.send(rate)
        except StopIteration:
            return
        except (Failed, recession_surface.NoRate) as why:
            self.failure = str(why)

    def solution(self, state):
        """The rate at a state, from a run that is long enough to become steady, or from one each way."""
        name = f"{state.number}" + (" predicted" + " again" * state.attempt if state.predicted else "")
        while True:
            turns = [{}, self.view.reverse] if self.view.reverse else [{}]
            names = [name + (", reversed" if turn else "") + (f", {self.longer} times as long" if self.longer > 1 else "")
                     for turn in turns]
            records = yield [self.setting(*of) for of in zip(names, itertools.repeat(state), turns)]
            self.records |= dict(zip(names, records))
            for record in records:
                if record.exit_code != DONE:
                    self.failed_code = record.exit_code
                    raise Failed(f"the solution '{name}' failed: {record.cause}")
            rate, unsteadiness = self.read(state, records)
            if unsteadiness <= self.view.steady_within:
                break
            if self.longer >= LONGEST or not isinstance(self.end_time, (int, float)):
                raise Failed(f"the flow of the solution '{name}' does not become steady: its rate of removal still changes by "
                             f"{unsteadiness * 100:.2g} % within 'shares' of {self.longer} times the case's end time")
            self.longer *= 2
        self.keep(State(state.time, state.depth if state.depth is not None else np.zeros_like(rate), state.number,
                        state.attempt, state.jump_error, rate), name, records[0], unsteadiness)
        return rate

    def setting(self, name, state, turn):
        sets = dict(turn)
        if state.depth is not None and self.surface is not None:
            sets |= self.surface.worn(state.depth, self.view.walls)
        if self.longer > 1:
            sets["case.end_time"] = self.end_time * self.longer
        return self.make([*self.others[:self.place], Value(name, sets), *self.others[self.place:]])

    def read(self, state, records):
        view, found = self.view, []
        for record in records:
            with recession_surface.open_file(record.folder) as file:
                if self.surface is None:
                    self.surface, self.law = recession_surface.wetted(file), law_of(file)
                found.append(recession_surface.rates(self.surface, file, view.window, view.pressure))
        rates = [np.maximum(rate, 0.0) for rate, _ in found]
        if view.way == "mirrored":
            rates.append(self.surface.mirrored(rates[0], view.along))
        elif view.way == "first_half":
            rates = [np.where(view.counts(self.surface), rates[0], self.surface.mirrored(rates[0], view.along))]
        return sum(rates) / len(rates), max(change for _, change in found)

    def keep(self, state, name, record, unsteadiness):
        with recession_surface.open_file(record.folder) as file:
            found = float(self.surface.removed(recession_surface.depth_read_back(self.surface, file)).sum())
        removed = float(self.surface.removed(state.depth).sum())
        error = found / removed - 1 if removed > 0 else 0.0
        self.solved[record.folder.name] = Solved(state, name, record, self, unsteadiness, error)


def chains_of(study, make):
    view = study.recession
    others = [axis.values for axis in study.axes if axis is not view.axis]
    place = study.axes.index(view.axis)
    return [Chain(study, make, list(column)) for column in itertools.product(*others) if not any(
        left_out(study, rule, [*column[:place], view.axis.values[0], *column[place:]]) for rule in study.leave_out)]


def search(study, make, run):
    """Takes all chains on side by side; returns the records in their order. `run(settings)`: their records, or None to
    stop before this wave."""
    chains = study.recession.chains = chains_of(study, make)
    marches = [(chain, chain.solutions()) for chain in chains]
    waiting = [(march, settings) for _, march in marches if (settings := next(march, None))]
    while waiting:
        made = run([setting for _, settings in waiting for setting in settings])
        if made is None:
            break
        made, further = list(made), []
        for march, settings in waiting:
            records, made = made[:len(settings)], made[len(settings):]
            try:
                further.append((march, march.send(records)))
            except StopIteration:
                pass
        waiting = further
    return [record for chain in chains for record in chain.records.values()]
