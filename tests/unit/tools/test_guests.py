"""Programs of a user in the place of a solver: what the launcher asks them, and how it tells of mistakes in them."""

import pathlib
import unittest

from launch_case import Launch


class Guests(Launch):
    """Programs that take a solver's place."""

    def setUp(self):
        super().setUp()
        self.guest = self.folder / "guests/my_fluid"
        self.guest.parent.mkdir()
        self.fake(self.guest)
        self.warning = f"warning: {self.guest} cannot write checkpoints: this run goes on without them\n"

    def words(self, plan, *options):
        self.guest.with_suffix(".plan").write_text(plan)
        done = self.launch("--fluid", str(self.guest), *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stderr

    def test_one_that_can_is_not_warned_of(self):
        self.assertEqual(self.words("answers 0 0 yes", "--check"), "")

    def test_any_other_answer_warns(self):
        for plan in ("answers 0 0 no", "answers 0 3 yes", "answers 0 0 yes,no", ""):
            self.assertEqual(self.words(plan, "--check"), self.warning, plan)
        self.assertIn(self.warning, self.words(""))  # the start of the run too

    def test_one_that_does_not_answer_is_not_waited_for(self):
        self.assertEqual(self.words("answers 60 0 yes", "--check"),
                         f"warning: {self.guest} has not said within 5 s whether it can write checkpoints\n")
        for path in pathlib.Path("/proc").glob("[0-9]*/cmdline"):
            try:
                self.assertNotIn(str(self.guest).encode(), path.read_bytes())
            except OSError:
                pass  # it ended just now

    def test_one_that_cannot_cannot_go_on(self):
        (self.out / "checkpoint/000001").mkdir(parents=True)
        (self.out / "checkpoint/000001/manifest.toml").touch()
        self.guest.with_suffix(".plan").write_text("answers 0 0 no")
        done = self.launch("--fluid", str(self.guest), "--restart")
        self.assertEqual((done.returncode, done.stderr), (
            2, f"--restart: error: {self.guest} cannot write checkpoints, so it cannot go on from one\n"))
        self.assertEqual(self.pids(), [])

    def test_one_that_the_case_does_not_need_is_refused(self):
        for side in ("fluid", "solid"):
            self.write_case(f"[{side}]\n")
            done = self.launch("--fluid", str(self.guest), "--solid", str(self.guest))
            other = {"fluid": "solid", "solid": "fluid"}[side]
            self.assertEqual((done.returncode, done.stderr), (
                2, f"--{other} {self.guest}: error: the case has no {other}\n"))
            self.assertEqual(self.pids(), [])

    def test_our_own_are_not_asked(self):
        self.launch("--check")
        self.assertFalse((self.bin / "asked").exists())

    def test_one_in_this_folder_needs_no_slash(self):
        self.guest = self.guest.rename(self.folder / "here.py")
        (self.folder / "here.plan").write_text("answers 0 0 yes")
        done = self.launch("--fluid", "here.py")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertTrue((self.out / "here.py.pid").exists())


class Mistakes(Launch):
    """In programs in Python: told in a line, before former results are moved."""

    def setUp(self):
        super().setUp()
        (self.out / "fluid.csv").write_text("time[s]\n0\n")
        self.guest = self.folder / "my_fluid.py"

    def assert_refused(self, words, *options):
        done = self.launch("--fluid", str(self.guest), *options)
        self.assertEqual((done.returncode, done.stderr), (2, f"{self.guest}{words}\n"))
        self.assertEqual(sorted(path.name for path in self.folder.glob("out*")), ["out"])

    def write(self, *lines, mode=0o755):
        self.guest.write_text("".join(f"{line}\n" for line in lines))
        self.guest.chmod(mode)

    def test_of_syntax(self):
        self.write("#!/usr/bin/python3", "class Push", "    pass")
        for options in ((), ("--check",)):
            self.assert_refused(":2: error: SyntaxError: expected ':'", *options)

    def test_told_by_a_description_too(self):
        self.write("#!/usr/bin/python3", "import no_such_module")
        self.assert_refused(":2: error: ModuleNotFoundError: No module named 'no_such_module'", "--describe")

    def test_in_how_it_is_encoded(self):
        self.guest.write_bytes(b"#!/usr/bin/python3\n'\xff'\n")
        self.guest.chmod(0o755)
        done = self.launch("--fluid", str(self.guest))
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, "^SyntaxError: .*my_fluid.py.* line 2, .*\n$")

    def test_of_what_is_imported(self):
        self.write("#!/usr/bin/python3", "import no_such_module")
        self.assert_refused(":2: error: ModuleNotFoundError: No module named 'no_such_module'")

    def test_in_its_own_line_where_a_package_fails(self):
        self.write("#!/usr/bin/python3", "import json", "def read():", "    return json.loads('{')", "read()")
        self.assert_refused(":4: error: json.decoder.JSONDecodeError: Expecting property name enclosed in double quotes: "
                            "line 1 column 2 (char 1)")

    def test_of_the_last_of_several(self):
        self.write("#!/usr/bin/python3", "try:", "    1 / 0", "except ZeroDivisionError:", "    absent")
        self.assert_refused(":5: error: NameError: name 'absent' is not defined")

    def test_in_how_it_is_started(self):
        self.write("#!/usr/bin/python3", mode=0o644)
        self.assert_refused(": error: may not be executed, needed as fluid_solver; 'chmod +x' allows it")
        self.write("import numpy")
        self.assert_refused(": error: cannot be started: Exec format error; a script begins with a line as #!/usr/bin/python3")
        self.write("#!/usr/bin/python3\r")
        self.assert_refused(": error: cannot be started: No such file or directory; its first line is "
                            "'#!/usr/bin/python3\\r\\n'")


if __name__ == "__main__":
    unittest.main()
