"""Extremes on the centre lines of a cavity: of fields that a fit of the second order gives exactly."""

import unittest

import numpy as np

import extremes


class Extremes(unittest.TestCase):
    def test_those_of_parabolas_are_exact(self):
        s = (np.arange(20) + 0.5) / 20
        x = np.array([(a, b) for a in s for b in s]) + 0.01 * np.random.default_rng(1).uniform(-1, 1, (400, 2))
        u = (x[:, 1] - 0.403) ** 2 - 0.3 + 0.1 * (x[:, 0] - 0.5)
        v = np.where(x[:, 0] < 0.5, 0.2 - (x[:, 0] - 0.257) ** 2, (x[:, 0] - 0.811) ** 2 - 0.4)
        swinging = [(x, np.column_stack([u + k, v - k])) for k in (-0.1, 0.1)]  # of which the mean counts
        self.assertTrue(np.allclose(extremes.of_frames(swinging, 0.05), (-0.3, 0.2, -0.4), atol=1e-9))

    def test_one_at_the_end_of_a_line_is_taken_as_it_is(self):
        self.assertEqual(extremes.extreme(np.array([3.0, 2.0, 1.0]), True), 1.0)
        self.assertEqual(extremes.extreme(np.array([1.0, 2.0, 1.0]), False), 2.0)


if __name__ == "__main__":
    unittest.main()
