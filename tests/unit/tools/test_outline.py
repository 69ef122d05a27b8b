"""Outlines of drawings, against lengths and areas worked by hand."""

import argparse
import importlib.util
import math
import pathlib
import tempfile
import unittest

from toryu import outline

PAGE = '<svg xmlns="http://www.w3.org/2000/svg" {page}>{content}</svg>'
MILLIMETRES = 'width="40mm" height="30mm" viewBox="0 0 40 30"'


def area(ring):
    return sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(ring, [*ring[1:], ring[0]])) / 2


class Drawing(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def rings(self, path, **options):
        given = {"id": None, "layer": None, "unit": None, "tolerance": 0.0} | options
        return outline.rings_of(path, argparse.Namespace(**given))

    def fault(self, path, **options):
        with self.assertRaises(outline.BadDrawing) as caught:
            self.rings(path, **options)
        return caught.exception.key, str(caught.exception)


@unittest.skipUnless(importlib.util.find_spec("svgelements"), "tools/install.sh import")
class Svg(Drawing):
    def file(self, content, page=MILLIMETRES):
        path = self.folder / "part.svg"
        path.write_text(PAGE.format(page=page, content=content))
        return path

    def test_corners_are_in_metres_from_the_lower_edge_of_the_page(self):
        ring, = self.rings(self.file('<path id="a" d="M 10 20 h 20 v -10 z"/>'))
        self.assertEqual([[round(x, 12) for x in corner] for corner in ring], [[0.01, 0.01], [0.03, 0.01], [0.03, 0.02]])

    def test_a_unit_of_the_page_may_be_a_part_of_a_millimetre(self):
        ring, = self.rings(self.file('<rect width="100" height="50"/>', 'width="4cm" height="3cm" viewBox="0 0 400 300"'))
        self.assertAlmostEqual(abs(area(ring)), 0.01 * 0.005, delta=1e-15)

    def test_groups_hold_the_outlines_of_all_their_elements_as_they_are_transformed(self):
        path = self.file('<g id="all" transform="translate(5,0) scale(2)"><rect width="4" height="4"/>'
                         '<rect id="in" x="1" y="1" width="1" height="1"/></g><rect x="30" width="2" height="2"/>')
        self.assertEqual([round(abs(area(ring)) * 1e6, 9) for ring in self.rings(path, id="all")], [64, 4])
        ring, = self.rings(path, id="in")
        self.assertAlmostEqual(min(x for x, y in ring), 0.007, delta=1e-12)
        self.assertEqual(len(self.rings(path)), 3)

    def test_arcs_and_splines_keep_the_tolerance(self):
        path = self.file('<circle cx="20" cy="15" r="10"/>')
        counts = []
        for tolerance in (1e-4, 1e-5, 1e-6):
            ring, = self.rings(path, tolerance=tolerance)
            sides = zip(ring, [*ring[1:], ring[0]])
            middles = [math.hypot((a[0] + b[0]) / 2 - 0.02, (a[1] + b[1]) / 2 - 0.015) for a, b in sides]
            self.assertGreater(min(middles), 0.01 - tolerance)
            self.assertLessEqual(max(math.hypot(x - 0.02, y - 0.015) for x, y in ring), 0.01 + 1e-12)
            counts.append(len(ring))
        self.assertEqual(counts, [32, 128, 256])
        # the area under a cubic y = 3 t (1 - t) from x = 0 to 1 in units of 10 mm: 1/2
        ring, = self.rings(self.file('<path d="M 0 10 C 3.3333333333333333 0 6.6666666666666667 0 10 10 Z"/>'),
                           tolerance=1e-7)
        self.assertAlmostEqual(abs(area(ring)) / 1e-4, 0.5, delta=1e-4)

    def test_units_are_asked_for(self):
        for page in ('viewBox="0 0 40 30"', 'width="40" height="30" viewBox="0 0 40 30"', 'width="40mm" height="30mm"'):
            path = self.file('<rect width="2" height="2"/>', page)
            key, words = self.fault(path)
            self.assertEqual(key, "file")
            self.assertIn("does not say its unit", words)
            ring, = self.rings(path, unit="mm")
            self.assertAlmostEqual(abs(area(ring)), 4e-6, delta=1e-15)
        self.assertEqual(self.fault(self.file('<rect width="2" height="2"/>'), unit="cm"),
                         ("unit", 'the file says width="40mm", so its unit is 0.001 m: leave \'unit\' out'))

    def test_what_is_wrong_is_told_with_its_place(self):
        path = self.file('<path id="open" d="M 10 20 L 20 20 L 20 10"/>')
        self.assertEqual(self.fault(path), ("file", "the outline of 'open' is open: it begins at (0.01, 0.01) m and ends at "
                                                    "(0.02, 0.02) m"))
        self.assertEqual(self.fault(path, id="oben"), ("id", "no element 'oben' in the file; did you mean 'open'?"))
        self.assertEqual(self.fault(self.file("<text>a</text>")), ("file", "the file holds no outline"))
        broken = self.folder / "broken.svg"
        broken.write_text("<svg")
        self.assertTrue(self.fault(broken)[1].startswith("cannot be read as SVG: "))


@unittest.skipUnless(importlib.util.find_spec("ezdxf"), "tools/install.sh import")
class Dxf(Drawing):
    def file(self, draw, unit=4):
        import ezdxf
        drawing = ezdxf.new()
        drawing.header["$INSUNITS"] = unit
        draw(drawing.modelspace())
        path = self.folder / "part.dxf"
        drawing.saveas(path)
        return path

    @staticmethod
    def rounded(space):
        """A rectangle of 20 mm by 10 mm with one corner rounded by 5 mm, its lines in any order and either way round."""
        on = {"dxfattribs": {"layer": "part"}}
        space.add_line((0, 0), (20, 0), **on)
        space.add_line((0, 10), (15, 10), **on)
        space.add_line((20, 5), (20, 0), **on)
        space.add_arc((15, 5), 5, 0, 90, **on)
        space.add_line((0, 0), (0, 10), **on)
        space.add_circle((40, 0), 2, dxfattribs={"layer": "pin"})

    def test_lines_and_arcs_are_joined_in_any_order(self):
        ring, = self.rings(self.file(self.rounded), layer="part", tolerance=1e-8)
        self.assertAlmostEqual(abs(area(ring)) * 1e6, 200 - 25 * (1 - math.pi / 4), delta=1e-3)
        self.assertEqual(len(self.rings(self.file(self.rounded))), 2)

    def test_polylines_have_bulges_and_splines_are_closed(self):
        def draw(space):
            space.add_lwpolyline([(0, 0, 0), (10, 0, 1), (10, 10, 0), (0, 10, 0)], format="xyb", close=True)
            space.add_spline([(50, 0), (60, 0), (60, 10), (50, 10), (50, 0)])
        d_shape, _ = sorted(self.rings(self.file(draw), tolerance=1e-8), key=lambda ring: ring[0][0])
        self.assertAlmostEqual(abs(area(d_shape)) * 1e6, 100 + 12.5 * math.pi, delta=1e-3)

    def test_units_are_those_of_the_header_or_asked_for(self):
        ring, = self.rings(self.file(self.rounded, unit=6), layer="pin", tolerance=1e-4)
        self.assertAlmostEqual(abs(area(ring)), 4 * math.pi, delta=1e-3)
        path = self.file(self.rounded, unit=0)
        self.assertEqual(self.fault(path)[0], "file")
        self.assertIn("$INSUNITS = 0", self.fault(path)[1])
        self.assertEqual(len(self.rings(path, unit="in")), 2)

    def test_what_is_wrong_is_told_with_its_place(self):
        def open_one(space):
            space.add_line((0, 0), (10, 0))
            space.add_line((10, 0), (10, 10))

        def forked(space):
            for end in ((10, 0), (0, 10), (10, 10)):
                space.add_line((0, 0), end)
        self.assertEqual(self.fault(self.file(open_one)), ("file", "the outline is open at (0.01, 0.01) m"))
        self.assertEqual(self.fault(self.file(forked))[1], "the outline is open at (0.01, 0) m")
        self.assertEqual(self.fault(self.file(self.rounded), layer="prt"),
                         ("layer", "no layer 'prt' with lines in the file; did you mean 'part'?"))
        broken = self.folder / "broken.dxf"
        broken.write_text("hello")
        self.assertTrue(self.fault(broken)[1].startswith("cannot be read as DXF: "))

    def test_two_thousand_lines_take_a_moment(self):
        def wheel(space):
            corners = [(math.cos(k * math.pi / 1000) * 50, math.sin(k * math.pi / 1000) * 50) for k in range(2000)]
            for a, b in zip(corners, [*corners[1:], corners[0]]):
                space.add_line(a, b)
        ring, = self.rings(self.file(wheel))
        self.assertEqual(len(ring), 2000)


if __name__ == "__main__":
    unittest.main()
