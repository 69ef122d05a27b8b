"""Starts a part of toryu, whatever the environment says of Python and of the locale:

    python3 -I -X utf8 tools/toryu launch|study|report|compare ...
"""

import pathlib
import runpy
import sys

sys.path[0] = str(pathlib.Path(__file__).resolve().parents[1])  # in the place of this folder
try:
    runpy.run_module(f"toryu.{sys.argv.pop(1)}", run_name="__main__", alter_sys=True)
except (ImportError, MemoryError) as error:
    if "toryu" in (getattr(error, "name", None) or ""):
        raise
    from toryu.installation import INSTALLER

    print(f"error: the machine: a package of Python cannot be loaded: {error or 'not enough memory'}; "
          f"'{INSTALLER} run study' installs what is missing", file=sys.stderr)
    sys.exit(5)  # as in processes.py
