"""Draws an orbit with one VTK mapper; prints one JSON line. Needs a display: compare.py gives one.

usage: vtk_frames.py DATA.vtu FIELD CAMERA.json MAP.tf WIDTH HEIGHT MAPPER FRAMES ORBIT [RGBA.u8]
MAPPER: linear, partial, preintegration (vtkUnstructuredGridVolumeRayCastMapper with that ray
integrator), projected (vtkProjectedTetrahedraMapper), contour (vtkContourFilter and its polygons, the
level changing from frame to frame: extraction is part of the time).
"""

import json
import math
import sys
import time

import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

INTEGRATORS = {
    "linear": vtk.vtkUnstructuredGridLinearRayIntegrator,
    "partial": vtk.vtkUnstructuredGridPartialPreIntegration,
    "preintegration": vtk.vtkUnstructuredGridPreIntegration,
}


def load(path, name):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    whole = reader.GetOutput()
    grid = vtk.vtkUnstructuredGrid()
    grid.CopyStructure(whole)
    array = whole.GetPointData().GetArray(name)
    grid.GetPointData().SetScalars(array)
    return grid


def volume(grid, table, mapper_name):
    largest = max(row[4] for row in table)
    colour, opacity = vtk.vtkColorTransferFunction(), vtk.vtkPiecewiseFunction()
    for value, r, g, b, extinction in table:
        colour.AddRGBPoint(value, r, g, b)
        opacity.AddPoint(value, extinction / largest)
    properties = vtk.vtkVolumeProperty()
    properties.SetInterpolationTypeToLinear()
    properties.SetColor(colour)
    properties.SetScalarOpacity(opacity)
    # Extinction of a world unit is opacity over this distance.
    properties.SetScalarOpacityUnitDistance(1.0 / largest)
    if mapper_name == "projected":
        mapper = vtk.vtkProjectedTetrahedraMapper()
    else:
        mapper = vtk.vtkUnstructuredGridVolumeRayCastMapper()
        mapper.SetRayIntegrator(INTEGRATORS[mapper_name]())
        mapper.SetAutoAdjustSampleDistances(0)
        mapper.SetImageSampleDistance(1.0)
        mapper.SetIntermixIntersectingGeometry(0)
    mapper.SetInputData(grid)
    actor = vtk.vtkVolume()
    actor.SetProperty(properties)
    actor.SetMapper(mapper)
    return actor


def turned(camera, degrees):
    axis = np.array(camera["up"], float)
    axis /= np.linalg.norm(axis)
    center = np.array(camera["center"], float)
    arm = np.array(camera["eye"], float) - center
    angle = math.radians(degrees)
    return center + arm * math.cos(angle) + np.cross(axis, arm) * math.sin(angle) + axis * np.dot(
        axis, arm) * (1 - math.cos(angle))


def main():
    data, field, camera_file, map_file, width, height, mapper_name, frames, orbit = sys.argv[1:10]
    with open(camera_file) as file:
        camera = json.load(file)
    with open(map_file) as file:
        table = [[float(x) for x in line.split()] for line in file if line.split() and line[0] != "#"]
    grid = load(data, field)
    window, renderer = vtk.vtkRenderWindow(), vtk.vtkRenderer()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetAlphaBitPlanes(1)
    window.SetSize(int(width), int(height))
    renderer.SetBackgroundAlpha(0.0)
    window.AddRenderer(renderer)
    contour = None
    if mapper_name == "contour":
        contour = vtk.vtkContourFilter()
        contour.SetInputData(grid)
        contour.ComputeScalarsOff()
        contour.ComputeNormalsOff()
        polygons, actor = vtk.vtkPolyDataMapper(), vtk.vtkActor()
        polygons.SetInputConnection(contour.GetOutputPort())
        polygons.ScalarVisibilityOff()
        actor.SetMapper(polygons)
        renderer.AddActor(actor)
    else:
        renderer.AddVolume(volume(grid, table, mapper_name))
    view = renderer.GetActiveCamera()
    low, high = grid.GetPointData().GetScalars().GetRange()

    def draw(k):
        view.SetPosition(*turned(camera, k * float(orbit)))
        view.SetFocalPoint(*camera["center"])
        view.SetViewUp(*camera["up"])
        view.SetViewAngle(camera["fovy"])
        view.SetClippingRange(camera["near"], camera["far"])
        if contour is not None:
            contour.SetValue(0, low + (high - low) * (0.4 + 0.02 * k))
        start = time.perf_counter()
        window.Render()
        window.WaitForCompletion()
        return (time.perf_counter() - start) * 1e3

    draw(0)
    pixels = vtk.vtkUnsignedCharArray()
    window.GetRGBACharPixelData(0, 0, int(width) - 1, int(height) - 1, 0, pixels)
    if len(sys.argv) > 10:
        vtk_to_numpy(pixels).reshape(int(height), int(width), 4)[::-1].tofile(sys.argv[10])
    times = sorted(draw(k) for k in range(1, int(frames) + 1))
    print(json.dumps({"median_ms": times[len(times) // 2], "min_ms": times[0], "max_ms": times[-1]}))


main()
