"""The radius of an edge at which two receding faces meet, of shapes that are known."""

import unittest

import numpy as np
from toryu.study.recession_edges import edges, radius
from toryu.study.recession_surface import Face, Surface

SPACING, COUNT = 1e-4, 60
S = (np.arange(COUNT) + 0.5) * SPACING  # distance of the points from the edge


def corner():
    """A left and an upper face that meet at (0, 0); the point at the edge is of both."""
    left, upper = np.column_stack([np.full(COUNT, SPACING / 2), -S]), np.column_stack([S, np.full(COUNT, -SPACING / 2)])
    rows = np.concatenate([[0], COUNT + np.arange(COUNT - 1)])
    length = np.full(COUNT, SPACING)
    faces = [Face("block", "left", rows[::-1], left[::-1, 1], length), Face("block", "upper", np.arange(COUNT), S, length)]
    return Surface(faces, np.concatenate([left[::-1], upper]),
                   np.repeat([[-1.0, 0.0], [0.0, 1.0]], COUNT, axis=0))


def rounded(arc, recess=0.0):
    """Depth along a face that has receded by `recess`, and meets the other one in an arc. Beyond the other one, where
    nothing is left, it says nothing."""
    x = S - recess
    inside = np.sqrt(np.maximum(arc**2 - (arc - x)**2, 0))
    return recess + np.where(x < 0, arc / 2, np.where(x < arc, arc - inside, 0))


def found(depth_left, depth_upper):
    surface = corner()
    (edge,) = edges(surface)
    return radius(surface, np.concatenate([depth_left[::-1], depth_upper]), edge)


class Radius(unittest.TestCase):
    def test_the_edge_is_where_the_faces_meet(self):
        (edge,) = edges(corner())
        self.assertEqual(edge.name, "block, left upper edge")
        np.testing.assert_allclose(edge.corner, [0, 0], atol=1e-18)

    def test_of_an_arc_it_is_exact_wherever_the_faces_have_gone(self):
        for arc in (2, 3.3, 8, 11):
            for recess in (0, 0.5, 3):
                depth = rounded(arc * SPACING, recess * SPACING)
                self.assertAlmostEqual(found(depth, depth) / SPACING, arc, delta=1e-3 * arc, msg=f"{arc} {recess}")

    def test_of_faces_that_recede_unlike(self):
        arc, left, upper = 6 * SPACING, 2 * SPACING, 0.7 * SPACING
        depth_upper = rounded(arc, left) - left + upper  # its arc begins where the left face is now
        depth_left = rounded(arc, upper) - upper + left
        self.assertAlmostEqual(found(depth_left, depth_upper) / arc, 1, delta=1e-3)

    def test_a_sharp_edge_has_none(self):
        for recess in (0.0, 0.5, 3.0):
            depth = np.full(COUNT, recess * SPACING)
            self.assertEqual(found(depth, depth), 0)

    def test_the_depth_that_scatters_by_a_fiftieth_of_a_spacing_costs_a_tenth(self):
        scatter = 0.02 * SPACING * np.sin(7 * np.arange(COUNT))
        for arc in (4, 8, 12):
            depth = rounded(arc * SPACING) + scatter
            self.assertAlmostEqual(found(depth, depth) / SPACING / arc, 1, delta=0.1)


class AlongTheNormal(unittest.TestCase):
    def test_a_slope_recedes_faster_and_its_deepest_point_does_not(self):
        surface = corner()
        slope = np.concatenate([np.zeros(COUNT), 0.75 * S[::-1]])  # of the upper face, deepest at the edge
        rate = surface.along_normal(np.full(2 * COUNT, 2.0), slope)
        np.testing.assert_allclose(rate[:COUNT], 2)
        np.testing.assert_allclose(rate[COUNT + 1:], 2.5)
        self.assertEqual(rate[COUNT], 2)

    def test_the_side_of_a_pit_goes_along_at_the_same_rate(self):
        surface, rate, dt = corner(), np.ones(2 * COUNT), SPACING / 100
        depth = np.concatenate([np.zeros(COUNT), np.where(S < 10 * SPACING, 40 * SPACING, 0.0)])
        for _ in range(1000):  # 10 spacings in all
            depth = depth + dt * surface.along_normal(rate, depth)
        side = S[np.flatnonzero(depth[COUNT:] > 25 * SPACING)[-1]] / SPACING
        self.assertAlmostEqual(side, 20, delta=2)  # the scheme is of first order


if __name__ == "__main__":
    unittest.main()
