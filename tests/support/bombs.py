"""Writes files of about 1 MB that unpack to 1 GB of zeros, into the working folder: all, or those
that are named. Their headers say so (honest) or say little (small).
"""

import base64
import struct
import sys
import zlib

SIDE, SMALL = 1024, 4
ZEROS = bytes(1 << 24)
TIMES = SIDE ** 3 // len(ZEROS)


def deflated(head=b""):
    """`head` and SIDE^3 zeros: a part that stands alone, again and again."""
    stream = zlib.compressobj(9, zlib.DEFLATED, -15)
    begin = stream.compress(head) + stream.flush(zlib.Z_FULL_FLUSH)
    part = stream.compress(ZEROS) + stream.flush(zlib.Z_FULL_FLUSH)
    return begin + part * TIMES + stream.flush()


def checked(check, head=b""):
    value = check(head)
    for _ in range(TIMES):
        value = check(ZEROS, value)
    return value


def gzipped(head=b""):
    end = struct.pack("<2I", checked(zlib.crc32, head), len(head) + SIDE ** 3)
    return b"\x1f\x8b\x08\0\0\0\0\0\2\3" + deflated(head) + end


def zlibbed():
    return b"\x78\xda" + deflated() + struct.pack(">I", checked(zlib.adler32))


def nrrd(side):
    head = f"NRRD0004\ntype: uchar\ndimension: 3\nsizes: {side} {side} {side}\nencoding: gzip\n\n"
    return head.encode() + gzipped()


def mha(side):
    head = (f"ObjectType = Image\nNDims = 3\nDimSize = {side} {side} {side}\n"
            "ElementType = MET_UCHAR\nCompressedData = True\nElementDataFile = LOCAL\n")
    return head.encode() + zlibbed()


def nifti(side):
    head = bytearray(352)
    struct.pack_into("<i", head, 0, 348)
    struct.pack_into("<8h", head, 40, 3, side, side, side, 1, 1, 1, 1)
    struct.pack_into("<2h", head, 70, 2, 8)
    struct.pack_into("<8f", head, 76, *[1.0] * 8)
    struct.pack_into("<f", head, 108, 352.0)
    head[344:348] = b"n+1\0"
    return gzipped(bytes(head))


def vtu(block_bytes, data):
    """One tetrahedron with a field in one block, whose header says `block_bytes`."""
    header = struct.pack("<4I", 1, block_bytes, 0, len(data))
    field = base64.b64encode(header).decode() + base64.b64encode(data).decode()
    return f"""<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian"
 header_type="UInt32" compressor="vtkZLibDataCompressor">
<UnstructuredGrid><Piece NumberOfPoints="4" NumberOfCells="1">
<PointData><DataArray type="Float32" Name="heat" format="binary">{field}</DataArray></PointData>
<Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">
0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points>
<Cells><DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 3</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">4</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">10</DataArray></Cells>
</Piece></UnstructuredGrid></VTKFile>""".encode()


BOMBS = {"honest.nrrd": lambda: nrrd(SIDE), "small.nrrd": lambda: nrrd(SMALL),
         "honest.mha": lambda: mha(SIDE), "small.mha": lambda: mha(SMALL),
         "honest.nii.gz": lambda: nifti(SIDE), "small.nii.gz": lambda: nifti(SMALL),
         "honest.vtu": lambda: vtu(SIDE ** 3, zlibbed()),
         "small.vtu": lambda: vtu(16, zlibbed()),
         # No bomb but in its header: 16 bytes that are said to be 2 GB.
         "large.vtu": lambda: vtu(0x7fffffff, zlib.compress(struct.pack("<4f", 1, 2, 3, 4)))}

for name in sys.argv[1:] or BOMBS:
    with open(name, "wb") as file:
        file.write(BOMBS[name]())
