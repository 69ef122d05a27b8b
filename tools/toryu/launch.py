"""Runs a case with a built toryu: checks the input, starts the processes that the case needs, watches them, and
closes with the report and a summary; a study it hands on to toryu.study.

    python3 -m toryu.launch CASE [options]
"""

import argparse
import contextlib
import os
import pathlib
import re
import shutil
import subprocess
import sys

from toryu import PROGRAMS, results, summary_text
from toryu.folder_lock import FolderTaken, lock_folder
from toryu.processes import BAD_INPUT, BUG, DONE, Run

# A thread that has nothing to do must sleep, not spin: in a coupled run at most one side computes at a time, and
# beside other programs a spinning thread keeps the one it waits for from its core (dam break: 3 to 5 times slower).
# A short spin first bridges the gaps within a step (gate: 13 % faster on idle cores).
ENVIRONMENT = {"OMP_WAIT_POLICY": "passive", "GOMP_SPINCOUNT": "1000"}


def parse(arguments):
    parser = argparse.ArgumentParser(
        prog="run.sh", allow_abbrev=False, description="Runs a case: a folder with a case.toml, or the file itself. A file "
        "with a table [study] is a study; its options: ./run.sh STUDY.toml --help.",
        epilog="All other options go to the programs. Exit codes: 0 done, 1 a bug, 2 bad input, 3 physics failed, "
               "4 a process was lost, 130 interrupted.")
    parser.add_argument("case", metavar="CASE")
    parser.add_argument("--out", metavar="DIR", help="results folder; default out/<case name>")
    parser.add_argument("--set", metavar="KEY=VALUE", action="append", default=[],
                        help="another value for a key of the case file; repeatable")
    parser.add_argument("--end-time", metavar="SECONDS")
    parser.add_argument("--threads", metavar="N")
    parser.add_argument("--log-level", metavar="LEVEL")
    parser.add_argument("--check", action="store_true", help="only check the case file")
    parser.add_argument("--describe", action="store_true", help="list the keys of the case's sections with units, "
                                                                "defaults and ranges")
    parser.add_argument("--print-case", action="store_true", help="print the case as it is read, with its base and the "
                                                                  "values of --set")
    parser.add_argument("--fluid", metavar="EXE", help="another program in the place of fluid_solver")
    parser.add_argument("--solid", metavar="EXE", help="another program in the place of solid_solver")
    parser.add_argument("--no-report", action="store_true", help="leave report.html out")
    parser.add_argument("--bin", metavar="DIR", default=PROGRAMS, type=pathlib.Path,
                        help=argparse.SUPPRESS)
    options, unknown = parser.parse_known_args(arguments)
    options.passed_on = [f"--set={pair}" for pair in options.set] + unknown
    for name in ("end_time", "threads", "log_level"):
        if (value := getattr(options, name)) is not None:
            options.passed_on.append(f"--{name.replace('_', '-')}={value}")
    options.out = pathlib.Path(options.out or pathlib.Path("out") / results.case_name(options.case))
    return options


def is_study(path):
    """Whether `path` is a file with a table [study]."""
    try:
        return bool(re.search(r"^\s*\[study\]", pathlib.Path(path).read_text(encoding="utf-8"), re.MULTILINE))
    except (OSError, ValueError):
        return False  # a folder, an option, or nothing that can be read


def content_of(options):
    """What the case says; all that is wrong with an override, the programs' checks will tell."""
    coupler = options.bin / "coupler"
    try:
        with contextlib.suppress(results.BadCase):
            return results.case_content(options.case, coupler, tuple(options.set))
        return results.case_content(options.case, coupler)
    except results.BadCase as error:
        raise SystemExit(complain(str(error)))
    except OSError as error:
        raise SystemExit(complain(f"{coupler}: error: cannot be started: {error.strerror}"))


def programs(options, content):
    """Name -> executable of each program that the case needs, the lead first."""
    executables = {"coupler": options.bin / "coupler", "fluid_solver": options.fluid or options.bin / "fluid_solver",
                   "solid_solver": options.solid or options.bin / "solid_solver"}
    needed = [f"{side}_solver" for side in ("fluid", "solid") if content.get(side, False) is not False]
    if not needed:
        raise SystemExit(complain(f"{results.case_file(options.case)}: error: no section [fluid] and no section [solid]: "
                                  "nothing to compute"))
    names = ["coupler", *needed] if len(needed) == 2 else needed
    for name in names:
        if not shutil.which(executables[name]):
            raise SystemExit(complain(f"{executables[name]}: error: no such program, needed as {name}"))
    return {name: executables[name] for name in names}


def complain(text):
    print(text, file=sys.stderr)
    return BAD_INPUT


def check(commands, show_warnings):
    """Runs `--check` of every program; returns 0, or 2 after listing all errors once, in the order of the file. A run
    that follows gives the warnings itself."""
    errors, others = set(), []
    for name, command in commands.items():
        done = subprocess.run([*command, "--check"], capture_output=True, text=True, stdin=subprocess.DEVNULL)
        if done.returncode == DONE:
            if show_warnings and done.stderr:
                print(done.stderr, end="", file=sys.stderr)
            continue
        lines = (done.stdout + done.stderr).splitlines()
        if done.returncode == BAD_INPUT:
            errors.update(line for line in lines if line.strip())
        else:
            others.append("\n".join([*lines, f"{name} --check ended with exit code {done.returncode}"]))
    if not errors and not others:
        return DONE

    def place(line):
        found = re.match(r".*?:(\d+):(\d+): error:", line)
        return (int(found[1]), int(found[2]), line) if found else (0, 0, line)

    print(*sorted(errors, key=place), *others, sep="\n", file=sys.stderr)
    return BAD_INPUT if errors else BUG


def describe(commands):
    """The keys of all sections; a section that several programs read is shown once."""
    seen = set()
    for command in commands.values():
        done = subprocess.run([*command, "--describe"], stdout=subprocess.PIPE, text=True)
        if done.returncode != DONE:
            return done.returncode
        for paragraph in done.stdout.split("\n\n"):
            if paragraph.strip() and paragraph not in seen:
                seen.add(paragraph)
                print(paragraph.strip("\n"), end="\n\n")
    return DONE


def hold(out):
    """Holds the results folder for this run. A coupler that was started by hand holds it by its own lock."""
    held = contextlib.ExitStack()
    try:
        held.enter_context(lock_folder(out, "launch.lock"))
        if (out / "coupler.lock").exists():
            with lock_folder(out, "coupler.lock"):
                pass
    except FolderTaken:
        raise SystemExit(complain(f"{out}: error: another run writes its results here; wait for it or give --out "
                                  "another folder"))
    except OSError as error:
        raise SystemExit(complain(f"--out {out}: error: no results can be written there: {error.strerror}"))
    return held


def report(options, content, code, words):
    """Makes report.html and prints the summary; returns whether the report could be made, if there is to be one."""
    made = not options.no_report and subprocess.run(
        [sys.executable, "-m", "toryu.report", options.out, "--case", options.case, f"--bin={options.bin}",
         f"--exit-code={code}", f"--words={words}"], stdout=subprocess.DEVNULL).returncode == 0
    print(summary_text.of_run(options.case, content, options.out))
    if made:
        print(f"report  {options.out / 'report.html'}")
    return made or options.no_report


def main(arguments):
    if any(map(is_study, arguments)):
        os.execv(sys.executable, [sys.executable, "-m", "toryu.study", *arguments])
    options = parse(arguments)
    content = content_of(options)
    commands = {name: [str(executable), options.case, f"--out={options.out}", *options.passed_on]
                for name, executable in programs(options, content).items()}
    if options.print_case:
        return subprocess.run([options.bin / "coupler", options.case, "--print-case", *options.passed_on]).returncode
    if options.describe:
        return describe(commands)
    # A program that takes a solver's place checks its own input when it starts.
    own = {name: command for name, command in commands.items() if pathlib.Path(command[0]).parent == options.bin}
    if code := check(own, show_warnings=options.check):
        return code
    if options.check:
        print(f"{results.case_file(options.case)}: no errors")
        return DONE

    # what the user has set, stays
    environment = dict(os.environ) if "OMP_WAIT_POLICY" in os.environ else ENVIRONMENT | os.environ
    with hold(options.out):
        results.remove_old(options.out)
        code, words = Run(commands, lead=next(iter(commands)), environment=environment)()
        if words:
            print(words, file=sys.stderr)
        reported = report(options, content, code, words)
    return code or (DONE if reported else BUG)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
