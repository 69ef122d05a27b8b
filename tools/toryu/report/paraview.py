"""`frames.py`: the script by which ParaView opens the frames of a run coloured."""

import os
import pathlib

from toryu import results
from toryu.report import data, frames

SCRIPT = pathlib.Path(__file__).resolve().parent / "frames_in_paraview.py"
COLOURS = {"fluid": "Viridis (matplotlib)", "solid": "Inferno (matplotlib)", "signed": "Cool to Warm"}  # as in particles.js


def script(out, case, bodies, view):
    """The script of a run: of its measured bodies, in colours, and of its walls, in grey."""
    shown = [described(case, body) for body in bodies]
    if results.list_frames(out, "walls"):
        spacing = data.table(case, "fluid").get("spacing")
        shown.append(plain("walls", spacing if data.is_number(spacing) else shown[0]["spacing"]))
    text = SCRIPT.read_text(encoding="utf-8")
    for name, value in (("FOLDER", os.path.abspath(out)), ("VIEW", view), ("BODIES", shown)):
        text = text.replace(f"\n{name} = ...\n", f"\n{name} = {value!r}\n")
    return text


def plain(name, spacing):
    return {"name": name, "series": f"{name}.hdf.series", "spacing": spacing, "field": ""}


def described(case, body):
    found = plain(body.name, frames.spacing(case, body))
    first = next((q for q in body.quantities if q.component in (None, -1)), None)
    if first is None:
        return found
    low, high = first.span
    return found | {"field": first.field, "component": "" if first.component is None else "Magnitude", "low": low, "high": high,
                    "title": f"{first.label} [{data.pretty(first.unit)}]",
                    "colours": COLOURS["signed" if first.signed else body.name if body.name in COLOURS else "fluid"]}
