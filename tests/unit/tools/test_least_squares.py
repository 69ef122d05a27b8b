"""Weighted least squares against problems with known answers."""

import math
import unittest

import numpy as np

from toryu.study import least_squares

# NIST StRD, Misra1a (Misra 1978): y = b1 (1 - exp(-b2 x))
X = np.array([77.6, 114.9, 141.1, 190.8, 239.9, 289.0, 332.8, 378.4, 434.8, 477.3, 536.8, 593.1, 689.1, 760.0])
Y = np.array([10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02, 44.82, 50.76, 55.05, 61.01, 66.40, 75.47, 81.78])


def fitted(residuals, start, lower, upper, steps):
    """The Fit, and how many points were asked for."""
    search = least_squares.search(*(np.array(values, float) for values in (start, lower, upper, steps)))
    points, asked = next(search), 0
    try:
        while True:
            asked += len(points)
            points = search.send([residuals(point) for point in points])
    except StopIteration as end:
        return end.value, asked


class LeastSquares(unittest.TestCase):
    def test_a_line_has_the_covariance_of_the_book(self):
        x, y, scatter = np.array([0.0, 1, 2, 4]), np.array([1.1, 2.9, 5.2, 8.8]), np.array([0.1, 0.2, 0.1, 0.4])
        fit, _ = fitted(lambda p: (p[0] + p[1] * x - y) / scatter, [3, 3], [-10, -10], [10, 10], [0.1, 0.1])
        weights = scatter**-2
        s, sx, sxx = weights.sum(), weights @ x, weights @ x**2
        determinant = s * sxx - sx**2
        exact = np.array([[sxx, -sx], [-sx, s]]) / determinant
        np.testing.assert_allclose(fit.covariance(), exact, rtol=1e-9)
        best = exact @ [weights @ y, weights @ (x * y)]
        errors = np.sqrt(np.diag(exact))
        self.assertLess(np.max(np.abs(fit.point - best) / errors), least_squares.ENOUGH)
        self.assertTrue(fit.converged)
        self.assertEqual(fit.freedom, 2)
        self.assertEqual(fit.untold(), [])

    def test_a_certified_curve(self):
        scatter = math.sqrt(1.2455138894e-01 / 12)
        for start in ([500, 1e-4], [250, 5e-4]):
            # by their logarithms, and so are the errors relative ones
            fit, _ = fitted(lambda p: (math.exp(p[0]) * -np.expm1(-math.exp(p[1]) * X) - Y) / scatter, np.log(start),
                            np.log([1, 1e-7]), np.log([1e5, 1e-1]), [1e-3, 1e-3])
            certified, errors = np.array([2.3894212918e2, 5.5015643181e-4]), np.array([2.7070075241, 7.2668688436e-6])
            self.assertTrue(fit.converged)
            self.assertLess(np.max(np.abs(np.exp(fit.point) - certified) / errors), 0.05)
            np.testing.assert_allclose(np.sqrt(np.diag(fit.covariance())), errors / certified, rtol=2e-3)
            self.assertAlmostEqual(fit.chi_squared, 12, delta=0.01)

    def test_few_evaluations_suffice(self):
        target = math.log(3e-7)
        fit, asked = fitted(lambda p: np.array([(math.exp(target) / math.exp(p[0]) - 1) / 0.02]), [math.log(1e-7)],
                            [math.log(1e-9)], [math.log(1e-5)], [0.1])
        self.assertAlmostEqual(fit.point[0], target, delta=1e-3)
        self.assertLess(asked, 16)

    def test_a_step_that_leads_away_is_not_taken(self):
        # Gauss and Newton's step leads farther away from beyond 1.39
        fit, _ = fitted(lambda p: 100 * np.arctan(p - 2), [5], [-28], [32], [1e-4])
        self.assertAlmostEqual(fit.point[0], 2, delta=1e-3)
        self.assertTrue(fit.converged)

    def test_a_best_value_beyond_a_bound_ends_there(self):
        fit, _ = fitted(lambda p: np.array([p[0] - 5, p[1] - 1, p[0] + p[1] - 6]) / 0.1, [1, 0], [0, 0], [2, 2], [0.1, 0.1])
        self.assertEqual(fit.point[0], 2)
        self.assertAlmostEqual(fit.point[1], 2, delta=0.02)  # its best between 1 and 6 - 2 lies beyond as well
        self.assertTrue(fit.converged)

    def test_what_the_data_do_not_tell_is_named(self):
        def product(p):
            return np.array([p[0] + p[1] - 2, 2 * (p[0] + p[1] - 2.1)]) / 0.01

        self.assertEqual(fitted(product, [0, 0], [-5, -5], [5, 5], [0.1, 0.1])[0].untold(), [[0, 1]])

        def one_alone(p):
            return np.array([p[0] - 2, p[0] - 2.1, 1e-3 * p[1]]) / 0.05

        self.assertEqual(fitted(one_alone, [0, 0], [-5, -5], [5, 5], [0.1, 0.1])[0].untold(), [[1]])

    def test_chi_squared_as_in_the_tables(self):
        for freedom, value in ((1, 3.841), (2, 5.991), (3, 7.815), (9, 16.919), (10, 18.307)):
            self.assertAlmostEqual(least_squares.chi_squared_beyond(value, freedom), 0.05, delta=2e-5)
        self.assertEqual(least_squares.chi_squared_beyond(0, 7), 1)
        self.assertAlmostEqual(least_squares.chi_squared_beyond(1000, 200), 0, delta=1e-12)

    def test_runs_that_tell_too_little_end_the_search(self):
        numbers = np.random.default_rng(1)
        fit, asked = fitted(lambda p: np.array([p[0], 10.0]) + 3 * numbers.normal(size=2), [4], [-9], [9], [1e-3])
        self.assertLess(asked, 400)
        self.assertEqual(len(fit.point), 1)


if __name__ == "__main__":
    unittest.main()
