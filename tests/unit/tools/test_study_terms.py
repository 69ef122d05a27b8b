"""Studies of terms: what each alteration of a case changes, against its discretisation error, and what it saves."""

import unittest

from toryu_testing.study_case import Study

TERMS = """
[timing]
repeat = 1
[[metric]]
name = "end"
series = "fluid.csv:speed[m/s]"
[[metric]]
name = "curve"
series = "fluid.csv:speed[m/s]"
take = "distance"
against = { alteration = "as shipped" }
[terms]
quantities = ["end", "curve"]
[terms.discretisation]
name = "double spacing"
set = { fluid.x = 1.4 }
ratio = 2.0
[[terms.term]]
name = "no drag"
set = { fluid.x = 1.1, fluid.cost = 0.2 }
[[terms.term]]
name = "no gravity"
set = { fluid.x = 2, fluid.cost = 0.2 }
[[terms.term]]
name = "no diffusion"
set = { fluid.x = 1.2 }
[[terms.term]]
name = "no neighbour list"
set = { fluid.cost = 0.5 }
[[terms.term]]
name = "no walls"
set = { fluid.fails = 3 }
[[terms.term]]
name = "shifting"
set = { fluid.y = 2.5 }
adds = true
[[terms.term]]
name = "lift"
set = { fluid.y = 2.01 }
adds = true
"""


class Terms(Study):
    def test_verdicts(self):
        self.write(TERMS)
        ended = self.done()
        rows = {row["alteration"]: row for row in self.table("terms.csv")}
        self.assertEqual({name: row["verdict"] for name, row in rows.items()}, {
            "no drag": "below discretisation error: can be left out", "no gravity": "needed",
            "no diffusion": "costs nothing", "no neighbour list": "saves time", "no walls": "needed: without it the run fails",
            "shifting": "changes the result", "lift": "adds nothing beyond the discretisation error"})
        # the shipped run ends at 7 m/s, that at the double spacing at 7.4; so of first order its error is 0.4
        row = rows["no gravity"]
        self.assertEqual([row[name] for name in ("change_end[m/s]", "discretisation_error_end[m/s]", "end_in_errors")],
                         ["1", "0.4", "2.5"])
        self.assertEqual((row["curve_in_errors"], row["time_saved"]), ("2.5", "0.2"))
        self.assertIn("Can be left out: no drag (20 % of the time).\nNeeded: no gravity, no walls.\n", ended.stdout)
        table = (self.out / "table.md").read_text().splitlines()
        self.assertEqual(table[2], "| no drag | +100 mm/s | 0.25 | +0.0143 | 0.25 | 20 | below discretisation error: can "
                                   "be left out |")
        self.assertEqual(table[-1], "| discretisation error | 400 mm/s | 1 | 0.0571 | 1 |  |  |")
        self.assertTrue((self.out / "charts/terms.png").is_file())

    def test_faults(self):
        self.write(TERMS.replace("[timing]\nrepeat = 1\n", "").replace('quantities = ["end"', 'quantities = ["ende"')
                   .replace("ratio = 2.0", "ratio = 1").replace('name = "lift"', 'name = "shifting"'))
        self.assertEqual([line.split(": error: ")[1] for line in self.study().stderr.splitlines()], [
            "[terms] has the name 'shifting' twice", "a study of terms needs [timing]: it says what each costs",
            "'quantities' must hold some of 'end', 'curve', found 'ende'; did you mean 'end'?",
            "'ratio' is that run's spacing over the shipped one: above 0 and not 1, found 1"])


if __name__ == "__main__":
    unittest.main()
