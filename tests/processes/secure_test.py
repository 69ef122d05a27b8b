"""A secured run: the same bits as without, and who is refused, by name on both sides.

    secure_test.py BIN [GROUP]"""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

from toryu import identities
from toryu.processes import BAD_INPUT, DONE, MACHINE
from toryu_testing.process_case import LIMIT, SOLVERS, ProcessCase
from toryu_testing.trio import ROLES

LAUNCH = [sys.executable, "-I", "-X", "utf8", str(pathlib.Path(identities.__file__).parent), "launch"]
END_TIME = "0.01"  # [s] of the strip
LIFE = 30  # [s] of an identity that expires in mid-run
PATIENCE = ["--set", "coupling.time_limit=5"]  # of who waits for one that is refused [s]
NONE, OTHER = "it has no certificate, which --secure asks for", "its certificate is of another CA than that of --secure"
ASKED = "it takes certificates alone, and this program has none: give it --secure FOLDER too"


class SecureCase(ProcessCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="toryu_identities_")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        identities.make(cls.folder / "own")
        identities.make(cls.folder / "encrypted", encrypt=True)

    def secure(self, name="own"):
        return [f"--secure={self.folder / name}"]

    def start(self, run, **folders):
        """The three programs, each with the folder of identities named, or without any."""
        for role in ROLES:
            name = folders.get(role, "own")
            run.start(role, extra=[*PATIENCE, *(self.secure(name) if name else [])])
        return run

    def assert_refused(self, run, role, reason, limit=LIMIT):
        code, text = run.ending_of(role, limit)
        self.assertEqual(code, BAD_INPUT, f"{role}: {text}")
        self.assertRegex(text, reason, role)
        self.assertNotIn("Traceback", text)


class Results(SecureCase):
    def test_are_bit_for_bit_those_without_security(self):
        for names in ({}, SOLVERS):
            plain = self.run_of_three(**names, end_time=END_TIME).start_all()
            self.assert_all_end(plain, DONE)
            for name in ("own", "encrypted"):
                with self.subTest(names=names, name=name):
                    secured = self.run_of_three(**names, end_time=END_TIME).start_all(self.secure(name))
                    self.assert_all_end(secured, DONE)
                    self.assertEqual(secured.results(), plain.results())

    def test_need_of_the_folder_what_is_of_the_own_part_alone(self):
        for role in ROLES:
            own = self.folder / f"of_{role}"
            own.mkdir()
            for name in ("ca.pem", "governance.p7s", f"{role}.pem", f"{role}.key", f"{role}.p7s"):
                (own / name).write_bytes((self.folder / "own" / name).read_bytes())
                (own / name).chmod(0o600)
        run = self.run_of_three(end_time=END_TIME)
        self.assert_all_end(self.start(run, **{role: f"of_{role}" for role in ROLES}), DONE)


class Refusal(SecureCase):
    def test_of_another_authority_is_told_on_both_sides(self):
        identities.make(self.folder / "other", encrypt=True)
        run = self.start(self.run_of_three(), solid="other")
        self.assert_refused(run, "solid", f"--secure: error: coupler, process [0-9]+ of host .*: {OTHER}")
        for role in ("coupler", "fluid"):
            self.assert_refused(run, role, f"--secure: error: fake_solid, process [0-9]+ of host .*: {OTHER}")

    def test_of_a_participant_without_a_certificate_is_told_on_both_sides(self):
        run = self.start(self.run_of_three(), fluid=None)
        self.assert_refused(run, "fluid", f"--secure: error: coupler, process [0-9]+ of host .*: {ASKED}")
        for role in ("coupler", "solid"):
            self.assert_refused(run, role, f"--secure: error: fake_fluid, process [0-9]+ of host .*: {NONE}")

    def test_of_a_coupler_without_a_certificate_is_told_on_both_sides(self):
        run = self.start(self.run_of_three(), coupler=None)
        self.assert_refused(run, "coupler", f"--secure: error: fake_.*, process [0-9]+ of host .*: {ASKED}")
        for role in ("fluid", "solid"):
            self.assert_refused(run, role, f"--secure: error: coupler, process [0-9]+ of host .*: {NONE}")

    def test_of_the_wrong_part_is_told_on_both_sides(self):
        wrong = self.folder / "wrong"
        subprocess.run(["cp", "-a", self.folder / "own", wrong], check=True)
        for ending in ("pem", "key", "p7s"):
            (wrong / f"fluid.{ending}").write_bytes((wrong / f"solid.{ending}").read_bytes())
        run = self.start(self.run_of_three(), fluid="wrong")
        self.assert_refused(run, "fluid", f"--secure {wrong}/fluid.pem: error: is the certificate of the part 'solid', and "
                            "must be that of 'fluid'")
        for role in ("coupler", "solid"):
            self.assert_refused(run, role, "--secure: error: fake_fluid, process .*: its certificate is that of the part "
                                "'solid', and it plays the part 'fluid'")

    def test_leaves_the_place_to_one_that_comes_later(self):
        run = self.run_of_three(end_time=END_TIME)
        run.start("fluid", name="stranger").start("coupler", extra=self.secure())
        self.assert_refused(run, "stranger", ASKED)
        run.start("fluid", extra=self.secure()).start("solid", extra=self.secure())
        self.assert_all_end(run, DONE)

    def test_of_one_that_comes_into_a_run_leaves_that_alone(self):
        run = self.run_of_three().start_all(self.secure()).wait_until_running()
        run.start("solid", name="stranger")
        run.wait_for_log(f"coupler warning: refused fake_solid, process [0-9]+ of host .*: {NONE}", LIMIT)
        before = run.windows()
        run.wait_until_running(beyond=before + 10)
        self.assert_refused(run, "stranger", ASKED)

    def test_of_identities_that_expire_in_mid_run_is_told_by_all(self):
        made = identities.permissions
        for name, longer in (("short", ()), ("of_one", ("coupler", "solid"))):
            lives = {role: LIFE * (2 if role in longer else 1) / 86400 for role in ROLES}
            with mock.patch.object(identities, "permissions", lambda part, now, _: made(part, now, lives[part])):
                identities.make(self.folder / name)
        runs = {name: self.run_of_three().start_all(self.secure(name)) for name in ("short", "of_one")}
        for name, run in runs.items():
            for role in ROLES:
                with self.subTest(name=name, role=role):
                    files = f"{self.folder}/{name}/{'fluid' if name == 'of_one' else '(coupler|fluid|solid)'}.p7s"
                    self.assert_refused(run, role, f"--secure {files}: error: expires on .* UTC, in mid-run: no message passes "
                                        "from then on", limit=LIFE + LIMIT)


class Launcher(SecureCase):
    def launch(self, *words):
        done = subprocess.run([*LAUNCH, *map(str, words)], capture_output=True, text=True, timeout=4 * LIMIT)
        return done.returncode, done.stdout + done.stderr

    def test_makes_identities_in_a_new_folder_alone(self):
        folder = self.folder / "by_command"
        code, said = self.launch("--make-identities", folder, "--days", 3)
        self.assertEqual((code, said.partition(";")[0]), (DONE, f"{folder}: identities of coupler, fluid and solid, valid for "
                                                          "3 days"))
        for words, expected in ((["--make-identities", folder], f"--make-identities {folder}: error: is there already; remove "
                                 "it first, or give another folder\n"),
                                (["--make-identities", folder / "a", "--days", 0], "--days 0: error: must be from 1 to 36500\n"),
                                (["--make-identities", "/proc/no"], "--make-identities /proc/no: error: cannot be written: No "
                                 "such file or directory\n")):
            self.assertEqual(self.launch(*words), (BAD_INPUT, expected))
        before = sorted(path.name for path in self.folder.iterdir())
        with mock.patch.dict(os.environ, PATH="/nowhere"):
            code, said = self.launch("--make-identities", self.folder / "half")
        self.assertEqual(code, MACHINE, said)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), before)

    def test_checks_and_passes_on_the_folder(self):
        case = self.run_of_three().case
        for words in (["--check"], []):
            code, said = self.launch(case, "--bin", self.bin, "--out", self.folder / "out", "--secure", "/nowhere", *words)
            self.assertEqual((code, said.partition("\n")[0]), (BAD_INPUT, "--secure /nowhere: error: is no folder; './run.sh "
                                                               "--make-identities FOLDER' makes one"))
        alone = pathlib.Path(identities.__file__).parents[2] / "cases/dam_break"
        self.assertEqual(self.launch(alone, "--bin", self.bin, "--check", "--secure", self.folder / "own"), (
            BAD_INPUT, f"--secure {self.folder}/own: error: the case is not coupled: one program computes it, and sends "
                       "nothing\n"))
        code, said = self.launch(case, "--bin", self.bin, "--out", self.folder / "out", "--end-time", END_TIME, "--no-report",
                                 *self.secure("encrypted"))
        self.assertEqual(code, DONE, said)


if __name__ == "__main__":
    SecureCase.bin = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main()
