"""Wear over machining time in jumps: dh/dt = r(h), where each rate r costs a solution of the flow.

Heun's rule (1900): the rate at the end of a jump is taken at the shape that the rate at its start foresees, and the mean of
both counts. What that differs by from the first rate alone is of second order in the jump and bounds the error, which is of
third order: where a jump of 10 % of a gap lets the rate grow by 10 %, they differ by 5 % and the error is 0.2 % of what
the jump takes off. A jump in which they differ by more than the tolerance is made anew, and shorter."""

import itertools
import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

SHORTER = (0.2, 0.9)  # a jump is shortened to the share that the tolerance asks for: at least, and times


@dataclass
class State:
    """The shape at a machining time, and how fast it wears."""

    time: float  # [s]
    depth: np.ndarray | None  # [m] of each point; None: nothing is off
    number: int  # of the jumps that led here
    attempt: int | None = None  # at the jump, if this is where the rate at its start leads; else its end
    jump_error: float = 0.0  # largest difference of Heun's and Euler's rule over the largest depth of the jump
    rate: np.ndarray | None = None  # [m/s]

    @property
    def predicted(self):
        return self.attempt is not None


@dataclass
class March:
    """How far it goes, and in which jumps."""

    until: float  # [s]
    allowed: Callable  # depth [m] so far -> what may come off in a jump [m], of each point or of all
    tolerance: float  # of State.jump_error
    missing: Callable = lambda depth: math.inf  # what a depth lacks of the goal: it ends where that falls to 0

    def __call__(self):
        """A generator of states; it is sent the rate of each [m/s], and ends after that of the last."""
        state = State(0.0, None, 0)
        state.rate = yield state
        state.depth = np.zeros_like(state.rate)
        while state.time < self.until * (1 - 1e-12) and self.missing(state.depth) > 0:
            dt = self.length(state)
            if dt == 0:
                return
            jump = yield from self.jump(state, dt)
            state = self.end(state, *jump)
            state.rate = yield state

    def length(self, state):
        """Of the next jump [s]: as many equal ones as the present rate asks for; 0 if nothing comes off."""
        left = self.until - state.time
        left = first_zero(lambda passed: self.missing(state.depth + passed * state.rate), left)
        wears = state.rate > 0
        if not wears.any():
            return 0.0
        most = float(np.min(np.broadcast_to(self.allowed(state.depth), state.rate.shape)[wears] / state.rate[wears]))
        return left / math.ceil(left / most * (1 - 1e-9))

    def jump(self, state, dt):
        """Predicts, and shortens the jump until its error is within the tolerance; its length, last rate and error."""
        for attempt in itertools.count():
            rate = yield State(state.time + dt, state.depth + dt * state.rate, state.number + 1, attempt)
            change = dt / 2 * (state.rate + rate)
            error = float(np.max(np.abs(rate - state.rate))) * dt / 2 / float(np.max(np.abs(change)))
            if error <= self.tolerance:
                return dt, rate, error
            dt *= max(SHORTER[0], SHORTER[1] * self.tolerance / error)

    def end(self, state, dt, rate, error):
        """The state after the jump, or within it where the goal is reached: the rate is taken as linear in time."""
        def depth(passed):
            return state.depth + passed * state.rate + passed**2 / (2 * dt) * (rate - state.rate)

        passed = first_zero(lambda passed: self.missing(depth(passed)), dt)
        return State(state.time + passed, depth(passed), state.number + 1, jump_error=error)


def first_zero(missing, end):
    """Where `missing`, above 0 at 0, has fallen to 0 within `end`, by bisection; `end` if it has not."""
    if missing(end) > 0:
        return end
    low, high = 0.0, end
    while high - low > 1e-12 * high:
        middle = (low + high) / 2
        low, high = (middle, high) if missing(middle) > 0 else (low, middle)
    return high
