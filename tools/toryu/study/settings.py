"""The settings of a study: every combination of the axes' values, and the key under which its run is kept."""

import hashlib
import itertools
import json
from dataclasses import dataclass


@dataclass
class Setting:
    values: dict[str, float | str]  # axis name -> value
    overrides: dict[str, str]  # key of the case -> value as TOML
    key: str = ""  # names the folder of its run
    repetition: int = 0  # of a timed study, from 0

    def options(self):
        """As a user would give it to run.sh."""
        return [f"--set={key}={value}" for key, value in self.overrides.items()]

    def __str__(self):
        return ", ".join(f"{name} {value}" for name, value in self.values.items())


def toml(value):
    """A value as TOML."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{json.dumps(key)} = {toml(inner)}" for key, inner in value.items()) + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(toml, value)) + "]"
    if isinstance(value, float):
        return repr(value)
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    return json.dumps(value, ensure_ascii=False) if isinstance(value, (str, bool, int)) else str(value)


class Maker:
    """Makes settings of a study. `extra`: overrides of the command line, which win. `mark`: what else makes a run
    another one."""

    def __init__(self, study, extra=(), program_identity="", mark=None):
        self.study, self.extra, self.program_identity, self.mark = study, extra, program_identity, mark

    def __call__(self, values, repetition=0):
        """`values`: one of each axis, in their order."""
        overrides = {} if self.study.keep_frames else {"case.frame_interval": 0}
        overrides |= self.study.overrides
        for value in values:
            overrides |= value.overrides
        as_toml = {key: toml(value) for key, value in overrides.items()}
        as_toml |= dict(pair.split("=", 1) for pair in self.extra)
        setting = Setting({axis.name: value.name for axis, value in zip(self.study.axes, values)}, as_toml,
                          repetition=repetition)
        parts = [self.program_identity, self.study.content, list(as_toml.items())]
        parts += [[self.mark, repetition]] if self.mark else []
        setting.key = hashlib.sha256(json.dumps(parts, default=str).encode()).hexdigest()[:12]
        return setting


def settings(study, make):
    """Every combination of the axes but those that are left out, the last axis changing fastest; with repetitions in
    rounds, so that a machine that slows down treats all alike."""
    combinations = [values for values in itertools.product(*(axis.values for axis in study.axes))
                    if not any(left_out(study, rule, values) for rule in study.leave_out)]
    rounds = study.timing.repeat if study.timing else 1
    return [make(values, repetition) for repetition in range(rounds) for values in combinations]


def left_out(study, rule, values):
    """Whether the rule, axis -> values, matches."""
    names = {axis.name: value.name for axis, value in zip(study.axes, values)}
    return all(names[axis] in matching for axis, matching in rule.items())
