"""The part of a page that plays frames: its markup, its scripts, and the content that they read."""

import json
import pathlib
import string

from toryu.report import data

HERE = pathlib.Path(__file__).resolve().parent
SCRIPTS = ("particles.js", "stage.js", "save.js", "player.js")


def markup(choice=""):
    """`choice`: a control more."""
    return string.Template((HERE / "player.html").read_text(encoding="utf-8")).substitute(choice=choice)


def script(paths):
    return "\n".join(path.read_text(encoding="utf-8") for path in paths)


def embedded(content):
    """JSON without <: a name may not end the script, nor begin a comment in it."""
    return json.dumps(data.finite(content), separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")


def left_out(step):
    """That frames are, if so."""
    return f"every {step}th frame is shown" if step > 1 else ""
