"""Runs cases and studies of toryu, and reads what they leave."""

import pathlib

PROGRAMS = pathlib.Path(__file__).resolve().parents[2] / "build/release/bin"  # where a build leaves them
