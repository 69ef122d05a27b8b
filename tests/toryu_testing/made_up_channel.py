"""Results of an abrasive flow run that never was: pistons push a medium past two work pieces, rigid or elastic."""

import h5py
import numpy as np

from toryu_testing.made_up_run import lattice, write_frames, write_series, write_summary
from toryu_testing.made_up_surface import standing

END, SPEED, SPACING = 2.35, 0.05, 1e-3
PROFILE = [[0, 0], [0.475, 1], [0.7, 1], [1.65, -1], [1.875, -1], [2.35, 0]]  # time [s], share of SPEED
WALLS = {"lower_piston": (0, -0.071, 0.017, -0.068), "upper_piston": (0, 0.033, 0.017, 0.036),
         "left_wall": (-0.003, -0.0945, 0, 0.0945), "right_wall": (0.017, -0.0945, 0.02, 0.0945)}
PIECES = {"left_work_piece": (0, -0.012, 0.004, 0.012), "right_work_piece": (0.013, -0.012, 0.017, 0.012)}


def make_case(folder, elastic=False):
    folder.mkdir(parents=True)
    (folder / "case.toml").write_text(case(elastic))


def case(elastic):
    rows = ", ".join(f"[{t}, 0.0, {v}]" for t, v in PROFILE)
    text = f'[case]\ntitle = "Made-up abrasive flow"\nend_time = {END}\n[fluid]\nspacing = {SPACING}\n'
    text += f"[solid]\nspacing = {SPACING}\n" if elastic else ""
    for name, (x0, y0, x1, y1) in (WALLS if elastic else WALLS | PIECES).items():
        text += f'[[wall]]\nname = "{name}"\nbox = {{ min = [{x0}, {y0}], max = [{x1}, {y1}] }}\n'
        if "piston" in name:
            text += f"motion = {{ velocity = [{rows}], speed = {SPEED} }}\n"
        if name in PIECES:
            text += "work_piece = true\n"
    return text


def velocity(time):
    """Of the pistons [m/s]."""
    return SPEED * np.interp(time, *np.transpose(PROFILE))


def displacement(time):
    times = np.linspace(0, time, 400)
    return np.trapz(velocity(times), times)


def fluid(time):
    x = lattice(0, -0.068, 0.017, 0.033, SPACING)
    x = x[(np.abs(x[:, 1]) > 0.012) | ((x[:, 0] > 0.004) & (x[:, 0] < 0.013))]
    v, moved = velocity(time), displacement(time)
    narrow = np.exp(-((x[:, 1] + moved) / 0.015) ** 4)  # squeezed into the throat
    moved = np.column_stack([0.0085 + (x[:, 0] - 0.0085) * (1 - 0.45 * narrow), x[:, 1] + moved])
    pressure = 400 - 3000 * v * moved[:, 1] / 0.05 + 20 * np.sin(900 * x[:, 0] + 30 * time)
    speed = np.column_stack([0 * pressure, v * (1 + narrow)])
    return moved, {"particle": ("1", np.arange(len(x))), "pressure": ("Pa", pressure), "velocity": ("m/s", speed)}


def solid(time):
    x = np.concatenate([lattice(*box, SPACING) for box in PIECES.values()])
    depth = np.minimum(x[:, 0], 0.017 - x[:, 0])
    u = np.column_stack([0 * depth, 1e-7 * velocity(time) / SPEED * depth / 0.004])
    return x + u, {"von_mises_stress": ("Pa", 50 * np.abs(velocity(time)) / SPEED * (0.004 - depth) / 0.004),
                   "displacement": ("m", u)}


def write_surface(out, names, times):
    """surface.h5 as the fluid solver writes it."""
    pieces = [standing(side, spacing=SPACING) for side in ("left", "right")]
    position, normal, area = (np.concatenate([piece[k] for piece in pieces]) for k in range(3))
    owner = np.repeat([0, 1] if len(names) > 1 else [0, 0], len(position) // 2)
    pressure = 400 + 150 * np.outer(np.sin(40 * times), position[:, 1] / 0.012) + 10 * np.sin(7e3 * position[:, 1])
    share = 0.4 + 0.6 * np.exp(-((np.minimum(position[:, 0], 0.017 - position[:, 0]) - 0.0035) / 0.002) ** 2)
    speed = np.outer(np.abs(velocity(times)), 1.9 * share)
    summed = np.cumsum(pressure * speed * np.gradient(times)[:, None], axis=0)
    series = {"contact_pressure": ("Pa", pressure), "sliding_speed": ("m/s", speed),
              "sliding_pressure": ("Pa.m", summed), "friction_work": ("J/m2", 0.2 * summed), "preston_depth": ("m", 1e-11 * summed)}
    with h5py.File(out / "surface.h5", "w") as file:
        for name, (unit, values) in {"start_position": ("m", position), "area": ("m", area), "normal": ("1", normal),
                                     "work_piece": ("1", owner), "time": ("s", times), **series}.items():
            file[name] = values
            file[name].attrs["unit"] = np.bytes_(unit)
        file["work_piece"].attrs["names"] = np.bytes_(";".join(names))
    return 1e-11 * summed


def make_results(out, elastic=False, frames=12):
    out.mkdir(parents=True)
    (out / "used_case.toml").write_text(case(elastic))
    times = np.linspace(0, END, 236)
    depth = write_surface(out, ["interface"] if elastic else list(PIECES), times)
    columns = {"time[s]": times, "removed_depth_mean[m]": depth.mean(axis=1),
               "removed_depth_largest[m]": depth.max(axis=1)}
    for name in WALLS if elastic else WALLS | PIECES:
        columns[f"force_from_{name}_x[N/m]"] = 0 * times
        columns[f"force_from_{name}_y[N/m]"] = (9 if "upper" in name else -9) * 17 * velocity(times)
    write_series(out, "fluid", columns)
    for name, body in [("fluid", fluid), ("solid", solid)][:2 if elastic else 1]:
        write_frames(out, name, body, np.linspace(0, END, frames))
        write_summary(out, name, end=END)
