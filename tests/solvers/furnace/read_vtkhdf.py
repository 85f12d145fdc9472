# SPDX-License-Identifier: MIT
"""read_vtkhdf.py FOLDER: reads the last frame of a run with VTK's own reader, the one inside ParaView, and checks it against
the run's history."""
import csv
import glob
import math
import sys

from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter
from vtkmodules.vtkIOHDF import vtkHDFReader


def last(folder, stem):
    reader = vtkHDFReader()
    reader.SetFileName(sorted(glob.glob(f"{folder}/{stem}_*.hdf"))[-1])
    reader.Update()
    return reader.GetOutput()


def values(data, name):
    array = data.GetArray(name)
    assert array is not None, f"no {name}"
    return [array.GetValue(i) for i in range(array.GetNumberOfTuples())]


folder = sys.argv[1]
with open(f"{folder}/history.csv", newline="") as file:
    end = list(csv.DictReader(file))[-1]

particles, cells = last(folder, "particles"), last(folder, "cells")
assert particles.GetNumberOfCells() == particles.GetNumberOfPoints() > 100
assert cells.GetNumberOfCells() > 100 and cells.GetCellType(0) == 12
temperature = values(particles.GetPointData(), "temperature_K")
hottest = max(range(len(temperature)), key=temperature.__getitem__)
# Single precision keeps seven digits.
assert abs(temperature[hottest] - float(end["peak_particle_temperature_K"])) < 1e-3, temperature[hottest]
assert abs(particles.GetPoint(hottest)[2] - float(end["peak_height_m"])) < 1e-5
assert min(values(particles.GetPointData(), "diameter_m")) > 0
pressure = values(cells.GetCellData(), "pressure_Pa")
assert 0.5 < (max(pressure) - min(pressure)) / float(end["pressure_drop_Pa"]) < 1.1
assert all(0 < e <= 1 for e in values(cells.GetCellData(), "void_fraction"))
time = cells.GetFieldData().GetArray("TimeValue")
assert time is not None and abs(time.GetValue(0) - float(end["process_time_s"])) < 1e-6 * time.GetValue(0)
# The hexahedra fill a shaft 10 m high and 0.85 m wide, and none is inside out.
size = vtkCellSizeFilter()
size.SetInputData(cells)
size.Update()
volumes = values(size.GetOutput().GetCellData(), "Volume")
assert min(volumes) > 0
assert abs(sum(volumes) - math.pi / 4 * 0.85**2 * 10) < 1e-4 * sum(volumes)
