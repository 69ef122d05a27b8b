"""tools/build.sh in a small project of its own: it builds what is out of date, one at a time, and nothing where it may not
write."""

import os
import pathlib
import shutil
import subprocess
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[3]
NOBODY = 65534
PROJECT = """cmake_minimum_required(VERSION 3.25)
project(small LANGUAGES NONE)
set(program ${CMAKE_BINARY_DIR}/bin/program)
add_custom_command(OUTPUT ${program} DEPENDS ${CMAKE_SOURCE_DIR}/source VERBATIM
  COMMAND sh -c "echo built >>'${CMAKE_BINARY_DIR}/times'; sleep 0.5; cp '${CMAKE_SOURCE_DIR}/source' '${program}'; chmod +x '${program}'")
add_custom_target(program DEPENDS ${program})
"""
PRESETS = """{"version": 6, "configurePresets": [{"name": "release", "generator": "Ninja",
"binaryDir": "${sourceDir}/build/release"}]}"""


class Build(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        self.root.chmod(0o755)
        for path in ("tools/build.sh", "common/run/write_commit.cmake"):
            (self.root / path).parent.mkdir(parents=True)
            shutil.copy(ROOT / path, self.root / path)
        self.folder = self.root / "build/release"
        self.program = self.folder / "bin/program"
        (self.root / "CMakeLists.txt").write_text(PROJECT)
        (self.root / "CMakePresets.json").write_text(PRESETS)
        (self.root / "source").write_text("#!/bin/sh\n")

    def command(self):
        return [self.root / "tools/build.sh", "release", "program"]

    def build(self, **settings):
        done = subprocess.run(self.command(), capture_output=True, text=True, **settings)
        return done.returncode, done.stderr

    def build_as_another(self):
        """As somebody who may read alone."""
        if os.getuid() == 0:
            return self.build(user=NOBODY, group=NOBODY, extra_groups=[])
        folders = [self.root, *(path for path in self.root.rglob("*") if path.is_dir())]
        for path in folders:
            path.chmod(0o555)
        try:
            return self.build()
        finally:
            for path in folders:
                path.chmod(0o755)

    def times_built(self):
        return len((self.folder / "times").read_text().splitlines())

    def change(self):
        (self.root / "source").write_text("#!/bin/sh\ntrue\n")
        later = time.time() + 5  # than what is built, whatever the clock of the file system resolves
        os.utime(self.root / "source", (later, later))

    def test_what_is_up_to_date_is_left_alone(self):
        self.assertEqual(self.build()[0], 0)
        before = self.program.stat()
        self.assertEqual(self.build(), (0, ""))
        self.assertEqual((self.program.stat(), self.times_built()), (before, 1))
        self.change()
        self.build()
        self.assertEqual(self.times_built(), 2)

    def test_two_at_once_build_once(self):
        both = [subprocess.Popen(self.command(), stderr=subprocess.PIPE, text=True) for _ in range(2)]
        words = [process.communicate(timeout=60)[1] for process in both]
        self.assertEqual([process.returncode for process in both], [0, 0], words)
        self.assertEqual(self.times_built(), 1)
        self.assertIn("waiting for another build of build/release\n", words)

    def test_who_may_not_write_runs_what_is_built(self):
        code, words = self.build_as_another()
        self.assertEqual(code, 5)
        self.assertIn("build/release cannot be written", words)
        self.build()
        self.assertEqual(self.build_as_another(), (0, ""))
        self.change()
        code, words = self.build_as_another()
        self.assertEqual(code, 0)
        self.assertIn("warning: the sources are newer than the programs", words)
        self.assertEqual(self.times_built(), 1)

    def test_a_copy_is_built_of_its_own_sources(self):
        self.build()
        copy = self.root.with_name(self.root.name + "_copy")
        self.addCleanup(shutil.rmtree, copy)
        shutil.copytree(self.root, copy)
        (copy / "source").write_text("#!/bin/sh\necho copy\n")
        done = subprocess.run([copy / "tools/build.sh", "release", "program"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("echo copy", (copy / "build/release/bin/program").read_text())
        self.assertEqual(self.times_built(), 1)

    def test_an_option_with_a_question_mark_is_for_the_first_time(self):
        def configured(*options):
            done = subprocess.run([*self.command(), *options], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            return "TORYU_TESTS:UNINITIALIZED=ON" in (self.folder / "CMakeCache.txt").read_text()

        self.assertTrue(configured("-DTORYU_TESTS?=ON"))
        self.assertFalse(configured("-DTORYU_TESTS=OFF"))
        self.assertFalse(configured("-DTORYU_TESTS?=ON"))

    def test_a_commit_is_noted_and_builds_nothing(self):
        git = ["git", "-C", self.root, "-c", "user.name=a", "-c", "user.email=a", "-c", "init.defaultBranch=main"]
        commits = []
        for text in ("one", "two"):
            (self.root / "CHANGELOG.md").write_text(text)
            for words in (["init", "-q"], ["add", "tools", "CHANGELOG.md"], ["commit", "-qm", text]):
                subprocess.run([*git, *words], check=True)
            self.assertEqual(self.build()[0], 0)
            commits.append((self.folder / "bin/commit.txt").read_text().strip())
        head = subprocess.run([*git, "rev-parse", "HEAD"], capture_output=True, text=True).stdout
        self.assertEqual(commits[1], head[:12])
        self.assertNotEqual(commits[0], commits[1])
        self.assertEqual(self.times_built(), 1)


if __name__ == "__main__":
    unittest.main()
