# SPDX-License-Identifier: MIT
"""Reads particles.hdf with VTK's own reader, the one inside ParaView, and compares it with particles.txt.  Ends with 77 where
python3-vtk9 is not there."""
import sys

try:
    from vtkmodules.vtkIOHDF import vtkHDFReader
except ImportError:
    sys.exit(77)

with open("particles.txt") as file:
    time, *rows = [[float(word) for word in line.split()] for line in file]

reader = vtkHDFReader()
reader.SetFileName("particles.hdf")
reader.Update()
grid = reader.GetOutput()
assert grid.GetNumberOfPoints() == grid.GetNumberOfCells() == len(rows) > 100
assert grid.GetFieldData().GetArray("TimeValue").GetValue(0) == time[0]
fields = {name: grid.GetPointData().GetArray(name) for name in
          ("id", "diameter_m", "temperature_K", "velocity_m_per_s", "spin_rad_per_s", "contacts")}
for i, (number, x, y, z, diameter, temperature, vx, vy, vz, contacts) in enumerate(rows):
    assert grid.GetPoint(i) == (x, y, z)
    assert fields["id"].GetValue(i) == number
    # Single precision keeps seven digits.
    assert abs(fields["diameter_m"].GetValue(i) - diameter) < 1e-7 * diameter
    assert abs(fields["temperature_K"].GetValue(i) - temperature) < 1e-7 * temperature
    for found, expected in zip(fields["velocity_m_per_s"].GetTuple3(i), (vx, vy, vz)):
        assert abs(found - expected) <= 1e-7 * abs(expected)
    assert fields["contacts"].GetValue(i) == contacts
