"""How charts look: matplotlib in the colours of the pages, saved as PNG and SVG, and as SVG for a page."""

import io
import math
import pathlib
import re
import textwrap

import matplotlib
import matplotlib.figure
import matplotlib.ticker

from toryu.report import data

STYLE = pathlib.Path(__file__).resolve().parents[1] / "report/style.css"
# The light palette of the pages: name -> colour. On a page each colour becomes its variable again, so that the
# charts follow the reader's choice of light or dark.
PALETTE = {name: colour for name, colour in re.findall(r"--(\w+): (#[0-9a-f]{6});",
                                                       STYLE.read_text(encoding="utf-8").split("@media")[0])
           if name != "accent"}  # the same as c0
LINES = [PALETTE[f"c{i}"] for i in range(7)]
MARKERS = "osD^vPX"
WIDTH_OF_AXES = 0.6  # of the picture, beside legend and labels
LETTER, LINE = 0.085, 0.2  # [inch] of a digit of the labels, and of a line of them
WIDTH, HEIGHT = 6.2, 3.6  # [inch] of a single panel; several share twice the width, that of the page

matplotlib.rcdefaults()  # not what the user has set for other charts
matplotlib.rcParams.update({
    "text.parse_math": False,  # a name may hold a dollar
    "svg.fonttype": "none", "font.family": "sans-serif", "font.sans-serif": ["DejaVu Sans"], "font.size": 9.5,
    "axes.titlesize": 10, "axes.titlelocation": "left", "axes.edgecolor": PALETTE["soft"],
    "axes.labelcolor": PALETTE["ink"],
    "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True, "grid.color": PALETTE["line"],
    "grid.linewidth": 0.8, "axes.axisbelow": True, "xtick.color": PALETTE["soft"], "ytick.color": PALETTE["soft"],
    "xtick.labelcolor": PALETTE["ink"], "ytick.labelcolor": PALETTE["ink"], "text.color": PALETTE["ink"],
    "lines.linewidth": 1.8, "lines.markersize": 5, "legend.frameon": False, "legend.fontsize": 9, "legend.handlelength": 3.5,
    "figure.facecolor": "none", "axes.facecolor": "none", "savefig.facecolor": "none", "axes.formatter.limits": (-3, 5),
})


def figure(columns=1, height=HEIGHT):
    """A figure and its panels side by side."""
    made = matplotlib.figure.Figure(figsize=(WIDTH if columns == 1 else 2 * WIDTH, height), layout="constrained")
    return made, list(made.subplots(1, columns, squeeze=False, sharey=True).flat)


def save(made, path):
    """PATH.png and PATH.svg, on white; returns the SVG for a page, in the page's own colours."""
    made.draw_without_rendering()
    made.set_layout_engine("none")  # the panels stay where they are now: to lay them out takes as long as to draw them
    made.savefig(path.with_name(path.name + ".png"), dpi=160, facecolor="white")
    text = io.StringIO()
    with matplotlib.rc_context({"svg.hashsalt": path.name}):
        made.savefig(text, format="svg", metadata={"Date": None})
    text = text.getvalue()
    head = text.index('<g id="figure_1">')
    white = '<rect width="100%" height="100%" fill="white"/>\n '
    path.with_name(path.name + ".svg").write_text(text[:head] + white + text[head:], encoding="utf-8")
    return for_page(text)


def for_page(text):
    """The <svg> element alone; its size is left to the page, its colours to the style."""
    text = text[text.index("<svg"):]
    text = re.sub(r"<metadata>.*?</metadata>", "", text, flags=re.DOTALL)
    text = re.sub(r'<g id="(?!run-)[^"]*">', "<g>", text)
    text = re.sub(r'(<svg[^>]*?) width="[^"]*"', r"\1", re.sub(r'(<svg[^>]*?) height="[^"]*"', r"\1", text, 1), 1)
    text = re.sub(r"font: ([^;\"]*?)'DejaVu Sans'[^;\"]*", r"font: \1sans-serif", text)
    for name, colour in PALETTE.items():
        text = text.replace(colour, f"var(--{name})")
    return text


class LogMarks(matplotlib.ticker.Locator):
    """1, 2, 5, 10, ...; powers of ten, or every second or third of them, where the texts would run into each other; even
    steps on an axis that holds hardly one of these."""

    def __call__(self):
        return self.tick_values(*self.axis.get_view_interval())

    def tick_values(self, vmin, vmax):
        low, high = (math.floor(math.log10(v)) for v in sorted((vmin, vmax)))
        marks = [k * 10.0**n for n in range(low, high + 1) for k in (1, 2, 5)]
        if sum(vmin <= mark <= vmax for mark in marks) < 2:
            return matplotlib.ticker.MaxNLocator(3).tick_values(vmin, vmax)
        step = 0
        while not self.are_apart(marks, math.log10(vmax / vmin)) and step <= high - low:
            step += 1
            marks = [10.0**n for n in range(low, high + 1) if n % step == 0]
        return marks

    def are_apart(self, marks, decades):
        box, across = self.axis.axes.get_window_extent(), self.axis.axis_name == "x"
        decade = (box.width if across else box.height) / self.axis.figure.dpi / decades  # [inch]
        sizes = [(len(f"{mark:g}") + 1) * LETTER if across else LINE for mark in marks]
        return all(math.log10(b / a) * decade > (size + other) / 2
                   for a, b, size, other in zip(marks, marks[1:], sizes, sizes[1:]))


def logarithmic(panel, which):
    """Makes the "x" or "y" axis logarithmic, with plain numbers."""
    getattr(panel, f"set_{which}scale")("log")
    axis = getattr(panel, f"{which}axis")
    axis.set_major_locator(LogMarks())
    axis.set_major_formatter(matplotlib.ticker.FormatStrFormatter("%g"))
    axis.set_minor_locator(matplotlib.ticker.NullLocator())


def width_of(panel):
    """About that of its axes [inch]."""
    return panel.figure.get_figwidth() / panel.get_subplotspec().get_gridspec().ncols * WIDTH_OF_AXES


def ticks(panel, values, texts):
    """Marks at the values; a text that would run into the one before is left out."""
    log = panel.get_xscale() == "log" and min(values) > 0
    places = [math.log(v) if log else v for v in values]
    span = (max(places) - min(places)) or 1
    end, shown = -math.inf, {}
    for place, value, text in sorted(zip(places, values, texts)):
        centre, half = (place - min(places)) / span * width_of(panel), len(text) * LETTER / 2
        shown[value] = text if centre - half > end else ""
        end = centre + half + LETTER if shown[value] else end
    panel.set_xticks(values, [shown[value] for value in values])


def choices(panel, texts):
    """A mark for each choice, 0, 1, ...; a text is broken into lines where it is wider than its share of the axis."""
    letters = max(int(width_of(panel) / len(texts) / LETTER) - 1, 1)
    panel.set_xticks(range(len(texts)), [textwrap.fill(text, letters) for text in texts])


def readable(name, unit):
    words, unit = name.replace("_", " "), data.pretty(unit)
    return f"{words}  [{unit}]" if unit else words
