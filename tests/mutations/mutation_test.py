"""Cases, references, studies and results that are damaged at random: none crashes what reads them, none hangs it, each ends
well or with exit code 2 and a place. By hand, for more of them:

    PYTHONPATH=tools:tests tests/mutations/mutation_test.py --count 5000 --seed 7 [--bin DIR] [--memory BYTES] [NAME ...]

Programs under the address sanitizer want more address space than there is memory: --memory -1, as CTest gives it.
"""

import argparse
import ast
import contextlib
import functools
import io
import json
import pathlib
import random
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import types
import unittest
from unittest import mock

import mutate
from fork_server import ForkServer

from toryu import PROGRAMS, case, results, summary_text
from toryu.processes import BAD_INPUT, DONE, MACHINE
from toryu.compare import motion, runs
from toryu.report import data
from toryu.report.__main__ import files
from toryu.study import __main__ as study_main
from toryu.study import runner, settings, study_file
from toryu.study.document import BadStudy
from toryu_testing import made_up_run

HERE = pathlib.Path(__file__).resolve().parent
CASES = HERE.parents[1] / "cases"
LIMIT = 300  # [s] within which a check ends, of half a million particles beside other work too
PLACED = re.compile(r".+: error: .+")
servers = contextlib.ExitStack()
options = argparse.Namespace(count=40, seed=1, bin=PROGRAMS, memory=4_000_000_000)  # [bytes] that a check may take


@functools.cache
def server_of(program):
    limit = functools.partial(resource.setrlimit, resource.RLIMIT_AS, (options.memory, options.memory))
    return servers.enter_context(contextlib.closing(ForkServer(program, options.bin / "fork_server.so", limit)))


def run(command, **_):
    """In the place of subprocess.run, where toryu starts a program to read a case."""
    done = server_of(command[0]).run(*command[1:], timeout=LIMIT)
    done.stdout, done.stderr = (text.decode(errors="surrogateescape") for text in (done.stdout, done.stderr))
    return done


def tearDownModule():
    servers.close()


class Mutations(unittest.TestCase):
    def setUp(self):
        forked = mock.patch.object(case, "subprocess", types.SimpleNamespace(run=run, DEVNULL=subprocess.DEVNULL))
        forked.start()
        self.addCleanup(forked.stop)
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def each(self, share=1.0):
        """Numbers from the seed, each with a random generator of its own, so that one can be repeated alone."""
        for n in range(max(1, int(options.count * share))):
            yield n, random.Random(f"{options.seed} {type(self).__name__} {n}")

    def check(self, program, path, what):
        done = server_of(options.bin / program).run(path, "--check", cwd=self.folder, timeout=LIMIT)
        words = done.stderr.decode(errors="replace")
        short_of_memory = done.returncode == MACHINE and "memory" in words
        self.assertTrue(done.returncode in (DONE, BAD_INPUT) or short_of_memory, f"{what}: {done.returncode}: {words}")
        if done.returncode == BAD_INPUT:
            self.assertRegex(words, PLACED, what)

    def keep(self, what, text):
        """Where to find what fell."""
        kept = pathlib.Path(tempfile.gettempdir()) / f"toryu_mutation_{type(self).__name__}"
        kept.write_bytes(text)
        return f"{what}, kept in {kept}"


SMALL_CASE = b"""[case]
title = "Small"
end_time = 0.01
frame_interval = 0.005
domain = { min = [-0.5, -0.5], max = [1.5, 1.5] }
[[wall]]
name = "floor"
box = { min = [-0.15, -0.15], max = [1.15, 0.0] }
motion = { velocity = [[0.0, 0.0, 0.0], [0.01, 0.1, 0.0]], speed = 1.0 }
[fluid]
density = 1000.0
sound_speed = 30.0
spacing = 0.05
density_diffusion = {}
artificial_viscosity = { alpha = 0.1 }
region = [ { name = "water", box = { min = [0.0, 0.0], max = [0.5, 0.5] } } ]
observer = [ { name = "gauge", quantity = "pressure", point = [0.1, 0.1] } ]
[solid]
density = 1000.0
youngs_modulus = 2e6
poissons_ratio = 0.4
spacing = 0.025
region = [ { name = "plate", box = { min = [0.6, 0.0], max = [0.7, 0.4] } } ]
clamp = [ { name = "foot", box = { min = [0.6, 0.0], max = [0.7, 0.05] } } ]
observer = [ { name = "tip", point = [0.65, 0.4] } ]
[[reference]]
label = "measured"
file = "tip.csv"
series = "solid.csv:tip_displacement_x[m]"
column = "x[m]"
"""
REFERENCE = b"# by hand\nt[s],x[m]\n0,0\n0.005,1e-4\n0.01,2e-4\n"


class DamagedCases(Mutations):
    def test_each_program_checks_them(self):
        (self.folder / "tip.csv").write_bytes(REFERENCE)
        path = self.folder / "case.toml"
        for n, generator in self.each():
            text = mutate.mutated(SMALL_CASE, generator)
            path.write_bytes(text)
            for program in ("coupler", "fluid_solver", "solid_solver"):
                self.check(program, path, self.keep(f"case {n}", text))


class DamagedReferences(Mutations):
    def test_each_is_judged_before_the_run_and_resolved(self):
        path = self.folder / "case.toml"
        path.write_bytes(SMALL_CASE)
        for n, generator in self.each():
            text = mutate.mutated(REFERENCE, generator)
            (self.folder / "tip.csv").write_bytes(text)
            what = self.keep(f"reference {n}", text)
            self.check("coupler", path, what)
            case.resolve.cache_clear()
            reference, = case.resolve(path, options.bin / "coupler").references
            self.assertNotEqual("points" in reference, "fault" in reference, what)
            results.compare([reference], self.folder)


class DamagedStudies(Mutations):
    def setUp(self):
        super().setUp()
        self.studies = [path for path in sorted(CASES.glob("*/*.toml")) if re.search(rb"(?m)^\[study\]", path.read_bytes())]

    def test_each_is_read_or_refused_with_a_place(self):
        for path in CASES.iterdir():
            shutil.copytree(path, self.folder / path.name)
        for n, generator in self.each():
            source = generator.choice(self.studies)
            text = mutate.mutated(source.read_bytes(), generator)
            path = self.folder / source.parent.name / "damaged.toml"
            path.write_bytes(text)
            self.read(path, self.keep(f"study {n}", text))

    def read(self, path, what):
        case.resolve.cache_clear()
        with contextlib.suppress(case.BadCase):
            if case.resolve(path, options.bin / "coupler").kind != "study":
                return
        try:
            small = path.stat().st_size % 2 == 0
            study = study_file.read(path, options.bin / "coupler", study_main.VIEWS, small)
            make = settings.Maker(study)
            made = make([axis.values[0] for axis in study.axes]) if study.searched else settings.settings(study, make)
            self.assertTrue(made, what)
        except BadStudy as error:
            for fault in str(error).splitlines():
                self.assertRegex(fault, PLACED, what)
        except Exception as error:
            raise AssertionError(what) from error


class DamagedResults(Mutations):
    def test_the_report_passes_over_them(self):
        with mock.patch.dict(made_up_run.SPACING, fluid=0.02, solid=0.0025):  # small files: their heads are hit too
            made_up_run.make_case(self.folder / "gate")
            made_up_run.make_results(self.folder / "whole", frames=3, rows=21)
        for n, generator in self.each():
            out = self.folder / "out"
            shutil.rmtree(out, ignore_errors=True)
            shutil.copytree(self.folder / "whole", out)
            what = self.damage(out, generator, n)
            case.resolve.cache_clear()
            try:
                with contextlib.redirect_stderr(io.StringIO()):
                    report = files(self.folder / "gate", out, options.bin / "coupler", None, "")
                summary_text.of_run([], out)
                pair = self.folder / "whole", out
                self.compare(*pair[::generator.choice((1, -1))])
            except Exception as error:
                raise AssertionError(what) from error
            json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', report["report.html"], re.S)[1])
            for line in re.findall(r"^(?:VIEW|BODIES) = (.*)$", report.get("frames.py", ""), re.MULTILINE):
                ast.literal_eval(line)  # all numbers are finite

    def compare(self, *outs):
        runs.compare(*outs)
        used = [data.used_case(out / "used_case.toml", out, options.bin / "coupler")[0] for out in outs]
        json.dumps(data.finite(motion.collect([(out, case, []) for out, case in zip(outs, used)], ("a", "b"))), allow_nan=False)

    def damage(self, out, generator, n):
        """Damages one file, or several."""
        told = []
        for path in generator.sample(sorted(p for p in out.rglob("*") if p.is_file()), generator.choice((1, 1, 2, 4))):
            text = path.read_bytes()
            is_text = path.suffix in (".csv", ".toml", ".series", ".txt")
            changed = mutate.mutated(text, generator) if is_text else generator.choice(mutate.CHANGES_OF_BYTES)(text, generator)
            path.write_bytes(changed)
            if generator.random() < 0.05:
                path.unlink()
            told.append(self.keep(f"{path.name} of results {n}", changed))
        return "; ".join(told)

    def test_a_damaged_record_of_a_study_counts_as_none(self):
        made_up_run.make_results(self.folder / "run", frames=2)
        run = settings.Setting({"x": 1.0}, {})
        record = runner.Record(run, self.folder / "run", DONE, "", 1.0, 1, 1)
        runner.write_record(record)
        whole = (self.folder / "run/run.json").read_bytes()
        self.assertIsNotNone(runner.read_record(self.folder / "run", run))
        for n, generator in self.each():
            text = mutate.mutated(whole, generator)
            (self.folder / "run/run.json").write_bytes(text)
            try:
                runner.read_record(self.folder / "run", run)
            except Exception as error:
                raise AssertionError(self.keep(f"record {n}", text)) from error


if __name__ == "__main__":
    parser = argparse.ArgumentParser(add_help=False)
    parser.add_argument("--count", type=int, default=options.count)
    parser.add_argument("--seed", type=int, default=options.seed)
    parser.add_argument("--bin", type=pathlib.Path, default=PROGRAMS)
    parser.add_argument("--memory", type=int, default=options.memory)
    options, rest = parser.parse_known_args()
    unittest.main(argv=[sys.argv[0], *rest])
