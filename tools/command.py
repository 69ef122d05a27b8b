#!/usr/bin/python3 -IXutf8
"""The command of an installation, bin/toryu: does what ./run.sh does in the sources, but for installing and building.
By the name of a program, it is that program in the build for this processor."""

import os
import pathlib
import sys

tools = pathlib.Path(__file__).resolve().parents[1] / "lib/toryu/tools"
name = pathlib.Path(sys.argv[0]).name
if name == "toryu":
    os.execv(sys.executable, [sys.executable, "-I", "-X", "utf8", tools / "toryu", "launch", *sys.argv[1:]])
sys.path.insert(0, str(tools))
from toryu import PROGRAMS  # noqa: E402

os.execv(PROGRAMS / name, [name, *sys.argv[1:]])
