"""Makes `report.html` in a results folder: one page that needs no network and no other file.

    python3 -I -X utf8 tools/toryu report OUT --case CASE
"""

import argparse
import html
import json
import pathlib
import re
import string
import sys

from toryu import PROGRAMS, program, results, surface
from toryu.processes import DONE, INTERRUPTED
from toryu.report import along, data, frames, scene, tables

HERE = pathlib.Path(__file__).resolve().parent
SCRIPTS = ("chart.js", "particles.js", "stage.js", "along.js", "page.js")  # in this order


def comparisons_of(case, content, out):
    try:
        return results.compare(case, content, out)
    except (OSError, KeyError) as error:
        print(f"report: the references cannot be read: {error!r}", file=sys.stderr)
        return []


def page(case_path, out, coupler, exit_code, words):
    case, case_text = data.used_case(case_path, out, coupler)
    summaries = results.read_summaries(out)
    comparisons = comparisons_of(case_path, case, out)
    bodies, boxes, step = frames.collect(out, case)
    end = scene.end_of(case, bodies)
    walls = scene.wall_paths(case, end)
    file = along.read(out)
    contours = surface.contours(file) if file else []
    times = sorted({time for body in bodies for time in body["times"]})
    view = scene.view_of(boxes)
    compared, others = data.charts(out, comparisons)
    state = data.state(summaries, exit_code, words)
    title = case.get("case", {}).get("title") or results.case_name(case_path)
    content = {
        "view": view, "near": scene.near_view(view, walls, bodies, contours), "walls": walls, "bodies": bodies,
        "motions": scene.motion_charts(walls, end), "end": end,
        "along": along.collect(file, contours, times, frames.start_of(out, "solid")) if file else {},
        "compared": compared, "others": others, "failed": state["code"] not in (DONE, INTERRUPTED),
    }
    return string.Template((HERE / "page.html").read_text(encoding="utf-8")).substitute(
        title=html.escape(title), name=html.escape(results.case_name(case_path)),
        style=(HERE / "style.css").read_text(encoding="utf-8"),
        script="\n".join((HERE / f).read_text(encoding="utf-8") for f in SCRIPTS),
        data=re.sub("</", r"<\\/", json.dumps(content, separators=(",", ":"), allow_nan=False)),
        state=tables.state(state) + tables.warnings(out), figures=tables.figures(out, summaries, comparisons, state),
        frames_note=f"every {step}th frame is shown" if step > 1 else "",
        times=tables.times(summaries), terms=tables.terms(summaries), particles=tables.particles(summaries),
        numbers=tables.numbers(summaries), provenance=tables.provenance(summaries), case=html.escape(case_text),
        log=html.escape(tables.log_tail(out)))


def main(arguments):
    parser = argparse.ArgumentParser(prog="report", description="Makes report.html of the results in OUT.")
    parser.add_argument("out", metavar="OUT", type=pathlib.Path)
    parser.add_argument("--case", metavar="CASE", required=True, help="the case that was run, for its references")
    parser.add_argument("--bin", metavar="DIR", default=PROGRAMS, type=pathlib.Path, help=argparse.SUPPRESS)
    parser.add_argument("--exit-code", type=int, help="of the run; default: as the participants left it")
    parser.add_argument("--words", default="", help="why the run ended")
    options = parser.parse_args(arguments)
    text = page(options.case, options.out, options.bin / "coupler", options.exit_code, options.words)
    program.write_whole(options.out / "report.html", text)
    print(options.out / "report.html")


if __name__ == "__main__":
    program.run(main)
