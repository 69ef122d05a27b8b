"""What moves by prescription, and the two boxes that the page shows: all that happens, and the enlargement."""

import math

import numpy as np

from toryu import results
from toryu.report import data

# What the enlargement shows around a work piece, as shares of its longest side: beyond its shorter and longer sides.
MARGIN_ACROSS, MARGIN_ALONG = 0.4, 0.12
SMALL = 0.6  # of the whole view: a solid below that is worth an enlargement


def view_of(boxes):
    """The box that the picture shows at first: wherever a particle comes in the run, and a little around it."""
    if not boxes:
        return [0, 0, 1, 1]
    low, high = np.min([b[0] for b in boxes], axis=0), np.max([b[1] for b in boxes], axis=0)
    margin = max(min(0.05 * max(high - low), 0.2 * min(high - low)), 0.02 * max(high - low))
    return [*map(float, low - margin), *map(float, high + margin)]


def near_view(view, walls, bodies, contours):
    """The box of the enlargement: the first work piece and what is around it, as far as there is anything; else the
    solid of a run with moving walls that shows much more; else none."""
    solid = next((np.array(body["box"]) for body in bodies if body["name"] == "solid"), None)
    if contours:
        reach = contours[0].spacing / 2
        low, high = contours[0].position.min(axis=0) - reach, contours[0].position.max(axis=0) + reach
    elif (solid is not None and any(wall["path"] for wall in walls)
          and max(solid[2:] - solid[:2]) < SMALL * max(view[2] - view[0], view[3] - view[1])):
        low, high = solid[:2], solid[2:]
    else:
        return None
    side = high - low
    margin = max(side) * np.where(side < max(side), MARGIN_ACROSS, MARGIN_ALONG)
    boxes = np.array([body["box"] for body in bodies] + [wall["box"] for wall in walls])
    low = np.maximum(low - margin, boxes[:, :2].min(axis=0))
    high = np.minimum(high + margin, boxes[:, 2:].max(axis=0))
    return [*map(float, low), *map(float, high)]


def wall_paths(case, end, outlines=None, motions=None):
    """Boxes of the rigid walls, the rings of those that `outlines` has by their number, and how they move until `end` [s]:
    of a table of velocities rows of time, displacement, velocity (x, y of each), the displacement the integral of the
    velocity; and of any motion that `motions` has by their number the poses that it passes."""
    walls = []
    for number, wall in enumerate(data.tables_of(case, "wall")):
        rings, path = (outlines or {}).get(number, []), []
        box = bounds(rings) if rings else data.box_of(data.table(wall, "box"))
        if box is None:
            continue
        rows = rows_of(motion_of(case, wall))
        if len(rows):
            times = np.union1d(rows[:, 0], np.linspace(0, end, 201))
            velocity = np.column_stack([np.interp(times, rows[:, 0], rows[:, axis]) for axis in (1, 2)])
            steps = np.diff(times)[:, None] * (velocity[1:] + velocity[:-1]) / 2
            moved = np.vstack([[0, 0], np.cumsum(steps, axis=0)])
            moved -= moved[np.searchsorted(times, 0)]
            path = np.column_stack([times, moved, velocity]).tolist()
        walls.append({"name": str(wall.get("name", "")), "box": box, "round": data.table(wall, "box").get("round") is True,
                      "path": path, "work_piece": wall.get("work_piece") is True, "rings": rings or worn_rings(wall, box),
                      **(motions or {}).get(number, {"about": [0, 0], "poses": []})})
    return walls


def bounds(rings):
    corners = np.array([corner for ring in rings for corner in ring])
    return [*map(float, corners.min(axis=0)), *map(float, corners.max(axis=0))]


def worn_rings(wall, box):
    """A ring of corners [x, y] of a wall whose faces are worn, anticlockwise; none of one that is as its box."""
    low_x, low_y, high_x, high_y = box
    depths = {worn.get("face"): depth for worn in data.tables_of(wall, "worn")
              if isinstance(depth := worn.get("depth"), list) and depth and all(data.numbers(row, 2) for row in depth)}
    if not any(row[1] for depth in depths.values() for row in depth):
        return []
    corners = []
    for face, across, along, turned in (("lower", low_y, (low_x, high_x), False), ("right", high_x, (low_y, high_y), True),
                                        ("upper", high_y, (high_x, low_x), False), ("left", low_x, (high_y, low_y), True)):
        inward, rows = 1 if face in ("lower", "left") else -1, depths.get(face, [[along[0], 0.0]])
        places, worn = zip(*rows)
        inner = [s for s in places if min(along) < s < max(along)]
        for s in [along[0], *(inner if along[0] < along[1] else inner[::-1]), along[1]]:
            level = across + inward * float(np.interp(s, places, worn))
            corners.append([level, s] if turned else [s, level])
    return [corners]


def motion_of(case, wall):
    """Its own, or the one that it shares."""
    shared = [m for m in data.tables_of(case, "motion") if m.get("name") == wall.get("moves_with")]
    return shared[0] if shared else data.table(wall, "motion")


def rows_of(motion):
    """Rows of time, velocity x, y of a prescribed motion; none if it cannot be read, or is more than a table of
    velocities: the picture shows such walls as they lie at the start."""
    if any(motion.get(kind) for kind in ("position", "sine", "rotation")):
        return np.empty((0, 3))
    speed, time = motion.get("speed", 1), motion.get("time", 1)
    rows = motion.get("velocity", [])
    if not isinstance(rows, list) or not all(data.numbers(row, 3) for row in rows) or not data.numbers([speed, time], 2):
        return np.empty((0, 3))
    return np.array(rows, float).reshape(-1, 3) * [time, speed, speed]


def motion_charts(walls, end):
    """Charts of velocity and displacement of what moves by prescription, from 0 to `end` [s]; what moves alike is
    one line."""
    groups = {}
    for wall in walls:
        if wall["path"]:
            groups.setdefault(str(wall["path"]), []).append(wall)
    lines = {"velocity": [], "displacement": []}
    for alike in groups.values():
        name = joined([results.readable(wall["name"]) for wall in alike])
        path = np.array([row for row in alike[0]["path"] if 0 <= row[0] <= end * (1 + 1e-9)])
        for axis, letter in enumerate("xy"):
            moved, velocity = path[:, 1 + axis], path[:, 3 + axis]
            if velocity.any():
                for kind, values in (("velocity", velocity), ("displacement", moved)):
                    lines[kind].append((f"{name}, {letter}", path[:, 0].tolist(), values.tolist(), "line"))
    units = {"velocity": "m/s", "displacement": "m"}
    return [data.chart(f"prescribed {kind}", units[kind], found) for kind, found in lines.items() if found]


def joined(names):
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"


def end_of(case, bodies):
    """The end of the case, of an endless one the time that was reached [s]."""
    end = data.table(case, "case").get("end_time", math.inf)
    reached = max((body["times"][-1] for body in bodies), default=0.0)
    return end if data.is_number(end) else reached
