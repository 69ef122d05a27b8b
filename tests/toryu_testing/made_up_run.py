"""Results of a run that never was: a swinging plate and a sloshing block of water, in the formats of common/output."""

import json
import math

import h5py
import numpy as np

CASE = """[case]
title = "A made-up gate & its water"
gravity = [0.0, -9.81]
end_time = 0.4
domain = {{ min = [-0.1, -0.1], max = [0.9, 0.4] }}
{fluid}{solid}
[[wall]]
name = "floor"
box = {{ min = [-0.01, -0.01], max = [0.3, 0.0] }}
[[wall]]
name = "piston"
box = {{ min = [-0.01, 0.0], max = [0.0, 0.16] }}
motion = {{ velocity = [[0.0, 0.0, 0.0], [0.4, 0.05, 0.0]] }}
"""
REFERENCE = """[[reference]]
label = "Somebody 2007"
file = "reference/measured.csv"
series = "solid.csv:tip_displacement_x[m]"
column = "x_m"
"""
SPACING = {"fluid": 0.0025, "solid": 0.00125}


def case_text(sides):
    text = CASE.format(**{side: f"[{side}]\nspacing = {SPACING[side]}\n" if side in sides else ""
                          for side in ("fluid", "solid")})
    return text + (REFERENCE if "solid" in sides else "")


def make_case(folder, sides=("fluid", "solid")):
    folder.mkdir(parents=True)
    (folder / "case.toml").write_text(case_text(sides))
    make_reference(folder)


def make_reference(folder):
    (folder / "reference").mkdir(exist_ok=True)
    points = "".join(f"{t:.2f},{1.1 * tip(t)[0]:.6f}\n" for t in np.arange(0, 0.5, 0.04))
    (folder / "reference/measured.csv").write_text("# made up\nt_s,x_m\n" + points)


def tip(time):
    return 0.04 * math.sin(math.pi * time / 0.3) ** 2, 0.015 * math.sin(math.pi * time / 0.3) ** 2


def lattice(x0, y0, x1, y1, spacing):
    xs, ys = np.arange(x0 + spacing / 2, x1, spacing), np.arange(y0 + spacing / 2, y1, spacing)
    return np.stack(np.meshgrid(xs, ys), axis=-1).reshape(-1, 2)


def fluid(time):
    x = lattice(0, 0, 0.1, 0.14, SPACING["fluid"])
    moved = x * [1 + 1.5 * time, 1 / (1 + 1.5 * time)] + [0.0125 * time, 0.004 * np.sin(20 * time)] * x / 0.1
    depth = moved[:, 1].max() - moved[:, 1]
    velocity = np.column_stack([1.5 * x[:, 0], -1.5 * x[:, 1]])
    return moved, {"particle": ("1", np.arange(len(x))), "pressure": ("Pa", 9810 * depth),
                   "density": ("kg/m3", 1000 + depth), "velocity": ("m/s", velocity)}


def solid(time):
    x = lattice(0.1, 0.001, 0.105, 0.08, SPACING["solid"])
    share = ((0.08 - x[:, 1]) / 0.08) ** 2
    moved = x + np.outer(share, tip(time))
    stress = np.zeros((len(x), 4))
    stress[:, 3] = 1e6 * (x[:, 0] - 0.1025) / 0.0025 * tip(time)[0] / 0.04 * x[:, 1] / 0.08
    return moved, {"von_mises_stress": ("Pa", np.abs(stress[:, 3])), "stress": ("Pa", stress),
                   "displacement": ("m", np.outer(share, tip(time)))}


def write_frame(path, points, fields):
    wide = lambda v: np.column_stack([v, np.zeros(len(v))]) if v.ndim == 2 and v.shape[1] == 2 else v
    with h5py.File(path, "w") as file:
        file["VTKHDF/Points"] = wide(points)
        for name, (unit, values) in fields.items():
            file[f"VTKHDF/PointData/{name}"] = wide(values).astype("f4")
            file[f"VTKHDF/PointData/{name}"].attrs["unit"] = np.bytes_(unit)


def write_frames(out, name, body, times):
    (out / "frames").mkdir(parents=True, exist_ok=True)
    files = []
    for i, time in enumerate(times):
        files.append({"name": f"frames/{name}_{i:06}.hdf", "time": float(time)})
        write_frame(out / files[-1]["name"], *body(time))
    (out / f"{name}.hdf.series").write_text(json.dumps({"file-series-version": "1.0", "files": files}))


def write_series(out, name, columns, ending=".csv"):
    rows = [",".join(columns)] + [",".join(repr(float(v)) for v in row) for row in zip(*columns.values())]
    (out / f"{name}{ending}").write_text("\n".join(rows) + "\n")


def write_summary(out, participant, exit_code=0, words="", waiting=0.0, end=0.4):
    (out / f"{participant}_summary.toml").write_text(f"""participant = "{participant}"
exit_code = {exit_code}
end_reason = "{words}"
simulated_time = {end}
wall_time = 61.5
waiting_time = {waiting}
processor_time = 52.0
steps = 12800
smallest_time_step = 2.9e-05
largest_time_step = 3.4e-05
time_step_rule = "acoustic"
[provenance]
version = "0.1.0"
commit = "abc1234"
compiler = "GNU 12.2.0"
flags = "-O3 -march=native"
cpu = "a made-up processor"
threads = {1 if participant == "solid" else 2}
[particles]
"{participant}" = 2240
"wall floor" = 372
[figures]
"largest_impulse_error" = 3.1e-16
[[term]]
name = "artificial viscosity"
formula = "-m_j Pi_ij grad_i W_ij, Pi_ij = -alpha c h v_ij.x_ij / (rho_ij (r_ij^2 + eta^2))"
source = "Monaghan 1992, eq. 4.1"
parameters = "alpha 0.02, beta 0; effective kinematic viscosity 1.3e-6 m2/s"
[[term]]
name = "gravity"
formula = "g"
source = "-"
parameters = "(0, -9.81) m/s2"
[[part]]
name = "momentum"
seconds = 21.0
calls = 25600
[[part]]
name = "density gradient"
seconds = 12.5
calls = 25600
[[part]]
name = "neighbours"
seconds = 4.0
calls = 310
""")


def make_results(out, sides=("fluid", "solid"), end=0.4, frames=21, rows=801):
    """A complete run."""
    out.mkdir(parents=True, exist_ok=True)
    times = np.linspace(0, end, rows)
    for side, body in (("fluid", fluid), ("solid", solid)):
        if side not in sides:
            continue
        write_frames(out, side, body, np.linspace(0, end, frames))
        columns = {"time[s]": times, "kinetic_energy[J/m]": 3 * np.sin(8 * times) ** 2,
                   "potential_energy[J/m]": 9 - 3 * np.sin(8 * times) ** 2, "momentum_x[N.s/m]": 2 * np.sin(8 * times),
                   "momentum_y[N.s/m]": -np.sin(16 * times), "leaked_mass[kg/m]": 0 * times}
        if side == "solid":
            columns |= {f"tip_displacement_{axis}[m]": [tip(t)[i] for t in times] for i, axis in enumerate("xy")}
        write_series(out, side, columns)
        write_summary(out, side, waiting=14.2 if len(sides) > 1 else 0.0, end=end)
    if len(sides) > 1:
        write_series(out, "coupler", {"time[s]": times, "window_length[s]": 3e-5 + 0 * times,
                                      "round_trip[s]": 7e-5 + 1e-5 * np.sin(90 * times)})
        write_summary(out, "coupler", waiting=57.0, end=end)
    (out / "used_case.toml").write_text(case_text(sides))
    make_reference(out)
    (out / "log.txt").write_text("2026-01-01 10:00:00.000 fluid_solver info: 2240 particles\n")
