"""The lock of a results folder: what two runs write into one folder would mix."""

import contextlib
import fcntl
import time

POLL = 0.05  # [s]


class FolderTaken(Exception):
    """Another process holds the folder."""


def is_held(folder, name):
    """Whether a process holds `folder` by its file `name`, which need not be there."""
    try:
        with open(folder / name) as lock:
            fcntl.flock(lock, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except BlockingIOError:
        return True
    except OSError:
        pass
    return False


@contextlib.contextmanager
def lock_folder(folder, name, patience=0.0):
    """Holds `folder`, which is made if need be, by a lock on its file `name`; waits `patience` [s] for another to let
    go. The system frees the lock if the process dies. Yields why it does not hold it, "" if it does: not every file
    system has locks."""
    folder.mkdir(parents=True, exist_ok=True)
    with open(folder / name, "w") as lock:
        end = time.monotonic() + patience
        while True:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                break
            except BlockingIOError:
                if time.monotonic() >= end:
                    raise FolderTaken(folder) from None
            except OSError as error:
                yield error.strerror
                return
            time.sleep(POLL)
        yield ""
