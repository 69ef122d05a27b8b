"""What a map says: the edge in each column, against theory; as a table, a page and sentences."""

import csv
import html
import math
from collections import Counter
from dataclasses import dataclass

from toryu import counted
from toryu.program import whole_file
from toryu.report import tables
from toryu.study import bisection, page, verdicts
from toryu.study.answer import Answer


@dataclass
class Column:
    """A column of a bisected map: one value of x, one of the edges axis."""

    x: float
    edge_of: object  # value of the axis `edges`, None without
    rows: list[dict]  # from the stable side on
    stable: float | None  # the last value before the first failure
    unstable: float | None  # the first failure
    against: list[float]  # values beyond it that are stable all the same

    def edge(self, y):
        """Between both, nan if there is no edge within the range."""
        return math.nan if self.stable is None else bisection.middle(y, self.stable, self.unstable)


def columns(study, table):
    made, y, found = study.map, study.map.y, {}
    for row in table.rows:
        found.setdefault((row[made.edges] if made.edges else None, row[made.x_name]), []).append(row)
    result = []
    for (edge_of, x), rows in found.items():
        tried = {row[y.axis.name]: row["verdict"] == verdicts.STABLE for row in rows}
        bracket = bisection.bracket(y, tried) or (None, None)
        rows = sorted(rows, key=lambda row: row[y.axis.name], reverse=y.unstable < y.stable)
        result.append(Column(x, edge_of, rows, *bracket, bisection.contradictions(y, tried)))
    return result


def ratio(column, y, theory):
    """Measured over theory."""
    value = theory(column.x)
    return column.edge(y) / value if value else math.nan


def theories_of(study, column):
    return [t for t in study.map.theories if t.edge in (None, column.edge_of)]


def answers(study, table, out):
    made = study.map
    parts = [explanation(made.explanation), tally(table)]
    sentences = [counts(table)]
    if made.y:
        every = columns(study, table)
        write_edges(study, every, out / "edges.csv")
        sentences += edge_sentences(study, every)
        parts.insert(1, edge_table(study, every) + '<p class="note">The same in <a href="edges.csv">edges.csv</a>.</p>')
    hung = [row for row in table.rows if row["verdict"] == verdicts.HANGS]
    if hung:
        sentences.insert(0, f"{len(hung)} of the runs HUNG: {page.setting_text(study, hung[0])}. That is a bug.")
    return [Answer("Where it fails", "\n".join(sentences), "".join(parts))]


def counts(table):
    found = Counter(row["verdict"] for row in table.rows)
    told = ", ".join(f"{found[kind]} {kind}" for kind in verdicts.WORDS if found[kind])
    return f"{counted(len(table.rows), 'run')}: {told}."


def edge_sentences(study, every):
    made, y, sentences = study.map, study.map.y, []
    for edge_of in dict.fromkeys(column.edge_of for column in every):
        mine = [column for column in every if column.edge_of == edge_of]
        found = [column for column in mine if column.stable is not None]
        name = f"{edge_of}: " if edge_of is not None else ""
        edges = [column.edge(y) for column in found]
        text = f"{name}an edge at {len(found)} of {counted(len(mine), 'value')} of {made.x_name.replace('_', ' ')}"
        if edges:
            text += f", {y.axis.name.replace('_', ' ')} {min(edges):.4g} to {max(edges):.4g} {y.axis.unit}".rstrip()
        text += "."
        for theory in [t for t in made.theories if t.edge in (None, edge_of)]:
            ratios = [r for column in found if math.isfinite(r := ratio(column, y, theory))]
            if ratios:
                text += f" Measured over theory ({theory.label}): {min(ratios):.3g} to {max(ratios):.3g}."
        sentences.append(text)
    odd = [column for column in every if column.against]
    if odd:
        sentences.append(f"{len(odd)} {'column is' if len(odd) == 1 else 'columns are'} not monotone: stable runs lie beyond "
                         "the first failure (ringed in the chart).")
    return sentences


def edge_table(study, every):
    made, y = study.map, study.map.y
    header = [made.x_name.replace("_", " ")] + ([made.edges.replace("_", " ")] if made.edges else [])
    unit = f" [{y.axis.unit}]" if y.axis.unit else ""
    header += [f"last stable{unit}", f"first failure{unit}", "how it fails", "seen at [s]"]
    header += [f"over theory: {t.label}" for t in made.theories] + ["not monotone at"]
    rows = []
    for column in every:
        failure = next((row for row in column.rows if row[y.axis.name] == column.unstable), None)
        if column.stable is None:
            failure = column.rows[0] if column.rows[0]["verdict"] != verdicts.STABLE else None
        rows.append([f"{column.x:g}"] + ([str(column.edge_of)] if made.edges else []) + [
            shown(column.stable, "none" if failure else f"all up to {y.unstable:g}"),
            shown(column.unstable, "all" if failure else "none"),
            f"{failure['verdict']}: {failure['cause']}" if failure else "",
            f"{failure['detected_at']:.4g}" if failure and math.isfinite(failure["detected_at"]) else "",
            *(f"{ratio(column, y, t):.3g}" if t in theories_of(study, column) and math.isfinite(ratio(column, y, t)) else ""
              for t in made.theories),
            ", ".join(f"{v:g}" for v in column.against)])
    return tables.table(header, rows)


def shown(value, otherwise):
    return otherwise if value is None else f"{value:.5g}"


def write_edges(study, every, path):
    """edges.csv: a row a column of the map."""
    made, y = study.map, study.map.y
    name, unit = y.axis.name, f"[{y.axis.unit}]" if y.axis.unit else ""
    header = [made.x_name] + ([made.edges] if made.edges else []) + [
        f"{name}_stable{unit}", f"{name}_unstable{unit}", f"{name}_edge{unit}", "verdict", "cause", "contradictions"]
    for theory in made.theories:
        header += [f"theory {theory.label}", f"measured over theory {theory.label}"]
    with whole_file(path) as file:
        writer = csv.writer(file)
        writer.writerow(header)
        for column in every:
            failure = next((row for row in column.rows if row["verdict"] != verdicts.STABLE), {})
            line = [column.x] + ([column.edge_of] if made.edges else [])
            line += [blank(column.stable), blank(column.unstable), blank(column.edge(y)), failure.get("verdict", ""),
                     failure.get("cause", ""), " ".join(f"{v:g}" for v in column.against)]
            for theory in made.theories:
                mine = theory in theories_of(study, column)
                line += [blank(theory(column.x)), blank(ratio(column, y, theory))] if mine else ["", ""]
            writer.writerow(line)


def blank(value):
    return "" if value is None or not math.isfinite(value) else f"{value:.6g}"


def tally(table):
    """How often each verdict came, and how failures were told."""
    causes = Counter((row["verdict"], row["cause"]) for row in table.rows if row["verdict"] != verdicts.STABLE)
    rows = [[kind, cause, str(number)] for (kind, cause), number in causes.most_common(12)]
    told = tables.table(["verdict", "as told", "runs"], rows) if rows else ""
    words = tables.table(["verdict", "means"], [[kind, text] for kind, text in verdicts.WORDS.items()])
    return f"<details><summary>Verdicts, and how failures are told</summary>{words}{told}</details>"


def explanation(text):
    return "".join(f"<p>{html.escape(paragraph)}</p>" for paragraph in text.split("\n\n"))
