"""Wear in jumps by Heun's rule, with rates that are known."""

import math
import unittest

import numpy as np
from toryu.study.recession_steps import March

GAP, RATE = 2e-3, 6.75e-5  # V8: w = GAP exp(RATE t), both faces alike


def opening(depth):
    """The rate of each face of a passage that opens by exp(RATE t)."""
    return 0.5 * RATE * (GAP + 2 * depth)


def go(march, rate, points=3):
    """All states of a march with the rates of `rate(depth)`."""
    states, running = [], march()
    state = next(running)
    try:
        while True:
            states.append(state)
            depth = np.zeros(points) if state.depth is None else state.depth
            state = running.send(rate(depth))
    except StopIteration:
        return states


def of_gap(jump):
    return lambda depth: 0.5 * jump * (GAP + 2 * depth.min())


class Steps(unittest.TestCase):
    def test_a_passage_opens_by_a_fifth_within_a_thousandth(self):
        for jump, solutions, error in ((0.1, 5, 2e-3), (0.05, 9, 5e-4)):
            states = go(March(2700, of_gap(jump), 0.1), opening)
            self.assertEqual(len(states), solutions)
            opened = 2 * states[-1].depth[0] / GAP
            exact = math.exp(RATE * 2700) - 1
            self.assertLess(abs(opened / exact - 1), error)
            self.assertGreater(abs(opened / exact - 1), error / 20, "exact by accident")
            for state in states:  # the jumps keep their limit; the rate that grows may take them a little further
                if not state.predicted and state.number > 0:
                    before = next(s for s in states if s.number == state.number - 1 and not s.predicted)
                    self.assertLess(np.max(state.depth - before.depth), 1.06 * of_gap(jump)(before.depth))

    def test_its_order_is_the_second(self):
        exact = GAP / 2 * (math.exp(RATE * 2700) - 1)
        errors = [abs(go(March(2700, of_gap(jump), 1.0), opening)[-1].depth[0] - exact) for jump in (0.2, 0.1, 0.05)]
        self.assertGreater(math.log2(errors[0] / errors[2]) / 2, 1.5)

    def test_a_constant_rate_is_exact_in_any_jump(self):
        states = go(March(100, lambda _: 1.0, 1e-9), lambda depth: np.array([1e-3, 2e-3, 0.0]))
        np.testing.assert_allclose(states[-1].depth, [0.1, 0.2, 0.0], rtol=1e-12)
        self.assertEqual([s.predicted for s in states], [False, True, False])

    def test_the_jump_error_bounds_and_is_bounded(self):
        states = go(March(2700, of_gap(0.5), 0.02), opening)
        errors = [s.jump_error for s in states if not s.predicted and s.number > 0]
        self.assertLessEqual(max(errors), 0.02)
        self.assertGreater(max(s.attempt for s in states if s.predicted), 0, "a jump was made anew")
        exact = GAP / 2 * (math.exp(RATE * 2700) - 1)
        self.assertLess(abs(states[-1].depth[0] / exact - 1), 0.02)

    def test_points_that_may_lose_less_hold_the_jump(self):
        allowed = np.array([1.0, 1.0, 0.01])
        states = go(March(1.0, lambda _: allowed, 1.0), lambda depth: np.full(3, 0.1))
        self.assertEqual(sum(not s.predicted for s in states) - 1, 10)

    def test_it_ends_at_the_goal(self):
        states = go(March(1e9, of_gap(0.1), 0.1, lambda depth: 1e-4 - depth.mean()), opening)
        self.assertAlmostEqual(states[-1].depth.mean() / 1e-4, 1, places=9)
        self.assertAlmostEqual(states[-1].time / (math.log(1.1) / RATE), 1, delta=2e-3)

    def test_the_last_jump_is_no_longer_than_to_the_goal(self):
        predicted = go(March(1e9, of_gap(0.1), 0.1, lambda depth: 5e-5 - depth.mean()), opening)[1]
        self.assertAlmostEqual(predicted.depth.mean() / 5e-5, 1, places=9)

    def test_what_nothing_wears_stays(self):
        states = go(March(100, of_gap(0.1), 0.1), lambda depth: np.zeros(3))
        self.assertEqual(len(states), 1)


if __name__ == "__main__":
    unittest.main()
