"""Parameters from measurements by weighted least squares: the method of Levenberg (1944) and Marquardt (1963), written
for models of which each evaluation is costly. A residual is (computed - measured) / scatter."""

import math
from dataclasses import dataclass

import numpy as np

ENOUGH = 0.05  # the search ends where the next step would change the computed by less than that of their scatter
MOST_STEPS = 30
DAMPING = 1e-3  # at the start, of J'J with columns of unit length
LOWEST_DAMPING, HIGHEST_DAMPING = 1e-9, 1e4  # beyond the highest nothing is gained along the gradient either
LONGEST_STEP = 1 / 3  # of what lies between the bounds of a parameter
SHARE = 0.3  # of a direction that nothing tells: the parameters that have at least so much of it are named


@dataclass
class Fit:
    """Where the search has ended, for n residuals and p parameters."""

    point: np.ndarray  # p
    residuals: np.ndarray  # n
    jacobian: np.ndarray  # n x p, of the residuals
    widths: np.ndarray  # p, from bound to bound
    converged: bool

    @property
    def chi_squared(self):
        return float(self.residuals @ self.residuals)

    @property
    def freedom(self):
        """Degrees of freedom."""
        return len(self.residuals) - len(self.point)

    @property
    def probability(self):
        """Of a chi squared at least as large, if the model is right; nan without a degree of freedom."""
        return chi_squared_beyond(self.chi_squared, self.freedom) if self.freedom > 0 else math.nan

    def covariance(self):
        """Of the parameters, p x p: (J'J)^-1, by the scatter that was stated."""
        return np.linalg.inv(self.jacobian.T @ self.jacobian)

    def untold(self):
        """Lists of parameters, by number, of which the residuals tell nothing, or nothing of each alone: along such a
        direction the residuals change by less than 1 on the whole way between the bounds."""
        _, sizes, directions = np.linalg.svd(self.jacobian * self.widths)
        sizes = np.pad(sizes, (0, len(self.point) - len(sizes)))
        return [[int(j) for j in np.flatnonzero(np.abs(direction) >= SHARE)]
                for size, direction in zip(sizes, directions) if size < 1]


def search(start, lower, upper, steps):
    """A generator of lists of points, each an array of p parameters; it is sent the residuals of each, and returns the
    Fit. `steps`: by how much each parameter is changed to either side for the derivatives."""
    x, widths = np.clip(start, lower, upper), upper - lower
    r = (yield [x])[0]
    damping = DAMPING
    for _ in range(MOST_STEPS):
        jacobian = yield from derivatives(x, lower, upper, steps)
        gradient = jacobian.T @ r
        free = ~((x <= lower) & (gradient > 0) | (x >= upper) & (gradient < 0))
        whole = step(jacobian, r, free, 0.0, widths)
        if np.linalg.norm(jacobian @ whole) < ENOUGH:
            return Fit(x, r, jacobian, widths, True)
        while True:
            trial = np.clip(x + step(jacobian, r, free, damping, widths), lower, upper)
            found = (yield [trial])[0]
            if found @ found < r @ r:
                x, r, damping = trial, found, max(damping / 10, LOWEST_DAMPING)
                break
            damping *= 10
            if damping > HIGHEST_DAMPING:  # the next digits are beyond what the computation tells
                return Fit(x, r, jacobian, widths, bool(np.linalg.norm(jacobian @ whole) < 1))
    jacobian = yield from derivatives(x, lower, upper, steps)
    return Fit(x, r, jacobian, widths, False)


def derivatives(x, lower, upper, steps):
    """The Jacobian, by central differences, at a bound one-sided: a generator as `search`."""
    moves = np.diag(steps)
    above, below = np.minimum(x + moves, upper), np.maximum(x - moves, lower)
    found = yield [*above, *below]
    count = len(x)
    return np.column_stack([(found[j] - found[count + j]) / (above[j, j] - below[j, j]) for j in range(count)])


def step(jacobian, residuals, free, damping, widths):
    """The step of the free parameters, at most LONGEST_STEP; without damping that of Gauss and Newton."""
    lengths = np.linalg.norm(jacobian, axis=0)
    used = free & (lengths > 0)
    whole = np.zeros(len(free))
    if used.any():
        unit = jacobian[:, used] / lengths[used]
        rows = np.vstack([unit, math.sqrt(damping) * np.eye(unit.shape[1])])
        wanted = np.concatenate([-residuals, np.zeros(unit.shape[1])])
        whole[used] = np.linalg.lstsq(rows, wanted, rcond=1e-9)[0] / lengths[used]
    longest = float(np.max(np.abs(whole) / widths))
    return whole * min(1.0, LONGEST_STEP / longest) if longest > 0 else whole


def chi_squared_beyond(value, freedom):
    """The probability that chi squared is larger: Q(freedom/2, value/2) of the incomplete gamma function, by
    Q(a + 1, x) = Q(a, x) + x^a exp(-x) / Gamma(a + 1) from Q(1, x) = exp(-x) and Q(1/2, x) = erfc(sqrt(x))."""
    x, a = value / 2, 0.5 if freedom % 2 else 1.0
    q = math.erfc(math.sqrt(x)) if freedom % 2 else math.exp(-x)
    while a < freedom / 2:
        q += math.exp(a * math.log(x) - x - math.lgamma(a + 1)) if x > 0 else 0.0
        a += 1
    return min(q, 1.0)
