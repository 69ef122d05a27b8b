"""Faults of a study file: each told with its line before anything runs."""

import unittest

from toryu_testing.study_case import HEAD, TWO_AXES, Study


class BadInput(Study):
    def faults(self, text, head=HEAD):
        self.write(text, head)
        ended = self.study()
        self.assertEqual(ended.returncode, 2, ended.stderr)
        self.assertEqual(self.starts(), [])
        return ended.stderr.replace(str(self.case) + "/", "").splitlines()

    def test_removal_a_cycle_about_an_axis_is_refused(self):
        path = self.case / "case.toml"
        path.write_text(path.read_text().replace("[case]", '[case]\ngeometry = "axisymmetric"'))
        self.assertIn('[removal] is of the plane: a case with geometry = "axisymmetric" goes with [recession]',
                      "\n".join(self.faults('[removal]\npistons = ["piston"]\npiston_area = 0.1\ncycle = 1.0\n')))

    def test_all_faults_of_the_file_at_once_with_their_lines(self):
        self.assertEqual(self.faults("""keep_frame = true
[[axis]]
name = "x"
values = [1, 2]
key = ["fluid.x"]
[[metric]]
name = "end"
series = "fluid.csv:speed[m/s]"
take = "larges"
[[chart]]
x = "x"
y = "and"
log = ["z"]
"""), [
            "window.toml:4: error: unknown key 'keep_frame' in [study]; did you mean 'keep_frames'?",
            "window.toml:5: error: [[axis]] 1 needs 'keys', the keys of the case that take its values",
            "window.toml:8: error: unknown key 'key' in [[axis]] 1; did you mean 'keys'?",
            "window.toml:12: error: 'take' must be one of 'last', 'first', 'largest', 'smallest', 'peak', 'peak_time', "
            "'mean', 'rms', 'middle', 'amplitude', 'period', 'frequency', 'amplitude_loss', 'distance', found 'larges'; did "
            "you mean 'largest'?",
            "window.toml:15: error: 'y' must be one of 'end', 'wall_time', 'processor_time', 'simulated_time', 'steps', "
            "found 'and'; did you mean 'end'?",
            "window.toml:16: error: 'log' must hold some of 'x', 'y', found 'z'"])

    def test_what_neither_case_nor_study_has(self):
        self.assertEqual(self.faults(TWO_AXES + """[[metric]]
name = "evenness"
reference = "measured"
[[metric]]
name = ""
series = "fluid.csv:speed[m/s]"
shares = [-1, 2]
[removal]
pistons = ["pistn"]
piston_area = 0.5
cycle = 2.0
answer = { wanted_depth = 1e-6, pressure_at_most = -1 }
"""), [
            "window.toml: error: [removal] has a figure 'evenness' of its own: the axis or metric needs another name",
            "window.toml:21: error: 'reference' must be one of none that there are, found 'measured'",
            "window.toml:23: error: 'name' must be a text of printable characters on one line, not empty, found ''",
            "window.toml:25: error: 'shares' must be from 0 to 1, found [-1, 2]",
            "window.toml:27: error: 'pistons' must hold some of 'piston', found 'pistn'; did you mean 'piston'?",
            "window.toml:30: error: 'pressure_at_most' must be above 0, found -1"])

    def test_a_case_that_is_not_there(self):
        faults = self.faults(TWO_AXES, HEAD.replace("case.toml", "absent.toml"))
        self.assertEqual(faults, ["window.toml:3: error: 'case' must be a case file beside the study, found "
                                  "'absent.toml', which is no file"])

    def test_a_case_that_the_coupler_cannot_read(self):
        (self.bin / "coupler").write_text("#!/bin/sh\necho case.toml:1:1: error: not valid TOML >&2\nexit 2\n")
        self.assertEqual(self.faults(TWO_AXES), ["case.toml:1:1: error: not valid TOML"])
        (self.bin / "coupler").unlink()
        self.assertEqual(self.faults(TWO_AXES), [f"{self.bin}/coupler: error: cannot be started: No such file or directory"])

    def test_no_toml(self):
        self.assertEqual(self.faults("[[axis]\n"), ["window.toml:4:8: error: not valid TOML: Error while parsing table header: expected ']', saw '\\n'"])

    def test_a_key_that_the_case_does_not_know(self):
        self.assertEqual(self.faults(TWO_AXES.replace('["fluid.x"]', '["fluid.xx"]'))[0],
                         "window.toml:5: error: [[axis]] 'x': --set fluid.xx=1: error: unknown key 'xx' in [fluid]")
        self.assertEqual(self.faults(TWO_AXES, HEAD + "set = { fluid.z = 1 }\n"),
                         ["window.toml:4: error: [study] set: --set fluid.z=1: error: unknown key 'z' in [fluid]"])

    def test_series_that_no_run_writes(self):
        text = TWO_AXES + "".join(f'[[metric]]\nname = "{k}"\nseries = "{series}"\n' for k, series in enumerate((
            "fluid.csv:swing[m]", "fluid.csv:fast[1]", "fluid.csv:sped[m/s]", "fluid.csv:energy", "solid.csv:swing[m]",
            "fluid.csv:time[s]")))
        self.assertEqual(self.faults(text), [
            "window.toml:27: error: [[metric]] '2': fluid.csv will have no column 'sped[m/s]'; did you mean 'speed[m/s]'?",
            "window.toml:30: error: [[metric]] '3': fluid.csv will have no column 'energy'; did you mean 'energy[J]'?",
            "window.toml:33: error: [[metric]] '4': no run writes 'solid.csv'; did you mean 'fluid.csv'?"])
        self.assertEqual(self.starts(), [])

    def test_summaries_that_no_run_leaves(self):
        text = TWO_AXES + "".join(f'[[metric]]\nname = "{k}"\nsummary = "{path}"\n' for k, path in enumerate((
            "fluid.figures.anything", "fluid.steps", "flud.steps", "fluid", "fluid.wall_tim", "fluid.figures", "fluid.steps.all")))
        example = ("'summary' must be PARTICIPANT.KEY, such as 'fluid.figures.largest_speed', the participant one of 'fluid', "
                   "'solid', 'coupler', found")
        faults = self.faults(text)
        self.assertEqual(faults[:2], [f"window.toml:27: error: {example} 'flud.steps'; did you mean 'fluid'?",
                                      f"window.toml:30: error: {example} 'fluid'"])
        self.assertEqual([fault.partition("; there are")[0] for fault in faults[2:]], [
            "window.toml:33: error: a summary has no number 'wall_tim'; did you mean 'wall_time'?",
            "window.toml:36: error: a summary has no number 'figures'",
            "window.toml:39: error: a summary has no number 'steps.all'"])

    def test_a_chart_that_leaves_an_axis_open(self):
        faults = self.faults(TWO_AXES + '[[chart]]\nx = "x"\ny = "wall_time"\n')
        self.assertEqual(faults, ["window.toml:19: error: the chart leaves the axis 'wait' open: draw it as 'lines' or "
                                  "'panels', or choose one value, at = { wait = ... }"])

    def test_a_key_that_two_axes_set(self):
        faults = self.faults(TWO_AXES.replace('["fluid.seconds"]', '["fluid.x"]'))
        self.assertEqual(faults, ["window.toml: error: 'fluid.x' is set by the axes 'x' and 'wait': a run can have one "
                                  "value only"])

    def test_what_is_a_study_is_told_by_its_table_alone(self):
        text = TWO_AXES
        for head in ("[ study ]\n" + HEAD.split("\n", 1)[1], "\ufeff" + HEAD,
                     'study.title = "dotted"\nstudy.case = "case.toml"\n', 'study = { title = "inline", case = "case.toml" }\n'):
            self.write(text, head)
            ended = self.study("--check")
            self.assertEqual((ended.returncode, ended.stdout), (0, f"{self.case}/window.toml: no errors; 6 runs, 0 of them "
                                                                   "done\n"), ended.stderr)
        self.write('[case]\ntitle = """\n[study]\n"""\n', "")
        self.assertIn("no section [fluid] and no section [solid]", self.study("--check").stderr)

    def test_wrong_kinds_of_what_is_needed(self):
        self.assertEqual(self.faults("", "study = 1\n"), ["window.toml:1: error: 'study' must be a table, found 1"])
        self.assertEqual(self.faults("[timing]\n[terms]\nquantities = []\n[terms.discretisation]\nratio = 2\n"
                                     '[[terms.term]]\nname = "a"\n')[:2],
                         ["window.toml:6: error: 'quantities' needs at least one metric",
                          "window.toml:7: error: [discretisation] needs 'set', a table"])
        self.assertIn("window.toml:9: error: [[term]] 1 needs 'set', a table",
                      self.faults("[timing]\n[terms]\nquantities = []\n[terms.discretisation]\nratio = 2\n"
                                  '[[terms.term]]\nname = "a"\n'))
        self.assertEqual(self.faults(TWO_AXES, HEAD.replace('"case.toml"', '"window.toml"')),
                         [f"window.toml:3: error: 'case' must be a case file beside the study, found '{self.case}/window.toml', "
                          "which is a study".replace(str(self.case) + "/", "")])
        self.assertEqual(self.faults(TWO_AXES.replace("[1, 2, 4]", "[1, nan]")),
                         ["window.toml:8: error: 'values' must be finite numbers, found nan"])

    def test_units_that_no_table_or_chart_can_hold(self):
        for unit in ("nonsense[m]", "a\\nb", "m,s", " "):
            for before in ('name = "wait"', 'name = "end"'):
                with self.subTest(unit=unit, before=before):
                    head = ('[[axis]]\nname = "wait"\nvalues = [1, 2]\nkeys = ["coupling.wait"]\n[[metric]]\nname = "end"\n'
                            'series = "fluid.csv:speed[m/s]"\n')
                    fault, *_ = self.faults(head.replace(before, f'{before}\nunit = "{unit}"'))
                    self.assertRegex(fault, r"window.toml:\d+: error: 'unit' must be a text of printable characters on one "
                                     r"line without any of \[ \] , \", found ")
                    self.assertTrue(fault.isprintable())

    def test_names_that_no_table_or_chart_can_hold(self):
        for name in ("", " ", "a\\nb", "\\u001b[31m"):
            fault, *_ = self.faults(TWO_AXES.replace('"wait"', f'"{name}"'))
            self.assertRegex(fault, r"window.toml:16: error: 'name' must be a text of printable characters on one line")
            self.assertTrue(fault.isprintable())

    def test_more_runs_than_can_be_done(self):
        many = "[" + ", ".join(map(str, range(1, 1001))) + "]"
        self.assertEqual(self.faults(TWO_AXES.replace("[1, 2, 4]", many).replace("[0.0, 0.001]", many)),
                         ["window.toml: error: the axes give 1000000 runs; at most 100000 can be done"])

    def test_a_folder_with_files_of_others(self):
        self.write(TWO_AXES)
        self.out.mkdir()
        (self.out / "table.csv").write_text("mine")
        ended = self.study()
        self.assertEqual((ended.returncode, ended.stderr), (2, f"--out {self.out}: error: holds 'table.csv', which no study "
                                                               "wrote, and a study would write over it; give another folder\n"))
        self.assertEqual((self.out / "table.csv").read_text(), "mine")

    def test_options(self):
        self.write(TWO_AXES)
        self.assertEqual(self.study("--jobs", "0").stderr, "--jobs 0: error: must be an integer of at least 1\n")
        ended = self.study("--check")
        self.assertEqual((ended.returncode, ended.stdout, self.starts()),
                         (0, f"{self.case}/window.toml: no errors; 6 runs, 0 of them done\n", []))


if __name__ == "__main__":
    unittest.main()
