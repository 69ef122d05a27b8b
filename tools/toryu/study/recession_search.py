"""The solutions of the flow that a receding surface asks for, one after the other: where the surface is next depends on
the ones before. What is done is kept as of any study, so a study that was stopped goes the same way again up to there."""

import itertools
import math
from dataclasses import dataclass

import numpy as np

from toryu.case import resolve
from toryu.processes import DONE
from toryu.study import calibrated, page, recession_edges, recession_goals, recession_surface, removed_depth
from toryu.study.recession_steps import State
from toryu.study.runner import OUTPUT
from toryu.study.settings import left_out
from toryu.study.study_file import Value

AT_STOP = "has come to the end of its travel"  # the fluid's warning


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
        figures = {"machining_time": self.state.time, **{name: of(depth) for name, of in self.chain.shape.items()},
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
        self.study, self.view, self.make, self.others = study, study.recession, make, others
        chosen = list(zip([a for a in study.axes if a is not self.view.axis], others))
        self.calibration = next((v.name for axis, v in chosen if axis.name == calibrated.AXIS), calibrated.FITTED)
        self.line = label([(axis, value) for axis, value in chosen if axis.name != calibrated.AXIS])
        self.label = self.line if self.is_fitted() else label(chosen)
        self.end_time = study.overrides.get("case.end_time", study.content.get("case", {}).get("end_time"))
        self.longer = 1  # times that
        self.surface, self.failure, self.failed_code = None, "", DONE
        self.law = None  # the depth that counts
        self.edges, self.roughness_law = [], None  # recession_edges.Edge; [fluid.removal.roughness]
        self.shape = {}  # figure of the shape -> function of the depth
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
        march = self.view.march(self)()
        state = next(march)
        try:
            while True:
                rate = yield from self.solution(state)
                if not state.predicted and self.has_reached():
                    return
                state = march.send(rate)
        except StopIteration:
            return
        except (Failed, recession_surface.NoRate) as why:
            self.failure = str(why)

    def missing(self, depth):
        """What a depth lacks of the first goal of the shape."""
        start = np.zeros_like(depth)
        goals = [goal for goal in self.view.until if goal.of_shape]
        lacks = [goal.missing(self.shape[goal.name](depth), self.shape[goal.name](start)) for goal in goals]
        if any(map(math.isnan, lacks)):
            raise Failed("'until' names a radius, and no edge of two receding faces that the medium touches is there to fit")
        return min(lacks, default=math.inf)

    def course(self, study, goal):
        """Machining times [s] and the figure of a goal there."""
        states = self.states()
        values = [self.shape[goal.name](solved.state.depth) if goal.of_shape else
                  recession_goals.metric(study, goal, solved.record) for solved in states]
        return [solved.state.time for solved in states], values

    def has_reached(self):
        """Whether the last state has come to a goal that only its flow tells."""
        goals = [goal for goal in self.view.until if not goal.of_shape]
        return any(not math.isnan(recession_goals.time_of(goal, *self.course(self.study, goal))) for goal in goals)

    def begin(self, file, folder):
        """With the first run."""
        self.surface = surface = recession_surface.wetted(file)
        self.law = removed_depth.law_of(file)
        self.edges = recession_edges.edges(surface)
        law = self.roughness_law = resolve(folder / "used_case.toml", self.study.coupler).content["fluid"]["removal"].get("roughness")
        first = surface.gap(np.zeros(len(surface.place)), self.view.along)
        self.shape = {
            "depth_mean": surface.mean, "depth_largest": lambda depth: float(depth.max()),
            "gap": lambda depth: self.view.gap + (
                surface.gap(depth, self.view.along) - first if first else (1 + self.view.about_axis) * depth.min()),
            "edge_radius": lambda depth: min((recession_edges.radius(surface, depth, e) for e in self.edges), default=math.nan),
            "roughness": lambda depth: surface.mean(removed_depth.roughness(depth, law)) if law else math.nan}

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
                if said := stopped(record.folder):
                    raise Failed(f"in the solution '{name}' {said}: nothing flows from then on. Give it a longer 'travel', or "
                                 "the case an earlier end")
            rate, unsteadiness = self.read(state, records)
            if unsteadiness <= self.view.steady_within:
                break
            longest, why = self.view.longest
            if self.longer >= longest or not isinstance(self.end_time, (int, float)):
                raise Failed(f"the flow of the solution '{name}' does not become steady: its rate of removal still changes by "
                             f"{unsteadiness * 100:.2g} % within 'shares' of {self.longer} times the case's end time" + (
                                 f", and it cannot run longer: {why}" if why else ""))
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
                    self.begin(file, record.folder)
                found.append(recession_surface.rates(self.surface, file, view.window, view.pressure))
        rates = [np.maximum(rate, 0.0) for rate, _ in found]
        if view.way == "mirrored":
            rates.append(self.surface.mirrored(rates[0], view.along))
        elif view.way == "first_half":
            rates = [np.where(view.counts(self.surface), rates[0], self.surface.mirrored(rates[0], view.along))]
        rate = sum(rates) / len(rates)
        if state.depth is not None:
            rate = self.surface.along_normal(rate, state.depth)
        return rate, max(change for _, change in found)

    def keep(self, state, name, record, unsteadiness):
        with recession_surface.open_file(record.folder) as file:
            found = float(self.surface.removed(recession_surface.depth_read_back(self.surface, file)).sum())
        removed = float(self.surface.removed(state.depth).sum())
        error = found / removed - 1 if removed > 0 else 0.0
        self.solved[record.folder.name] = Solved(state, name, record, self, unsteadiness, error)


def stopped(folder):
    """What the fluid said of a pressed wall that came to its stop, "" if none did."""
    printed = (folder / OUTPUT).read_text(encoding="utf-8", errors="replace").splitlines()
    line = next((line for line in printed if AT_STOP in line), "")
    return line[line.index("the wall"):] if "the wall" in line else line


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
