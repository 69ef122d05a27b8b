"""The faces of work pieces that recede: their points, images and edges, and the pressure of the medium along them."""

import unittest
from types import SimpleNamespace

import numpy as np
from toryu.study.recession import Recession
from toryu.study.recession_surface import NoRate, Pressure, rates, same_points, wetted


class Column:
    """Of a made-up surface.h5."""

    def __init__(self, values, **attributes):
        self.values, self.attrs = np.asarray(values, float), attributes

    def __getitem__(self, key):
        return self.values[key]

    def __len__(self):
        return len(self.values)


def block(shift=0.0, touched=True, seconds=10):
    """A work piece of 4 x 2 cells of 1 m that stands on a wall: points left, right, on top and at both edges. A metre comes
    off in each second, of the edges two; the first five seconds it is half of that."""
    r = np.sqrt(0.5)
    points = [(0.5, 0.5, -1, 0), (0.5, 1.5, -r, r), (1.5, 1.5, 0, 1), (2.5, 1.5, 0, 1), (3.5, 1.5, r, r), (3.5, 0.5, 1, 0)]
    x, y, n_x, n_y = np.array(points).T
    rate = np.where(np.abs(n_x * n_y) > 0.1, 2.0, 1.0)
    time = np.arange(seconds + 1.0)
    return {"start_position": Column(np.column_stack([x + shift, y])), "normal": Column(np.column_stack([n_x, n_y])),
            "area": Column(np.where(rate > 1, 1 / r, 1.0)), "work_piece": Column(np.zeros(6), names="block"),
            "time": Column(time),
            "preston_depth": Column(np.outer(time - np.minimum(time, 5) / 2, rate)),
            "contact_pressure": Column(np.full((len(time), 6), 1e6 * touched)),
            "sliding_speed": Column(np.full((len(time), 6), 1e-3))}


class OfABlock(unittest.TestCase):
    def test_its_faces_have_their_points_in_order_and_share_its_edges(self):
        found = wetted(block())
        self.assertEqual([(face.side, face.rows.tolist()) for face in found.faces],
                         [("left", [0, 1]), ("right", [5, 4]), ("upper", [1, 2, 3, 4])])
        np.testing.assert_allclose(found.length, 1)
        with self.assertRaisesRegex(NoRate, "touches no work piece"):
            wetted(block(touched=False))

    def test_the_case_takes_its_shape(self):
        found = wetted(block())
        worn = found.worn(np.arange(8.0), ["floor", "block"])
        self.assertEqual(worn["wall.1.worn"][2], {"face": "upper", "depth": [[0.5, 4.0], [1.5, 5.0], [2.5, 6.0], [3.5, 7.0]]})

    def test_its_outline_recedes_from_half_a_cell_before_its_points(self):
        outline = wetted(block()).outline(np.full(8, 0.2))
        np.testing.assert_allclose(outline[[0, 2, 5]], [[0.2, 0.5], [3.8, 0.5], [1.5, 1.8]])

    def test_an_edge_holds_a_jump(self):
        found = wetted(block())
        view = Recession(None, time=100, gap=1000, jump=0.1, edge_jump=0.25)
        allowed = view.march(SimpleNamespace(surface=found, missing=None)).allowed(np.zeros(8))
        np.testing.assert_allclose(allowed, [50, 0.25, 50, 0.25, 0.25, 50, 50, 0.25])

    def test_about_an_axis_rings_come_off(self):
        """Of the block of 4 x 2 cells, a disc of radius 2 m with its flat sides: 0.2 m off all around."""
        file = block() | {"circumference": Column(np.full(6, 1.0))}
        found = wetted(file)
        left, right, outside = found.parts(found.removed(np.full(8, 0.2)))
        np.testing.assert_allclose(outside, np.pi * (2**2 - 1.8**2))
        np.testing.assert_allclose([left.sum(), right.sum()], np.pi * 2**2 * 0.2)
        rings = [np.pi, 3 * np.pi] * 2 + [4 * np.pi] * 4  # flat, and outside
        self.assertAlmostEqual(found.mean(np.arange(8.0)), np.average(np.arange(8.0), weights=rings))
        diameters, _ = found.diameters(np.full(8, 0.2), np.full(8, True))
        np.testing.assert_allclose(diameters, 3.6)
        bore = wetted(file | {"normal": Column(file["normal"].values * [1, -1])})  # open towards the axis
        np.testing.assert_allclose(bore.parts(bore.removed(np.full(8, 0.2)))[2], np.pi * (1.2**2 - 1))

    def test_the_image_of_a_face_is_the_opposite_one(self):
        found = wetted(block())
        np.testing.assert_allclose(found.mirrored(np.arange(8.0), 0), [2, 3, 0, 1, 7, 6, 5, 4])
        with self.assertRaisesRegex(NoRate, "not symmetric about y"):
            found.mirrored(np.arange(8.0), 1)

    def test_the_rate_is_that_of_the_window_and_its_halves_tell_of_change(self):
        found = wetted(block())
        rate, change = rates(found, block(), (0.5, 1.0))
        np.testing.assert_allclose(rate, [1, 2, 1, 2, 2, 1, 1, 2])
        self.assertAlmostEqual(change, 0)
        rate, change = rates(found, block(), (0.0, 1.0))
        np.testing.assert_allclose(rate, 0.75 * np.array([1, 2, 1, 2, 2, 1, 1, 2]))
        self.assertAlmostEqual(change, 0.5 / 0.75)
        with self.assertRaisesRegex(NoRate, "fewer than three rows"):
            rates(found, block(), (0.99, 1.0))

    def test_other_points_are_no_rate(self):
        found, other = wetted(block()), block()
        other["area"].values[2] = 0
        with self.assertRaisesRegex(NoRate, "the upper face of 'block' has 3 points, and had 4"):
            same_points(found, other)


class OfTheMedium(unittest.TestCase):
    def test_what_is_missing_wears_with_the_speed_that_is_found(self):
        found, file = wetted(block()), block()
        file["sliding_pressure"] = Column(file["preston_depth"][:] / 2e-9)
        more = Pressure([[0.0, 3e6], [4.0, 3e6]], 0, 2.0)  # 2 MPa more
        rate, _ = rates(found, file, (0.5, 1.0), more)
        np.testing.assert_allclose(rate, np.array([1, 2, 1, 2, 2, 1, 1, 2]) + 2e-9 * 2e6 * 1e-3)
        file["shear_depth"] = file.pop("preston_depth")
        with self.assertRaisesRegex(NoRate, "shear_depth is none"):
            rates(found, file, (0.5, 1.0), more)

    def test_a_constant_and_a_gradient_are_made_good_and_a_bend_stays(self):
        x = np.linspace(0.05, 9.95, 100)
        place = np.column_stack([x, np.zeros(100)])
        pressure = Pressure([[0.0, 5e6], [10.0, 1e6]], 0, 0.5)
        true = 5e6 - 4e5 * x + 1e5 * np.sin(np.pi * x / 10) ** 3
        missing = pressure.missing(place, true - 7e6 + 3e5 * x)
        np.testing.assert_allclose(true - 7e6 + 3e5 * x + missing, true, atol=2e3)

    def test_it_needs_points_where_the_pressure_is_known(self):
        with self.assertRaisesRegex(NoRate, "a row at 90 m"):
            Pressure([[90.0, 1.0]], 0, 0.5).missing(np.zeros((5, 2)), np.zeros(5))


if __name__ == "__main__":
    unittest.main()
