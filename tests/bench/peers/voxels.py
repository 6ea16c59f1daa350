"""Compares volcast with VTK's ray casters of voxels on the same software GL; writes Markdown tables and JSON.

A field of 256^3 (--voxels) is made here, as 8 bits, 16 bits and floats. Every row draws the same orbit with steps
of one voxel; rows take turns, round after round, so that a busy machine disturbs all alike. Times are medians of
a picture; `of VTK` is how many times as long VTK's caster on the GPU and the one of fixed point take for the same
picture. RMS is over pixels and channels against volcast's exact integrator at a quarter of the step.

--more adds a table of what volcast's choices cost, each of 8 bits, 16 bits and floats: passing over empty space or
not, light, samplings, slices, integrators. There are two figures in a cell, milliseconds a picture and seconds of
all CPUs a picture; `times` compares the latter of 8 bits with a march where every sample counts.

All ends after --minutes: what there was no time for is missing, and named at the end.
"""

import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

from voxel_data import CASTERS, ORBIT, TYPES, np, write_volumes

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]
# what is drawn: (label, map, model, options of volcast)
SCENES = [("volume, every sample", "full", "volume", []), ("volume, most bricks empty", "sparse", "volume", []),
          ("mip", "full", "mip", [])]
COSTS = [("every sample counts", "full", "volume", []),
         ("most bricks empty, passed over", "sparse", "volume", []),
         ("the same, nothing passed over", "veiled", "volume", []),
         ("most bricks empty, lit", "sparse", "volume", ["--light"]),
         ("every sample counts, lit", "full", "volume", ["--light"]),
         ("nearest", "full", "volume", ["--sampling", "nearest"]),
         ("tricubic", "full", "volume", ["--sampling", "tricubic"]),
         ("slices", "full", "volume", ["--voxel-evaluator", "slices"]),
         ("instances of slices", "full", "volume", ["--voxel-evaluator", "slice_instances"]),
         ("preintegrated", "full", "volume", ["--integrator", "preintegrated"]),
         ("exact", "full", "volume", ["--integrator", "exact"]),
         ("adaptive", "full", "volume", ["--integrator", "adaptive"]),
         ("mip", "full", "mip", []), ("isosurface", "full", "isosurface", ["--levels", "120"])]


def parse():
    parser = argparse.ArgumentParser(prog="tests/bench/peers/run --voxels", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--volcast", default=str(ROOT / "build/release/bin/volcast"), help="the program to measure")
    parser.add_argument("--side", type=int, default=256, help="voxels along each axis (256)")
    parser.add_argument("--sizes", type=int, nargs="+", default=[512], help="widths of square pictures (512)")
    parser.add_argument("--rounds", type=int, default=2, help="of all rows (2)")
    parser.add_argument("--frames", type=int, default=5, help="of an orbit, each round (5)")
    parser.add_argument("--more", action="store_true", help="the table of costs too")
    parser.add_argument("--timeout", type=float, default=300, help="seconds that one row may take in a round (300)")
    parser.add_argument("--minutes", type=float, default=40, help="that all may take (40)")
    parser.add_argument("--out", default="voxels.md", help="the tables; .json beside it (voxels.md)")
    options = parser.parse_args()
    if not pathlib.Path(options.volcast).exists():
        parser.error(f"{options.volcast} does not exist: build it or name another with --volcast")
    options.deadline = time.monotonic() + 60 * options.minutes
    return options


def run(command, options):
    """The JSON of the last line that a command prints; None where it fails, with its words."""
    seconds = min(options.timeout, options.deadline - time.monotonic())
    if seconds <= 0:
        return None
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=seconds, check=False)
        return json.loads(done.stdout.strip().splitlines()[-1])
    except subprocess.TimeoutExpired:
        print(f"  over {seconds:.0f} s: {' '.join(command[:3])}", file=sys.stderr)
    except (IndexError, json.JSONDecodeError):
        print("  failed:", (done.stderr or done.stdout).strip()[-300:], file=sys.stderr)
    return None


class Scene:
    """One thing that is drawn, at one size, and what was measured of each row that draws it."""

    def __init__(self, options, folder, scene, size, rows):
        self.options, self.folder, self.size = options, folder, size
        self.label, self.map_name, self.model, self.extra = scene
        self.step = 1 / (options.side - 1)
        self.rows = {name: {"ms": [], "cpu_ms": [], "rms": None} for name in rows}
        self.truth = None

    def find_truth(self):
        exact = ["--integrator", "exact"] if self.model == "volume" else []
        self.truth = self.ours("f32", 1, [*exact, "--step", str(self.step / 4)])[1]

    def ours(self, kind, frames, extra):
        raw = self.folder / "ours.f32"
        found = run([self.options.volcast, "render", str(self.folder / f"{kind}.mhd"), "--camera",
                     str(self.folder / "camera.json"), "--tf", str(self.folder / f"{self.map_name}.tf"), "--model",
                     self.model, "--size", str(self.size), str(self.size), "--frames", str(frames), "--orbit",
                     str(ORBIT), "--raw", str(raw), *extra], self.options)
        return found, np.fromfile(raw, np.float32) if found else None

    def peer(self, caster):
        raw = self.folder / "peer.u8"
        found = run(["xvfb-run", "-a", "-s", "-screen 0 2048x2048x24", "/usr/bin/python3", str(HERE / "vtk_voxels.py"),
                     str(self.folder), caster, self.map_name, self.model, str(self.size), str(self.options.frames),
                     str(self.step), str(raw)], self.options)
        return found, np.fromfile(raw, np.uint8) / 255.0 if found else None

    def measure(self, turn):
        print(f"{self.label}, {self.size}^2, round {turn + 1}", file=sys.stderr)
        for name, row in self.rows.items():
            draws = self.peer(name) if name in CASTERS else self.ours(
                name, self.options.frames, ["--step", str(self.step), *self.extra])
            found, picture = draws
            if not found:
                continue
            row["ms"].append(found["median_ms"])
            row["cpu_ms"].append(found.get("cpu_ms", 0.0))
            if self.truth is not None:
                row["rms"] = float(np.sqrt(np.mean((picture - self.truth) ** 2)))

    def median(self, name, what="ms"):
        return statistics.median(self.rows[name][what]) if self.rows[name][what] else None

    def missing(self):
        return [f"{self.label}, {self.size}^2, {name}" for name, row in self.rows.items()
                if len(row["ms"]) < self.options.rounds]


def peer_lines(scenes):
    yield "| scene | size | drawn by | median ms | medians of rounds | of VTK gpu | of VTK fixed | RMS |"
    yield "|---|---|---|---|---|---|---|---|"
    for scene in scenes:
        for name, row in scene.rows.items():
            own = scene.median(name)
            if own is None:
                continue
            of = [f"{scene.median(c) / own:.2f}" if name not in CASTERS and scene.median(c) else "" for c in CASTERS]
            rms = f"{row['rms']:.1e}" if row["rms"] is not None else ""
            drawn_by = f"VTK {name}" if name in CASTERS else f"volcast {name}"
            yield (f"| {scene.label} | {scene.size} | {drawn_by} | {own:.1f} | "
                   f"{min(row['ms']):.1f}-{max(row['ms']):.1f} | {of[0]} | {of[1]} | {rms} |")


def cost_lines(scenes):
    yield "| a march of trilinear values, but for: | size | u8: ms, CPU s | u16 | f32 | times |"
    yield "|---|---|---|---|---|---|"
    for scene in scenes:
        cells = [f"{scene.median(kind):.0f}, {scene.median(kind, 'cpu_ms') / 1e3:.2f}" if scene.median(kind) else ""
                 for kind in TYPES]
        first = next(s for s in scenes if s.size == scene.size)
        both = [s.median("u8", "cpu_ms") for s in (scene, first)]
        times = f"{both[0] / both[1]:.2f}" if all(both) else ""
        yield f"| {scene.label} | {scene.size} | {' | '.join(cells)} | {times} |"


def main():
    options = parse()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        write_volumes(folder, options.side)
        compared = [Scene(options, folder, scene, size, [*TYPES, *CASTERS])
                    for size in options.sizes for scene in SCENES]
        costs = [Scene(options, folder, scene, size, TYPES)
                 for size in options.sizes for scene in (COSTS if options.more else [])]
        for scene in compared:
            scene.find_truth()
        for turn in range(options.rounds):
            for scene in compared + costs:
                scene.measure(turn)
    lines = list(peer_lines(compared))
    if costs:
        lines += ["", *cost_lines(costs)]
    missing = [what for scene in compared + costs for what in scene.missing()]
    if missing:
        lines += ["", f"Not measured in all rounds ({options.minutes:g} minutes): {'; '.join(missing)}."]
    out = pathlib.Path(options.out)
    out.write_text("\n".join(lines) + "\n")
    out.with_suffix(".json").write_text(json.dumps(
        [{"scene": s.label, "size": s.size, "rows": s.rows} for s in compared + costs], indent=1))
    print("\n".join(lines))


main()
