"""The pressure drop of the throat by a Stokes solution on a staggered grid, by how far the pistons are.

    /usr/bin/python3 cases/abrasive_throat/stokes_reference.py [EXPONENT]

Velocities on the faces of square cells, pressures in their middles (Harlow & Welch 1965), eta D for the stress with the
viscosity at middles and corners, walls and pistons that hold the medium. Incompressibility by an augmented Lagrangian, the
viscosity by fixed-point steps in its logarithm. The drop between the points 9.6 mm before and behind the middle, and that of the
mean pressures of their sections, are told on two grids and extrapolated with the order 1.4 that three Newtonian grids show: that
of the corners.
"""

import sys

import numpy as np

WIDTH, THROAT, HALF_THROAT, LENGTH, START = 6e-3, 2e-3, 3e-3, 24e-3, -14e-3  # [m]
SPEED, POINT, ORDER = 0.01, 9.6e-3, 1.4  # [m/s], [m]
SMALLEST, LARGEST = 10.0, 16000.0  # viscosities of power_law.toml [Pa s]


def viscosity(exponent, shear_rate):
    if exponent == 1:
        return np.full_like(shear_rate, 1000.0)
    return np.clip(18990.0 * np.maximum(shear_rate, 1e-9) ** (exponent - 1), SMALLEST, LARGEST)


class Form:
    """A difference of velocities in each place: sum of coefficients times unknowns, and what is known."""

    def __init__(self, entries):
        self.index = np.stack([e[0].ravel() for e in entries], axis=1)
        self.coefficient = np.stack([e[2].ravel() for e in entries], axis=1)
        known = np.stack([e[1].ravel() for e in entries], axis=1)
        self.constant = np.where(self.index < 0, self.coefficient * known, 0).sum(axis=1)
        self.coefficient[self.index < 0] = 0
        self.index[self.index < 0] = 0

    def __call__(self, velocities):
        return (self.coefficient * velocities[self.index]).sum(axis=1) + self.constant

    def add_transposed(self, values, target):
        np.add.at(target, self.index, self.coefficient * values[:, None])

    def add_square(self, weight, columns):
        """Adds the matrix of sum weight form^2 to blocks of columns and those right of them."""
        m = columns.diagonal.shape[1]
        for k in range(self.index.shape[1]):
            for l in range(self.index.shape[1]):
                a, b = self.index[:, k], self.index[:, l]
                value = weight * self.coefficient[:, k] * self.coefficient[:, l]
                for blocks, there in ((columns.diagonal, a // m == b // m), (columns.right, b // m == a // m + 1)):
                    np.add.at(blocks, (a[there] // m, a[there] % m, b[there] % m), value[there])


class Columns:
    """A symmetric matrix of blocks beside the diagonal, factorised column by column."""

    def __init__(self, count, size):
        self.diagonal, self.right = np.zeros((count, size, size)), np.zeros((count, size, size))

    def factorise(self):
        self.inverse = np.empty_like(self.diagonal)
        for i, block in enumerate(self.diagonal):
            if i:
                block = block - self.right[i - 1].T @ self.inverse[i - 1] @ self.right[i - 1]
            self.inverse[i] = np.linalg.inv(block)

    def solve(self, b):
        x = b.reshape(len(self.diagonal), -1).copy()
        for i in range(1, len(x)):
            x[i] -= self.right[i - 1].T @ (self.inverse[i - 1] @ x[i - 1])
        for i in reversed(range(len(x))):
            if i + 1 < len(x):
                x[i] -= self.right[i] @ x[i + 1]
            x[i] = self.inverse[i] @ x[i]
        return x.ravel()


def drop(h, stroke, exponent):
    """Between the points, and between the means of their sections [Pa]; `h` [m] the side of a cell."""
    nx, ny = round(LENGTH / h), round(WIDTH / h)
    x = START + round(stroke / h) * h + (np.arange(nx) + 0.5) * h
    y = (np.arange(ny) + 0.5) * h - WIDTH / 2
    wet = np.zeros((nx + 2, ny + 2), bool)
    wet[1:-1, 1:-1] = ~((np.abs(x)[:, None] < HALF_THROAT) & (np.abs(y)[None, :] > THROAT / 2))
    cell = wet[1:-1, 1:-1].ravel().astype(float)
    corners = wet[:-1, :-1].astype(float) + wet[1:, :-1] + wet[:-1, 1:] + wet[1:, 1:]

    # Faces, one more of them on either side: in the medium (2), on a wall (1), inside it (0).
    m = 2 * ny + 1
    u_kind, v_kind = np.zeros((nx + 1, ny + 2), int), np.zeros((nx + 2, ny + 1), int)
    u_kind[:, 1:-1] = wet[:-1, 1:-1].astype(int) + wet[1:, 1:-1]
    v_kind[1:-1] = wet[1:-1, :-1].astype(int) + wet[1:-1, 1:]
    u = np.where(u_kind == 2, np.arange(nx + 1)[:, None] * m + np.arange(-1, ny + 1)[None, :], -1)
    v = np.where(v_kind == 2, np.arange(-1, nx + 1)[:, None] * m + ny + np.arange(ny + 1)[None, :], -1)
    u_known, v_known = np.zeros(u.shape), np.zeros(v.shape)
    u_known[0] = u_known[-1] = SPEED
    half_u = np.where((u_kind[:, 1:] == 0) != (u_kind[:, :-1] == 0), 2.0, 1.0) / h  # to a wall half a cell away
    half_u[0] = half_u[-1] = 0
    half_v = np.where((v_kind[1:] == 0) != (v_kind[:-1] == 0), 2.0, 1.0) / h
    one = np.ones((nx, ny)) / h
    along_x = [(u[1:, 1:-1], u_known[1:, 1:-1], one), (u[:-1, 1:-1], u_known[:-1, 1:-1], -one)]
    along_y = [(v[1:-1, 1:], v_known[1:-1, 1:], one), (v[1:-1, :-1], v_known[1:-1, :-1], -one)]
    stretch_x, stretch_y, divergence = Form(along_x), Form(along_y), Form(along_x + along_y)
    shear = Form([(u[:, 1:], u_known[:, 1:], half_u), (u[:, :-1], u_known[:, :-1], -half_u),
                  (v[1:], v_known[1:], half_v), (v[:-1], v_known[:-1], -half_v)])  # fmt: skip

    eta_cell, eta_corner = np.full(nx * ny, 1000.0), np.full(corners.size, 1000.0)
    p, free = np.zeros(nx * ny), np.setdiff1d(np.arange((nx + 1) * m), np.concatenate([u[u >= 0], v[v >= 0]]))
    before = 0.0
    for step in range(100):
        penalty = 3e3 * np.median(eta_cell[cell > 0])
        weights = [(stretch_x, 2 * eta_cell * cell), (stretch_y, 2 * eta_cell * cell),
                   (shear, eta_corner * corners.ravel() / 4)]  # fmt: skip
        columns = Columns(nx + 1, m)
        for form, weight in [*weights, (divergence, penalty * cell)]:
            form.add_square(weight, columns)
        columns.diagonal.reshape(nx + 1, -1)[free // m, free % m * (m + 1)] = 1e9
        columns.factorise()
        for _ in range(3):
            b = np.zeros((nx + 1) * m)
            for form, weight in weights:
                form.add_transposed(-weight * form.constant, b)
            divergence.add_transposed((p - penalty * divergence.constant) * cell, b)
            velocities = columns.solve(b)
            p -= penalty * divergence(velocities) * cell

        def at(place):
            k = int((place - x[0]) / h)
            share = (place - x[k]) / h
            section = (1 - share) * p.reshape(nx, ny)[k] + share * p.reshape(nx, ny)[k + 1]
            return np.array([section[ny // 2 - 1 : ny // 2 + 1].mean(), section.mean()])

        found = at(-POINT) - at(POINT)
        if exponent == 1 or abs(found[0] - before) < 2e-5 * found[0]:
            return found
        before = found[0]
        gamma = shear(velocities).reshape(nx + 1, ny + 1) ** 2
        along = np.zeros((nx + 2, ny + 2))
        along[1:-1, 1:-1] = (2 * (stretch_x(velocities) ** 2 + stretch_y(velocities) ** 2) * cell).reshape(nx, ny)
        at_cell = along[1:-1, 1:-1] + (gamma[:-1, :-1] + gamma[1:, :-1] + gamma[:-1, 1:] + gamma[1:, 1:]) / 4
        at_corner = gamma + (along[:-1, :-1] + along[1:, :-1] + along[:-1, 1:] + along[1:, 1:]) / np.maximum(corners, 1)
        share = 0.5 if step < 10 else 0.7
        eta_cell = eta_cell ** (1 - share) * viscosity(exponent, np.sqrt(at_cell.ravel())) ** share
        eta_corner = eta_corner ** (1 - share) * viscosity(exponent, np.sqrt(at_corner.ravel())) ** share
    raise SystemExit("the viscosity does not settle")


def main():
    exponent = float(sys.argv[1]) if len(sys.argv) > 1 else 0.4
    print("stroke [mm]   between the points, between means [MPa]")
    for stroke in (0.0, 1e-3, 2e-3, 3e-3, 3.8e-3):
        coarse, fine = drop(2e-4, stroke, exponent), drop(1e-4, stroke, exponent)
        limit = fine + (fine - coarse) / (2**ORDER - 1)
        print(f"{stroke * 1e3:11.1f}   {limit[0] / 1e6:.3f} {limit[1] / 1e6:.3f}", flush=True)


if __name__ == "__main__":
    main()
