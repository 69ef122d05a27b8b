"""How far the plates of the elastic tank lean out, and how deep the box floats, against what is worked by hand.

    python3 cases/elastic_tank/elastic_tank.py out/elastic_tank out/elastic_tank_floating_box ...
"""
import csv
import dataclasses
import pathlib
import sys

WIDTH, HEIGHT, THICKNESS, GRAVITY, WATER = 0.6, 0.4, 0.05, 9.81, 1000.0  # between the plates, of them [m], [m/s2], [kg/m3]
NU = 0.3
SOFT, STIFF = (4e7, 1100.0), (8e7, 2000.0)  # E [Pa], density [kg/m3]
BOX = (0.2, 0.05, 0.06)  # width, depth at the start, depth afloat [m]


@dataclasses.dataclass
class Plate:
    tip: float  # how far it leans out [m]
    area: float  # between it and its place at rest, below the water's level [m2]


@dataclasses.dataclass
class State:
    left: float
    right: float
    draught: float = 0.0  # of the box, if there is one [m]


def plate(level, modulus, density):
    """A cantilever under the pressure of water: bending and shear (Timoshenko), made more by its own weight (Greenhill)."""
    D = modulus / (1 - NU**2) * THICKNESS**3 / 12
    shear = 5 / 6 * modulus / (2 * (1 + NU)) * THICKNESS
    q = WATER * GRAVITY * level
    lean = 1 / (1 - density * GRAVITY * THICKNESS * HEIGHT**3 / (7.837 * D))
    tip = q * level**4 / (30 * D) + q * level**3 / (24 * D) * (HEIGHT - level) + q * level**2 / (6 * shear)
    return Plate(lean * tip, lean * (q * level**5 / (72 * D) + q * level**3 / (8 * shear)))


def level_of(water, left, right):
    """Of as much water as there is, in the plane [m2], between the plates as they lean [m]."""
    level = water / WIDTH
    for _ in range(20):
        level = (water - plate(level, *left).area - plate(level, *right).area) / WIDTH
    return level


def water_with(draught):
    """What the water fills with what of the box is in it [m2]; without a box its draught is that of the start."""
    width, at_first, _ = BOX
    return WIDTH * 0.3 + width * (draught - at_first)


def expected(with_box, left=SOFT, right=STIFF):
    level = level_of(water_with(BOX[2] if with_box else BOX[1]), left, right)
    return State(plate(level, *left).tip, plate(level, *right).tip, BOX[2] if with_box else 0.0)


def found(rows, left=SOFT, right=STIFF):
    """Mean of the last half second."""
    late = [row for row in rows if row["time[s]"] >= rows[-1]["time[s]"] - 0.5]

    def mean(column):
        return sum(row[column] for row in late) / len(late)

    state = State(-mean("left tip_displacement_x[m]"), mean("right tip_displacement_x[m]"))
    if "box_displacement_y[m]" in late[0]:
        risen = mean("box_displacement_y[m]")
        for _ in range(20):
            state.draught = level_of(water_with(state.draught or BOX[1]), left, right) - (0.3 - BOX[1]) - risen
    return state


def rows_of(out):
    with open(pathlib.Path(out) / "solid.csv", encoding="utf-8") as file:
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


if __name__ == "__main__":
    for run in sys.argv[1:]:
        rows = rows_of(run)
        now = found(rows)
        exact = expected(now.draught != 0)
        for name in ("left", "right", "draught"):
            value, of = 1e3 * getattr(now, name), 1e3 * getattr(exact, name)
            if of:
                print(f"{run}: {name} {value:.4f} mm, expected {of:.4f} mm, {100 * (value / of - 1):+.2f} %")
