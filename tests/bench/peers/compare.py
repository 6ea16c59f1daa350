"""Compares volcast with VTK's mappers of unstructured grids; writes a Markdown table and JSON.

Each row draws the same orbit of the same data with the same camera and map; rows take turns, round
after round, so that a busy machine disturbs all alike. Errors are RMS over pixels and channels
against volcast's exact integrator, which `volcast accuracy` compares with its reference.
"""

import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

try:
    import numpy as np
except ImportError:  # --help works without; `run` has looked for it otherwise.
    np = None

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]
PEERS = ["linear", "partial", "preintegration", "projected", "contour"]
OURS = [("volume", "exact"), ("volume", "psi"), ("volume", "average"), ("mip", None), ("xray", None),
        ("isosurface", None)]
CAMERA = {"eye": [1.9, 1.45, 2.3], "center": [0.5, 0.5, 0.5], "up": [0, 1, 0], "fovy": 30,
          "near": 0.5, "far": 6.0}
MAP = "0.05 .1 .2 .9 0\n0.3 .2 .6 .9 .3\n0.45 .2 .9 .4 2\n0.6 .9 .8 .1 6\n0.95 1 .2 .1 16\n"


def parse():
    parser = argparse.ArgumentParser(prog="tests/bench/peers/run", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--volcast", default=str(ROOT / "build/release/bin/volcast"), help="the program to measure")
    parser.add_argument("--cells", type=int, nargs="+", default=[100_000],
                        help="cubes of about so many Delaunay cells, made here (100000)")
    parser.add_argument("--data", nargs=4, metavar=("VTU", "FIELD", "CAMERA", "MAP"), action="append", default=[],
                        help="a mesh of your own instead; camera and map as `volcast render` reads them")
    parser.add_argument("--sizes", type=int, nargs="+", default=[512], help="widths of square pictures (512)")
    parser.add_argument("--rounds", type=int, default=2, help="of all rows (2)")
    parser.add_argument("--frames", type=int, default=5, help="of an orbit, each round (5)")
    parser.add_argument("--peers", nargs="*", default=PEERS, choices=PEERS)
    parser.add_argument("--quick", action="store_true", help="10000 cells, one round of 2 frames")
    parser.add_argument("--timeout", type=float, default=300, help="seconds that one row may take in a round (300)")
    parser.add_argument("--out", default="peers.md", help="the table; .json beside it (peers.md)")
    options = parser.parse_args()
    if options.quick:
        options.cells, options.rounds, options.frames = [10_000], 1, 2
    if not pathlib.Path(options.volcast).exists():
        parser.error(f"{options.volcast} does not exist: build it or name another with --volcast")
    return options


def run(command, timeout):
    """The JSON of the last line that a command prints; None where it fails, with its words."""
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=timeout, check=False)
    except subprocess.TimeoutExpired:
        print(f"  over {timeout:g} s: {command[0]}", file=sys.stderr)
        return None
    try:
        return json.loads(done.stdout.strip().splitlines()[-1])
    except (IndexError, json.JSONDecodeError):
        print("  failed:", (done.stderr or done.stdout).strip()[-300:], file=sys.stderr)
        return None


def rms(picture, truth):
    return float(np.sqrt(np.mean((picture - truth) ** 2)))


class Case:
    def __init__(self, options, folder, label, data, field, camera, table, size):
        self.options, self.folder, self.label, self.size = options, folder, label, size
        self.data, self.field, self.camera, self.table = data, field, camera, table
        self.rows, self.truth, self.cells = {}, None, 0
        self.low, self.high = self.range()

    def range(self):
        found = run([self.options.volcast, "import", self.data, "--json"], self.options.timeout)
        field = next(f for f in found["fields"] if f["name"] == self.field)
        return field["min"], field["max"]

    def ours(self, model, integrator):
        raw = self.folder / "ours.f32"
        command = [self.options.volcast, "render", self.data, "--field", self.field, "--camera", self.camera,
                   "--tf", self.table, "--model", model, "--size", str(self.size), str(self.size),
                   "--frames", str(self.options.frames), "--raw", str(raw)]
        if model == "isosurface":  # The level changes from frame to frame, as that of the contour filter does.
            step = 0.02 * (self.high - self.low)
            command += ["--levels", str(self.low + 20 * step), "--level-step", str(step)]
        if integrator:
            command += ["--integrator", integrator]
        found = run(command, self.options.timeout)
        if found is None:
            return None
        self.cells = found.get("cells", 0)
        if model == "volume":
            picture = np.fromfile(raw, np.float32).reshape(self.size, self.size, 4)
            if integrator == "exact":
                self.truth = picture
            found["rms"] = rms(picture, self.truth) if self.truth is not None else None
        return found

    def peer(self, mapper):
        raw = self.folder / "peer.u8"
        found = run(["xvfb-run", "-a", "-s", "-screen 0 2048x2048x24", "/usr/bin/python3",
                     str(HERE / "vtk_frames.py"), self.data, self.field, self.camera, self.table, str(self.size),
                     str(self.size), mapper, str(self.options.frames), "36", str(raw)], self.options.timeout)
        if found is None:
            return None
        if mapper != "contour" and self.truth is not None:
            picture = np.fromfile(raw, np.uint8).reshape(self.size, self.size, 4) / 255.0
            found["rms"] = rms(picture, self.truth)
        return found

    def measure(self):
        for turn in range(self.options.rounds):
            print(f"{self.label}, {self.size}^2, round {turn + 1}", file=sys.stderr)
            for model, integrator in OURS:
                self.keep("volcast " + model + (f" {integrator}" if integrator else ""), self.ours(model, integrator))
            for mapper in self.options.peers:
                self.keep("VTK " + mapper, self.peer(mapper))

    def keep(self, name, found):
        if found is None:
            return
        row = self.rows.setdefault(name, {"ms": [], "rms": None})
        row["ms"].append(found["median_ms"])
        row["rms"] = found.get("rms")

    def lines(self):
        exact = self.median("volcast volume exact")
        for name, row in self.rows.items():
            ms = self.median(name)
            ratio = f"{ms / exact:.2f}" if exact else ""
            error = f"{row['rms']:.1e}" if row["rms"] is not None else ""
            yield (f"| {self.label} | {self.cells} | {self.size} | {name} | {ms:.1f} | "
                   f"{min(row['ms']):.1f}-{max(row['ms']):.1f} | {ratio} | {error} |")

    def median(self, name):
        return statistics.median(self.rows[name]["ms"]) if name in self.rows else None


def main():
    options = parse()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        inputs = [(pathlib.Path(d[0]).stem, *d) for d in options.data]
        if not inputs:
            (folder / "camera.json").write_text(json.dumps(CAMERA))
            (folder / "map.tf").write_text(MAP)
            for cells in options.cells:
                path = folder / f"cube{cells}.vtu"
                print(f"making a cube of {cells} cells", file=sys.stderr)
                subprocess.run(["/usr/bin/python3", str(HERE / "make_cube.py"), str(cells), str(path)], check=True)
                inputs.append((f"cube {cells}", str(path), "smooth", str(folder / "camera.json"),
                               str(folder / "map.tf")))
        cases = [Case(options, folder, *one, size) for one in inputs for size in options.sizes]
        for case in cases:
            case.measure()
        table = ["| data | cells | size | drawn by | median ms | medians of rounds | of exact | RMS |",
                 "|---|---|---|---|---|---|---|---|"] + [line for case in cases for line in case.lines()]
        out = pathlib.Path(options.out)
        out.write_text("\n".join(table) + "\n")
        out.with_suffix(".json").write_text(json.dumps(
            [{"data": c.label, "cells": c.cells, "size": c.size, "rows": c.rows} for c in cases], indent=1))
        print("\n".join(table))


main()
