"""Writes a sound file of one family, and each kind of damage to it, into the working folder.

Families are the functions `make_*`; each writes good, empty, cut, nan, absurd, kind and typed, as
files of its suffix or as folders of pictures. `kind` holds another kind of file, `typed` a value or
a type that has no place there. Read by bad_matrix_test.cpp.
"""

import base64
import os
import struct
import zlib

HUGE = 1000000000000
CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
FACES = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
TRIANGLES = [t for f in FACES for t in ((f[0], f[1], f[2]), (f[0], f[2], f[3]))]
VALUES = [float(i) for i in range(8)]
WITH_INFINITY = VALUES[:5] + [float("inf")] + VALUES[6:]


def png(rows, bits=8):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    head = struct.pack(">IIBBBBB", len(rows[0]), len(rows), bits, 0, 0, 0, 0)
    data = zlib.compress(b"".join(b"\0" + struct.pack(f">{len(row)}{'H' if bits == 16 else 'B'}", *row)
                                  for row in rows))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", data) +
            chunk(b"IEND", b""))


def tiff(pages, kinds=("<f4", "<f4"), claim=None):
    """Pages of 2 x 2 pixels; `claim` is the width and height that the first page says."""
    import numpy
    out, at = bytearray(b"II*\0\0\0\0\0"), 4
    for number, (page, kind) in enumerate(zip(pages, kinds)):
        values = numpy.array(page).astype(kind).tobytes()
        data = len(out)
        out += values
        struct.pack_into("<I", out, at, len(out))
        width, height = claim if claim and number == 0 else (2, 2)
        sample = {"u": 1, "i": 2, "f": 3}[kind[1]]
        tags = [(256, 4, width), (257, 4, height), (258, 3, 8 * numpy.dtype(kind).itemsize),
                (259, 3, 1), (262, 3, 1), (273, 4, data), (277, 3, 1), (278, 4, height),
                (279, 4, len(values)), (339, 3, sample)]
        out += struct.pack("<H", len(tags))
        out += b"".join(struct.pack("<HHII", t, k, 1, v) for t, k, v in tags)
        at = len(out)
        out += b"\0\0\0\0"
    return bytes(out)


OTHER_KIND = png([[1, 2], [3, 4]])


def put(name, data):
    with open(name, "wb") as file:
        file.write(data.encode() if isinstance(data, str) else data)


def put_all(suffix, good, **damaged):
    """`damaged`: cut, nan, absurd, typed; left out where it makes no sense."""
    put("good" + suffix, good)
    put("empty" + suffix, "")
    put("kind" + suffix, OTHER_KIND)
    for name, data in damaged.items():
        put(name + suffix, data)


def node_text(points=CORNERS, count=None, index_from=0):
    rows = [f"{i + index_from} {p[0]} {p[1]} {p[2]}\n" for i, p in enumerate(points)]
    return f"{count or len(points)} 3 0 0\n" + "".join(rows)


def corners_with(value):
    return CORNERS[:2] + [(1, value, 0)] + CORNERS[3:]


ELE = "1 4 1\n0 0 1 3 4 7.5\n"


def make_node():
    for name in ("good", "empty", "kind", "cut", "nan", "absurd", "typed"):
        put(name + ".ele", ELE)
    put_all(".node", node_text(), cut=node_text()[:-12], nan=node_text(corners_with("nan")),
            absurd=node_text(count=HUGE), typed=node_text(corners_with("one")))


def make_ele():
    for name in ("good", "empty", "kind", "cut", "nan", "absurd", "typed"):
        put(name + ".node", node_text())
    put_all(".ele", ELE, cut=ELE[:-9], nan=ELE.replace("7.5", "inf"),
            absurd=ELE.replace("1 4 1", f"{HUGE} 4 1"), typed=ELE.replace("0 0 1 3", "0 0 1.5 3"))


def make_stl_text():
    def text(points):
        parts = ["solid cube\n"]
        for t in TRIANGLES:
            corners = "".join("vertex {} {} {}\n".format(*points[v]) for v in t)
            parts.append(f"facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n")
        return "".join(parts) + "endsolid cube\n"
    good = text(CORNERS)
    put_all(".stl", good, cut=good[:len(good) // 2], nan=text(corners_with("nan")),
            typed=text(corners_with("one")))


def make_stl_binary():
    def binary(points, count=len(TRIANGLES)):
        parts = [b"binary".ljust(80) + struct.pack("<I", count)]
        for t in TRIANGLES:
            parts.append(bytes(12) + b"".join(struct.pack("<3f", *points[v]) for v in t) + b"\0\0")
        return b"".join(parts)
    good = binary(CORNERS)
    put_all(".stl", good, cut=good[:-30], nan=binary(corners_with(float("nan"))),
            absurd=binary(CORNERS, 0xFFFFFFFF))


def ply_head(style, count=8, kind="float"):
    return (f"ply\nformat {style} 1.0\nelement vertex {count}\nproperty {kind} x\n"
            f"property {kind} y\nproperty {kind} z\nelement face 6\n"
            "property list uchar int vertex_indices\nend_header\n")


def make_ply_text():
    def text(points, **head):
        rows = ["{} {} {}\n".format(*p) for p in points]
        rows += ["4 {} {} {} {}\n".format(*f) for f in FACES]
        return ply_head("ascii", **head) + "".join(rows)
    good = text(CORNERS)
    put_all(".ply", good, cut=good[:-20], nan=text(corners_with("nan")),
            absurd=text(CORNERS, count=HUGE), typed=text(corners_with("one")))


def make_ply_binary():
    def binary(points, **head):
        rows = [struct.pack("<3f", *p) for p in points] + [struct.pack("<B4i", 4, *f) for f in FACES]
        return ply_head("binary_little_endian", **head).encode() + b"".join(rows)
    good = binary(CORNERS)
    put_all(".ply", good, cut=good[:-20], nan=binary(corners_with(float("nan"))),
            absurd=binary(CORNERS, count=HUGE), typed=binary(CORNERS, kind="complex"))


def make_off():
    def text(points, count=8):
        rows = ["{} {} {}\n".format(*p) for p in points]
        return f"OFF\n{count} 6 12\n" + "".join(rows) + "".join(
            "4 {} {} {} {}\n".format(*f) for f in FACES)
    good = text(CORNERS)
    put_all(".off", good, cut=good[:-20], nan=text(corners_with("nan")),
            absurd=text(CORNERS, HUGE), typed=text(corners_with("one")))


def make_poly():
    facets = "6 0\n" + "".join("1 0\n4 {} {} {} {}\n".format(*f) for f in FACES) + "0\n0\n"
    put_all(".poly", node_text() + facets, cut=(node_text() + facets)[:-30],
            nan=node_text(corners_with("nan")) + facets,
            absurd=node_text() + facets.replace("6 0", f"{HUGE} 0"),
            typed=node_text() + facets.replace("4 0 3 2 1", "4 0 3 2 x"))


def make_smesh():
    facets = "6 0\n" + "".join("4 {} {} {} {}\n".format(*f) for f in FACES) + "0\n0\n"
    put_all(".smesh", node_text() + facets, cut=(node_text() + facets)[:-30],
            nan=node_text(corners_with("nan")) + facets,
            absurd=node_text() + facets.replace("6 0", f"{HUGE} 0"),
            typed=node_text() + facets.replace("4 0 3 2 1", "4 0 3 2 x"))



def vtu_text(values=(1, 2, 3, 4), points=4, kind="Float32"):
    data = struct.pack("<4f", *values)
    coded = base64.b64encode(struct.pack("<I", len(data)) + data).decode()
    return f"""<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">
<UnstructuredGrid><Piece NumberOfPoints="{points}" NumberOfCells="1">
<PointData><DataArray type="{kind}" Name="heat" format="binary">{coded}</DataArray></PointData>
<Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">
0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points>
<Cells><DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 3</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">4</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">10</DataArray></Cells>
</Piece></UnstructuredGrid></VTKFile>"""


def make_vtu():
    good = vtu_text()
    put_all(".vtu", good, cut=good[:len(good) // 2], nan=vtu_text((1, float("inf"), 3, 4)),
            absurd=vtu_text(points=HUGE), typed=vtu_text(kind="Complex64"))


def make_vti():
    def text(values=VALUES, extent="0 1 0 1 0 1", kind="Float32"):
        data = struct.pack("<8f", *values)
        coded = base64.b64encode(struct.pack("<I", len(data)) + data).decode()
        return f"""<VTKFile type="ImageData" version="0.1" byte_order="LittleEndian">
<ImageData WholeExtent="{extent}" Origin="0 0 0" Spacing="1 1 1"><Piece Extent="{extent}">
<PointData><DataArray type="{kind}" Name="heat" format="binary">{coded}</DataArray></PointData>
</Piece></ImageData></VTKFile>"""
    good = text()
    put_all(".vti", good, cut=good[:len(good) // 2], nan=text(WITH_INFINITY),
            absurd=text(extent="0 9999 0 9999 0 9999"), typed=text(kind="Complex64"))


def make_vtk():
    def binary(values=VALUES, size="2 2 2", kind="float"):
        return (f"# vtk DataFile Version 3.0\nx\nBINARY\nDATASET STRUCTURED_POINTS\n"
                f"DIMENSIONS {size}\nORIGIN 0 0 0\nSPACING 1 1 1\nPOINT_DATA 8\n"
                f"SCALARS heat {kind} 1\nLOOKUP_TABLE default\n").encode() + struct.pack(
                    ">8f", *values) + b"\n"
    good = binary()
    put_all(".vtk", good, cut=good[:-14], nan=binary(WITH_INFINITY), absurd=binary(size="9999 9999 9999"),
            typed=binary(kind="complex"))


def exodus(name, values):
    import vtkmodules.vtkCommonCore as core
    import vtkmodules.vtkCommonDataModel as model
    import vtkmodules.vtkIOExodus as io
    grid, points, heat, cell = (model.vtkUnstructuredGrid(), core.vtkPoints(),
                                core.vtkDoubleArray(), core.vtkIdList())
    heat.SetName("heat")
    for i, p in enumerate(((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1))):
        points.InsertNextPoint(p)
        heat.InsertNextValue(values[i])
        cell.InsertNextId(i)
    grid.SetPoints(points)
    grid.InsertNextCell(10, cell)
    grid.GetPointData().AddArray(heat)
    writer = io.vtkExodusIIWriter()
    writer.SetFileName(name)
    writer.SetInputData(grid)
    writer.Write()


def make_exodus():
    exodus("good.ex2", [1.0, 2.0, 3.0, 4.0])
    exodus("nan.ex2", [1.0, 2.0, float("inf"), 4.0])
    good = open("good.ex2", "rb").read()
    nodes = good.index(b"num_nodes") + 12  # The name is padded to a multiple of 4 bytes.
    kind = good.index(b"connect1")
    put("cut.ex2", good[:-20])
    put("absurd.ex2", good[:nodes] + struct.pack(">I", 0x7FFFFFFF) + good[nodes + 4:])
    # The element type of the block: TETRA becomes something that is no element.
    put("typed.ex2", good[:kind] + good[kind:].replace(b"TETRA", b"BLOBS").replace(
        b"tetra", b"blobs").replace(b"TET4", b"BLOB"))
    put("empty.ex2", "")
    put("kind.ex2", OTHER_KIND)


def make_mhd():
    def head(name, size="2 2 2", kind="MET_FLOAT"):
        return (f"ObjectType = Image\nNDims = 3\nDimSize = {size}\nElementType = {kind}\n"
                f"ElementDataFile = {name}.raw\n")
    good = struct.pack("<8f", *VALUES)
    for name, data in (("good", good), ("cut", good[:-3]), ("nan", struct.pack("<8f", *WITH_INFINITY))):
        put(name + ".raw", data)
    put_all(".mhd", head("good"), cut=head("cut"), nan=head("nan"),
            absurd=head("good", "9999 9999 9999"), typed=head("good", kind="MET_STRING"))


def make_nrrd():
    def file(values=VALUES, size="2 2 2", kind="float"):
        return (f"NRRD0004\ntype: {kind}\ndimension: 3\nsizes: {size}\nendian: little\n"
                "encoding: raw\n\n").encode() + struct.pack("<8f", *values)
    good = file()
    put_all(".nrrd", good, cut=good[:-3], nan=file(WITH_INFINITY), absurd=file(size="9999 9999 9999"),
            typed=file(kind="block"))


def make_nifti():
    def file(values=VALUES, side=2, kind=16):
        head = bytearray(352)
        struct.pack_into("<i", head, 0, 348)
        struct.pack_into("<8h", head, 40, 3, side, side, side, 1, 1, 1, 1)
        struct.pack_into("<2h", head, 70, kind, 32)
        struct.pack_into("<8f", head, 76, 1, 1, 1, 1, 0, 0, 0, 0)
        struct.pack_into("<f", head, 108, 352)
        head[344:348] = b"n+1\0"
        return bytes(head) + struct.pack("<8f", *values)
    good = file()
    put_all(".nii", good, cut=good[:-3], nan=file(WITH_INFINITY), absurd=file(side=9999),
            typed=file(kind=128))


def xdmf_text(geometry, attribute, points="4 3"):
    return f"""<Xdmf Version="3.0"><Domain><Grid><Topology TopologyType="Tetrahedron">
<DataItem Dimensions="1 4" NumberType="Int" Format="XML">0 1 2 3</DataItem></Topology>
<Geometry GeometryType="XYZ"><DataItem Dimensions="{points}" {geometry}</DataItem></Geometry>
<Attribute Name="heat" Center="Node"><DataItem Dimensions="4" {attribute}</DataItem></Attribute>
</Grid></Domain></Xdmf>"""


def make_xdmf():
    def text(values="1 2 3 4", points="4 3"):
        return xdmf_text('Format="XML">0 0 0 1 0 0 0 1 0 0 0 1', f'Format="XML">{values}', points)
    good = text()
    put_all(".xdmf", good, cut=good[:len(good) // 2], nan=text("1 2 inf 4"),
            absurd=text(points=f"{HUGE} 3"), typed=text("1 2 three 4"))


def make_xdmf_hdf5():
    import h5py
    import numpy
    points = numpy.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], "f8")
    heat = {"good": numpy.array([1.0, 2, 3, 4]), "nan": numpy.array([1, 2, float("inf"), 4]),
            "typed": numpy.array([b"a", b"b", b"c", b"d"])}
    for name in ("good", "empty", "cut", "nan", "absurd", "kind", "typed"):
        with h5py.File(name + ".h5", "w") as file:
            if name == "absurd":
                file.create_dataset("points", (HUGE, 3), "f8", chunks=(1024, 3))
            else:
                file["points"] = points
            file["heat"] = heat.get(name, heat["good"])
        size = f"{HUGE} 3" if name == "absurd" else "4 3"
        put(name + ".xdmf", xdmf_text(f'Format="HDF">{name}.h5:/points',
                                      f'Format="HDF">{name}.h5:/heat', size))
    put("empty.h5", "")
    put("cut.h5", open("good.h5", "rb").read()[:-100])
    put("kind.h5", OTHER_KIND)


def gmsh_text(nodes=4, third="0 1 0", kind=4, value="3"):
    return f"""$MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
{nodes}
1 0 0 0
2 1 0 0
3 {third}
4 0 0 1
$EndNodes
$Elements
1
1 {kind} 2 0 1 1 2 3 4
$EndElements
$NodeData
1
"heat"
1
0.0
3
0
1
4
1 1
2 2
3 {value}
4 4
$EndNodeData
"""


def make_gmsh():
    good = gmsh_text()
    put_all(".msh", good, cut=good[:good.index("$Elements") - 20], nan=gmsh_text(value="inf"),
            absurd=gmsh_text(nodes=HUGE), typed=gmsh_text(kind=999))
    put("nan_point.msh", gmsh_text(third="0 nan 0"))
    put("cut_data.msh", good[:good.index("3 3\n")])
    put("typed_value.msh", gmsh_text(third="0 one 0"))


PAGES = [[[0, 1], [2, 3]], [[4, 5], [6, 7]]]
INFINITE_PAGES = [PAGES[0], [[4, float("inf")], [6, 7]]]


def make_tiff_pages():
    good = tiff(PAGES)
    put_all(".tif", good, cut=good[:-100], nan=tiff(INFINITE_PAGES),
            absurd=tiff(PAGES, claim=(9999, 9999)), typed=tiff(PAGES, ("<f4", "<i2")))


def make_tiff_stack():
    first = tiff(PAGES[:1])
    second = tiff(PAGES[1:])
    damaged = {"good": second, "empty": b"", "cut": second[:60], "nan": tiff(INFINITE_PAGES[1:]),
               "absurd": tiff(PAGES[1:], claim=(9999, 9999)), "kind": OTHER_KIND,
               "typed": tiff(PAGES[1:], ("<i2",))}
    for name, data in damaged.items():
        os.mkdir(name)
        put(name + "/slice1.tif", first)
        put(name + "/slice2.tif", data)


def make_png_stack():
    first, second = png(PAGES[0]), png(PAGES[1])
    huge = struct.pack(">II", 9999, 9999)
    head = second[12:16] + huge + second[24:29]
    absurd = second[:12] + head + struct.pack(">I", zlib.crc32(head)) + second[33:]
    damaged = {"good": second, "empty": b"", "cut": second[:50], "absurd": absurd,
               "kind": tiff(PAGES[1:]), "typed": png(PAGES[1], bits=16)}
    for name, data in damaged.items():
        os.mkdir(name)
        put(name + "/slice1.png", first)
        put(name + "/slice2.png", data)
