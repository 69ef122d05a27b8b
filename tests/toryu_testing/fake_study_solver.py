#!/usr/bin/python3
"""Stands for fluid_solver in the tests of studies: leaves the results of a made-up process in the time it is told.
Every start of a run is written into `starts.txt` beside it. What an overridden key does:

    fluid.x, fluid.y     the series: speed[m/s] = x + y t; any other key under fluid is an error
    fluid.seconds        how long the run takes
    fluid.fails          ends with that exit code
    fluid.step, fluid.k  an explicit oscillator: fails at 0.5 s if step * sqrt(k) is above 2; its energy grows above 1
    fluid.islands        but not if the step is at least that
    fluid.hangs          does not end by itself if above 0
    fluid.cost           processor time [s] that the summary states
    fluid.error          of the displacement's period, which is 1 s without; it loses a tenth of its amplitude a second
    fluid.checkpoints    writes one before it waits if above 0, a whole one if 1; restarted it does not wait
    fluid.refuses        does not restart if above 0
    fluid.removal.preston_coefficient
                         that times fluid.x comes off as well
    fluid.opens          a surface.h5 of a passage that opens: see made_up_surface.passage; the worn walls count
    fluid.unsteady       what the rate of that has too much at the start, over it; it is gone after 2 s
    fluid.sticks         it fails where a wall is worn by more than that [m]
    fluid.removes        a surface.h5 from which that depth [m] comes off in each cycle of 1 s, twice that at the corners
"""

import math
import pathlib
import signal
import sys
import time
import tomllib

KEYS = {"fluid.removal.preston_coefficient": 0.0,
        "fluid.x": 1.0, "fluid.y": 2.0, "fluid.seconds": 0.0, "fluid.fails": 0, "fluid.removes": 0.0,
        "fluid.step": 0.0, "fluid.k": 1.0, "fluid.islands": 1e9, "fluid.hangs": 0, "fluid.checkpoints": 0,
        "fluid.refuses": 0, "fluid.cost": 0.25, "fluid.error": 0.0, "fluid.opens": 0.0, "fluid.unsteady": 0.0,
        "fluid.sticks": 1e9}
COLUMNS = ("time[s]", "speed[m/s]", "force_from_piston_x[N/m]", "force_from_piston_y[N/m]", "swing[m]", "energy[J]")
PROMISED = ("pressure[Pa]", "removed_depth_mean[m]")  # by --columns, and in no series after all
HERE = pathlib.Path(__file__).resolve().parent
case, arguments = sys.argv[1], sys.argv[2:]
if case == "--version":
    print("fluid_solver of toryu 0.1.0 (commit 0123456789ab)")
    sys.exit(0)
values, faults, worn, end = dict(KEYS), [], [None, None], None
for pair in (a.removeprefix("--set=") for a in arguments if a.startswith("--set=")):
    key, _, value = pair.partition("=")
    if key in KEYS:
        values[key] = float(value)
    elif key.endswith(".worn"):
        worn[int(key.split(".")[1])] = tomllib.loads(f"faces = {value}")["faces"][0]["depth"]
    elif key == "case.end_time":
        end = float(value)
    elif not key.startswith(("case.", "wall.")):
        faults.append(f"--set {pair}: error: unknown key '{key.removeprefix('fluid.')}' in [fluid]")
if faults:
    print(*faults, sep="\n", file=sys.stderr)
    sys.exit(2)
if "--check" in arguments:
    if "--columns" in arguments:
        told = [*COLUMNS, *PROMISED, *["fast[1]"] * (values["fluid.x"] == 4)]
        print(*(f"fluid.csv:{column}" for column in told), sep="\n")
    sys.exit(0)

signal.signal(signal.SIGINT, lambda *_: sys.exit(130))
out = pathlib.Path(next(a.removeprefix("--out=") for a in arguments if a.startswith("--out=")))
with open(HERE / "starts.txt", "a") as starts:
    starts.write(out.name + "\n")
(out / "half.txt").write_text("a run that ends here is half done")
restart = "--restart" in arguments
if restart:
    with open(HERE / "restarts.txt", "a") as restarts:
        restarts.write(out.name + "\n")
    if values["fluid.refuses"]:
        sys.exit(2)
elif values["fluid.checkpoints"]:
    (out / "checkpoint/000001").mkdir(parents=True)
    if values["fluid.checkpoints"] == 1:
        (out / "checkpoint/000001/manifest.toml").touch()
time.sleep(0 if restart else values["fluid.seconds"])
while values["fluid.hangs"]:
    if (out / "stop").exists():
        sys.exit(130)
    time.sleep(0.1)
code = int(values["fluid.fails"])
speed = values["fluid.step"] * math.sqrt(values["fluid.k"]) if values["fluid.step"] < values["fluid.islands"] else 0
code = 3 if speed > 2 else code
code = 3 if any(row[1] > values["fluid.sticks"] for rows in worn if rows for row in rows) else code

END = end or 3.0
times = [END * k / 300 for k in range(301)]
rows = [f"{t},{values['fluid.x'] + values['fluid.y'] * t},0,{300 * values['fluid.x'] * min(t, 1.5)},"
        f"{0.9 ** t * math.sin(2 * math.pi * t / (1 + values['fluid.error']))},{1 + (10 * t if speed > 1 else 0)}"
        for t in times]
(out / "fluid.csv").write_text("\n".join([",".join(COLUMNS), *rows]))
(out / "used_case.toml").write_text('[[wall]]\nname = "piston"\nmotion = { time = 0.5 }\n'
                                  '[fluid.removal]\nroughness = { initial = 2e-6, final = 5e-7, decay_depth = 1e-5 }\n')
(out / "fluid_summary.toml").write_text(f"""participant = "fluid"
exit_code = {code}
end_reason = "{'particle 7 left the domain' if code else ''}"
simulated_time = {0.5 if code else END}
wall_time = 0.5
waiting_time = 0.0
processor_time = {values['fluid.cost']}
steps = 300
smallest_time_step = 1e-3
largest_time_step = 1e-3
time_step_rule = "acoustic"
[figures]
largest_speed = {values['fluid.x'] * 3}
[provenance]
cpu = "a made-up processor"
compiler = "GNU 12.2.0"
""")
if removes := values["fluid.removes"] + values["fluid.removal.preston_coefficient"] * values["fluid.x"]:
    from toryu_testing import made_up_surface  # imports h5py, which takes its time
    made_up_surface.write(out / "surface.h5", times, removes)
if values["fluid.opens"]:
    from toryu_testing import made_up_surface
    made_up_surface.write_passage(out / "surface.h5", times, values["fluid.opens"], worn, values["fluid.unsteady"])
if code:
    print("fluid_solver: error: particle 7 left the domain", file=sys.stderr)
sys.exit(code)
