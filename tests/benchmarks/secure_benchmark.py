"""What security costs: windows per second of runs that are authenticated, or encrypted too, against those without, in turn.

    PYTHONPATH=tools:tests secure_benchmark.py BIN [ROUNDS]

For the exchange alone (the strip of tests/participants between two programs that compute nothing) and for a case that
computes (cases/elastic_gate). A window takes what coupler.csv says of it: round trip and both sides' computing. Its time is
the median of the rows' lower half over all rounds, so that other programs on the machine count little."""
import csv
import pathlib
import statistics
import sys
import tempfile

from toryu import identities
from toryu_testing.process_case import LIMIT, NAMES, SOLVERS
from toryu_testing.trio import CASE, ROLES, Trio

TIMES = ("round_trip[s]", "fluid_compute[s]", "solid_compute[s]")
GATE = pathlib.Path(__file__).resolve().parents[2] / "cases/elastic_gate"
SETTINGS = ["case.checkpoint_interval=0", "case.checkpoint_every=0", "case.series_interval=0"]


def measure(bin_folder, names, case, end_time, extra):
    """Wall time of each row's window [s]."""
    programs = {role: bin_folder / (names | {"coupler": "coupler"})[role] for role in ROLES}
    with Trio(programs, case=case, end_time=end_time, settings=SETTINGS) as run:
        run.start_all([*extra, "--threads=1"])
        for role in ROLES:
            code, text = run.ending_of(role, 20 * LIMIT)
            if code:
                raise SystemExit(f"{role} ended with {code}: {text}")
        with open(run.out / "coupler.csv", encoding="utf-8") as file:
            return [sum(float(row[name]) for name in TIMES) for row in csv.DictReader(file)]


def compare(title, bin_folder, rounds, names, case, end_time, kinds):
    walls = {kind: [] for kind in kinds}
    for _ in range(rounds):
        for kind, extra in kinds.items():
            walls[kind] += measure(bin_folder, names, case, end_time, extra)
    window = {kind: statistics.median(sorted(rows)[:len(rows) // 2]) for kind, rows in walls.items()}
    print(title)
    for kind in kinds:
        print(f"  {kind:14} {1 / window[kind]:8.0f} windows/s {window['none'] / window[kind]:6.2f} of none", flush=True)


def main(bin_folder, rounds=5):
    with tempfile.TemporaryDirectory(prefix="toryu_identities_") as folder:
        folder = pathlib.Path(folder)
        identities.make(folder / "authenticated")
        identities.make(folder / "encrypted", encrypt=True)
        kinds = {"none": []} | {name: [f"--secure={folder / name}"] for name in ("authenticated", "encrypted")}
        places = pathlib.Path(bin_folder).resolve(), int(rounds)
        compare("exchange alone", *places, NAMES, CASE, "0.3", kinds)
        compare("cases/elastic_gate", *places, SOLVERS, GATE, "0.02", kinds)


if __name__ == "__main__":
    main(*sys.argv[1:])
