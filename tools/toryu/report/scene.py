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
    elif (solid is not None and any(wall["poses"] for wall in walls)
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


def walls_of(case, outlines=None, motions=None):
    """Boxes of the rigid walls, the rings of those that `outlines` has by their number, and of those that `motions` has the
    poses that they pass."""
    walls = []
    for number, wall in enumerate(data.tables_of(case, "wall")):
        rings = (outlines or {}).get(number, [])
        box = bounds(rings) if rings else data.box_of(data.table(wall, "box"))
        if box is None:
            continue
        walls.append({"name": str(wall.get("name", "")), "box": box, "round": data.table(wall, "box").get("round") is True,
                      "work_piece": wall.get("work_piece") is True, "rings": rings or worn_rings(wall, box),
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


def motion_charts(walls, end):
    """Charts of velocity, displacement and angle of what moves by prescription, from 0 to `end` [s]; what moves alike is
    one line."""
    groups = {}
    for wall in walls:
        if wall["poses"]:
            groups.setdefault(str((wall["about"], wall["poses"])), []).append(wall)
    lines = {"velocity": [], "displacement": [], "angle": []}
    for alike in groups.values():
        name = joined([results.readable(wall["name"]) for wall in alike])
        poses = [row for row in alike[0]["poses"] if row[0] <= end * (1 + 1e-9)]
        if not poses:  # a damaged case ends before it starts
            continue
        times, x, y, angle, v_x, v_y = np.array(poses).T
        about = alike[0]["about"]
        for letter, moved, velocity in (("x", x - about[0], v_x), ("y", y - about[1], v_y)):
            if velocity.any():
                for kind, values in (("velocity", velocity), ("displacement", moved)):
                    lines[kind].append((f"{name}, {letter}", times.tolist(), values.tolist(), "line"))
        if angle.any():
            lines["angle"].append((name, times.tolist(), angle.tolist(), "line"))
    units = {"velocity": "m/s", "displacement": "m", "angle": "rad"}
    return [data.chart(f"prescribed {kind}", units[kind], found) for kind, found in lines.items() if found]


def joined(names):
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"


def end_of(case, bodies):
    """The end of the case, of an endless one the time that was reached [s]."""
    end = data.table(case, "case").get("end_time", math.inf)
    reached = max((body["times"][-1] for body in bodies), default=0.0)
    return end if data.is_number(end) else reached
