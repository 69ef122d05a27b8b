"""What the page shows beside the particles: state, figures, charts, times; taken from the files of the run."""

import contextlib
import itertools
import math
import pathlib
import re

from toryu import results
from toryu.case import BadCase, Case, resolve
from toryu.folder_lock import is_held
from toryu.processes import BAD_INPUT, BUG, DONE, INTERRUPTED, MACHINE, PEER_LOST, PHYSICS_FAILED

MEANING = {DONE: "Done", BUG: "Ended by a bug", BAD_INPUT: "Bad input", PHYSICS_FAILED: "Physics failed",
           PEER_LOST: "A process was lost", MACHINE: "A fault of the machine", INTERRUPTED: "Interrupted"}
# Of the participants' exit codes, the run's is the first of these.
CAUSE_FIRST = (BAD_INPUT, PHYSICS_FAILED, MACHINE, BUG, INTERRUPTED, PEER_LOST, DONE)
MOST_POINTS = 1500  # of a line in a chart: more than it has pixels


def used_case(path, out, coupler):
    """The case as it was run, else as it is written, and its text."""
    for file in (out / "used_case.toml", path):
        with contextlib.suppress(BadCase):
            case = resolve(file, coupler)
            return case, case.file.read_text(encoding="utf-8", errors="replace")
    return Case("empty", pathlib.Path(path), "", [], {}), ""


def state(out, summaries, exit_code, words):
    """Exit code of the run and its reason: as the launcher saw them, else as the participants left them; a run without an
    end has no code."""
    if exit_code is not None:
        return {"code": exit_code, "meaning": MEANING.get(exit_code, f"Exit code {exit_code}"), "words": words}
    if any(is_held(out, name) for name in ("run.lock", "launch.lock")):
        return {"code": None, "meaning": "Still running", "words": words}
    if not summaries:
        words = words or "No participant left a sound summary: the run was killed, or never began."
        return {"code": None, "meaning": "Without an end", "words": words}
    left = [s["exit_code"] for s in summaries.values()]
    code = min(left, key=lambda c: CAUSE_FIRST.index(c) if c in CAUSE_FIRST else 0)
    words = words or "; ".join(dict.fromkeys(s["end_reason"] for s in summaries.values()
                                             if s["exit_code"] == code and s["end_reason"]))
    return {"code": code, "meaning": MEANING.get(code, f"Exit code {code}"), "words": words}


# What a case says, which may be damaged ------------------------------------------------------------------------------

def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) < 1e300


def numbers(value, count):
    """Whether `value` is a list of so many numbers."""
    return isinstance(value, list) and len(value) == count and all(map(is_number, value))


def table(content, key):
    value = content.get(key)
    return value if isinstance(value, dict) else {}


def tables_of(content, key):
    value = content.get(key)
    return [item for item in value if isinstance(item, dict)] if isinstance(value, list) else []


def box_of(box):
    """[x min, y min, x max, y max] of a box, None if it has none."""
    low, high = box.get("min"), box.get("max")
    return [*low, *high] if numbers(low, 2) and numbers(high, 2) else None


def finite(value):
    """The same content with None for every number that JSON does not know."""
    if isinstance(value, dict):
        return {key: finite(inner) for key, inner in value.items()}
    if isinstance(value, (list, tuple)):
        return [finite(inner) for inner in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


# Units ---------------------------------------------------------------------------------------------------------------

PREFIXED = {"m", "s", "Pa", "J/m", "N/m", "N.s/m", "m/s", "Pa.s", "J", "N", "N.s", "J/m2", "W/m2", "Pa.m"}
PREFIXES = {-9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G"}


def pretty(unit):
    """N.s/m -> N·s/m, kg/m3 -> kg/m³; no unit for plain numbers."""
    if unit in ("", "1"):
        return ""
    raised = re.sub(r"(?<=[a-zA-Z])-?\d", lambda found: found[0].translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")),
                    unit)
    return raised.replace(".", "·")


def scaled(unit, largest):
    """Factor and unit that bring `largest` near 1 to 1000."""
    if unit not in PREFIXED or not math.isfinite(largest) or largest <= 0:
        return 1.0, pretty(unit)
    power = min(9, max(-9, 3 * math.floor(math.log10(largest * 1.001) / 3)))
    return 10.0 ** -power, PREFIXES[power] + pretty(unit)


NOT_DRAWN = {"time[s]", "window[1]"}  # they only count


# Charts --------------------------------------------------------------------------------------------------------------

def thinned(xs, ys):
    """At most MOST_POINTS points: of each stretch the smallest and the largest, in order."""
    if len(xs) <= MOST_POINTS:
        return list(zip(xs, ys))
    stretch = math.ceil(2 * len(xs) / MOST_POINTS)
    kept = {0, len(xs) - 1}
    for start in range(0, len(xs), stretch):
        part = [i for i in range(start, min(start + stretch, len(xs))) if math.isfinite(ys[i])]
        if part:
            kept |= {min(part, key=ys.__getitem__), max(part, key=ys.__getitem__)}
    return [(xs[i], ys[i]) for i in sorted(kept)]


def chart(title, unit, lines, columns=()):
    """`lines`: (label, times, values, kind), kind "line" or "points"; the first are those of `columns`, "fluid:mass[kg]"."""
    finite = [abs(v) for _, _, values, _ in lines for v in values if math.isfinite(v)]
    factor, unit = scaled(unit, max(finite, default=0))
    return {"title": title, "unit": unit, "factor": factor, "lines": [
        {"label": label, "kind": kind, "column": column,
         "points": [[t, v * factor] if math.isfinite(v) else [t, None] for t, v in thinned(times, values)]}
        for (label, times, values, kind), column in itertools.zip_longest(lines, columns)]}


FROM_BOUNDARY = re.compile(r"(force|impulse|friction|friction_impulse)_from_(\w+)_([xy])")


def label_of(column):
    """The name of a line in its chart: what the chart's title does not say already."""
    from_boundary = FROM_BOUNDARY.fullmatch(column.partition("[")[0])
    return f"from {results.readable(from_boundary[2])}" if from_boundary else results.readable(column)


def group_of(column):
    """Columns of one group and unit share a chart."""
    name = column.partition("[")[0]
    if from_boundary := FROM_BOUNDARY.fullmatch(name):
        return f"{results.readable(from_boundary[1])}, {from_boundary[3]}"
    if name.startswith("removed_depth"):
        return "removed depth"
    if results.unit_of(column) in ("J/m", "J"):
        return "energy and work"
    for word in ("momentum", "impulse", "displacement"):
        if word in name:
            return word
    return re.sub(r" [xy]$", "", results.readable(column))


def charts(out, comparisons, faults=None):
    """Charts of the comparisons with references, and of all other columns by participant."""
    series = {name: results.read_series(out, name, faults) for name in (*results.PARTICIPANTS, "replay")}
    compared, shown = [], set()
    for comparison in comparisons:
        key = (comparison.series, comparison.column)
        values = series.get(comparison.series, {}).get(comparison.column)
        same = [c for c in comparisons if (c.series, c.column) == key]
        if key in shown or not values:
            continue
        shown.add(key)
        lines = [("this run", series[comparison.series]["time[s]"], values, "line")]
        lines += [(c.label, [t for t, _ in c.reference], [v for _, v in c.reference], "points") for c in same]
        compared.append(chart(comparison.quantity, comparison.unit, lines, [":".join(key)]) | {
            "notes": [f"{c.label}: root mean square distance {100 * c.distance:.1f} % of its peak"
                      for c in same if math.isfinite(c.distance)]})
    others = {}
    for name, columns in series.items():
        groups = {}
        for column, values in columns.items():
            if column not in NOT_DRAWN and (name, column) not in shown and any(map(math.isfinite, values)):
                groups.setdefault((group_of(column), results.unit_of(column)), []).append((column, values))
        if groups:
            order = ["energy and work", "momentum"]
            keys = sorted(groups, key=lambda k: order.index(k[0]) if k[0] in order else 9)
            others[name] = [chart(group, unit, [(label_of(c), columns["time[s]"], v, "line")
                                                for c, v in groups[group, unit]],
                                  [f"{name}:{c}" for c, _ in groups[group, unit]]) for group, unit in keys]
    return compared, others
