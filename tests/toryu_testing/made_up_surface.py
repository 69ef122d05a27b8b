"""Work pieces that never were."""

import numpy as np


def standing(side, columns=4, rows=24, spacing=1e-3, width=17e-3):
    """Positions, outward normals and areas of the surface of a lattice that stands at mid height on the left or
    the right wall of a channel that is `width` wide."""
    faces = {}
    for column in range(columns):
        for row in range(rows):
            face = np.array([column == columns - 1, (row == rows - 1) * 1.0 - (row == 0)], float)
            if face.any():
                faces[(column + 0.5) * spacing, (row + 0.5 - rows / 2) * spacing] = face
    points, vectors = np.array(list(faces)), np.array(list(faces.values()))
    if side == "right":
        points[:, 0], vectors[:, 0] = width - points[:, 0], -vectors[:, 0]
    length = np.linalg.norm(vectors, axis=1)
    return points, vectors / length[:, None], length * spacing


def write(path, times, depth):
    """A surface.h5 of two standing work pieces: `depth` [m] comes off in each second, twice that at the corners, and
    twice as much in the first second."""
    import h5py

    sides = [standing(side) for side in ("left", "right")]
    points, normals, areas = (np.concatenate(parts) for parts in zip(*sides))
    a_second = depth * np.where(np.abs(normals).min(axis=1) > 0.1, 2.0, 1.0)
    times = np.asarray(times)
    with h5py.File(path, "w") as file:
        file["start_position"], file["area"], file["normal"] = points, areas, normals
        file["work_piece"] = np.repeat([0, 1], [len(part[2]) for part in sides])
        file["work_piece"].attrs["names"] = "left_piece;right_piece"
        file["time"] = times
        file["preston_depth"] = np.outer(times + np.minimum(times, 1), a_second)


GAP, LENGTH, POINTS = 2e-3, 1e-2, 20  # of a passage [m]


def write_passage(path, times, opening, worn, unsteady):
    """A surface.h5 of a passage along x between the walls 'lower' and 'upper', whose upper and lower face are worn by the
    rows `worn` of place and depth [m]. Each face recedes by (opening/2) w 2 (1 - x/L) [m/s], w the width at x: evenly if the
    medium goes both ways, w = GAP exp(opening t). `unsteady` times too much at the start, falling to 0 after 2 s."""
    import h5py

    x = (np.arange(POINTS) + 0.5) * LENGTH / POINTS
    depth = [np.interp(x, *zip(*rows)) if rows else np.zeros(POINTS) for rows in worn]
    rate = 0.5 * opening * (GAP + sum(depth)) * 2 * (1 - x / LENGTH)
    times = np.asarray(times)
    passed = times + unsteady * (times - np.minimum(times, 2) / 2) * (np.minimum(times, 2) / np.maximum(times, 1e-9))
    with h5py.File(path, "w") as file:
        sides = [(-GAP / 2 - 2.5e-4, 1.0, depth[0]), (GAP / 2 + 2.5e-4, -1.0, depth[1])]
        file["start_position"] = np.concatenate([np.column_stack([x, y - sense * h]) for y, sense, h in sides])
        file["normal"] = np.concatenate([np.tile([0.0, sense], (POINTS, 1)) for _, sense, _ in sides])
        file["area"] = np.full(2 * POINTS, LENGTH / POINTS)
        file["work_piece"] = np.repeat([0, 1], POINTS)
        file["work_piece"].attrs["names"] = "lower;upper"
        file["time"] = times
        file["preston_depth"] = np.outer(passed, np.tile(rate, 2))
        file["sliding_pressure"] = np.outer(passed, np.tile(rate, 2)) / 1e-12
        file["contact_pressure"] = np.full((len(times), 2 * POINTS), 1e6)
        file["sliding_speed"] = np.full((len(times), 2 * POINTS), 1e-2)
