"""Contours of work pieces whose surfaces are known."""

import unittest

import numpy as np

from toryu import surface
from toryu_testing import made_up_surface


class Column:
    """As of an HDF file: values with attributes."""

    def __init__(self, values, **attributes):
        self.values, self.attrs = np.asarray(values), attributes

    def __getitem__(self, key):
        return self.values[key]


def file_of(points, normals, owner=None, area=None, names="piece"):
    """A surface whose points stand in an order that says nothing."""
    shuffled = np.random.default_rng(1).permutation(len(points))
    owner = np.zeros(len(points), int) if owner is None else np.asarray(owner)
    area = np.ones(len(points)) if area is None else np.asarray(area)
    return {"start_position": Column(np.asarray(points, float)[shuffled]), "area": Column(area[shuffled]),
            "normal": Column(np.asarray(normals, float)[shuffled]), "work_piece": Column(owner[shuffled], names=names)}


class Contours(unittest.TestCase):
    def test_a_work_piece_on_a_wall_runs_from_foot_to_foot(self):
        for side in ("left", "right"):
            with self.subTest(side):
                points, normals, area = made_up_surface.standing(side, columns=4, rows=24, spacing=1e-3)
                contour, = surface.contours(file_of(points, normals, area=area))
                self.assertFalse(contour.closed)
                self.assertEqual(len(contour.rows), 4 + 22 + 4)
                self.assertAlmostEqual(contour.arc_length[-1], (3 + 23 + 3) * 1e-3)
                np.testing.assert_allclose(np.diff(contour.arc_length), 1e-3)
                self.assertLess(contour.position[0, 1], contour.position[-1, 1])
                corners = contour.position[contour.corners]
                self.assertEqual(len(corners), 2)
                np.testing.assert_allclose(np.abs(corners[:, 1]), 11.5e-3, atol=1.1e-3)

    def test_a_disc_is_closed_and_runs_anticlockwise_from_its_lowest_point(self):
        angle = np.linspace(0, 2 * np.pi, 60, endpoint=False) - np.pi / 2
        normal = np.column_stack([np.cos(angle), np.sin(angle)])
        contour, = surface.contours(file_of([0.2, 0.1] + 0.01 * normal, normal))
        self.assertTrue(contour.closed)
        np.testing.assert_allclose(contour.position, [0.2, 0.1] + 0.01 * normal)
        np.testing.assert_allclose(contour.arc_length[-1], 59 * 0.02 * np.sin(np.pi / 60))
        self.assertEqual(contour.corners, [])

    def test_a_plate_of_two_rows_does_not_jump_to_its_other_side(self):
        x = np.arange(20.0)
        points = np.concatenate([np.column_stack([x, 0 * x]), np.column_stack([x, 0 * x + 1])])
        normals = np.repeat([[0.0, -1.0], [0.0, 1.0]], 20, axis=0)
        normals[[0, 19, 20, 39]] += [[-1, 0], [1, 0], [-1, 0], [1, 0]]
        normals /= np.linalg.norm(normals, axis=1)[:, None]
        contour, = surface.contours(file_of(points, normals))
        self.assertTrue(contour.closed)
        np.testing.assert_array_equal(contour.position[:20], points[:20])
        np.testing.assert_array_equal(contour.position[20:], points[39:19:-1])

    def test_an_inner_corner_whose_particle_has_no_face_is_passed(self):
        # A step: along the lower floor, up the riser, along the upper floor; the corner itself is inside.
        lower = [(x, 0.0) for x in range(8)]
        riser = [(8.0, y) for y in (1.0, 2.0, 3.0)]
        upper = [(x, 4.0) for x in range(8, 14)]
        normals = [(0, 1)] * 8 + [(-1, 0)] * 3 + [(-0.5 ** 0.5, 0.5 ** 0.5)] + [(0, 1)] * 5
        points = lower + riser + upper
        contour, = surface.contours(file_of(points + [(8.0, 0.0)], normals + [(0, 1)], area=[1.0] * 17 + [0.0]))
        np.testing.assert_array_equal(contour.position, points)
        self.assertAlmostEqual(contour.arc_length[8], 7 + 2 ** 0.5)

    def test_each_work_piece_and_each_separate_part_has_a_contour_of_its_own(self):
        left, normal_left, _ = made_up_surface.standing("left")
        right, normal_right, _ = made_up_surface.standing("right")
        points, normals = np.concatenate([left, right]), np.concatenate([normal_left, normal_right])
        owner = np.repeat([0, 1], [len(left), len(right)])
        two = surface.contours(file_of(points, normals, owner, names="west;east"))
        self.assertEqual([(c.work_piece, c.label, len(c.rows)) for c in two],
                         [("west", "west", len(left)), ("east", "east", len(right))])
        one = surface.contours(file_of(points, normals, names="interface"))
        self.assertEqual(sorted(c.label for c in one), ["interface 1", "interface 2"])
        by_label = {c.label: c for c in one}
        self.assertLess(by_label["interface 1"].position[:, 0].max(), by_label["interface 2"].position[:, 0].min())

    def test_rows_lead_back_to_the_file(self):
        points, normals, area = made_up_surface.standing("left")
        file = file_of(points, normals, area=area)
        contour, = surface.contours(file)
        np.testing.assert_array_equal(file["start_position"][:][contour.rows], contour.position)
        np.testing.assert_array_equal(file["area"][:][contour.rows], contour.area)
        self.assertEqual(len(set(contour.rows)), len(points))


class Alone(unittest.TestCase):
    def test_the_spacing_of_a_point_alone_is_its_face(self):
        self.assertEqual(surface.typical_spacing(np.zeros((1, 2)), np.array([0.25])), 0.25)
        self.assertEqual(surface.typical_spacing(np.zeros((2, 2)), np.array([0.25, 0.25])), 0.25)


if __name__ == "__main__":
    unittest.main()
