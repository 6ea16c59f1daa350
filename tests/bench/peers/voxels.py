"""Compares volcast with VTK's ray casters of voxels on the same software GL; writes a Markdown table and JSON.

A field of 256^3 (--voxels) is made here, as 8 bits, 16 bits and floats. Every row draws the same orbit with steps
of one voxel; rows take turns, round after round, so that a busy machine disturbs all alike. Times are medians of
a picture; `of VTK` is how many times as long the faster of VTK's two casters takes for the same picture. RMS is
over pixels and channels against volcast's exact integrator at a quarter of the step.
"""

import argparse
import json
import math
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

try:
    import numpy as np
except ImportError:  # --help works without; `run` has looked for it otherwise.
    np = None

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]
CAMERA = {"eye": [1.9, 1.45, 2.3], "center": [0.5, 0.5, 0.5], "up": [0, 1, 0], "fovy": 30, "near": 0.5, "far": 6.0}
ORBIT = 36.0
# Every sample counts; three quarters of the bricks show nothing. Values from 0 to 255.
MAPS = {"full": [(0, .1, .2, .9, .2), (76.5, .2, .8, .4, .5), (153, .9, .8, .1, 1), (255, 1, .1, .1, 2)],
        "sparse": [(0, .1, .2, .9, 0), (110, .2, .6, .9, 0), (140, .9, .8, .1, 6), (255, 1, .2, .1, 16)]}
TYPES = {"u8": "MET_UCHAR", "u16": "MET_USHORT", "f32": "MET_FLOAT"}
# what is drawn: (label, map, model, options of volcast)
SCENES = [("volume, every sample", "full", "volume", []), ("volume, most bricks empty", "sparse", "volume", []),
          ("mip", "full", "mip", [])]
# More of volcast alone: what its choices cost.
MORE = [("volume, lit", "sparse", "volume", ["--light"]),
        ("volume, nearest", "full", "volume", ["--sampling", "nearest"]),
        ("volume, tricubic", "full", "volume", ["--sampling", "tricubic"]),
        ("volume, slices", "full", "volume", ["--voxel-evaluator", "slices"]),
        ("volume, instances of slices", "full", "volume", ["--voxel-evaluator", "slice_instances"]),
        ("volume, exact", "full", "volume", ["--integrator", "exact"]),
        ("volume, adaptive", "full", "volume", ["--integrator", "adaptive"])]


def parse():
    parser = argparse.ArgumentParser(prog="tests/bench/peers/run --voxels", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--volcast", default=str(ROOT / "build/release/bin/volcast"), help="the program to measure")
    parser.add_argument("--side", type=int, default=256, help="voxels along each axis (256)")
    parser.add_argument("--sizes", type=int, nargs="+", default=[512], help="widths of square pictures (512)")
    parser.add_argument("--rounds", type=int, default=2, help="of all rows (2)")
    parser.add_argument("--frames", type=int, default=5, help="of an orbit, each round (5)")
    parser.add_argument("--more", action="store_true", help="volcast's samplings, light, slices and integrators too")
    parser.add_argument("--timeout", type=float, default=300, help="seconds that one row may take in a round (300)")
    parser.add_argument("--out", default="voxels.md", help="the table; .json beside it (voxels.md)")
    options = parser.parse_args()
    if not pathlib.Path(options.volcast).exists():
        parser.error(f"{options.volcast} does not exist: build it or name another with --volcast")
    return options


def field(side):
    """Two blobs and waves, 0 to 1; z slowest."""
    g = np.arange(side) / (side - 1.0)
    z, y, x = np.meshgrid(g, g, g, indexing="ij")
    near = (x - .35) ** 2 + (y - .4) ** 2 + (z - .5) ** 2
    far = (x - .7) ** 2 + (y - .65) ** 2 + (z - .45) ** 2
    waves = np.sin(6 * np.pi * x) * np.sin(4 * np.pi * y) * np.sin(4 * np.pi * z)
    return np.clip(.15 + .55 * np.exp(-near / .045) + .45 * np.exp(-far / .02) + .08 * waves, 0, 1)


def write_volumes(folder, side):
    values = field(side)
    for kind, met in TYPES.items():
        # All hold the same values, so that pictures can be compared.
        voxels = np.round(values * 255).astype({"u8": np.uint8, "u16": np.uint16, "f32": np.float32}[kind])
        voxels.tofile(folder / f"{kind}.raw")
        (folder / f"{kind}.mhd").write_text(
            "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
            f"DimSize = {side} {side} {side}\n" + "ElementSpacing =" + f" {1 / (side - 1):.17g}" * 3 +
            f"\nOffset = 0 0 0\nElementType = {met}\nElementDataFile = {kind}.raw\n")
    (folder / "camera.json").write_text(json.dumps(CAMERA))
    for name, rows in MAPS.items():
        (folder / f"{name}.tf").write_text("".join(" ".join(map(str, row)) + "\n" for row in rows))


def run(command, timeout):
    """The JSON of the last line that a command prints; None where it fails, with its words."""
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=timeout, check=False)
        return json.loads(done.stdout.strip().splitlines()[-1])
    except subprocess.TimeoutExpired:
        print(f"  over {timeout:g} s: {' '.join(command[:3])}", file=sys.stderr)
    except (IndexError, json.JSONDecodeError):
        print("  failed:", (done.stderr or done.stdout).strip()[-300:], file=sys.stderr)
    return None


def vtk_frames(folder, caster, map_name, model, size, frames, step, out):
    """The orbit by one of VTK's casters; prints one JSON line. Runs where there is a display."""
    import vtk
    from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

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


class Scene:
    def __init__(self, options, folder, label, map_name, model, extra, size):
        self.options, self.folder, self.label, self.size = options, folder, label, size
        self.map_name, self.model, self.extra = map_name, model, extra
        self.step = 1 / (options.side - 1)
        self.rows = {}
        self.truth = self.ours("f32", 1, ["--integrator", "exact", "--step", str(self.step / 4)] if
                               model == "volume" else ["--step", str(self.step / 4)])[1]

    def ours(self, kind, frames, extra):
        raw = self.folder / "ours.f32"
        found = run([self.options.volcast, "render", str(self.folder / f"{kind}.mhd"), "--camera",
                     str(self.folder / "camera.json"), "--tf", str(self.folder / f"{self.map_name}.tf"), "--model",
                     self.model, "--size", str(self.size), str(self.size), "--frames", str(frames), "--orbit",
                     str(ORBIT), "--raw", str(raw), *extra], self.options.timeout)
        picture = np.fromfile(raw, np.float32) if found else None
        return found, picture

    def peer(self, caster):
        raw = self.folder / "peer.u8"
        found = run(["xvfb-run", "-a", "-s", "-screen 0 2048x2048x24", "/usr/bin/python3", str(HERE / "voxels.py"),
                     "vtk", str(self.folder), caster, self.map_name, self.model, str(self.size),
                     str(self.options.frames), str(self.step), str(raw)], self.options.timeout)
        return found, np.fromfile(raw, np.uint8) / 255.0 if found else None

    def keep(self, name, found, picture, judged=True):
        if not found:
            return
        row = self.rows.setdefault(name, {"ms": [], "rms": None})
        row["ms"].append(found["median_ms"])
        if judged and self.truth is not None:
            row["rms"] = float(np.sqrt(np.mean((picture - self.truth) ** 2)))

    def measure(self, peers):
        for turn in range(self.options.rounds):
            print(f"{self.label}, {self.size}^2, round {turn + 1}", file=sys.stderr)
            for kind in TYPES if peers else ["u8"]:
                # Light is another picture than that without.
                self.keep(f"volcast {kind}", *self.ours(kind, self.options.frames,
                                                        ["--step", str(self.step), *self.extra]),
                          "--light" not in self.extra)
            for caster in ["gpu", "fixed"] if peers else []:
                self.keep(f"VTK {caster}", *self.peer(caster))

    def lines(self):
        medians = {name: statistics.median(row["ms"]) for name, row in self.rows.items()}
        best = min((ms for name, ms in medians.items() if name.startswith("VTK")), default=None)
        for name, row in self.rows.items():
            ratio = f"{best / medians[name]:.2f}" if best and name.startswith("volcast") else ""
            rms = f"{row['rms']:.1e}" if row["rms"] is not None else ""
            yield (f"| {self.label} | {self.size} | {name} | {medians[name]:.1f} | "
                   f"{min(row['ms']):.1f}-{max(row['ms']):.1f} | {ratio} | {rms} |")


def main():
    options = parse()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        write_volumes(folder, options.side)
        scenes = []
        for size in options.sizes:
            for peers, rows in [(True, SCENES), (False, MORE if options.more else [])]:
                for row in rows:
                    scene = Scene(options, folder, *row, size)
                    scene.measure(peers)
                    scenes.append(scene)
        table = ["| scene | size | drawn by | median ms | medians of rounds | of VTK | RMS |",
                 "|---|---|---|---|---|---|---|"] + [line for scene in scenes for line in scene.lines()]
        out = pathlib.Path(options.out)
        out.write_text("\n".join(table) + "\n")
        out.with_suffix(".json").write_text(json.dumps(
            [{"scene": s.label, "size": s.size, "rows": s.rows} for s in scenes], indent=1))
        print("\n".join(table))


if len(sys.argv) > 1 and sys.argv[1] == "vtk":
    vtk_frames(pathlib.Path(sys.argv[2]), *sys.argv[3:6], int(sys.argv[6]), int(sys.argv[7]), float(sys.argv[8]),
               sys.argv[9])
else:
    main()
