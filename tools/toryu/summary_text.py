"""The summary of a run as lines of text: what moved, how far from the measurement, how long, where the time went."""

import math
import re

from toryu import counted, results


def of_run(references, out):
    """`references`: of the case, as resolved."""
    summaries = results.read_summaries(out)
    lines = [*displacements(out), *distances(references, out), *failed_bonds(summaries), *times(summaries),
             *coupling(summaries)]
    width = max((len(label) for label, _ in lines), default=0)
    return "\n".join(f"{label:{width}}  {text}" for label, text in lines)


def displacements(out):
    """Peak of every displacement that was observed."""
    series = results.read_series(out, "solid")
    for column, values in series.items():
        found = re.fullmatch(r"(\w+)_displacement_(\w)\[m\]", column)
        if found and any(math.isfinite(v) for v in values):
            time, value = results.peak(series["time[s]"], values)
            yield f"peak {found[1]} displacement {found[2]}", f"{value * 1e3:.4g} mm at {time:.4g} s"


def distances(references, out):
    return [(f"distance in {c.quantity}", f"{100 * c.distance:.1f} % of the peak of '{c.label}' (root mean square)")
            for c in results.compare(references, out) if math.isfinite(c.distance)]


def failed_bonds(summaries):
    """Whether a solid tore or its particles clumped, which no other figure may show."""
    figures = summaries.get("solid", {}).get("figures", {})
    for key, words in {"torn_bonds": "torn", "clumped_bonds": "clumped"}.items():
        if (number := figures.get(key, 0)) > 0:
            yield "WARNING", f"the solid has {words}: up to {number:.0f} pairs of adjacent particles; see log.txt"


def times(summaries):
    for participant, summary in summaries.items():
        name = participant if participant == "coupler" else f"{participant}_solver"
        wall, waiting = summary["wall_time"], summary["waiting_time"]
        text = f"{wall:.1f} s"
        if waiting > 0 and wall > 0:
            text += f", {100 * waiting / wall:.0f} % of it waiting"
        thing = "window" if participant == "coupler" else "step"
        yield f"wall time {name}", f"{text}; {counted(summary['steps'], thing)}, {summary['processor_time']:.1f} s of processor"


def coupling(summaries):
    """What the exchange cost and how exactly both sides agree on what was exchanged."""
    figures = summaries.get("coupler", {}).get("figures", {})
    if "round_trip_median" in figures:
        yield "round trip", (f"{figures['round_trip_median'] * 1e6:.0f} microseconds (median), "
                             f"{100 * figures['round_trip_share']:.0f} % of the run")
    if "largest_impulse_error" in figures:
        yield "impulse given and taken", f"differ by at most {figures['largest_impulse_error']:.1g} of the sum of the forces"
    if "work_given" in figures:
        yield "work given and taken", f"{figures['work_given']:.3g} and {figures['work_taken']:.3g} J/m"
