"""What a run left as numpy arrays with units, for scripts:

    run = toryu.results.read("out/elastic_gate")
    tip = run.series("solid")["tip_displacement_x"]      # tip.unit == "m"
    last = run.frames("fluid")[-1]                       # last.time, last.position, last["pressure"]
    run.interface()["force"]                             # times x particles x 2
    run.summaries()["solid"]["wall_time"]
"""

import functools
import pathlib

import h5py
import numpy as np

from toryu import nearest, results


class Values(np.ndarray):
    """An array with the unit of its values, "1" for plain numbers. Parts of it keep the unit; what is computed of it is a plain
    array."""

    unit = ""

    def __new__(cls, values, unit):
        made = np.asarray(values).view(cls)
        made.unit = unit
        return made

    def __array_finalize__(self, other):
        self.unit = getattr(other, "unit", "")

    def __array_wrap__(self, values, context=None):
        return np.asarray(values)[()]

    def __repr__(self):
        return f"{np.asarray(self)!r} [{self.unit}]"


class Named(dict):
    """Values by their names; what is not among them is told with the nearest."""

    def __missing__(self, name):
        raise KeyError(f"no '{name}'{nearest(str(name), list(self))}")


class Frame:
    """The particles of one body at one time."""

    def __init__(self, time, path):
        self.time, self.path = time, path  # [s]

    @functools.cached_property
    def position(self):
        with h5py.File(self.path) as file:
            return Values(file["VTKHDF/Points"][:, :2], "m")

    def fields(self):
        with h5py.File(self.path) as file:
            return list(file["VTKHDF/PointData"])

    def __getitem__(self, name):
        """A field: n numbers, n x 2 of a vector, n x 2 x 2 of a tensor."""
        with h5py.File(self.path) as file:
            field = Named(file["VTKHDF/PointData"])[name]
            values, unit = field[:], unit_of(field)
        if values.ndim == 2:
            values = values[:, :2] if values.shape[1] == 3 else values.reshape(-1, 2, 2)
        return Values(values, unit)

    def __repr__(self):
        return f"Frame({self.time:g} s, {self.path})"


def unit_of(dataset):
    unit = dataset.attrs.get("unit", b"")
    return unit.decode() if isinstance(unit, bytes) else str(unit)


class Results:
    """The folder of a run. What is not there is a FileNotFoundError, what is damaged a ValueError that says how."""

    def __init__(self, out):
        self.out = pathlib.Path(out)
        if not self.out.is_dir():
            raise FileNotFoundError(f"{out}: no such folder of results")

    def series(self, name):
        """Column -> values of NAME.csv ("fluid", "solid", "coupler"), "time" among them."""
        columns = self._read(f"{name}.csv", results.read_series, name)
        return Named({column.partition("[")[0]: Values(values, results.unit_of(column)) for column, values in columns.items()})

    def frames(self, name):
        """The frames of a body ("fluid", "solid", "walls") in the order of time."""
        return [Frame(*frame) for frame in self._read(f"{name}.hdf.series", results.list_frames, name)]

    def interface(self):
        """What is in interface.h5: name -> values, those over time by "time"."""
        return self._datasets("interface.h5")

    def surface(self):
        """The same of surface.h5."""
        return self._datasets("surface.h5")

    def summaries(self):
        """Participant -> what its summary says."""
        return self._read("*_summary.toml", results.read_summaries)

    def __repr__(self):
        return f"Results({str(self.out)!r})"

    def _read(self, file, reader, *arguments):
        faults = []
        found = reader(self.out, *arguments, faults=faults)
        if not found:
            if not any(self.out.glob(f"{file}*")):
                raise FileNotFoundError(f"{self.out / file}: the run left none")
            raise ValueError(f"{self.out}: " + "; ".join(faults))
        return found

    def _datasets(self, name):
        path = results.newest(self.out / name)
        if path is None:
            raise FileNotFoundError(f"{self.out / name}: the run left none")
        try:
            with h5py.File(path) as file:
                return Named({key: Values(dataset[()], unit_of(dataset)) for key, dataset in file.items()})
        except results.DAMAGED as error:
            raise ValueError(f"{path} cannot be read: {error}") from None
