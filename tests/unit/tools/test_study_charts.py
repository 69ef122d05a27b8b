"""The charts of studies: labels that can be read, legends that name what is drawn and nothing else."""

import math
import unittest
from types import SimpleNamespace

from matplotlib.backends.backend_agg import FigureCanvasAgg

from toryu.study import bisection, charts, drawing, map_charts, map_results


def labels(panel, which):
    """(text, extent) of the labels that are seen along an axis."""
    axis = getattr(panel, f"{which}axis")
    low, high = sorted(axis.get_view_interval())
    seen = [tick.label1 for tick in axis.get_major_ticks() if low <= tick.get_loc() <= high]
    return [(label.get_text(), label.get_window_extent()) for label in seen if label.get_text() and label.get_visible()]


class Labels(unittest.TestCase):
    def assert_apart(self, made, which, least=2):
        """The labels of each panel, at least so many, stand apart. Returns those of the first."""
        FigureCanvasAgg(made).draw()
        for panel in made.axes:
            found = labels(panel, which)
            self.assertGreaterEqual(len(found), least, [text for text, _ in found])
            for (text, extent), (other, beside) in zip(found, found[1:]):
                self.assertFalse(extent.overlaps(beside), f"{text} and {other}")
        return [text for text, _ in labels(made.axes[0], which)]

    def test_of_a_logarithmic_axis_of_any_length(self):
        for columns in (1, 4):
            for low, high in ((1, 20), (0.3, 0.5), (3.1, 4.9), (1e-7, 1e-2), (1, 1e12), (1e-30, 1e30)):
                with self.subTest(columns=columns, low=low, high=high):
                    made, panels = drawing.figure(columns)
                    for panel in panels:
                        for which in "xy":
                            drawing.logarithmic(panel, which)
                        panel.set(xlim=(low, high), ylim=(low, high))
                    self.assert_apart(made, "x")
                    self.assert_apart(made, "y", least=0)  # the first panel's alone are shown

    def test_of_a_logarithmic_axis_are_plain_where_there_is_room(self):
        made, (panel,) = drawing.figure()
        drawing.logarithmic(panel, "x")
        panel.set_xlim(0.8, 60)
        self.assertEqual(self.assert_apart(made, "x"), ["1", "2", "5", "10", "20", "50"])

    def test_of_values(self):
        values = [0.004, 0.005, 0.006666666666666667, 0.0067, 0.01]
        for columns in (1, 4):
            made, panels = drawing.figure(columns)
            for panel in panels:
                drawing.logarithmic(panel, "x")
                panel.set_xlim(values[0], values[-1])
                drawing.ticks(panel, values, [f"{value:g}" for value in values])
            self.assert_apart(made, "x")

    def test_of_choices(self):
        names = ["serial explicit, 10 MPa", "serial explicit, 0.1 MPa", "alongwordthatcannotbebroken", "b", "none at all"]
        for columns in (1, 2, 3):
            made, panels = drawing.figure(columns)
            for panel in panels:
                panel.set_xlim(-0.5, len(names) - 0.5)
                drawing.choices(panel, names)
            shown = self.assert_apart(made, "x", len(names))
            self.assertEqual("".join(shown).replace("\n", "").replace(" ", ""), "".join(names).replace(" ", ""))


class Legends(unittest.TestCase):
    Y = SimpleNamespace(stable=10000.0, unstable=1.0, log=True, axis=SimpleNamespace(name="density", unit="kg/m3"))
    STUDY = SimpleNamespace(map=SimpleNamespace(y=Y, log=["x"], x_name="x"))

    def drawn(self, *parts):
        """What the legend of a panel names."""
        _, (panel,) = drawing.figure()
        for part in parts:
            part(panel)
        return panel.get_legend_handles_labels()[1]

    def edge(self, *brackets):
        columns = [map_results.Column(x, None, [], *bracket, []) for x, bracket in enumerate(brackets, 1)]
        return lambda panel: map_charts.draw_edge(panel, self.STUDY, columns, "black", "edge")

    def theory(self, formula, xs=(1.0, 2.0)):
        class Theory:
            label = "theory"
            __call__ = staticmethod(formula)

        every = [SimpleNamespace(x=x) for x in xs]
        return lambda panel: map_charts.draw_theories(panel, self.STUDY, every, "black", [Theory()])

    def test_of_a_map_name_what_lies_in_the_picture(self):
        self.assertEqual(self.drawn(self.edge((100.0, 80.0), (50.0, 40.0)), self.theory(lambda x: 30 * x)), ["theory", "edge"])
        self.assertEqual(self.drawn(self.edge((None, None)), self.theory(lambda x: 1e-3 * x)), [])
        self.assertEqual(self.drawn(self.theory(lambda x: math.nan)), [])
        self.assertEqual(self.drawn(self.theory(lambda x: 1e5 / x)), [])
        self.assertEqual(self.drawn(self.theory(lambda x: 1e5 / x**4)), ["theory"])  # a part of it

    def test_of_a_small_map_of_one_column_have_marks_for_what_a_line_cannot_show(self):
        _, (panel,) = drawing.figure()
        self.edge((100.0, 80.0))(panel)
        self.theory(lambda x: 30 * x, xs=(1.0,))(panel)
        self.assertEqual(panel.get_legend_handles_labels()[1], ["theory", "edge"])
        self.assertNotIn("None", [line.get_marker() for line in panel.lines if not line.get_label().startswith("_")])
        self.assertAlmostEqual(panel.containers[0].lines[0].get_ydata()[0], bisection.middle(self.Y, 100.0, 80.0))

    def test_of_lines_say_where_no_run_has_the_figure(self):
        chart = SimpleNamespace(log=["y"])
        self.assertEqual(charts.named("a", [(1, math.nan), (2, 0.5)], chart), "a")
        for points in ([(1, math.nan)], [(1, -2.0), (2, 0.0)], []):
            self.assertEqual(charts.named("a", points, chart), "a (none)")
        self.assertEqual(charts.named("a", [(1, -2.0)], SimpleNamespace(log=[])), "a")


if __name__ == "__main__":
    unittest.main()
