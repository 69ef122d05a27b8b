"""The settings of a study: every combination of the axes' values, and the key under which its run is kept."""

import hashlib
import itertools
import json
from dataclasses import dataclass

import results


@dataclass
class Setting:
    values: dict[str, float | str]  # axis name -> value
    overrides: dict[str, str]  # key of the case -> value as TOML
    key: str = ""  # names the folder of its run

    def options(self):
        """As a user would give it to run.sh."""
        return [f"--set={key}={value}" for key, value in self.overrides.items()]

    def __str__(self):
        return ", ".join(f"{name} {value}" for name, value in self.values.items())


def toml(value):
    """A value as TOML."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{json.dumps(key)} = {toml(inner)}" for key, inner in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml, value)) + "]"
    if isinstance(value, float):
        return repr(value)
    return json.dumps(value, ensure_ascii=False) if isinstance(value, (str, bool, int)) else str(value)


def content_of(case):
    """What a case file says, comments and layout aside; its text if it is no TOML, which the programs will tell."""
    try:
        return results.case_content(case)
    except (OSError, ValueError):
        return case.read_text(encoding="utf-8", errors="replace")


def settings(study, extra=(), program_identity=""):
    """All settings, the last axis changing fastest. `extra`: overrides of the command line, which win."""
    case = content_of(study.case)
    always = {} if study.keep_frames else {"case.frame_interval": 0}
    found = []
    for values in itertools.product(*(axis.values for axis in study.axes)):
        overrides = always | study.overrides
        for value in values:
            overrides |= value.overrides
        as_toml = {key: toml(value) for key, value in overrides.items()} | dict(pair.split("=", 1) for pair in extra)
        setting = Setting({axis.name: value.name for axis, value in zip(study.axes, values)}, as_toml)
        identity = json.dumps([program_identity, case, list(as_toml.items())], default=str)
        setting.key = hashlib.sha256(identity.encode()).hexdigest()[:12]
        found.append(setting)
    return found
