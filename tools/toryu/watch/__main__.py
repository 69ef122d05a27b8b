"""Serves the report of a running run, until that is over.

    python3 -I -X utf8 tools/toryu watch OUT [--port PORT]
"""

import argparse
import html
import json
import os
import pathlib
import signal
import string
import sys
import threading
import time

from toryu import PROGRAMS, program
from toryu.processes import BAD_INPUT, DONE, MACHINE
from toryu.report.__main__ import files
from toryu.watch import feed
from toryu.watch.server import LOOPBACK, PAUSE, Server

HERE = pathlib.Path(__file__).resolve().parent
MARKUP = string.Template((HERE / "live.html").read_text(encoding="utf-8"))


class Page:
    """The page of the run in `told`, or, once `ending` is there, its final report."""

    def __init__(self, told):
        self.told = told
        self.ending = None  # {"code", "words", "report"}: "report" tells that the final one is there

    def __call__(self):
        told = self.told
        path = told.out / "report.html"
        if self.ending and self.ending["report"] and path.is_file():
            return path.read_text(encoding="utf-8", errors="replace")
        if self.ending:
            return files(told.case_path, told.out, told.coupler, self.ending["code"], self.ending["words"])["report.html"]
        markup = MARKUP.substitute(progress=html.escape(told.progress()))
        return files(told.case_path, told.out, told.coupler, None, "",
                     live={"markup": markup, "scripts": [HERE / "live.js"], "cursor": told.cursor()})["report.html"]


def ending_from(descriptor):
    """What the launcher says at the end; None if it is gone without a word."""
    with open(descriptor, encoding="utf-8") as told:
        text = told.read()
    return json.loads(text) if text else None


def ending_of(out):
    """Waits for the end of a run that somebody else started; its report is there then, if it was wanted."""
    started = time.time()
    while feed.of_running(out):
        time.sleep(PAUSE)
    path = out / "report.html"
    return {"code": None, "words": "", "report": path.is_file() and path.stat().st_mtime > started}


def serve(server, page, wait):
    threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.1}, daemon=True).start()
    page.ending = wait()
    if page.ending:
        server.end()


def main(arguments):
    parser = argparse.ArgumentParser(prog="watch", description="Serves the report of the running run in OUT.")
    parser.add_argument("out", metavar="OUT", type=pathlib.Path)
    parser.add_argument("--case", metavar="CASE", help="the case that is run; default as it is used in OUT")
    parser.add_argument("--port", metavar="PORT", type=int, default=0)
    parser.add_argument("--told-by", metavar="DESCRIPTOR", type=int, help=argparse.SUPPRESS)  # of the launcher
    parser.add_argument("--bin", metavar="DIR", default=PROGRAMS, type=pathlib.Path, help=argparse.SUPPRESS)
    options = parser.parse_args(arguments)
    if options.told_by is None and not feed.of_running(options.out):
        print(f"--watch {options.out}: error: no run writes its results there"
              + (f"; what it left shows {options.out / 'report.html'}" if (options.out / "report.html").is_file() else ""),
              file=sys.stderr)
        return BAD_INPUT
    os.nice(19)  # the run comes first
    told = feed.Feed(options.out, options.case or str(options.out / "used_case.toml"), options.bin / "coupler")
    page = Page(told)
    try:
        server = Server(options.port, told, page)
    except (OSError, OverflowError) as error:
        print(f"--watch {options.port}: error: the machine: no server at {LOOPBACK}:{options.port}: "
              f"{getattr(error, 'strerror', None) or error}; without a number a free port is taken", file=sys.stderr)
        return MACHINE
    print(f"watch   {server.address}", flush=True)
    if options.told_by is not None:
        signal.signal(signal.SIGTERM, signal.SIG_DFL)  # the launcher is gone: nothing is to be told any more
        serve(server, page, lambda: ending_from(options.told_by))
    else:
        serve(server, page, lambda: ending_of(options.out))
    return DONE


if __name__ == "__main__":
    program.run(main)
