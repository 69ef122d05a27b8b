"""`study.html`: one page that needs no network and no other file."""

import datetime
import html
import math
import os
import pathlib
import platform
import re
import string

from toryu import counted, program, results
from toryu.processes import DONE
from toryu.report import data, tables
from toryu.study import runner, timing
from toryu.study.progress import duration
from toryu.study.table import readable_size

HERE = pathlib.Path(__file__).resolve().parent
SCALE = 1.19  # pixels of the page for a point of a chart


def write(path, study, table, records, drawn, answers, versions):
    """`drawn`: (title, SVG, file without ending) of each chart."""
    text = string.Template((HERE / "page.html").read_text(encoding="utf-8")).substitute(
        title=html.escape(study.title), name=html.escape(study.name),
        style=(HERE.parent / "report/style.css").read_text(encoding="utf-8"),
        script=(HERE / "page.js").read_text(encoding="utf-8"), state=state(records), tiles=tiles(study, table, records),
        answers="".join(f'<section id="answer"><h2>{html.escape(a.title)}</h2><p class="answer">'
                        f"{html.escape(a.sentence)}</p>{a.html}</section>" for a in answers),
        charts="".join(map(figure, drawn)), table=runs(study, table),
        timing=f'<p class="note">{html.escape(timing.sentence(study.timing, records))}</p>' if study.timing else "",
        axes=axes(study), fixed=fixed(study, records),
        provenance=provenance(records, versions), study=html.escape(study.text),
        case=html.escape(study.case.read_text(encoding="utf-8")))
    program.write_whole(path, text)


def state(records):
    failed = sum(r.exit_code != DONE for r in records)
    if hung := sum(r.exit_code == runner.HUNG for r in records):
        return f'<span class="badge bad">{hung} of {counted(len(records), "run")} hung: a bug</span>'
    if not failed:
        return '<span class="badge good">All runs done</span>'
    return f'<span class="badge stopped">Done; {failed} of {counted(len(records), "run")} ended by their physics</span>'


def tiles(study, table, records):
    processor = [v for v in table.column("processor_time") if math.isfinite(v)]
    names = ", ".join(axis.name.replace("_", " ") for axis in study.axes)
    parts = [tables.tile("runs", str(len(records)), combinations(study)),
             tables.tile("axes", str(len(study.axes)), names),
             tables.tile("elapsed, all runs", duration(sum(r.elapsed for r in records)),
                         f"{duration(sum(processor))} of processor"),
             tables.tile("at a time", " or ".join(sorted({str(r.jobs) for r in records})), "runs, each with "
                         f"{' or '.join(sorted({str(r.threads) for r in records}))} of {os.cpu_count()} cores")]
    return "".join(parts)


def combinations(study):
    """How the number of runs comes about."""
    if study.searched:
        return "as many as the search took"
    rounds = f"{study.timing.repeat} times " if study.timing else ""
    but = ", some left out" if study.leave_out else ""
    return rounds + " × ".join(str(len(axis.values)) for axis in study.axes) + but


def figure(chart):
    title, svg, place = chart
    width = float(re.search(r'viewBox="0 0 ([\d.]+)', svg)[1]) * SCALE
    return (f'<figure class="drawn" style="flex-basis: {width:.0f}px"><figcaption>{html.escape(title)} '
            '<span class="files">'
            f'<a href="{place}.png">PNG</a> <a href="{place}.svg">SVG</a></span></figcaption>{svg}</figure>')


def column(name, table, study):
    """Heading of an axis, as the study gives it, or of a figure with the factor that brings it to a readable size."""
    if name in (axis.name for axis in study.axes):
        return 1, heading(name, table.units[name])
    factor, unit = readable_size(table.units[name], table.column(name))
    return factor, heading(name, unit)


def heading(name, unit):
    unit = f' <span class="unit">{html.escape(data.pretty(unit))}</span>' if unit else ""
    return f"<th>{html.escape(name.replace('_', ' '))}{unit}</th>"


def cell(value, factor=1):
    if isinstance(value, str):
        return tables.cell(value)
    if not math.isfinite(value):
        return tables.cell("–", class_="number")
    shown = str(value) if isinstance(value, int) else f"{value * factor:.4g}"
    return f'<td class="number" data-value="{float(value)!r}">{shown}</td>'


def sortable(headings, rows):
    """`rows`: (run key, class, cells as HTML)."""
    body = "".join(f'<tr data-run="{key}" class="{kind}">{"".join(cells)}</tr>' for key, kind, cells in rows)
    return (f'<div class="scroll"><table class="sortable"><thead><tr>{"".join(headings)}</tr></thead>'
            f"<tbody>{body}</tbody></table></div>")


def runs(study, table):
    failed = any(row["cause"] for row in table.rows)
    factors, headings = zip(*(column(name, table, study) for name in table.units))
    headings = [*headings, *["<th>why it ended</th>"] * failed, "<th>results</th>"]
    rows = []
    for row in table.rows:
        record = row["record"]
        cells = [cell(row.get(name, math.nan), factor) for name, factor in zip(table.units, factors)]
        cells += [tables.cell(row["cause"], class_="cause", title=html.escape(row["cause"]))] * failed
        place = f"runs/{record.folder.name}/" + ("report.html" if study.keep_frames else "")
        cells.append(f'<td><a href="{place}">{record.folder.name}</a></td>')
        rows.append((record.folder.name, "failed" if row["cause"] else "", cells))
    return sortable(headings, rows)


def axes(study):
    rows = []
    for axis in study.axes:
        for value in axis.values:
            sets = ", ".join(f"{key} = {text(inner)}" for key, inner in value.overrides.items())
            rows.append([axis.name.replace("_", " ") if value is axis.values[0] else "",
                         f"{text(value.name)} {data.pretty(axis.unit)}", sets or "as in the case"])
    return tables.table(["axis", "value", "sets"], rows)


def setting_text(study, row):
    axes = [axis for axis in study.axes if row[axis.name] != axis.default] or study.axes
    return ", ".join(f"{axis.name.replace('_', ' ')} {text(row[axis.name])} {axis.unit}".strip() for axis in axes)


def text(value):
    return f"{value:g}" if isinstance(value, float) else str(value)


def fixed(study, records):
    """Overrides with one and the same value in all runs that no axis names."""
    named = {key for axis in study.axes for value in axis.values for key in value.overrides}
    rows = [[key, value] for key, value in records[0].setting.overrides.items() if key not in named]
    return tables.table(["key of the case", "value"], [["case", str(study.case.name)], *rows])


def provenance(records, versions):
    made = next((s["provenance"] for r in records for s in results.read_summaries(r.folder).values()
                 if "provenance" in s), {})
    rows = [["programs", "; ".join(versions)]]
    rows += [[key, str(made[key])] for key in ("compiler", "flags", "cpu") if key in made]
    rows += [["machine", f"{platform.system()} {platform.release()}, {os.cpu_count()} cores"],
             ["page made", datetime.datetime.now().astimezone().strftime("%Y-%m-%d %H:%M %Z")]]
    return tables.table(["", ""], rows)
