"""The data, camera and maps that volcast and VTK draw alike: a field of voxels as 8 bits, 16 bits and floats."""

import json

try:
    import numpy as np
except ImportError:  # --help works without; `run` has looked for it otherwise.
    np = None

CAMERA = {"eye": [1.9, 1.45, 2.3], "center": [0.5, 0.5, 0.5], "up": [0, 1, 0], "fovy": 30, "near": 0.5, "far": 6.0}
ORBIT = 36.0
# Every sample counts; three quarters of the bricks show nothing; the same, but as nothing is without extinction
# rays pass over nothing. Values from 0 to 255.
MAPS = {"full": [(0, .1, .2, .9, .2), (76.5, .2, .8, .4, .5), (153, .9, .8, .1, 1), (255, 1, .1, .1, 2)],
        "sparse": [(0, .1, .2, .9, 0), (110, .2, .6, .9, 0), (140, .9, .8, .1, 6), (255, 1, .2, .1, 16)]}
MAPS["veiled"] = [(value, r, g, b, max(extinction, 1e-30)) for value, r, g, b, extinction in MAPS["sparse"]]
CASTERS = ("gpu", "fixed")  # of VTK
TYPES = {"u8": "MET_UCHAR", "u16": "MET_USHORT", "f32": "MET_FLOAT"}


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
