"""What a calibration has found, taken into another study: the fitted values in every run, and how uncertain a figure is by
what they leave open."""

import csv
import math
from dataclasses import dataclass

import numpy as np

from toryu.case import BadCase, resolve
from toryu.study import study_file
from toryu.study.removed_depth import LAWS

AXIS, FITTED = "calibration", "fitted"
COVARIANCE = "calibration.csv"  # beside the fitted values


@dataclass
class Fitted:
    """A parameter of the calibration."""

    name: str
    log: bool
    law: str | None  # the depth that is proportional to it
    keys: list[str]
    value: float
    error: float  # standard error, of the logarithm if log

    @property
    def relative_error(self):
        return self.error if self.log else self.error / self.value

    def moved(self, sign):
        """The value a standard error away."""
        return self.value * math.exp(sign * self.error) if self.log else self.value + sign * self.error

    def overrides(self, value):
        return dict.fromkeys(self.keys, value)

    def neighbour(self, sign):
        return f"{self.name} {'+' if sign > 0 else '-'} 1 standard error"


@dataclass
class Calibrated:
    """All of them. Of those that no depth is proportional to each setting runs a standard error to either side too."""

    parameters: list[Fitted]
    covariance: np.ndarray

    def fitted(self):
        return {key: p.value for p in self.parameters for key in p.keys}

    def axis(self, line):
        values = [study_file.Value(FITTED, self.fitted())]
        values += [study_file.Value(p.neighbour(sign), self.fitted() | p.overrides(p.moved(sign)))
                   for p in self.parameters if not p.law for sign in (1, -1)]
        return study_file.Axis(AXIS, "", values, line, default=FITTED)

    def error(self, value, neighbours, law):
        """Standard error of a figure or of an array, to first order; nan without a neighbour. `neighbours`: value of the
        axis -> the figure there. `law`: the depth that the figure is, None if it is none."""
        return self.error_of(value, lambda p: np.asarray(value) * p.relative_error * (p.law == law) if p.law else
                             half_difference(neighbours, p))

    def error_of(self, value, move):
        """The same, `move(parameter)`: by how much a standard error of the parameter moves the figure."""
        errors = np.sqrt(np.diag(self.covariance))
        correlation = self.covariance / np.outer(errors, errors)
        moves = np.stack(np.broadcast_arrays(value, *map(move, self.parameters))[1:])
        return np.sqrt(np.maximum(np.einsum("i...,ij,j...->...", moves, correlation, moves), 0.0))


def half_difference(neighbours, parameter):
    """Of the figures at a standard error of the parameter to either side; nan without one."""
    up, down = (np.asarray(neighbours.get(parameter.neighbour(sign), math.nan)) for sign in (1, -1))
    return (up - down) / 2


def read(table, study):
    """The Calibrated that `calibration` of a table names: a file that a calibration wrote, its covariances beside it. None
    without it, or after a fault."""
    name = table.get("calibration", str, None)
    if name is None:
        return None
    path = study.path.parent / name
    beside = path.with_name(COVARIANCE)
    study.inputs += [path, beside]
    try:
        said = study_file.flat(resolve(path, study.coupler).content)
        made = _read_covariance(beside)
    except BadCase as error:
        table.fault(f"'calibration' must be the calibration.toml of a calibration, found '{name}': {error}", "calibration")
        return None
    except (OSError, ValueError, KeyError, IndexError, csv.Error) as error:
        table.fault(f"'calibration' needs the {COVARIANCE} that the calibration wrote beside '{name}': "
                    f"{getattr(error, 'strerror', None) or f'it cannot be read ({error})'}", "calibration")
        return None
    for key, value in made.fitted().items():
        if said.get(key) != value:
            table.fault(f"'{name}' and the {COVARIANCE} beside it are not of one calibration: '{key}' is {said.get(key)} "
                        f"there and {value} here", "calibration")
        if key in study.overrides:
            table.fault(f"'{key}' is given by the calibration and by 'set' of [study]: it can have one value only")
    return made


def _read_covariance(path):
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    if not rows:
        raise ValueError("no parameter")
    parameters = [Fitted(row["parameter"], row["scale"] == "logarithm", row["proportional"] or None, row["keys"].split(),
                         float(row["value"]), float(row["error"])) for row in rows]
    unknown = [p.law for p in parameters if p.law and p.law not in LAWS]
    covariance = np.array([[float(row[f"covariance with {p.name}"]) for p in parameters] for row in rows])
    if unknown or not np.isfinite(covariance).all() or not (np.diag(covariance) > 0).all():
        raise ValueError("no covariances of known parameters")
    return Calibrated(parameters, covariance)
