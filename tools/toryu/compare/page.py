"""`compare.html`: one page that needs no network and no other file; its charts lie beside it too."""

import html
import pathlib
import string

from toryu import printable, program
from toryu.compare.runs import percent
from toryu.report import player, tables
from toryu.results import readable, unit_of
from toryu.study import drawing
from toryu.study.page import figure
from toryu.study.table import readable_size

HERE = pathlib.Path(__file__).resolve().parent
MOST_DRAWN = 16  # columns, the farthest apart first
KEYS = "Wheel: zoom. Drag: move. Space: play. Arrow keys: one frame."


def write(comparison, names, motion, out):
    """`motion`: content for the player, {} if there is nothing to play, and what to say of it."""
    content, note = motion
    drawn = [(f"{column.series}: {readable(column.name)}", draw(column, names, out / "charts" / f"chart_{number:02}"),
              f"charts/chart_{number:02}") for number, column in enumerate(comparison.columns[:MOST_DRAWN], 1)]
    left_out = len(comparison.columns) - len(drawn)
    text = string.Template((HERE / "page.html").read_text(encoding="utf-8")).substitute(
        title=html.escape(" against ".join(names)),
        style=(HERE.parent / "report/style.css").read_text(encoding="utf-8"),
        damage=tables.damage(comparison.faults),
        player=player.markup(choice(names)) if content else "", motion_note=" ".join([KEYS] * bool(content) + [note]),
        data=player.embedded(content | {"telling": {"time": telling(comparison)}}),
        script=player.script([HERE.parent / "report" / file for file in ("chart.js", *player.SCRIPTS)] + [HERE / "page.js"]),
        settings=settings(comparison, names), charts="".join(map(figure, drawn)), columns=columns(comparison, names),
        left_out=f"{left_out} that differ less are in the table alone." if left_out else "",
        alike=f"{comparison.alike} columns are the same in both." + (
            f" Without a number at such times: {html.escape(', '.join(comparison.apart))}." if comparison.apart else "") + (
            f" One run alone has {html.escape(', '.join(comparison.alone))}." if comparison.alone else ""))
    program.write_whole(out / "compare.html", text)


def choice(names):
    """Which run the player shows."""
    texts = {"both": f"both, {names[1]} as an outline", "0": f"{names[0]} alone", "1": f"{names[1]} alone"}
    options = "".join(f'<option value="{value}">{html.escape(text)}</option>' for value, text in texts.items())
    return f'<label>show <select id="shown">{options}</select></label>'


def telling(comparison):
    """The moment at which the page opens: where what is told first is farthest apart [s]."""
    return comparison.columns[0].apart_at if comparison.columns else 0.0


def draw(column, names, path):
    """Both lines, the second dashed over the first."""
    made, (panel,) = drawing.figure()
    factor, unit = readable_size(unit_of(column.name), [v for run in column.values for v in run])
    for number, (name, times, values) in enumerate(zip(names, column.times, column.values)):
        panel.plot(times, [factor * v for v in values], color=drawing.LINES[number], label=name,
                   linestyle="-" if number == 0 else (0, (4, 2)))
    panel.set_xlabel("time [s]")
    label = f"{readable(column.name)} [{unit}]" if unit else readable(column.name)
    panel.set_ylabel(printable(label))  # XML holds no control characters
    panel.legend()
    return drawing.save(made, path)


def settings(comparison, names):
    if not comparison.settings:
        return "<p>None that both runs tell.</p>"
    return tables.table(["key of the case", *names], comparison.settings)


def columns(comparison, names):
    rows = [[column.place, *map(tables.number, column.peaks), percent(column.change), percent(column.distance)]
            for column in comparison.columns]
    return tables.table(["series", *(f"peak, {name}" for name in names), "change", "distance"], rows, range(1, 5))
