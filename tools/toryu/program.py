"""The frame of these programs, as common/run/program.hpp is that of the C++ ones: standard streams that may be closed,
full or read by nobody; how a program ends; how one starts another."""

import argparse
import contextlib
import errno
import io
import os
import pathlib
import select
import signal
import sys

from toryu.processes import BAD_INPUT, INTERRUPTED, MACHINE, requests_to_end

PACKAGE = pathlib.Path(__file__).resolve().parent

# A file of results has one writer and is read when it is whole; not every file system has locks.
os.environ["HDF5_USE_FILE_LOCKING"] = "FALSE"
os.environ["MPLBACKEND"] = "Agg"  # charts go into files

# What says that a path is wrong as it was given, not that the machine is short of something.
FAULTS_OF_PATH = {errno.ENAMETOOLONG, errno.ELOOP, errno.ENOTDIR, errno.ENOEXEC}
REMEDIES = {
    errno.ENOSPC: "make room on the disk (df -h and df -i show it), or give --out a folder on another",
    errno.EDQUOT: "your share of the disk is used up: make room, or give --out a folder on another",
    errno.EFBIG: "files may not become that large here: raise 'ulimit -f'",
    errno.ENOENT: "the folder was removed or moved in mid-run; leave it where it is until the run has ended",
    errno.EACCES: "give --out a folder that you may write to",
    errno.EROFS: "give --out a folder that you may write to",
    errno.EMFILE: "too many files are open: raise 'ulimit -n'",
    errno.EAGAIN: "too many processes: end others, or raise 'ulimit -u'",
    errno.ENOMEM: "not enough memory: end other programs",
    errno.ETXTBSY: "the program is being built: wait for that",
}


# What the machine is short of, whatever path was given.
SHORTAGES = {errno.ENOSPC, errno.EDQUOT, errno.EMFILE, errno.ENFILE, errno.EIO, errno.EAGAIN, errno.ENOMEM}


def python(part, *arguments):
    """The command that starts toryu.PART, untouched by PYTHONPATH, PYTHONIOENCODING, the locale and the like."""
    return [sys.executable, "-I", "-X", "utf8", str(PACKAGE), part, *map(str, arguments)]


def given(value):
    """The value of an option; an empty one would be the current folder, or count as none given."""
    if not value:
        raise argparse.ArgumentTypeError("has no value")
    return value


def path(value):
    return pathlib.Path(given(value))


class StandardStream(io.RawIOBase):
    """Standard output or error. What cannot be written is dropped: a run does not depend on who reads."""

    def __init__(self, descriptor):
        super().__init__()
        self.descriptor = descriptor
        self.error = None  # the first, as OSError

    def writable(self):
        return True

    def fileno(self):
        return self.descriptor

    def isatty(self):
        return os.isatty(self.descriptor)

    def write(self, data):
        left = memoryview(data).cast("B")
        while left and not self.error:
            try:
                left = left[os.write(self.descriptor, left):]
            except BlockingIOError:  # another program made the terminal or pipe so
                select.select([], [self.descriptor], [])
            except OSError as error:
                self.error = error
        return len(data)


def secure_streams():
    """Opens the descriptors 0 to 2 on /dev/null where they are closed, so that no file gets one of them; output is UTF-8
    from now on, and a stream that fails no fault."""
    for descriptor in range(3):
        try:
            os.fstat(descriptor)
        except OSError:
            os.set_inheritable(os.open(os.devnull, os.O_RDWR), True)  # takes the lowest that is free: this one
    sys.stdout, sys.stderr = (
        io.TextIOWrapper(io.BufferedWriter(StandardStream(descriptor)), "utf-8", "backslashreplace", line_buffering=True)
        for descriptor in (1, 2))


def must_be_printed():
    """Where standard output is what was asked for: raises OSError if it could not be written. A reader that went away has
    read enough."""
    sys.stdout.flush()
    error = sys.stdout.buffer.raw.error
    if error and error.errno != errno.EPIPE:
        raise OSError(error.errno, error.strerror, "standard output")


@contextlib.contextmanager
def whole_file(path):
    """A text file to write that is either there in full or not at all, after a power cut too. An OSError names it."""
    part = path.with_name(path.name + ".part")
    try:
        with open(part, "w", newline="", encoding="utf-8", errors="backslashreplace") as file:  # a path may be no text
            yield file
            file.flush()
            os.fsync(file.fileno())
        os.replace(part, path)
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(part)) from error


def write_whole(path, text):
    """Writes a text file as `whole_file` does."""
    with whole_file(path) as file:
        file.write(text)


def interrupt(*_):
    raise KeyboardInterrupt


def words_of(error):
    """What went wrong with the machine, and what can be done."""
    what = [str(part) for part in (error.filename, error.strerror or error) if part]
    remedy = REMEDIES.get(error.errno)
    return ": ".join(what) + (f"; {remedy}" if remedy else "")


def run(main):
    """Ends the program with what `main` returns for its arguments, or with a fault of the machine in one line."""
    secure_streams()
    # A program of the run that writes to a terminal where that stops what is in the background (stty tostop) is not
    # meant by it: each is in a group of its own. They inherit this.
    signal.signal(signal.SIGTTOU, signal.SIG_IGN)
    for number in requests_to_end():
        signal.signal(number, interrupt)
    try:
        sys.exit(main(sys.argv[1:]))
    except KeyboardInterrupt:
        print("interrupted", file=sys.stderr)
        sys.exit(INTERRUPTED)
    except OSError as error:
        if error.errno in FAULTS_OF_PATH:
            print(f"{error.filename}: error: {error.strerror}", file=sys.stderr)
            sys.exit(BAD_INPUT)
        print(f"error: the machine: {words_of(error)}", file=sys.stderr)
        sys.exit(MACHINE)
    except MemoryError:
        print("error: the machine: not enough memory; end other programs", file=sys.stderr)
        sys.exit(MACHINE)
