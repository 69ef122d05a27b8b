"""How much farther the gate's tip bends because its sides are free, than a strip of it in plane strain does.

    /usr/bin/python3 cases/elastic_gate/plate_width.py

Small deflections of a Kirchhoff plate, 0.079 m long, 0.1 m wide and 5 mm thick, held along its upper edge, under the
hydrostatic load of 0.14 m of water, by the rectangular elements of twelve terms of Adini, Clough and Melosh
(Zienkiewicz & Taylor 2000, section 4.3). A strip in plane strain is the same plate with cylindrical bending, integrated
as a beam of stiffness E t^3/(12 (1 - nu^2)); modulus and thickness drop out of the ratio.
"""

import numpy as np

LENGTH, WIDTH, DEPTH = 0.079, 0.1, 0.14
TERMS = [(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2), (3, 0), (2, 1), (1, 2), (0, 3), (3, 1), (1, 3)]
GAUSS = [(-np.sqrt(0.6), 5 / 9), (0.0, 8 / 9), (np.sqrt(0.6), 5 / 9)]


def load(s):
    """Pressure over rho g [m] at `s` [m] below the held edge."""
    return DEPTH - LENGTH + s


def derivative(x, y, along_x, along_y):
    """The terms x^i y^j, differentiated so often."""
    values = []
    for i, j in TERMS:
        factor = np.prod([i - k for k in range(along_x)]) * np.prod([j - k for k in range(along_y)])
        values.append(factor * x ** (i - along_x) * y ** (j - along_y) if factor else 0.0)
    return np.array(values)


def plate_tip(nu, elements):
    """Deflection of the lower edge's middle, flexural rigidity 1; `elements` each way, an even number."""
    a, b, n = LENGTH / elements / 2, WIDTH / elements / 2, elements + 1
    corners = [(-a, -b), (a, -b), (a, b), (-a, b)]
    shape = np.linalg.inv([row for x, y in corners
                           for row in (derivative(x, y, 0, 0), derivative(x, y, 1, 0), derivative(x, y, 0, 1))])
    law = np.array([[1, nu, 0], [nu, 1, 0], [0, 0, (1 - nu) / 2]])
    points = [(a * u, b * v, a * b * p * q) for u, p in GAUSS for v, q in GAUSS]
    element = sum(weight * B.T @ law @ B for x, y, weight in points for B in [np.array(
        [derivative(x, y, 2, 0), derivative(x, y, 0, 2), 2 * derivative(x, y, 1, 1)]) @ shape])
    stiffness, force = np.zeros((3 * n * n, 3 * n * n)), np.zeros(3 * n * n)
    for i in range(elements):
        for j in range(elements):
            nodes = [i * n + j, (i + 1) * n + j, (i + 1) * n + j + 1, i * n + j + 1]
            freedoms = np.array([3 * node + k for node in nodes for k in range(3)])
            stiffness[np.ix_(freedoms, freedoms)] += element
            force[freedoms] += sum(weight * load((2 * i + 1) * a + x) * derivative(x, y, 0, 0) @ shape
                                   for x, y, weight in points)
    free = slice(3 * n, None)  # the first row of nodes is held
    deflection = np.linalg.solve(stiffness[free, free], force[free])
    return deflection[3 * (elements * n + elements // 2 - n)]


def strip_tip():
    """The same for a strip: tip = integral of moment times lever arm."""
    s = np.linspace(0, LENGTH, 2001)
    moment = [np.trapz(load(s[k:]) * (s[k:] - s[k]), s[k:]) for k in range(len(s))]
    return np.trapz(moment * (LENGTH - s), s)


if __name__ == "__main__":
    for nu in (0.4, 0.49):
        for elements in (8, 16, 24):
            print(f"nu {nu}, {elements:2} x {elements:2} elements: {plate_tip(nu, elements) / strip_tip():.4f}")
