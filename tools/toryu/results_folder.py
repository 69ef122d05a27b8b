"""What a results folder holds of a former run: kept beside it, removed, or gone on from."""

import contextlib
import os
import pathlib
import re
import shutil

from toryu.installation import ROOT

CHECKPOINTS = "checkpoint"  # holds a folder of each checkpoint: 000001, 000002, ...
MANIFEST = "manifest.toml"  # put in place last: a checkpoint that has one is whole
LIST = ROOT / "common/scene/results_files.inc"
# All that the programs and the report write into a results folder, but for the checkpoints; nothing else there is ever
# moved or removed.
WRITTEN = re.findall(r'^"(.+)",$', LIST.read_text(encoding="utf-8"), re.MULTILINE)


def written(out):
    """What a former run has left in `out`, complete or not."""
    found = [path for pattern in WRITTEN for name in (pattern, pattern + ".part") for path in out.glob(name)]
    return found + [path for path in [out / CHECKPOINTS] if path.is_dir()]


def remove_former(out):
    for path in written(out):
        shutil.rmtree(path) if path.is_dir() else path.unlink()


def keep_former(out, references=()):
    """Moves the results of a former run into the next free folder OUT.N beside `out`, with copies of the files
    `references` that its used case names. Returns what to say of it, "" if there are none. Raises OSError if they cannot
    be measured or moved; they are all where they were then."""
    found = written(out)
    if not found:
        return ""
    size = room(found)
    # beside the folder itself, wherever a link leads
    beside = out.resolve() if out.is_symlink() or out.name in ("", "..") else out
    numbers = former_numbers(beside)
    former_size = size + room([numbered(beside, n) for n in numbers])
    target = numbered(beside, max(numbers, default=0) + 1)
    target.mkdir()
    move(found, out, target, references)
    with contextlib.suppress(OSError):
        (out / "frames").rmdir()  # stays if it holds something else
    total = f"; {len(numbers) + 1} former results take {readable_size(former_size)}" if numbers else ""
    return f"kept the former results in {target} ({readable_size(size)}{total})"


def numbered(out, number):
    return out.with_name(f"{out.name}.{number}")


def former_numbers(out):
    """Numbers N of the folders OUT.N that there are."""
    name = re.compile(re.escape(out.name) + r"\.(\d+)")
    return sorted(int(found[1]) for path in out.parent.iterdir() if (found := name.fullmatch(path.name)))


def move(paths, out, target, references=()):
    """Moves `paths` in `out` to the same places in `target`, all or none."""
    moved = []
    try:
        copy_references(out, target, references)  # before the case moves that names them
        for path in paths:
            new = target / path.relative_to(out)
            new.parent.mkdir(exist_ok=True)
            path.rename(new)
            moved.append((path, new))
    except OSError:
        for path, new in reversed(moved):
            new.rename(path)
        shutil.rmtree(target, ignore_errors=True)  # it holds copies alone
        raise


def copy_references(out, target, references):
    """The reference curves that the used case names lie beside it, so that it repeats the run wherever it is. They are
    not moved: `out` may be the folder of the case."""
    for file in map(pathlib.PurePath, references):
        if not file.is_absolute() and ".." not in file.parts and (out / file).is_file():
            (target / file).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(out / file, target / file)


def room(paths):
    """Bytes of all files in and below `paths`."""
    def fail(error):
        raise error

    total = 0
    for path in paths:
        total += path.lstat().st_size if not path.is_dir() else sum(
            os.lstat(os.path.join(folder, file)).st_size
            for folder, _, files in os.walk(path, onerror=fail) for file in files)
    return total


def readable_size(size):
    """12345678 bytes -> 12 MB"""
    for unit in ("B", "kB", "MB", "GB"):
        if size < 999.5:
            break
        size /= 1000
    else:
        unit = "TB"
    return f"{size:.2g} {unit}" if size < 10 else f"{size:.0f} {unit}"


def newest_checkpoint(out):
    """The folder of the newest whole checkpoint in `out`, None if there is none."""
    whole = [path.parent for path in out.glob(f"{CHECKPOINTS}/*/{MANIFEST}") if path.parent.name.isdigit()]
    return max(whole, key=lambda folder: int(folder.name), default=None)


def what_is_there(out):
    """Says what `out` holds that has no whole checkpoint."""
    found = written(out)
    if out / CHECKPOINTS in found and any((out / CHECKPOINTS).iterdir()):
        return "results of a run whose first checkpoint was not finished"
    return "results of a run without checkpoints" if found else "no results"
