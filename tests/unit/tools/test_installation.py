"""Which programs of an installation are for a processor."""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from types import SimpleNamespace

from toryu import PROGRAMS, installation
from toryu.installation import LEVELS, ROOT, best_level, flags_of_processor
from toryu.study import runner

OF_2012 = "cx16 lahf_lm popcnt sse4_1 sse4_2 ssse3 avx f16c xsave"  # Ivy Bridge: level 2
OF_2013 = f"{OF_2012} abm avx2 bmi1 bmi2 fma movbe"  # Haswell
OF_2016 = f"{OF_2013} avx512f avx512cd avx512er avx512pf"  # Knights Landing: of AVX-512, a part
OF_2017 = f"{OF_2013} avx512f avx512cd avx512bw avx512dq avx512vl"  # Skylake for servers


class Levels(unittest.TestCase):
    def test_the_best_level_is_that_of_which_nothing_is_missing(self):
        for flags, level in ((OF_2012, "x86-64"), (OF_2013, "x86-64-v3"), (OF_2016, "x86-64-v3"), (OF_2017, "x86-64-v4"),
                             (OF_2017.replace("fma", ""), "x86-64"), ("", "x86-64")):
            self.assertEqual(best_level(set(flags.split())), level, flags)

    def test_what_one_core_lacks_is_not_counted_on(self):
        with tempfile.TemporaryDirectory() as folder:
            cpuinfo = pathlib.Path(folder) / "cpuinfo"
            self.assertEqual(flags_of_processor(cpuinfo), set())
            cpuinfo.write_text("flags\t\t: fpu avx avx2\nbugs\t: x\n\nflags\t\t: fpu avx\n")
            self.assertEqual(flags_of_processor(cpuinfo), {"fpu", "avx"})
            cpuinfo.write_text("Features\t: fp asimd\n")
            self.assertEqual(flags_of_processor(cpuinfo), set())

    def test_the_loader_of_glibc_finds_the_same_level_here(self):
        loader = subprocess.run(["/lib64/ld-linux-x86-64.so.2", "--help"], capture_output=True, text=True).stdout
        supported = re.findall(r"(x86-64-v[34]) \(supported", loader) + ["x86-64"]
        self.assertEqual(best_level(flags_of_processor()), supported[0])


class Command(unittest.TestCase):
    """The command in an installation whose programs tell where they are."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.prefix = pathlib.Path(folder.name).resolve()
        self.programs = self.prefix / "lib/toryu/programs"
        package = self.prefix / "lib/toryu/tools/toryu"
        package.mkdir(parents=True)
        for name in ("__init__.py", "installation.py"):
            shutil.copy(ROOT / "tools/toryu" / name, package)
        (self.prefix / "bin").mkdir()
        shutil.copy(ROOT / "tools/command.py", self.prefix / "bin/toryu")
        (self.prefix / "bin/coupler").symlink_to("toryu")

    def put_program(self, folder):
        folder.mkdir(parents=True)
        (folder / "coupler").write_text("#!/bin/sh\necho \"$0\" \"$@\"\nexit 3\n")
        (folder / "coupler").chmod(0o755)

    def started(self):
        done = subprocess.run([self.prefix / "bin/coupler", "a case", "--check"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 3, done.stderr)
        return done.stdout.strip()

    def test_the_program_for_this_processor_is_started(self):
        for level in LEVELS:
            self.put_program(self.programs / level)
        best = best_level(flags_of_processor())
        self.assertEqual(self.started(), f"{self.programs / best / 'coupler'} a case --check")

    def test_other_hosts_are_given_the_command(self):
        for level in LEVELS:
            self.put_program(self.programs / level)
        program = ("from toryu import PROGRAMS; from toryu.installation import on_other_hosts\n"
                   "print(on_other_hosts(PROGRAMS / 'coupler'), on_other_hosts(PROGRAMS / 'replayed_fluid') == "
                   "PROGRAMS / 'replayed_fluid', on_other_hosts(PROGRAMS.parent / 'coupler') == PROGRAMS.parent / 'coupler')")
        done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True,
                              env={"PYTHONPATH": str(self.prefix / "lib/toryu/tools")})
        self.assertEqual(done.stdout.split(), [str(self.prefix / "bin/coupler"), "True", "True"], done.stderr)

    def test_a_build_for_one_processor_has_no_levels(self):
        self.put_program(self.programs)
        self.assertEqual(self.started(), f"{self.programs / 'coupler'} a case --check")


class Study(unittest.TestCase):
    def test_runs_on_other_machines_take_the_programs_that_are_for_those(self):
        def command(programs):
            runs = runner.Runner(SimpleNamespace(case="case.toml", map=None), pathlib.Path("out"), programs, 1, 1, None)
            return runs.command(SimpleNamespace(options=lambda: []))

        self.assertEqual(command(PROGRAMS)[-1], "case.toml")
        self.assertEqual(command(pathlib.Path("/other"))[-1], "--bin=/other")


class Sources(unittest.TestCase):
    def test_in_the_sources_the_command_is_the_script(self):
        self.assertEqual((installation.COMMAND, installation.folder_of_programs()), ("./run.sh", ROOT / "build/release/bin"))


if __name__ == "__main__":
    unittest.main()
