"""What a loss of power leaves: the image of a file system is copied while a run writes into it, with what has reached the
disk and nothing else, and the copy is looked at. Every file that has its final name must be there in full. Needs root.

    power_loss_test.py BUILD/bin CASES COUNT [SEED]
"""
import contextlib
import csv
import json
import os
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time
import tomllib

import h5py

from toryu import program
from toryu.processes import DONE
from toryu.results_folder import WRITTEN, newest_checkpoint, written

SKIPPED = 77  # exit code by which CTest knows that a test cannot run here
SIZE = 96  # [MB] of the file system
QUIET_LIMIT = 20  # [s] in which a moment without a write must come
LIMIT = 600  # [s] of a run
# case, settings: coupled and fluid alone, with many frames and checkpoints
RUNS = [("elastic_gate", ["case.end_time=0.02", "case.frame_interval=2e-4", "case.checkpoint_interval=4e-3"]),
        ("dam_break", ["case.end_time=0.1", "case.frame_interval=5e-4", "case.checkpoint_interval=0.02"])]


def shell(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip()


@contextlib.contextmanager
def mounted(image, place):
    """Yields the loop device of the image."""
    place.mkdir(exist_ok=True)
    shell("mount", "-o", "loop", image, place)
    try:
        yield shell("findmnt", "-n", "-o", "SOURCE", place)
    finally:
        shell("umount", place)


def writes(device):
    """How many writes the device has finished or has under way, see Documentation/block/stat.rst of Linux."""
    figures = pathlib.Path(f"/sys/block/{pathlib.Path(device).name}/stat").read_text().split()
    return figures[4], figures[8]


def copy_at_one_moment(image, device, copy):
    """A copy between two of whose blocks nothing was written."""
    end = time.monotonic() + QUIET_LIMIT
    while time.monotonic() < end:
        before = writes(device)
        shell("cp", "--sparse=always", image, copy)
        if before == writes(device) and before[1] == "0":
            return
    raise AssertionError("the disk never rests")


def read(path):
    """Raises what its reader does if the file is not whole."""
    if path.suffix in (".h5", ".hdf"):
        with h5py.File(path) as file:
            file.visititems(lambda _, node: node[()] if isinstance(node, h5py.Dataset) else None)
    elif path.suffix == ".series":
        for file in json.loads(path.read_text())["files"]:
            read(path.parent / file["name"])
    elif path.suffix == ".toml":
        tomllib.loads(path.read_text())
    elif path.suffix == ".csv":
        header, *rows = csv.reader(path.read_text().splitlines())
        assert rows and all(len(row) == len(header) for row in rows), "half a row"


def look_at(out):
    """How many files have their final names; raises AssertionError for one that is not whole."""
    files = [path for path in written(out) if path.is_file() and path.suffix != ".part" and path.name != "log.txt"]
    if checkpoint := newest_checkpoint(out):
        files += checkpoint.iterdir()
    for path in files:
        try:
            assert path.stat().st_size > 0, "empty"
            read(path)
        except Exception as error:
            raise AssertionError(f"{path.relative_to(out)}: {error}") from error
    return len(files)


def pause(run):
    """Stops the launcher and all of its processes, unless it ends first; returns whether it goes on."""
    run.send_signal(signal.SIGTSTP)
    while run.poll() is None:
        if pathlib.Path(f"/proc/{run.pid}/stat").read_text().rpartition(")")[2].split()[0] == "T":
            return True
        time.sleep(0.001)
    return False


def lose_power(folder, programs, case, settings, moment):
    """Starts a run, takes the copy after `moment` seconds or at its end, and lets it end; returns what `look_at` counts,
    that moment, and how long [s] the run took."""
    image, copy = folder / "disk", folder / "copy"
    shell("truncate", "-s", f"{SIZE}M", image)
    shell("mkfs.ext4", "-q", "-F", image)
    with mounted(image, folder / "at") as device:
        start = time.monotonic()
        run = subprocess.Popen(program.python("launch", case, f"--bin={programs}", f"--out={folder}/at/out",
                                              *(f"--set={setting}" for setting in settings)),
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        with contextlib.suppress(subprocess.TimeoutExpired):
            run.wait(moment)
        goes_on, moment = pause(run), time.monotonic() - start
        copy_at_one_moment(image, device, copy)
        if goes_on:
            run.send_signal(signal.SIGCONT)
        try:
            words = run.communicate(timeout=LIMIT)[1]
        finally:
            run.kill()  # what it started ends with it
        assert run.returncode == DONE, words
        duration = time.monotonic() - start
        look_at(folder / "at/out")
    with mounted(copy, folder / "then"):  # which replays its journal
        out = folder / "then/out"
        return (look_at(out) if out.is_dir() else 0), moment, duration


def main(programs, cases, count, seed=None):
    if os.geteuid() != 0 or subprocess.run(["losetup", "-f"], capture_output=True).returncode != 0:
        print("only root can mount an image")
        return SKIPPED
    seed = int(seed) if seed else random.randrange(10**6)
    print(f"seed {seed}, {len(WRITTEN)} kinds of files", flush=True)
    chance = random.Random(seed)
    durations = {}
    for number in range(int(count)):
        case, settings = RUNS[number % len(RUNS)]
        moment = chance.uniform(0, 1.3) * durations.get(case, 5)
        with tempfile.TemporaryDirectory() as folder:
            found, moment, durations[case] = lose_power(pathlib.Path(folder), pathlib.Path(programs).resolve(),
                                                pathlib.Path(cases) / case, settings, moment)
        print(f"{case}: power lost after {moment:.1f} s of {durations[case]:.1f} s: {found} files, all whole", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
