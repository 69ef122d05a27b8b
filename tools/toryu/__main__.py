"""Starts a part of toryu, whatever the environment says of Python and of the locale:

    python3 -I -X utf8 tools/toryu launch|study|report ...
"""

import pathlib
import runpy
import sys

sys.path[0] = str(pathlib.Path(__file__).resolve().parents[1])  # in the place of this folder
runpy.run_module(f"toryu.{sys.argv.pop(1)}", run_name="__main__", alter_sys=True)
