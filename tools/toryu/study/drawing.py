"""How charts look: matplotlib in the colours of the pages, saved as PNG and SVG, and as SVG for a page."""

import io
import math
import pathlib
import re

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
WIDTH_OF_AXES, LETTER = 0.6, 0.085  # of the picture, beside legend and labels; [inch] of a digit of the labels
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
    made.savefig(path.with_name(path.name + ".png"), dpi=160, facecolor="white")
    with matplotlib.rc_context({"svg.hashsalt": path.name}):
        made.savefig(path.with_name(path.name + ".svg"), facecolor="white", metadata={"Date": None})
        text = io.StringIO()
        made.savefig(text, format="svg", metadata={"Date": None})
    return for_page(text.getvalue())


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


def logarithmic(panel, which):
    """Makes the "x" or "y" axis logarithmic, with plain numbers at 1, 2, 5, 10, ..."""
    getattr(panel, f"set_{which}scale")("log")
    axis = getattr(panel, f"{which}axis")
    axis.set_major_locator(matplotlib.ticker.LogLocator(subs=(1, 2, 5)))
    axis.set_major_formatter(matplotlib.ticker.FormatStrFormatter("%g"))
    axis.set_minor_locator(matplotlib.ticker.NullLocator())


def ticks(panel, values, texts):
    """Marks at the values; a text that would run into the one before is left out."""
    log = panel.get_xscale() == "log" and min(values) > 0
    places = [math.log(v) if log else v for v in values]
    span = (max(places) - min(places)) or 1
    width = panel.figure.get_figwidth() / panel.get_subplotspec().get_gridspec().ncols * WIDTH_OF_AXES
    end, shown = -math.inf, {}
    for place, value, text in sorted(zip(places, values, texts)):
        centre, half = (place - min(places)) / span * width, len(text) * LETTER / 2
        shown[value] = text if centre - half > end else ""
        end = centre + half + LETTER if shown[value] else end
    panel.set_xticks(values, [shown[value] for value in values])


def readable(name, unit):
    words, unit = name.replace("_", " "), data.pretty(unit)
    return f"{words}  [{unit}]" if unit else words
