"""Where the programs are: in the sources, where a build leaves them; in an installation (cmake/install.cmake), whose
folders are laid out like the sources, those for this processor."""

import contextlib
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]
INSTALLED = ROOT / "programs"
COMMAND = "toryu" if INSTALLED.is_dir() else "./run.sh"  # starts all, as a user types it
INSTALLER = ROOT / "tools/install.sh" if INSTALLED.is_dir() else "tools/install.sh"
# What a processor has that a build for a level may use, by the names of /proc/cpuinfo: the levels of x86-64 that are
# defined in the System V ABI, AMD64 supplement, table 3.1. The best first; what a level has, those above it have too.
LEVELS = {
    "x86-64-v4": {"avx512f", "avx512bw", "avx512cd", "avx512dq", "avx512vl"},
    "x86-64-v3": {"cx16", "lahf_lm", "popcnt", "sse4_1", "sse4_2", "ssse3",
                  "abm", "avx", "avx2", "bmi1", "bmi2", "f16c", "fma", "movbe", "xsave"},
    "x86-64": set(),
}


def flags_of_processor(cpuinfo=pathlib.Path("/proc/cpuinfo")):
    """What every processor of this machine has; nothing if it cannot be read."""
    lines = []
    with contextlib.suppress(OSError):
        lines = re.findall(r"^flags\s*:(.*)$", cpuinfo.read_text(encoding="utf-8"), re.MULTILINE)
    return set.intersection(*(set(line.split()) for line in lines)) if lines else set()


def best_level(flags):
    """The highest level that a processor with these flags has."""
    best = "x86-64"
    for level, needed in reversed(LEVELS.items()):
        if not needed <= flags:
            break
        best = level
    return best


def folder_of_programs():
    if not INSTALLED.is_dir():
        return ROOT / "build/release/bin"
    if (INSTALLED / "coupler").exists():  # built for one processor
        return INSTALLED
    return INSTALLED / best_level(flags_of_processor())


def on_other_hosts(path):
    """Where other hosts of the same sources or installation have the program at `path`: there the command chooses."""
    program = pathlib.Path(path)
    command = ROOT.parents[1] / "bin" / program.name
    return command if INSTALLED.is_dir() and program.parent == folder_of_programs() and command.exists() else program
