"""Results written by the C++ code, read as a user reads them: VTK (ParaView), h5py, csv, tomllib."""

import csv
import json
import math
import os
import pathlib
import subprocess
import tempfile
import tomllib
import unittest

import h5py
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOHDF import vtkHDFReader

POINTS = [[0, 0.1, 0], [1, 1.1, 0], [2, 2 + 1e-12, 0]]


def read_by_vtk(path):
    reader = vtkHDFReader()
    assert reader.CanReadFile(str(path)), f"VTK refuses {path}"
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


class Results(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.out = pathlib.Path(folder.name)
        subprocess.run([os.environ["SAMPLE_WRITER"], cls.out], check=True)

    def test_series_names_the_frames(self):
        series = json.loads((self.out / "fluid.hdf.series").read_text())
        self.assertEqual(series["file-series-version"], "1.0")
        self.assertEqual([f["time"] for f in series["files"]], [0, 0.005])
        for file in series["files"]:
            self.assertTrue((self.out / file["name"]).is_file())

    def test_vtk_reads_points_and_cells(self):
        grid = read_by_vtk(self.out / "frames/fluid_000001.hdf")
        np.testing.assert_array_equal(vtk_to_numpy(grid.GetPoints().GetData()), POINTS)
        self.assertEqual(grid.GetNumberOfCells(), 3)
        for i in range(3):
            self.assertEqual(grid.GetCell(i).GetClassName(), "vtkVertex")
            self.assertEqual(grid.GetCell(i).GetPointId(0), i)

    def test_vtk_reads_fields(self):
        data = read_by_vtk(self.out / "frames/fluid_000000.hdf").GetPointData()
        self.assertEqual(data.GetNumberOfArrays(), 3)
        field = lambda name: vtk_to_numpy(data.GetArray(name)).tolist()
        self.assertEqual(field("pressure"), [10, -20, 30.5])
        self.assertEqual(field("velocity"), [[1, 2, 0], [3, 4, 0], [5, 6, 0]])
        self.assertEqual(field("stress"), [[1, 2, 3, 4], [5, 6, 7, 8], [9, 10, 11, 12]])

    def test_vtk_reads_compressed_chunks(self):
        grid = read_by_vtk(self.out / "frames/large_000000.hdf")
        self.assertEqual(grid.GetNumberOfCells(), 40000)
        number = vtk_to_numpy(grid.GetPointData().GetArray("number"))
        np.testing.assert_array_equal(number, np.arange(40000))
        np.testing.assert_array_equal(vtk_to_numpy(grid.GetPoints().GetData())[:, 1], -0.25 * np.arange(40000))

    def test_h5py_reads_units_and_provenance(self):
        with h5py.File(self.out / "frames/fluid_000001.hdf") as frame:
            self.assertEqual(frame["VTKHDF/PointData/pressure"].attrs["unit"], b"Pa")
            self.assertEqual(frame["VTKHDF/PointData/pressure"].attrs["description"], b"thermodynamic pressure")
            self.assertEqual(frame["VTKHDF/PointData/velocity"].attrs["description"], b"")
            self.assertEqual(frame["VTKHDF/Points"].dtype, np.float64)
            provenance = dict(frame["provenance"].attrs)
        self.assertEqual(provenance["commit"], b"abc1234")
        self.assertEqual(provenance["cpu"], b'some "cpu"')
        self.assertEqual(provenance["threads"], 2)
        self.assertEqual(provenance["time[s]"], 0.005)

    def test_csv_reads_back_exactly(self):
        with open(self.out / "fluid.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([float(r["time[s]"]) for r in rows], [0, 0.005])
        self.assertEqual([float(r["kinetic_energy[J/m]"]) for r in rows], [0.1, 0.1 + 0.005])
        self.assertEqual(float(rows[0]["momentum_x[N.s/m]"]), -1e-300)

    def test_summary_is_toml(self):
        summary = tomllib.loads((self.out / "fluid_summary.toml").read_text())
        self.assertEqual(summary["end_reason"], 'particle 7: "speed" = 1e3\n\tbeyond C:\\limit \x01')
        self.assertEqual(summary["particles"], {"fluid": 3, "wall tank_floor": 320})
        self.assertEqual(summary["figures"], {"largest_impulse_error": 1.5e-16, "windows": 40.0})
        self.assertEqual([t["name"] for t in summary["term"]], ["gravity", "pressure"])
        self.assertEqual(summary["term"][1]["formula"], "-grad p / ρ")
        self.assertEqual(summary["part"], [{"name": "density gradient", "seconds": 1.25, "calls": 200}])
        self.assertIsInstance(summary["simulated_time"], float)
        self.assertTrue(math.isinf(summary["smallest_time_step"]) and math.isnan(summary["largest_time_step"]))

    def test_no_temporary_file_is_left(self):
        self.assertEqual(list(self.out.rglob("*.part")), [])


if __name__ == "__main__":
    unittest.main()
