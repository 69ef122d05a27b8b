"""Extremes of the velocity on the centre lines: smallest u over x = 1/2, largest and smallest v over y = 1/2; means over the
frames from a time on, by fits of the second order to the particles about each place.

    PYTHONPATH=tools /usr/bin/python3 cases/lid_driven_cavity/extremes.py out/lid_driven_cavity 8.5
"""

import argparse

import numpy as np

from toryu import results

REACH = 2.6  # [spacings] of the particles that a fit takes
STEP = 0.01  # [m] between places on a line
# Where each is looked for: along y at x = 1/2, along x at y = 1/2; in the middles of the lines, away from the walls.
U_LINE = [(0.5, s) for s in np.arange(0.1, 0.7, STEP)]
V_RISING = [(s, 0.5) for s in np.arange(0.1, 0.4, STEP)]
V_FALLING = [(s, 0.5) for s in np.arange(0.7, 0.95, STEP)]
CONVERGED = {100: (-0.2141, 0.1796, -0.2538), 400: (-0.3288, 0.3039, -0.4542)}  # finite differences, see README.md
GHIA = {100: (-0.2109, 0.1753, -0.2453), 400: (-0.32726, 0.30203, -0.44993)}  # Ghia, Ghia & Shin 1982


def fitted(x, values, place, spacing):
    """What a parabola through the values about `place` is there."""
    r = (x - place) / spacing
    distance = np.hypot(r[:, 0], r[:, 1])
    near = distance < REACH
    (a, b), weight = r[near].T, 1 - distance[near] / REACH
    columns = np.column_stack([np.ones(len(a)), a, b, a * a, a * b, b * b])
    return np.linalg.lstsq(columns * weight[:, None], values[near] * weight, rcond=None)[0][0]


def extreme(values, smallest):
    """The smallest or largest of a line, by the parabola through it and its neighbours."""
    k = int(np.argmin(values) if smallest else np.argmax(values))
    if k in (0, len(values) - 1):
        return float(values[k])
    bend, slope = (values[k - 1] + values[k + 1]) / 2 - values[k], (values[k + 1] - values[k - 1]) / 2
    return float(values[k] - slope ** 2 / (4 * bend))


def of_frames(frames, spacing):
    """Smallest u, largest v, smallest v [m/s], each of the mean line of pairs (x, v) of the particles."""
    lines = np.array([[fitted(x, v[:, axis], np.array(place), spacing) for places, axis in
                       ((U_LINE, 0), (V_RISING, 1), (V_FALLING, 1)) for place in places] for x, v in frames]).mean(axis=0)
    u, rising, falling = np.split(lines, [len(U_LINE), len(U_LINE) + len(V_RISING)])
    return extreme(u, True), extreme(rising, False), extreme(falling, True)


def main():
    parser = argparse.ArgumentParser(prog="extremes", description=__doc__.split("\n\n")[0])
    parser.add_argument("out", metavar="OUT")
    parser.add_argument("start", metavar="SECONDS", type=float, help="the first frame of the means")
    options = parser.parse_args()
    frames = [f for f in results.read(options.out).frames("fluid") if f.time >= options.start - 1e-9]
    if not frames:
        parser.error(f"{options.out} has no frame from {options.start:g} s on")
    spacing = 1 / np.sqrt(len(frames[0].position))  # a unit square full of particles
    found = of_frames([(np.asarray(f.position), np.asarray(f["velocity"])) for f in frames], spacing)
    print(f"{len(frames)} frames: smallest u, largest v, smallest v  " + ", ".join(f"{value:.4f}" for value in found))
    reynolds = min(GHIA, key=lambda re: abs(GHIA[re][0] - found[0]))
    for name, reference in (("the converged flow", CONVERGED), ("Ghia, Ghia & Shin", GHIA)):
        print(f"over {name} at Re {reynolds}  " + ", ".join(
            f"{100 * (value / wanted - 1):+.1f} %" for value, wanted in zip(found, reference[reynolds])))


if __name__ == "__main__":
    main()
