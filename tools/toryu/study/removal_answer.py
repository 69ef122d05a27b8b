"""Which setting takes off the wanted depth: cycles, time, evenness, pressure; ranked, and said in a sentence."""

import math
from dataclasses import dataclass

from toryu import counted
from toryu.report import data, tables
from toryu.study import page
from toryu.study.answer import Answer
from toryu.study.progress import duration

MOST_CYCLES = 1_000_000  # beyond that a setting removes nothing


@dataclass
class Wanted:
    """The table [removal.answer]."""

    depth: float  # [m], mean over the work pieces
    evenness_at_most: float
    pressure_at_most: float  # [Pa]
    first: str  # what decides among the settings that meet the limits: "evenness", "time" or "pressure"

    @staticmethod
    def read(table):
        wanted = Wanted(table.get("wanted_depth", float), table.get("evenness_at_most", float, math.inf),
                        table.get("pressure_at_most", float, math.inf),
                        table.get("first", str, "evenness", allowed=list(BY)))
        if wanted.depth is not None and not wanted.depth > 0:
            table.fault(f"'wanted_depth' must be above 0, found {wanted.depth}", "wanted_depth")
        if wanted.evenness_at_most < 1:
            table.fault(f"'evenness_at_most' is the largest depth over the mean, so at least 1, found "
                        f"{wanted.evenness_at_most}", "evenness_at_most")
        if not wanted.pressure_at_most > 0:
            table.fault(f"'pressure_at_most' must be above 0, found {wanted.pressure_at_most}", "pressure_at_most")
        table.close()
        return wanted

    def figures(self, removed):
        """Whole cycles until the mean depth is reached, as the cycles after the first go on alike, and what is then."""
        a_cycle = removed.mean(removed.a_cycle())
        missing = self.depth - removed.mean(removed.depth[0])
        cycles = 1 if missing <= 0 else 1 + math.ceil(missing / a_cycle - 1e-9) if a_cycle > 0 else math.inf
        if cycles > MOST_CYCLES:
            return {}
        depth = removed.after(cycles)
        return {"cycles_needed": cycles, "time_needed": cycles * removed.period,
                "evenness_then": float(depth.max()) / removed.mean(depth), "roughness_then": removed.roughness_at(depth)}

    def met(self, row):
        """Whether the setting keeps the limits. A pressure that the run does not tell (nan) keeps none."""
        return (math.isfinite(row.get("cycles_needed", math.nan)) and row["evenness_then"] <= self.evenness_at_most
                and (math.isinf(self.pressure_at_most) or row["piston_pressure"] <= self.pressure_at_most))

    def limits(self):
        """The limits in words."""
        words = []
        if math.isfinite(self.evenness_at_most):
            words.append(f"an evenness of at most {self.evenness_at_most:g}")
        if math.isfinite(self.pressure_at_most):
            words.append(f"at most {in_words(self.pressure_at_most, 'Pa')} at the piston")
        return " and ".join(words)


BY = {"evenness": ("evenness_then", "most evenly"), "time": ("time_needed", "fastest"),
      "pressure": ("piston_pressure", "with the least pressure")}


def in_words(value, unit):
    """5e-06, "m" -> 5 µm"""
    factor, unit = data.scaled(unit, abs(value))
    return f"{value * factor:.3g} {unit}"


def figures_text(row):
    text = (f"{row['cycles_needed']} cycles in {duration(row['time_needed'])}, the largest depth "
            f"{row['evenness_then']:.2f} times the mean")
    if math.isfinite(row["piston_pressure"]):
        text += f", {in_words(row['piston_pressure'], 'Pa')} at the piston"
    if "depth_then_error" in row:
        text += (f"; by the calibration the depth is then uncertain by {in_words(row['depth_then_error'], 'm')} (one standard "
                 "error)")
    return text


def ranked(wanted, table):
    """Rows that reach the depth, those within the limits first, the best first."""
    key = BY[wanted.first][0]
    reached = [row for row in table.rows if "cycles_needed" in row]
    return sorted(reached, key=lambda row: (not wanted.met(row), row[key], row["time_needed"]))


def answer_of(wanted, study, table):
    rows = ranked(wanted, table)
    title = f"To remove {in_words(wanted.depth, 'm')}"
    if not rows:
        if all("removed_per_cycle" not in row for row in table.rows):
            return Answer(title, "No run shows what a cycle removes: it takes [fluid.removal], a work piece and two "
                                 "whole cycles.", "")
        return Answer(title, f"No setting removes {in_words(wanted.depth, 'm')} within {MOST_CYCLES:,} cycles.", "")
    met = [row for row in rows if wanted.met(row)]
    sentence = best_setting(wanted, study, table, met) if met else nearest_setting(wanted, study, table, rows)
    return Answer(title, sentence, ranking(wanted, study, table, rows))


def best_setting(wanted, study, table, met):
    """`met`: rows within the limits, the best first."""
    best, limits = met[0], wanted.limits()
    sentence = (f"{in_words(wanted.depth, 'm')} come off {BY[wanted.first][1]} with {page.setting_text(study, best)}: "
                f"{figures_text(best)}.")
    if limits:
        sentence += f" {len(met)} of {counted(len(table.rows), 'setting')} keep {limits}."
    fastest = min(met, key=lambda row: row["time_needed"])
    if fastest["time_needed"] < best["time_needed"]:
        sentence += (f" The fastest{' of them' if limits else ''}: {page.setting_text(study, fastest)}; "
                     f"{figures_text(fastest)}.")
    return sentence


def nearest_setting(wanted, study, table, rows):
    nearest = min(rows, key=lambda row: excess(wanted, row))
    return (f"None of the {len(table.rows)} settings removes {in_words(wanted.depth, 'm')} with {wanted.limits()}. "
            f"Nearest: {page.setting_text(study, nearest)}; {figures_text(nearest)}.")


def excess(wanted, row):
    """How far beyond the limits, as a factor."""
    return max(row["evenness_then"] / wanted.evenness_at_most, row["piston_pressure"] / wanted.pressure_at_most)


def ranking(wanted, study, table, rows):
    """All settings in the order of the answer, as a table for the page."""
    columns = [axis.name for axis in study.axes] + ["cycles_needed", "time_needed", "evenness_then", "roughness_then",
                                                    "piston_pressure"]
    columns = [name for name in columns if name in rows[0] and rows[0][name] == rows[0][name]]
    factors, headings = zip(*(page.column(name, table, study) for name in columns))
    headings = ["<th>rank</th>", *headings, "<th>within the limits</th>"]
    body = [(row["record"].folder.name, "", [page.cell(rank), *map(page.cell, (row[name] for name in columns), factors),
                                             tables.cell("yes" if wanted.met(row) else "no")])
            for rank, row in enumerate(rows, 1)]
    return f"<details><summary>All settings, ranked</summary>{page.sortable(headings, body)}</details>"
