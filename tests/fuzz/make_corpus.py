#!/usr/bin/python3
"""Writes the small corpora that are kept in corpus/: a few sound inputs for each target."""

import json
import pathlib
import struct

ROOT = pathlib.Path(__file__).parent


def keep(target, name, content):
    folder = ROOT / "corpus" / target
    folder.mkdir(parents=True, exist_ok=True)
    (folder / name).write_bytes(content if isinstance(content, bytes) else content.encode())


SCENE = {
    "camera": {"eye": {"x": 3, "y": 2, "z": 1}, "center": {}, "up": {"z": 1}, "fovyDegrees": 30},
    "layers": [{"id": "a", "dataset": "demo:volume", "model": "RAY_MODEL_VOLUME",
                "integrator": "INTEGRATOR_PREINTEGRATED", "stepWorld": 0.1,
                "scale": {"kind": "POWER", "exponent": 2},
                "levels": {"spacing": "LINEAR", "first": 0, "last": 1, "count": 3},
                "transferFunction": {"points": [
                    {"value": 0, "colour": {"r": 1}, "extinction": 0},
                    {"value": 1, "colour": {"g": 1}, "extinction": 5}]}}],
    "clipPlanes": [{"normal": {"x": 1}, "offset": 0.5}], "accuracy": {"kind": "EXACT"},
}
CODE = """// a comment /* with another
#uicontrol float gain slider(min=0, max=2, default=1)
#uicontrol vec3 tint color(default="red")
#uicontrol invlerp normalized(range=[0, 1])
float twice(float x) { return 2.0 * x; }
void main() {
    for (int i = 0; i < 3; ++i) { float y = twice(float(i)); }
    emitRGBA(vec4(tint * gain, normalized()));
}
"""


def messages():
    vectors = json.loads((ROOT.parents[1] / "protocol/vectors/vectors.json").read_text())
    for vector in vectors:
        name = vector["name"].replace(" ", "_").replace("/", "_")[:60]
        if vector["kind"] == "client":
            keep("message_binary", name, bytes.fromhex(vector["hex"]))
            keep("message_json", name + ".json", json.dumps(vector["json"]))
        elif vector["kind"] in ("frame", "invalid_frame"):
            keep("frame", name, bytes.fromhex(vector["hex"]))


def surfaces():
    corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    faces = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]
    points = "\n".join("%g %g %g" % c for c in corners)
    keep("off", "four.off", f"OFF\n4 4 0\n{points}\n" + "".join("3 %d %d %d\n" % f for f in faces))
    head = "ply\nformat %s 1.0\nelement vertex 4\nproperty float x\nproperty float y\n" \
           "property float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n"
    keep("ply", "text.ply", head % "ascii" + points + "\n" + "".join("3 %d %d %d\n" % f for f in faces))
    for order, sign in (("little", "<"), ("big", ">")):
        body = b"".join(struct.pack(sign + "3f", *c) for c in corners)
        body += b"".join(struct.pack(sign + "B3i", 3, *f) for f in faces)
        keep("ply", order + ".ply", (head % f"binary_{order}_endian").encode() + body)
    triangles = [[corners[i] for i in f] for f in faces]
    text = "".join("facet normal 0 0 0\nouter loop\n" + "".join("vertex %g %g %g\n" % c for c in t) +
                   "endloop\nendfacet\n" for t in triangles)
    keep("stl", "text.stl", f"solid four\n{text}endsolid four\n")
    keep("stl", "binary.stl", b"\0" * 80 + struct.pack("<I", 4) + b"".join(
        struct.pack("<12fH", 0, 0, 0, *[x for c in t for x in c], 0) for t in triangles))
    nodes = "# attributes: f\n4 3 1 0\n" + "".join(
        "%d %g %g %g %d\n" % (i, *c, i) for i, c in enumerate(corners))
    keep("tetgen", "four.node", nodes)
    keep("tetgen", "from_one.node", "4 3 0 1\n" + "".join(
        "%d %g %g %g 1\n" % (i + 1, *c) for i, c in enumerate(corners)))
    keep("poly", "four.poly", nodes.replace("1 0", "1 0", 1) + "4 0\n" + "".join(
        "1 0\n3 %d %d %d\n" % f for f in faces) + "0\n0\n")
    keep("poly", "apart.smesh", "0 3 0 0\n4 0\n" + "".join("3 %d %d %d\n" % f for f in faces) +
         "0\n0\n\x01" + nodes)


def binary():
    def record(kind, text=b"", data=b""):
        return struct.pack("<IIQ", kind, len(text), len(data)) + text + data
    keep("records", "mesh", record(1, b"reading") + record(4, b"VTU") +
         record(5, b"", struct.pack("<3d", 0, 1, 2)) + record(10))
    page = struct.pack("<H", 1) + struct.pack("<HHII", 256, 4, 1, 2)
    keep("tiff", "two_pages", b"II*\0" + struct.pack("<I", 8) + page + struct.pack("<I", 26) + page +
         struct.pack("<I", 0))
    keep("tiff", "circle", b"II*\0" + struct.pack("<I", 8) + page + struct.pack("<I", 8))
    big = struct.pack(">Q", 1) + struct.pack(">HHQQ", 256, 4, 1, 2)
    keep("tiff", "big", b"MM\0+" + struct.pack(">HHQ", 8, 0, 16) + big + struct.pack(">Q", 0))
    keep("packed", "zeros", b"\0" * 256)


def main():
    messages()
    surfaces()
    binary()
    keep("scene", "volume.json", json.dumps(SCENE))
    keep("scene", "least.json", "{}")
    keep("shader", "controls.glsl", CODE)
    keep("shader", "least.glsl", "void main() { emitTransparent(); }")
    keep("map_file", "lines.tf", "# value r g b sigma\n0 1 0 0 5\n1 0 1 0 6\n")
    keep("map_file", "points.json", json.dumps({"points": [{"value": 2, "extinction": 0.5}]}))
    keep("map_file", "drawn.json", json.dumps({
        "window": [0, 1], "distance": 2, "curve": "spline", "colours": [[0, "#ff0000"], [1, [0, 1, 0]]],
        "opacities": [[0, 0], [0.5, 0.2], [0.7, 0.9], [1, 1]]}))
    keep("map_file", "rgba.json", json.dumps({"percentiles": [1, 99], "rgba": [[1, 0, 0, 0], [0, 1, 0, 1]]}))
    keep("map_file", "linear.json", json.dumps({"linear": "#123456", "opacity": 0.5}))


if __name__ == "__main__":
    main()
