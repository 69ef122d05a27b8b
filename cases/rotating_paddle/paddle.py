"""Moment and bending of the rotating paddle, from the results of runs.

    python3 cases/rotating_paddle/paddle.py out/rotating_paddle ...
"""
import csv
import math
import pathlib
import sys

LENGTH, SPEED, RAMP = 0.064, 2.0, 0.4  # of a blade from the middle [m], of the hub [rad/s], until it is reached [s]
QUARTER = 0.5 * math.pi / SPEED  # in which the square tank looks the same [s]


def rows(path):
    with open(path, encoding="utf-8") as file:
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


def angle(time):
    return SPEED * (0.5 * time * time / RAMP if time < RAMP else time - 0.5 * RAMP)


def at(table, column, time):
    """Value between two rows."""
    for a, b in zip(table, table[1:]):
        if a["time[s]"] <= time <= b["time[s]"]:
            share = (time - a["time[s]"]) / (b["time[s]"] - a["time[s]"])
            return a[column] + share * (b[column] - a[column])
    raise ValueError(f"{column} at {time} s")


def moment_of_work(solid, begin, end):
    """By what a turning solid has given to the medium [N.m/m]."""
    work = at(solid, "interface_work[J/m]", begin) - at(solid, "interface_work[J/m]", end)
    return work / (angle(end) - angle(begin))


def moment_of_wall(fluid, begin, end):
    late = [row["moment_from_hub[N.m/m]"] for row in fluid if begin < row["time[s]"] <= end]
    return sum(late) / len(late)


def mean_moment(folder):
    """On the medium, mean of the last quarter turn [N.m/m]."""
    folder = pathlib.Path(folder)
    fluid = rows(folder / "fluid.csv")
    end = fluid[-1]["time[s]"]
    if (folder / "solid.csv").exists():
        return moment_of_work(rows(folder / "solid.csv"), end - QUARTER, end)
    return moment_of_wall(fluid, end - QUARTER, end)


def bending(folder, blade="right tip"):
    """How far the tip stays behind its place on a rigid paddle, mean of the last quarter turn [m]."""
    table = rows(pathlib.Path(folder) / "solid.csv")
    side = 1 if blade == "right tip" else -1
    late = [row for row in table if row["time[s]"] > table[-1]["time[s]"] - QUARTER]
    behind = []
    for row in late:
        turn = angle(row["time[s]"])
        x = side * LENGTH + row[f"{blade}_displacement_x[m]"]
        y = row[f"{blade}_displacement_y[m]"]
        behind.append(-side * (math.cos(turn) * y - math.sin(turn) * x))
    return sum(behind) / len(behind)


if __name__ == "__main__":
    for run in sys.argv[1:]:
        bent = f", tip {1e3 * bending(run):.3f} mm behind" if (pathlib.Path(run) / "solid.csv").exists() else ""
        print(f"{run}: moment {mean_moment(run):.4f} N.m/m{bent}")
