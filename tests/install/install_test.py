"""Installs a build, moves the installation, runs a case with it, and builds a fluid against it that takes part in a run:

    PYTHONPATH=tools:tests /usr/bin/python3 tests/install/install_test.py BUILD
"""
import gzip
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
COMMANDS = ("toryu", "coupler", "fluid_solver", "solid_solver")
OPTIONS_OF_A_BUILD = re.compile(r"-(W|O|f|m)\S+")  # warnings, optimisation, instruction set


def said(*command, **settings):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, **settings)
    if done.returncode:
        raise AssertionError(f"{command} ended with {done.returncode}: {done.stdout}{done.stderr}")
    return done.stdout


class Installation(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="toryu_install_")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        said("cmake", "--install", BUILD, "--prefix", cls.folder / "before")
        cls.prefix = (cls.folder / "before").rename(cls.folder / "after")
        cls.bin = cls.prefix / "bin"

    def test_a_case_gives_what_it_gives_in_the_sources(self):
        case, end = self.prefix / "share/toryu/cases/hydrostatic_tank", "--end-time=0.02"
        told = said(self.bin / "toryu", case, end, cwd=self.folder)
        self.assertIn("out/hydrostatic_tank/report.html", told)
        said(BUILD / "bin/fluid_solver", ROOT / "cases/hydrostatic_tank", end, "--out", self.folder / "built")
        found, expected = (self.folder / out / "fluid.csv" for out in ("out/hydrostatic_tank", "built"))
        self.assertEqual(found.read_text(), expected.read_text())

    def test_the_commands_are_the_programs(self):
        for name in COMMANDS[1:]:
            self.assertEqual(said(self.bin / name, "--version"), said(BUILD / "bin" / name, "--version"))

    def test_the_command_names_itself(self):
        self.assertIn("usage: toryu ", said(self.bin / "toryu", "--help"))

    def test_python_finds_the_package(self):
        program = "import toryu; print(toryu.PROGRAMS)"
        path = {"PYTHONPATH": str(self.prefix / "lib/python3/dist-packages")}
        self.assertEqual(said("/usr/bin/python3", "-c", program, env=os.environ | path).strip(),
                         str(self.prefix / "lib/toryu/programs"))

    def test_a_solid_in_python_takes_part_in_a_run(self):
        share = self.prefix / "share/toryu"
        told = said(self.bin / "toryu", share / "cases/elastic_gate", "--solid", share / "examples/beam.py", "--end-time=0.002",
                    "--no-report", "--out=python", cwd=self.folder)
        self.assertIn("impulse given and taken", told)

    def test_every_option_is_in_the_manual_page(self):
        for name in COMMANDS:
            page = gzip.decompress((self.prefix / f"share/man/man1/{name}.1.gz").read_bytes()).decode()
            described = set(re.findall(r"--[a-z-]+", page.replace("\\-", "-")))
            options = re.findall(r"^ +(?:-\w, ?)?(--[a-z-]+)", said(self.bin / name, "--help"), re.MULTILINE)
            self.assertGreater(len(options), 10)
            self.assertLessEqual(set(options), described, name)

    def test_the_shell_completes_the_options_of_every_command(self):
        for name in COMMANDS:
            self.assertTrue((self.prefix / f"share/bash-completion/completions/{name}").exists())
        for words, expected in ((["--ov"], ["--overwrite"]), (["--only", ""], ["fluid", "solid"]), (["my_case"], [])):
            script = (f"source {self.prefix}/share/bash-completion/completions/toryu\n"
                      f"COMP_WORDS=(toryu {' '.join(word or repr('') for word in words)}) COMP_CWORD={len(words)}\n"
                      f"_toryu {self.bin}/toryu; printf '%s\\n' \"${{COMPREPLY[@]}}\"")
            self.assertEqual(said("bash", "-c", script).split(), expected)

    def test_a_fluid_is_built_outside_and_takes_part_in_a_run(self):
        outside = self.folder / "outside"
        said("cmake", "-S", ROOT / "tests/participants/outside", "-B", outside, "-G", "Ninja",
             f"-DCMAKE_PREFIX_PATH={self.prefix}", "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON")
        said("cmake", "--build", outside)
        commands = json.loads((outside / "compile_commands.json").read_text())[0]["command"]
        commands += said("ninja", "-C", outside, "-t", "commands", "my_fluid").splitlines()[-1]
        self.assertEqual([word for word in commands.split() if OPTIONS_OF_A_BUILD.fullmatch(word)], [])

        programs = self.folder / "programs"
        programs.mkdir()
        (programs / "coupler").symlink_to(self.bin / "coupler")
        shutil.copy(BUILD / "bin/fake_solid", programs)
        said("/usr/bin/python3", ROOT / "tests/participants/conformance.py", "--bin", programs, "fluid", outside / "my_fluid",
             "Conformance.test_runs_to_the_end", "Conformance.test_goes_on_from_a_checkpoint")


if __name__ == "__main__":
    unittest.main(verbosity=2)
