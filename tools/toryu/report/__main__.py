"""Makes `report.html` in a results folder, one page that needs no network and no other file, and `frames.py` for ParaView.

    python3 -I -X utf8 tools/toryu report OUT --case CASE
"""

import argparse
import html
import os
import pathlib
import string
import sys

from toryu import PROGRAMS, program, results, surface
from toryu.case import BadCase, resolve
from toryu.report import along, data, frames, paraview, player, scene, tables, telling

HERE = pathlib.Path(__file__).resolve().parent
SCRIPTS = ("chart.js", *player.SCRIPTS, "along.js", "page.js")  # in this order
EXAGGERATION = '<label id="exaggeration" hidden>displacement of the solid, enlarged <select id="factor"></select></label>'


def name_of(path, out, coupler):
    """The case's name; that of the results if the case is there no more."""
    try:
        return resolve(path, coupler).name
    except BadCase:
        return pathlib.Path(os.path.abspath(out)).name


def files(case_path, out, coupler, exit_code, words, live=None):
    """The text of each file of the report. `live`: what the page of a running run has more, "markup", "scripts" and the
    "cursor" in the series from which it goes on; it shows the newest frame alone."""
    faults = []  # of the files: those that are damaged are left out, and the page says so
    used, case_text = data.used_case(case_path, out, coupler)
    case, name = used.content, name_of(case_path, out, coupler)
    summaries = results.read_summaries(out, faults)
    comparisons = results.compare(used.references, out)
    faults += results.faults_of(used.references, out)
    found = frames.read_bodies(out, faults, newest=live is not None)
    bodies, boxes, step = frames.collect(found, case)
    end = scene.end_of(case, bodies)
    walls = scene.walls_of(case, used.outlines, used.motions)
    file = None if live else along.read(out, faults)  # it is being written
    contours = surface.contours(file) if file else []
    times = sorted({time for body in bodies for time in body["times"]})
    view = scene.view_of(boxes)
    compared, others = data.charts(out, comparisons, faults)
    state = data.state(out, summaries, exit_code, words)
    if live:
        faults = []  # what is not there yet
    for fault in faults:
        print(f"report: {fault}", file=sys.stderr)
    content = {
        "view": view, "near": scene.near_view(view, walls, bodies, contours), "walls": walls, "bodies": bodies,
        "motions": scene.motion_charts(walls, end), "end": end,
        "along": along.collect(file, contours, times, frames.start_of(found, "solid")) if file else {},
        "compared": compared, "others": others, "telling": telling.moment(out, case, comparisons, found, state),
    } | ({"live": live["cursor"]} if live else {})
    title = data.table(case, "case").get("title") or name
    page = string.Template((HERE / "page.html").read_text(encoding="utf-8")).substitute(
        title=html.escape(str(title)), name=html.escape(name),
        style=(HERE / "style.css").read_text(encoding="utf-8"),
        script=player.script([*(HERE / f for f in SCRIPTS), *(live["scripts"] if live else [])]),
        data=player.embedded(content), player=player.markup(EXAGGERATION),
        state=tables.state(state) + (live["markup"] if live else "") + tables.damage(faults) + tables.warnings(out),
        figures=tables.figures(out, summaries, comparisons, state),
        frames_note=player.left_out(step),
        times=tables.times(summaries), terms=tables.terms(summaries), particles=tables.particles(summaries),
        numbers=tables.numbers(summaries), provenance=tables.provenance(summaries), case=html.escape(case_text),
        log=html.escape(tables.log_tail(out)))
    return {"report.html": page} | ({"frames.py": paraview.script(out, case, found, view)} if found else {})


def main(arguments):
    parser = argparse.ArgumentParser(prog="report", description="Makes report.html of the results in OUT.")
    parser.add_argument("out", metavar="OUT", type=pathlib.Path)
    parser.add_argument("--case", metavar="CASE", required=True, help="the case that was run, for its references")
    parser.add_argument("--bin", metavar="DIR", default=PROGRAMS, type=pathlib.Path, help=argparse.SUPPRESS)
    parser.add_argument("--exit-code", type=int, help="of the run; default: as the participants left it")
    parser.add_argument("--words", default="", help="why the run ended")
    options = parser.parse_args(arguments)
    for name, text in files(options.case, options.out, options.bin / "coupler", options.exit_code, options.words).items():
        program.write_whole(options.out / name, text)
    print(options.out / "report.html")


if __name__ == "__main__":
    program.run(main)
