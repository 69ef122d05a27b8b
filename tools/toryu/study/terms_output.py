"""What a study of terms leaves: a chart, terms.csv, and table.md to be pasted into a case's README."""

import csv
import html
import math

from toryu.program import whole_file
from toryu.report import data, tables
from toryu.study.answer import Answer
from toryu.study.terms_effects import FREE, LEFT_OUT, NEEDED


def charts(study, effects, folder):
    from toryu.study import drawing

    made, (left, right) = drawing.figure(2, height=1.2 + 0.26 * max(len(effects), 4))
    names = [effect.name for effect in effects]
    thickness = 0.8 / len(study.terms.quantities)
    for number, quantity in enumerate(study.terms.quantities):
        places = [k + (number + 0.5) * thickness - 0.4 for k in range(len(names))]
        values = [effect.in_errors[quantity] for effect in effects]
        left.barh(places, values, thickness * 0.9, color=drawing.LINES[number % 7], label=quantity.replace("_", " "))
    for k, effect in enumerate(effects):
        if effect.row["cause"]:
            left.text(1.05, k, "fails", va="center", color=drawing.PALETTE["bad"])
    left.axvline(1, color=drawing.PALETTE["ink"], linewidth=1.2, linestyle="--")
    largest = max((v for e in effects for v in e.in_errors.values() if math.isfinite(v)), default=1)
    if largest > 5:
        left.set_xscale("symlog", linthresh=1)
        ticks = [0, 0.5, 1, *(m * 10 ** p for p in range(6) for m in (2, 5, 10) if m * 10 ** p <= largest)]
        left.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    left.set_yticks(range(len(names)), names)
    left.invert_yaxis()
    left.grid(axis="y", visible=False)
    left.set_xlabel("change over discretisation error; beyond 1 it is seen")
    left.legend(loc="best")
    right.barh(range(len(names)), [100 * e.time_saved if math.isfinite(e.time_saved) else 0 for e in effects], 0.5,
               color=[drawing.PALETTE["good" if e.time_saved > 0 else "bad"] for e in effects])
    right.axvline(0, color=drawing.PALETTE["soft"], linewidth=1)
    right.grid(axis="y", visible=False)
    right.set_xlabel("processor time saved  [%]")
    return [("Each alteration alone: what it changes, what it saves", drawing.save(made, folder / "terms"), "charts/terms")]


def answer(study, effects, errors, out):
    header, rows = cells(study, effects, errors)
    write(out / "table.md", lambda file: file.write(markdown(header, rows)))
    write(out / "terms.csv", lambda file: csv.writer(file).writerows(plain(study, effects, errors)))
    numbers = tuple(range(1, len(header) - 1))
    note = (f'<p class="note">Discretisation error of the shipped case: its difference from the run '
            f"'{html.escape(study.terms.discretisation)}', by Richardson's extrapolation with order {study.terms.order:g}. "
            'The same as <a href="table.md">table.md</a>, for a README, and <a href="terms.csv">terms.csv</a>.</p>')
    return Answer("No more model than the scene needs", sentence(effects), tables.table(header, rows, numbers) + note)


def sentence(effects):
    """The alterations by verdict."""
    by_verdict = {}
    for effect in effects:
        saved = f" ({100 * effect.time_saved:.0f} % of the time)" if effect.verdict == LEFT_OUT else ""
        by_verdict.setdefault(effect.verdict.partition(":")[0] if effect.verdict != LEFT_OUT else "can be left out",
                              []).append(effect.name + saved)
    order = ["can be left out", NEEDED, FREE]
    ranked = sorted(by_verdict.items(), key=lambda item: order.index(item[0]) if item[0] in order else len(order))
    return "\n".join(f"{words[0].upper()}{words[1:]}: {', '.join(names)}." for words, names in ranked)


def shown(value, unit):
    """1.2e-3, "m" -> 1.2 mm"""
    if not math.isfinite(value):
        return "–"
    factor, unit = (1, "s") if unit == "s" else data.scaled(unit, abs(value))
    return f"{value * factor:+.3g} {unit}".strip() if value else "0"


def cells(study, effects, errors):
    """Heading and rows as texts; the last row gives the discretisation error itself."""
    units = study.units()
    header = ["alteration"]
    for quantity in study.terms.quantities:
        header += [f"change of {quantity.replace('_', ' ')}", "in discretisation errors"]
    header += ["time saved [%]", "verdict"]
    rows = []
    for effect in effects:
        row = [effect.name]
        for quantity in study.terms.quantities:
            row += [shown(effect.changes[quantity], units[quantity]), number(effect.in_errors[quantity])]
        rows.append([*row, number(100 * effect.time_saved, ".0f"), effect.verdict])
    row = ["discretisation error"]
    for quantity in study.terms.quantities:
        row += [shown(errors[quantity], units[quantity]).lstrip("+"), "1"]
    return header, [*rows, [*row, "", ""]]


def number(value, form=".2g"):
    return f"{value:{form}}" if math.isfinite(value) else "–"


def markdown(header, rows):
    line = "| " + " | ".join(header) + " |\n" + "|---" * len(header) + "|\n"
    return line + "".join("| " + " | ".join(cell.replace("|", "/") for cell in row) + " |\n" for row in rows)


def plain(study, effects, errors):
    """Rows of terms.csv, in SI units."""
    units = study.units()
    header = ["alteration"]
    for quantity in study.terms.quantities:
        unit = f"[{units[quantity]}]" if units[quantity] else ""
        header += [f"change_{quantity}{unit}", f"discretisation_error_{quantity}{unit}", f"{quantity}_in_errors"]
    yield [*header, "time_saved", "verdict"]
    for effect in effects:
        row = [effect.name]
        for quantity in study.terms.quantities:
            values = effect.changes[quantity], errors[quantity], effect.in_errors[quantity]
            row += [number(value, ".6g") for value in values]
        yield [*row, number(effect.time_saved, ".4g"), effect.verdict]


def write(path, fill):
    with whole_file(path) as file:
        fill(file)
