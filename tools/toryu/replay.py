"""A replay: one side of a case runs against what the other one answered in a run that was recorded. What it answers is
held against the record by `replay_comparison`."""

import pathlib

FILE = "exchange.h5"
OTHER = {"solid": "fluid", "fluid": "solid"}
HINT = "a run leaves it with [coupling] record = 'every_window'"


def fault_of(options, case):
    """What is wrong with the options of a replay; "" if nothing."""
    if options.replay is None:
        return "--only: error: is the side of a --replay RESULTS that runs" if options.only else ""
    if options.only is None:
        return f"--replay {options.replay}: error: say which side runs: --only solid or --only fluid"
    if case.kind != "coupled":
        return f"{case.file}: error: is not of a fluid with a solid: there is no other side to replay"
    if getattr(options, OTHER[options.only]) is not None:
        return f"--{OTHER[options.only]}: error: with --only {options.only} the {OTHER[options.only]} is the record's"
    record = pathlib.Path(options.replay)
    if not (record / FILE).is_file():
        return f"--replay {record}: error: holds no {FILE}; {HINT}"
    if options.out is not None and pathlib.Path(options.out).resolve() == record.resolve():
        return f"--out {options.out}: error: is the record itself"
    return ""


def settings(options, case):
    """What the replay sets otherwise than the case: key=value."""
    changed = ["coupling.record='every_window'"]
    coupling = case.content.get("coupling", {})
    # Iterations would answer a load that does not answer them. The solid takes the load of the last one.
    if options.only == "solid" and coupling.get("scheme") == "serial_implicit":
        changed.append("coupling.scheme='serial_explicit'")
        if "implicit" in coupling:
            changed.append("coupling.implicit=false")
    return changed
