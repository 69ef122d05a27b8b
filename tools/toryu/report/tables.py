"""The parts of the page that are plain HTML: state, key figures, tables."""

import html
import math
import re

from toryu import results
from toryu.processes import DONE, INTERRUPTED
from toryu.report import data

MOST_FAULTS = 12  # told of files that are damaged
MOST_PARTS = 7  # named in a bar; the rest is summed


def cell(text, kind="td", **attributes):
    extra = "".join(f' {name.rstrip("_")}="{value}"' for name, value in attributes.items())
    return f"<{kind}{extra}>{html.escape(str(text))}</{kind}>"


def table(header, rows, number_columns=()):
    def line(values, kind):
        return "<tr>" + "".join(cell(v, kind, class_="number") if i in number_columns else cell(v, kind)
                                for i, v in enumerate(values)) + "</tr>"

    body = "".join(line(row, "td") for row in rows)
    return f'<div class="scroll"><table><thead>{line(header, "th")}</thead><tbody>{body}</tbody></table></div>'


SYMBOLS = {"alpha": "α", "beta": "β", "gamma": "γ", "delta": "δ", "epsilon": "ε", "eta": "η", "theta": "θ", "lambda": "λ",
           "mu": "μ", "nu": "ν", "pi": "π", "rho": "ρ", "sigma": "σ", "tau": "τ", "phi": "φ", "psi": "ψ", "omega": "ω",
           "Delta": "Δ", "Gamma": "Γ", "Omega": "Ω", "Phi": "Φ", "Pi": "Π", "Psi": "Ψ", "Sigma": "Σ", "grad": "∇",
           "sum": "Σ", "Drho": "Dρ"}


def formula(text):
    """Plain text of a formula as HTML: Greek letters, subscripts, superscripts, units."""
    text = re.sub(r"(?<![A-Za-z])(grad(?=W)|[A-Za-z]+(?![A-Za-z]))", lambda found: SYMBOLS.get(found[0], found[0]), text)
    text = re.sub(r"(?<=\w)_([^\W_]+)", r"<sub>\1</sub>", html.escape(text))
    text = re.sub(r"(?<=[ /.]m|[ /.]s)([23])\b", r"<sup>\1</sup>", text)
    return re.sub(r"\^(-?\w+)", r"<sup>\1</sup>", text).replace(" - ", " − ")


def program(participant):
    return participant if participant == "coupler" else f"{participant} solver"


def number(value):
    return f"{value:.4g}"


def state(run):
    kind = "good" if run["code"] == DONE else "stopped" if run["code"] in (INTERRUPTED, None) else "bad"
    badge = f'<span class="badge {kind}">{html.escape(run["meaning"])}</span>'
    if run["code"] == DONE or run["code"] is None and not run["words"]:
        return badge
    code = "" if run["code"] is None else f"<p>Exit code {run['code']}.</p>"
    words = "".join(f"<p>{html.escape(line)}</p>" for line in run["words"].splitlines())
    return f'{badge}<div class="words {kind}">{code}{words}</div>'


def damage(faults):
    """What could not be shown."""
    lines = "".join(f"<p>{html.escape(fault)}</p>" for fault in faults[:MOST_FAULTS])
    more = f"<p>and {len(faults) - MOST_FAULTS} more</p>" if len(faults) > MOST_FAULTS else ""
    return f'<div class="words stopped"><p>Left out of this page:</p>{lines}{more}</div>' if faults else ""


def warning_lines(out, most=20):
    """What the programs warned of, each once: where a run failed, often what foretold it."""
    path = out / "log.txt"
    text = path.read_text(encoding="utf-8", errors="replace") if path.is_file() else ""
    found = list(dict.fromkeys(re.findall(r"^\S+ \S+ (\w+ warning: .*)$", text, re.MULTILINE)))
    more = [f"and {len(found) - most} more, see log.txt"] if len(found) > most else []
    return found[:most] + more


def warnings(out):
    lines = "".join(f"<p>{html.escape(line)}</p>" for line in warning_lines(out))
    return f'<div class="words stopped" id="warnings">{lines}</div>' if lines else ""


def tile(label, value, note=""):
    return (f'<div class="tile"><div class="label">{html.escape(label)}</div>'
            f'<div class="value">{html.escape(value)}</div><div class="note">{html.escape(note)}</div></div>')


def figures(out, summaries, comparisons, run):
    """Key figures: how far, how long, peaks, distances."""
    tiles = []
    if summaries:
        wall = max(s["wall_time"] for s in summaries.values())
        reached = max(s["simulated_time"] for s in summaries.values())
        tiles.append(tile("simulated", f"{number(reached)} s", "" if run["code"] == DONE else "not to the end"))
        tiles.append(tile("wall time", f"{wall:.1f} s", f"{sum(s['processor_time'] for s in summaries.values()):.1f}"
                                                        " s of processor"))
    tiles += removed(results.read_series(out, "fluid"))
    series = results.read_series(out, "solid")
    for column, values in series.items():
        found = re.fullmatch(r"(\w+)_displacement_(\w)\[m\]", column)
        if found and any(map(math.isfinite, values)):
            time, value = results.peak(series["time[s]"], values)
            factor, unit = data.scaled("m", abs(value))
            tiles.append(tile(f"peak {results.readable(found[1])} displacement {found[2]}", f"{number(value * factor)} {unit}",
                              f"at {number(time)} s"))
    for comparison in comparisons:
        if math.isfinite(comparison.distance):
            tiles.append(tile(f"distance in {comparison.quantity}", f"{100 * comparison.distance:.1f} %",
                              f"root mean square, of the peak of '{comparison.label}'; {found_and_expected(out, comparison)}"))
    return "".join(tiles)


def found_and_expected(out, comparison):
    """The largest value of the run and of its reference, at the reference's times."""
    series = results.read_series(out, comparison.series)
    times = series["time[s]"]
    expected = [point for point in comparison.reference if point[0] <= times[-1]]
    found = [(t, results.interpolate(t, times, series[comparison.column])) for t, _ in expected]
    values = [results.peak(*zip(*points))[1] for points in (found, expected)]
    factor, unit = data.scaled(comparison.unit, max(map(abs, values)))
    return f"largest {number(values[0] * factor)} {unit}, expected {number(values[1] * factor)}"


def removed(series):
    """What came off the work pieces: the mean depth, and the largest over it."""
    ends = [next((v for v in reversed(series.get(f"removed_depth_{kind}[m]", [])) if math.isfinite(v)), 0.0)
            for kind in ("mean", "largest")]
    if ends[0] <= 0:
        return []
    factor, unit = data.scaled("m", ends[0])
    return [tile("removed depth", f"{number(ends[0] * factor)} {unit}", "mean over the work pieces' surface"),
            tile("evenness", number(ends[1] / ends[0]), "largest over mean removed depth")]


def parts_of(summary):
    """(name, seconds, kind) of the wall time: the longest parts, the rest, waiting (which parts may hold already)."""
    wall, waiting = summary["wall_time"], summary["waiting_time"]
    parts = sorted(summary.get("part", []), key=lambda p: -p["seconds"])
    named = [(p["name"], p["seconds"], "part") for p in parts[:MOST_PARTS] if p["seconds"] > 0.003 * wall]
    rest = max(0.0, wall - sum(seconds for _, seconds, _ in named))
    waiting = min(waiting, rest)
    unnamed = [("other", rest - waiting, "other"), ("waiting", waiting, "waiting")]
    return named + [piece for piece in unnamed if piece[1] > 0.003 * wall]


def times(summaries):
    """A bar a process, on one scale, and the table behind it."""
    longest = max((s["wall_time"] for s in summaries.values()), default=0)
    if longest <= 0:
        return "<p>No process left its times.</p>"
    bars, rows = [], []
    for participant, summary in summaries.items():
        wall = summary["wall_time"]
        pieces = []
        for i, (name, seconds, kind) in enumerate(parts_of(summary)):
            share = seconds / longest
            label = f"{name} {seconds:.2f} s"
            colour = f"{kind} p{i}" if kind == "part" else kind
            pieces.append(f'<span class="{colour}" style="width:{share:.4%}" title="{html.escape(label)}">'
                          f"{html.escape(name) if share > 0.08 else ''}</span>")
        share = f"{100 * summary['waiting_time'] / wall:.0f} % waiting" if summary["waiting_time"] > 0 and wall > 0 else ""
        bars.append(f'<div class="process"><div class="who">{html.escape(program(participant))}</div>'
                    f'<div class="bar">{"".join(pieces)}</div>'
                    f'<div class="sum">{wall:.1f} s<br><small>{share}</small></div></div>')
        rows.append([program(participant), "all", f"{wall:.2f}", "100 %", summary["steps"], ""])
        calls = {p["name"]: p["calls"] for p in summary.get("part", [])}
        for name, seconds, _ in parts_of(summary):
            n = calls.get(name, 0)
            rows.append(["", name, f"{seconds:.2f}", f"{100 * seconds / wall:.1f} %" if wall > 0 else "", n or "",
                         f"{seconds / n * 1e3:.3g}" if n else ""])
    detail = table(["process", "part", "time [s]", "share", "calls", "a call [ms]"], rows, (2, 3, 4, 5))
    return f'<div class="bars">{"".join(bars)}</div><details><summary>All parts</summary>{detail}</details>'


def terms(summaries):
    text = ""
    for participant, summary in summaries.items():
        rows = "".join(f'<tr>{cell(t["name"])}<td class="formula">{formula(t["formula"])}</td><td>{formula(t["parameters"])}</td>'
                       f'{cell(t["source"])}</tr>' for t in summary.get("term", []))
        if rows:
            text += (f'<h3>{html.escape(program(participant))}</h3><div class="scroll"><table class="terms"><thead><tr>'
                     "<th>term</th><th>formula</th><th>parameters</th><th>source</th></tr></thead>"
                     f"<tbody>{rows}</tbody></table></div>")
    return text or "<p>No process left its terms.</p>"


def particles(summaries):
    rows = [[program(p), name, f"{count:,}".replace(",", " ")]
            for p, s in summaries.items() for name, count in s.get("particles", {}).items()]
    return table(["process", "body", "particles"], rows, (2,)) if rows else "<p>None were counted.</p>"


def numbers(summaries):
    """Steps and other figures of the processes."""
    rows = []
    for p, s in summaries.items():
        rows.append([program(p), "windows" if p == "coupler" else "steps", f"{s['steps']:,}".replace(",", " ")])
        if s["steps"] and 0 < s["smallest_time_step"] < math.inf:
            rule = f" ({s['time_step_rule']})" if s["time_step_rule"] else ""
            bounds = dict.fromkeys(number(s[f"{bound}_time_step"]) for bound in ("smallest", "largest"))
            rows.append(["", f"time step{rule}", f"{' to '.join(bounds)} s"])
        rows += [["", name.replace("_", " "), number(value)] for name, value in s.get("figures", {}).items()]
    return table(["process", "figure", "value"], rows, (2,))


def provenance(summaries):
    """What made the numbers; what is the same in all processes is said once."""
    made = {program(p): s["provenance"] for p, s in summaries.items()}
    rows = []
    for key in dict.fromkeys(k for values in made.values() for k in values):
        values = {who: str(values.get(key, "")) for who, values in made.items()}
        if len(set(values.values())) == 1:
            rows.append([key, next(iter(values.values()))])
        else:
            rows.append([key, "; ".join(f"{who}: {value}" for who, value in values.items())])
    return table(["", "all processes"], rows)


def log_tail(out, lines=60):
    path = out / "log.txt"
    return "\n".join(path.read_text(encoding="utf-8", errors="replace").splitlines()[-lines:]) if path.is_file() else ""
