"""Writes a unit cube of about CELLS Delaunay tetrahedra with a smooth field, as VTU.

usage: make_cube.py CELLS FILE.vtu
Points are random but for a grid on the cube's sides, so that its hull is the cube.
"""

import sys

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk


def points(cells):
    count = max(cells / 6.5, 64)
    side = max(int(round(count ** (1 / 3) / 1.6)), 3)
    axis = np.linspace(0, 1, side)
    grid = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), -1).reshape(-1, 3)
    hull = grid[((grid == 0) | (grid == 1)).any(axis=1)]
    inner = np.random.default_rng(1).random((int(count) - len(hull), 3)) * 0.98 + 0.01
    return np.concatenate([hull, inner])


def main():
    cells, path = int(sys.argv[1]), sys.argv[2]
    p = points(cells)
    value = 0.5 + 0.2 * np.sin(5 * p[:, 0]) * np.cos(4 * p[:, 1] + 1) + 0.25 * np.sin(3 * p[:, 2] + p[:, 0])
    cloud = vtk.vtkUnstructuredGrid()
    vertices = vtk.vtkPoints()
    vertices.SetData(numpy_to_vtk(np.ascontiguousarray(p, dtype=np.float32), deep=True))
    cloud.SetPoints(vertices)
    field = numpy_to_vtk(value.astype(np.float32), deep=True)
    field.SetName("smooth")
    cloud.GetPointData().SetScalars(field)
    mesher = vtk.vtkDelaunay3D()
    mesher.SetInputData(cloud)
    writer = vtk.vtkXMLUnstructuredGridWriter()
    writer.SetInputConnection(mesher.GetOutputPort())
    writer.SetFileName(path)
    writer.Write()


main()
