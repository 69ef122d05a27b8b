"""The command line of a run."""

import argparse
import os

from toryu import PROGRAMS
from toryu.installation import COMMAND
from toryu.program import given, path
from toryu.remote.placement import add_options


def parse(arguments):
    parser = argparse.ArgumentParser(
        prog=COMMAND.removeprefix("./"), allow_abbrev=False, description="Runs a case: a folder with "
        "a case.toml, or the file itself. A file "
        f"with a table [study] is a study; its options: {COMMAND} STUDY.toml --help.",
        epilog="Ctrl-C asks the programs to write a last checkpoint and to end; a second one ends them at once. All other "
               "options go to the programs. Exit codes: 0 done, 1 a bug, 2 bad input, 3 physics failed, "
               "4 a process was lost, 5 a fault of the machine (disk, network, threads), 130 interrupted.")
    parser.add_argument("case", metavar="CASE", nargs="?")
    parser.add_argument("--out", type=given, metavar="DIR", help="results folder; default out/<case name>. Results of a "
                        "former run that are there are kept in DIR.1, DIR.2, ...")
    parser.add_argument("--overwrite", action="store_true", help="remove the results of a former run")
    parser.add_argument("--restart", metavar="FOLDER", nargs="?", const="", help="go on with the run in the results "
                        "folder, or in FOLDER, from its newest checkpoint; with --end-time beyond its end")
    parser.add_argument("--set", metavar="KEY=VALUE", action="append", default=[],
                        help="another value for a key of the case file; repeatable")
    parser.add_argument("--end-time", metavar="SECONDS")
    parser.add_argument("--threads", metavar="N")
    parser.add_argument("--log-level", metavar="LEVEL")
    parser.add_argument("--lost-after", metavar="SECONDS", help=argparse.SUPPRESS)
    parser.add_argument("--check", action="store_true", help="only check the case file")
    parser.add_argument("--columns", action="store_true", help="with --check: list the columns of the series that the run "
                        "will write, as FILE.csv:COLUMN")
    parser.add_argument("--picture", metavar="FILE", nargs="?", const="", help="with --check: draw the scene as an SVG or, by "
                        "the ending of FILE, a PNG; default out/<case name>_scene.svg")
    parser.add_argument("--compare", type=given, metavar=("OUT_A", "OUT_B"), nargs=2, help="lay the results of two runs over "
                        "each other, in place of a run")
    parser.add_argument("--describe", action="store_true", help="list the keys of the case's sections with units, "
                                                                "defaults and ranges")
    parser.add_argument("--print-case", action="store_true", help="print the case as it is read, with its base and the "
                                                                  "values of --set")
    parser.add_argument("--replay", type=given, metavar="RESULTS", help="run one side alone, against what the other one "
                        "answered in the run that left RESULTS with [coupling] record = 'every_window'; what it answers is "
                        "compared")
    parser.add_argument("--only", choices=["fluid", "solid"], help="the side of a replay that runs")
    parser.add_argument("--fluid", type=given, metavar="EXE", help="another program in the place of fluid_solver")
    parser.add_argument("--solid", type=given, metavar="EXE", help="another program in the place of solid_solver")
    parser.add_argument("--ranks", metavar="N", help="compute the fluid by N processes with a part of it each, over MPI; the "
                        "results are the same to the last bit (docs/ranks.md)")
    parser.add_argument("--watch", metavar="PORT", nargs="?", const="", help="serve the report of the run while it runs, to a "
                        "browser on this machine, with a button that ends it; --watch OUT in place of a case watches the "
                        "run that writes into the results folder OUT")
    parser.add_argument("--secure", type=given, metavar="FOLDER", help="only programs that prove an identity of FOLDER take "
                        "part in a coupled run, and nobody else can change or, as FOLDER was made, read what they send")
    parser.add_argument("--make-identities", metavar="FOLDER", help="make the identities for that, in place of a run; with "
                        "--encrypt for messages that are encrypted too, with --days N for how long they are valid")
    add_options(parser)
    parser.add_argument("--no-report", action="store_true", help="leave report.html and frames.py out")
    parser.add_argument("--bin", metavar="DIR", default=PROGRAMS, type=path, help=argparse.SUPPRESS)
    options, unknown = parser.parse_known_args(arguments)
    for name in ("restart", "watch"):  # "--restart CASE": the case stands where a folder may
        value = getattr(options, name)
        if options.case is None and value and any(map(os.path.isfile, (value, os.path.join(value, "case.toml")))):
            options.case = value
            setattr(options, name, "")
    if options.case is None and not options.watch:
        parser.error("the following arguments are required: CASE")
    if options.secure is not None:
        options.secure = os.path.abspath(options.secure)  # the programs may be in other folders, on other hosts
    options.passed_on = [f"--set={pair}" for pair in options.set] + unknown
    for name in ("end_time", "threads", "log_level", "lost_after", "secure"):
        if (value := getattr(options, name)) is not None:
            options.passed_on.append(f"--{name.replace('_', '-')}={value}")
    return options
