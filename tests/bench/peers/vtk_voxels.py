"""Draws the orbit by one of VTK's casters of voxels and prints one JSON line; runs where there is a display.

Arguments: folder, caster (gpu, fixed), map, model (volume, mip), size, frames, step, file for the first picture.
"""

import json
import math
import pathlib
import statistics
import sys
import time

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

from voxel_data import CAMERA, MAPS, ORBIT


def main(folder, caster, map_name, model, size, frames, step, out):
    voxels = np.fromfile(folder / "u8.raw", np.uint8)
    side = round(len(voxels) ** (1 / 3))
    image = vtk.vtkImageData()
    image.SetDimensions(side, side, side)
    image.SetSpacing(*[1 / (side - 1)] * 3)
    image.GetPointData().SetScalars(numpy_to_vtk(voxels, deep=1))
    colour, opacity = vtk.vtkColorTransferFunction(), vtk.vtkPiecewiseFunction()
    rows = np.array(MAPS[map_name])
    for value in range(256):  # Opacity over a step is not linear between the map's points.
        r, g, b, extinction = [float(np.interp(value, rows[:, 0], rows[:, i])) for i in range(1, 5)]
        colour.AddRGBPoint(value, r, g, b)
        opacity.AddPoint(value, 1.0 if model == "mip" else -math.expm1(-extinction * step))
    properties = vtk.vtkVolumeProperty()
    properties.SetInterpolationTypeToLinear()
    properties.SetColor(colour)
    properties.SetScalarOpacity(opacity)
    properties.SetScalarOpacityUnitDistance(step)
    mapper = vtk.vtkGPUVolumeRayCastMapper() if caster == "gpu" else vtk.vtkFixedPointVolumeRayCastMapper()
    mapper.SetInputData(image)
    mapper.SetAutoAdjustSampleDistances(0)
    mapper.SetSampleDistance(step)
    mapper.SetBlendMode(1 if model == "mip" else 0)
    if caster == "fixed":
        mapper.SetImageSampleDistance(1.0)
        mapper.SetInteractiveSampleDistance(step)
    else:
        mapper.SetUseJittering(0)
    actor = vtk.vtkVolume()
    actor.SetProperty(properties)
    actor.SetMapper(mapper)
    window, renderer = vtk.vtkRenderWindow(), vtk.vtkRenderer()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetAlphaBitPlanes(1)
    window.SetSize(size, size)
    renderer.SetBackgroundAlpha(0.0)
    window.AddRenderer(renderer)
    renderer.AddVolume(actor)
    view = renderer.GetActiveCamera()
    arm, center = np.subtract(CAMERA["eye"], CAMERA["center"]), np.array(CAMERA["center"])

    def draw(k):
        angle = math.radians(k * ORBIT)
        x, y, z = arm
        view.SetPosition(*(center + [x * math.cos(angle) + z * math.sin(angle), y,
                                     z * math.cos(angle) - x * math.sin(angle)]))
        view.SetFocalPoint(*center)
        view.SetViewUp(*CAMERA["up"])
        view.SetViewAngle(CAMERA["fovy"])
        view.SetClippingRange(CAMERA["near"], CAMERA["far"])
        start = time.perf_counter()
        window.Render()
        window.WaitForCompletion()
        return (time.perf_counter() - start) * 1e3

    draw(0)
    pixels = vtk.vtkUnsignedCharArray()
    window.GetRGBACharPixelData(0, 0, size - 1, size - 1, 0, pixels)
    vtk_to_numpy(pixels).reshape(size, size, 4)[::-1].tofile(out)
    times = [draw(k) for k in range(1, frames + 1)]
    print(json.dumps({"median_ms": statistics.median(times)}))


main(pathlib.Path(sys.argv[1]), *sys.argv[2:5], int(sys.argv[5]), int(sys.argv[6]), float(sys.argv[7]), sys.argv[8])
