"""Runs a case with a built toryu: checks the input, starts the processes that the case needs, watches them, and
closes with the report and a summary; a study it hands on to toryu.study.

    python3 -I -X utf8 tools/toryu launch CASE [options]
"""

import argparse
import contextlib
import importlib.util
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

from toryu import PROGRAMS, guests, program, ranks, replay, summary_text
from toryu.case import PROGRAMS_OF, BadCase, resolve
from toryu.folder_lock import FolderTaken, lock_folder
from toryu.installation import COMMAND, ROOT
from toryu.launch_options import parse
from toryu.processes import BAD_INPUT, BUG, DONE, MACHINE, MEANING, PHYSICS_FAILED
from toryu.remote.placement import Placement
from toryu.results_folder import keep_former, newest_checkpoint, remove_former, what_is_there
from toryu.watch import launched

PACKAGES = str(ROOT / "tools")  # where a program in Python finds toryu
MOST_WORDS = 10000  # of why a run ended, for the report: a command line takes no more than some of them
PACKAGE_FOR = {".svg": "svgelements", ".dxf": "ezdxf"}  # of Python, that reads such drawings
# A thread that has nothing to do must sleep, not spin: in a coupled run at most one side computes at a time, and
# beside other programs a spinning thread keeps the one it waits for from its core (dam break: 3 to 5 times slower).
# A short spin first bridges the gaps within a step (gate: 13 % faster on idle cores).
ENVIRONMENT = {"OMP_WAIT_POLICY": "passive", "GOMP_SPINCOUNT": "1000"}


def settle_replay(options, case):
    """The recorded side of a replay takes its program's place."""
    if fault := replay.fault_of(options, case):
        raise SystemExit(complain(fault))
    if options.replay is None:
        return
    setattr(options, replay.OTHER[options.only], options.bin / f"replayed_{replay.OTHER[options.only]}")
    options.passed_on += [f"--set={pair}" for pair in replay.settings(options, case)]
    if options.restart is None and options.out is None:
        options.out = pathlib.Path("out") / f"{case.name}_replay_{options.only}"


def settle_folder(options, case):
    """Where the results go, or are."""
    given, options.out = options.out, pathlib.Path(options.restart or options.out or pathlib.Path("out") / case.name)
    if options.restart is None:
        return
    if options.overwrite:
        raise SystemExit(complain("--overwrite: error: would remove what --restart goes on from; give one of them"))
    if given and pathlib.Path(given).resolve() != options.out.resolve():
        raise SystemExit(complain(f"--out {given}: error: the run of --restart {options.out} goes on where it is; give one "
                                  "of them"))
    if not newest_checkpoint(options.out):
        raise SystemExit(complain(f"--restart: error: {options.out} holds no whole checkpoint; it holds "
                                  f"{what_is_there(options.out)}"))
    options.passed_on.append("--restart")


def programs_folder(arguments):
    parser = argparse.ArgumentParser(add_help=False, allow_abbrev=False)
    parser.add_argument("--bin", type=pathlib.Path, default=PROGRAMS)
    return parser.parse_known_args(arguments)[0].bin


def is_study(argument, coupler):
    """Whether `argument` is a file that describes a study; what is wrong with a file is told where it is run."""
    with contextlib.suppress(BadCase):
        return os.path.isfile(argument) and resolve(argument, coupler).kind == "study"
    return False


def install(group, modules):
    """Installs a group of packages unless the modules that they bring are there."""
    if all(map(importlib.util.find_spec, modules)):
        return
    installed = subprocess.run([ROOT / "tools/install.sh", group]).returncode
    if installed != DONE:
        raise SystemExit(installed)


def go_on_as(part, arguments):
    """Becomes toryu.study or toryu.compare, which need a package more."""
    install("study", ["matplotlib"])
    os.execv(sys.executable, program.python(part, *arguments))


def install_for_drawings(case):
    """What reads drawings is installed when a case names one."""
    wanted = {PACKAGE_FOR[kind] for name in case.files if (kind := pathlib.PurePath(name).suffix.lower()) in PACKAGE_FOR}
    install("import", wanted)


def case_of(options):
    """The case as it is read; all that is wrong with an override, the programs' checks will tell."""
    coupler = options.bin / "coupler"
    try:
        with contextlib.suppress(BadCase):
            return resolve(options.case, coupler, tuple(options.set))
        return resolve(options.case, coupler)
    except BadCase as error:
        raise SystemExit(complain(str(error)))


def programs(options, case):
    """Name -> executable of each program that the case needs, the lead first."""
    executables = {"coupler": options.bin / "coupler", "fluid_solver": options.fluid or options.bin / "fluid_solver",
                   "solid_solver": options.solid or options.bin / "solid_solver"}
    if case.kind not in PROGRAMS_OF:
        raise SystemExit(complain(f"{case.file}: error: no section [fluid] and no section [solid]: nothing to compute"))
    names = PROGRAMS_OF[case.kind]
    for side in ("fluid", "solid"):
        if getattr(options, side) and f"{side}_solver" not in names:
            raise SystemExit(complain(f"--{side} {getattr(options, side)}: error: the case has no {side}"))
    elsewhere = [f"{side}_solver" for side in ("fluid", "solid")
                 if getattr(options, side) and any(text.startswith(f"{side}=") for text in options.host)]
    for name in names:
        if name not in elsewhere:
            executables[name] = guests.located(str(executables[name]))
            if fault := guests.fault_of(executables[name], name):
                raise SystemExit(complain(fault))
    return {name: executables[name] for name in names}


def complain(text):
    print(text, file=sys.stderr)
    return BAD_INPUT


def check(commands, more=()):
    """Runs `--check` of every program; returns 0, or 2 after listing all errors once, in the order of the file. With the
    options `more` what they say of the run is shown, and what they warn of: a run that follows says it itself."""
    errors, others, codes = set(), [], set()
    for name, command in commands.items():
        done = subprocess.run([*command, "--check", *more], capture_output=True, encoding="utf-8", errors="backslashreplace",
                              stdin=subprocess.DEVNULL)
        if done.returncode == DONE:
            if more:
                print(done.stdout, end="")
                print(done.stderr, end="", file=sys.stderr)
            continue
        codes.add(done.returncode)
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
    return BAD_INPUT if errors else MACHINE if MACHINE in codes else BUG


def check_alone(options, case, own, others):
    """All that --check does, with the picture of the scene if that was asked for."""
    with contextlib.ExitStack() as kept:
        more, frames = ["--outlook", *["--columns"] * options.columns], None
        if options.picture is not None:
            frames = kept.enter_context(tempfile.TemporaryDirectory(prefix="toryu_picture_"))
            more.append(f"--start-frames={frames}")
        if code := check(own, more):
            return code
        if code := guests.warn_without_checkpoints(others, options.restart is not None):
            return code
        print(f"{case.file}: no errors")
        return DONE if frames is None else draw_scene(options, case, pathlib.Path(frames))


def draw_scene(options, case, frames):
    """Draws what the programs left in `frames`."""
    install("study", ["matplotlib"])
    from toryu import picture  # takes its time, and a package more

    path = pathlib.Path(options.picture or pathlib.Path("out") / f"{case.name}_scene.svg")
    if fault := picture.fault_of(path):
        return complain(fault)
    try:
        print(picture.draw(case, frames, path))
    except OSError as error:
        if error.errno in program.SHORTAGES:
            raise
        return complain(f"--picture {path}: error: cannot be written: {error.strerror}")
    print(f"picture {path}")
    return DONE


def describe(commands):
    """The keys of all sections; a section that several programs read is shown once."""
    seen = set()
    for command in commands.values():
        done = subprocess.run([*command, "--describe"], capture_output=True, encoding="utf-8", errors="backslashreplace")
        if done.returncode != DONE:
            mistake = guests.mistake_in(done.stderr)
            print(mistake or done.stderr.rstrip("\n"), file=sys.stderr)
            return BAD_INPUT if mistake else done.returncode if done.returncode in MEANING else BUG
        print(done.stderr, end="", file=sys.stderr)
        for paragraph in done.stdout.split("\n\n"):
            if paragraph.strip() and paragraph not in seen:
                seen.add(paragraph)
                print(paragraph.strip("\n"), end="\n\n")
    program.must_be_printed()
    return DONE


def hold(out, name):
    """Holds the results folder by the lock `name`."""
    held = contextlib.ExitStack()
    try:
        held.enter_context(lock_folder(out, name))
    except FolderTaken:
        raise SystemExit(complain(f"{out}: error: another run writes its results here; wait for it or give --out "
                                  "another folder"))
    except OSError as error:
        if error.errno in program.SHORTAGES:
            raise
        raise SystemExit(complain(f"--out {out}: error: no results can be written there: {error.strerror}"))
    return held


def used_files(options):
    """The files that the used case of a former run names."""
    with contextlib.suppress(BadCase):
        return resolve(options.out / "used_case.toml", options.bin / "coupler").files
    return []


def set_former_aside(options):
    """Former results are kept beside the new ones, or removed if that was asked for."""
    # Programs that were started by hand hold the folder by a lock of their own.
    by_hand = (options.out / "run.lock").exists()
    with hold(options.out, "run.lock") if by_hand else contextlib.nullcontext():
        try:
            if options.overwrite:
                remove_former(options.out)
            elif words := keep_former(options.out, used_files(options)):
                print(words, file=sys.stderr)
        except OSError as error:
            if error.errno in program.SHORTAGES:
                raise
            done, hint = ("removed", "") if options.overwrite else ("kept beside it", "; --overwrite removes them")
            raise SystemExit(complain(f"{options.out}: error: the former results cannot be {done}: {error}{hint}"))


def age_of_used_case(out):
    """When the programs wrote down what they use, which they do once they have met [ns]; None if they did not."""
    with contextlib.suppress(OSError):
        return (out / "used_case.toml").stat().st_mtime_ns
    return None


def go_on_with(arguments, options):
    """The command that goes on with this run: the same one, but that it restarts."""
    kept = [word for word in arguments if word != "--overwrite"] + ["--restart"] * (options.restart is None)
    return shlex.join([COMMAND, *kept])


def report(options, case, code, words):
    """Makes report.html and prints the summary; returns the exit code of the report."""
    failed = DONE if options.no_report else subprocess.run(
        program.python("report", options.out, "--case", options.case, f"--bin={options.bin}", f"--exit-code={code}",
                       f"--words={words}"), stdout=subprocess.DEVNULL).returncode
    if text := summary_text.of_run(case.references, options.out):
        print(text)
    if not failed and not options.no_report:
        print(f"report  {options.out / 'report.html'}")
    return failed


def compared_with_record(options):
    from toryu import replay_comparison  # takes its time

    try:
        return replay_comparison.sum_up(options)
    except replay_comparison.BadRecord as error:
        raise SystemExit(complain(str(error)))


def main(arguments):
    if "--compare" in arguments:
        go_on_as("compare", [argument for argument in arguments if argument != "--compare"])
    if any(argument.partition("=")[0] == "--make-identities" for argument in arguments):
        os.execv(sys.executable, program.python("identities", *arguments))
    coupler = programs_folder(arguments) / "coupler"
    if any(is_study(argument, coupler) for argument in arguments):
        go_on_as("study", arguments)
    options = parse(arguments)
    if options.case is None:
        os.execv(sys.executable, program.python("watch", options.watch, f"--bin={options.bin}"))
    launched.port_of(options)
    case = case_of(options)
    if options.picture is not None and not options.check:
        return complain("--picture: error: goes with --check")
    if options.columns and not options.check:
        return complain("--columns: error: goes with --check")
    install_for_drawings(case)
    settle_replay(options, case)
    settle_folder(options, case)
    executables = programs(options, case)
    if fault := ranks.fault_of(options, executables):
        return complain(fault)
    os.environ["PYTHONPATH"] = os.pathsep.join(filter(None, [PACKAGES, os.environ.get("PYTHONPATH")]))
    commands = {name: [str(executable), options.case, f"--out={options.out}", *options.passed_on]
                for name, executable in executables.items()}
    if options.replay is not None:
        commands[f"{replay.OTHER[options.only]}_solver"].append(f"--record={options.replay}")
    if options.print_case:
        return subprocess.run([options.bin / "coupler", options.case, "--print-case", *options.passed_on]).returncode
    if options.describe:
        return describe(commands)
    # A program that takes a solver's place checks its own input when it starts.
    own = [name for name, executable in executables.items() if pathlib.Path(executable).parent == options.bin]
    placement = Placement(options, case, executables, own)
    commands = ranks.over_ranks(options, {name: command + placement.network for name, command in commands.items()})
    own = {name: commands[name] for name in own}
    others = [command[0] for name, command in commands.items() if name not in {**own, **placement.jobs}]
    if options.check:
        return placement.check() or check_alone(options, case, own, others)
    if code := (check(own) or placement.check()
                or guests.warn_without_checkpoints(others, options.restart is not None)):
        return code

    # what the user has set, stays
    environment = dict(os.environ) if "OMP_WAIT_POLICY" in os.environ else ENVIRONMENT | os.environ
    with hold(options.out, "launch.lock"), contextlib.ExitStack() as kept:
        placement.forget_secret()  # of a run that was killed
        if options.restart is None:
            set_former_aside(options)
        tell = kept.enter_context(launched.watched(options))
        placement.make_secret()
        before = age_of_used_case(options.out)
        try:
            code, words = placement.run_of(commands, environment, lambda: age_of_used_case(options.out) != before)()
        finally:
            placement.forget_secret()
        if words:
            print(words, file=sys.stderr)
        words = words[-MOST_WORDS:]
        if options.replay is not None and code == DONE:
            print(compared_with_record(options))
        # A restart that is refused leaves the report of the run before.
        refused = code == BAD_INPUT and options.restart is not None
        unreported = DONE if refused else report(options, case, code, words)
        tell(code, words, not options.no_report and not refused and unreported == DONE)
        # a restart repeats a failure of physics
        if code not in (DONE, BAD_INPUT, PHYSICS_FAILED) and newest_checkpoint(options.out):
            print(f"go on with: {go_on_with(arguments, options)}")
    return code or (unreported if unreported in MEANING else BUG)


if __name__ == "__main__":
    program.run(main)
