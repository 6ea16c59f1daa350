"""MetaImage, NRRD and NIfTI volumes: a header and an array.

Read here and not through VTK, whose readers drop the axes' directions and take files that are too
short without a word.
"""

import bz2
import errno
import gzip
import math
import mmap
import re
import zlib

MAX_SIDE = 1 << 15
IDENTITY = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]


def stem_of(path):
    """What a channel without a name is called: the file's name without its suffixes."""
    return os.path.basename(path).split(".")[0] or "values"


def count_of(size):
    if not size or any(n < 1 or n > MAX_SIDE for n in size):
        raise Refusal(f"its size {size} is outside of 1 to {MAX_SIDE}", LIMIT)
    return math.prod(size)


def beside(path, name):
    """A data file that a header names must lie in the header's folder."""
    if os.path.isabs(name) or ".." in name.replace("\\", "/").split("/"):
        raise Refusal(f"its data file {name!r} lies outside of its folder", UNSUPPORTED)
    return os.path.join(os.path.dirname(path) or ".", name)


def read_bytes(path, offset=0, limit=-1):
    try:
        with open(path, "rb") as file:
            file.seek(offset)
            return file.read(limit)
    except OSError as error:
        code = NOT_FOUND if isinstance(error, FileNotFoundError) else IO
        raise Refusal(f"its data file {os.path.basename(path)}: {error.strerror}", code) from error


def mapped_bytes(path, offset=0):
    """The file's bytes from `offset` on; of a large one only what is looked at is read."""
    try:
        with open(path, "rb") as file:
            whole = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
    except OSError as error:
        if error.errno == errno.ENOMEM:  # Addresses are limited as memory is.
            raise MemoryError from error
        raise Refusal(f"its data file {os.path.basename(path)}: {error.strerror}", IO) from error
    except ValueError:  # It is empty.
        return b""
    return memoryview(whole)[offset:]


def unpacked(data, method, expected):
    """The bytes of `data`, uncompressed; of those of a small file there may be very many."""
    try:
        if method == "raw":
            return data
        if method == "bzip2":
            plain = bz2.BZ2Decompressor().decompress(data, expected + 1)
        else:
            plain = zlib.decompressobj(wbits=47).decompress(data, expected + 1)
    except (zlib.error, OSError, EOFError) as error:
        raise Refusal(f"its compressed data is damaged ({error})") from error
    return not_longer(plain, expected)


def not_longer(plain, expected):
    if len(plain) > expected:
        raise Refusal(f"its compressed data holds more than the {expected} bytes that its header "
                      "says")
    return plain


def numbers_of(data, dtype, count, what, tail=False):
    """`count` numbers; `tail` takes the last ones, for files with a header of unknown length."""
    import numpy
    dtype = numpy.dtype(dtype)
    needed = count * dtype.itemsize
    if len(data) < needed:
        raise Refusal(f"{what} has {len(data)} bytes, {count} values of type {dtype.name} need "
                      f"{needed}")
    values = numpy.frombuffer(data, dtype, count, len(data) - needed if tail else 0)
    return values.astype(dtype.newbyteorder("="), copy=False)


# What a byte unpacks to at most; bzip2 knows no such bound.
LARGEST_RATIOS = {"raw": 1, "zlib": 1100, "bzip2": math.inf}


def check_claim(path, count, itemsize, method):
    """Before memory is reserved: can a file of this size hold so many values, and the memory?"""
    size, packed = os.path.getsize(path), method != "raw"
    if count * itemsize > size * LARGEST_RATIOS[method]:
        raise Refusal(f"says {count} values of {itemsize} bytes, its data file "
                      f"{os.path.basename(path)} has {size} bytes", LIMIT if packed else INVALID)
    if packed and count * itemsize > memory_limit():  # What is not packed is mapped.
        raise Refusal(f"unpacks to {count * itemsize} bytes, this import may use {memory_limit()}",
                      LIMIT)


def channels_of(values, parts, name, count):
    if parts == 1:
        return [(name, values)]
    cube = values.reshape(count, parts)
    return [(f"{name}_{i}", cube[:, i]) for i in range(parts)]


def unit_axes(vectors):
    """Lengths and directions of the grid's axes; `vectors` are its steps."""
    lengths = [math.sqrt(sum(x * x for x in v)) for v in vectors]
    if any(not math.isfinite(n) or n <= 0 for n in lengths):
        raise Refusal(f"its axes {vectors} have no length")
    units = [[x / n for x in v] for v, n in zip(vectors, lengths)]
    return lengths, [[units[c][r] for c in range(3)] for r in range(3)]


META_TYPES = {"MET_UCHAR": "u1", "MET_CHAR": "i1", "MET_USHORT": "u2", "MET_SHORT": "i2",
              "MET_UINT": "u4", "MET_INT": "i4", "MET_ULONG": "u8", "MET_LONG": "i8",
              "MET_ULONG_LONG": "u8", "MET_LONG_LONG": "i8", "MET_FLOAT": "f4",
              "MET_DOUBLE": "f8"}


def meta_header(path):
    """Keys of a MetaImage header and the offset behind it."""
    head = read_bytes(path, 0, 1 << 16)
    if not head:
        raise Refusal("is empty")
    keys, offset = {}, 0
    for line in head.splitlines(keepends=True):
        offset += len(line)
        key, equals, value = line.partition(b"=")
        try:
            name, text = key.decode("ascii").strip(), value.decode("utf-8").strip()
        except UnicodeDecodeError:
            break
        if not equals:
            if name:
                break
            continue
        keys[name] = text
        if name == "ElementDataFile":
            return keys, offset
    raise Refusal("is no MetaImage header (there is no ElementDataFile in it)")


def floats(keys, names, count, default):
    for name in names:
        if name in keys:
            values = [float(word) for word in keys[name].split()]
            if len(values) < count:
                raise Refusal(f"{name} has {len(values)} numbers, {count} are needed")
            return values[:count]
    return default


def read_meta(path, send):
    keys, offset = meta_header(path)
    for name in ("NDims", "DimSize", "ElementType"):
        if name not in keys:
            raise Refusal(f"its header lacks {name}")
    if keys.get("BinaryData", "True").lower() != "true":
        raise Refusal("holds its values as text; only BinaryData = True is read", UNSUPPORTED)
    if keys["ElementType"] not in META_TYPES:
        raise Refusal(f"ElementType {keys['ElementType']} is not known", UNSUPPORTED)
    size = [int(word) for word in keys["DimSize"].split()]
    if int(keys["NDims"]) != 3 or len(size) != 3:
        raise Refusal(f"has {keys['NDims']} dimensions, 3 are needed", UNSUPPORTED)
    count = count_of(size)
    parts = int(keys.get("ElementNumberOfChannels", "1"))
    if not 1 <= parts <= 256:
        raise Refusal(f"ElementNumberOfChannels {parts} is outside of 1 to 256", LIMIT)
    big = keys.get("BinaryDataByteOrderMSB", keys.get("ElementByteOrderMSB", "False"))
    dtype = (">" if big.lower() == "true" else "<") + META_TYPES[keys["ElementType"]]
    packed = keys.get("CompressedData", "False").lower() == "true"
    method = "zlib" if packed else "raw"
    name = keys["ElementDataFile"]
    if name == "LIST" or "%" in name:
        raise Refusal("its values lie in several files; only one is read", UNSUPPORTED)
    local = name == "LOCAL"
    data_path = path if local else beside(path, name)
    if not local and not os.path.exists(data_path):
        raise Refusal(f"its data file {name} does not exist", NOT_FOUND)
    needed = count * parts * int(dtype[2:])
    check_claim(data_path, count * parts, int(dtype[2:]), method)
    skip = int(keys.get("HeaderSize", "0"))
    read = read_bytes if packed else mapped_bytes
    data = read(data_path, offset if local else max(skip, 0))
    data = unpacked(data, method, needed)
    values = numbers_of(data, dtype, count * parts, f"its data file {os.path.basename(data_path)}",
                        tail=skip == -1)
    matrix = floats(keys, ("TransformMatrix", "Rotation", "Orientation"), 9,
                    [1, 0, 0, 0, 1, 0, 0, 0, 1])
    _, direction = unit_axes([matrix[0:3], matrix[3:6], matrix[6:9]])
    spacing = floats(keys, ("ElementSpacing", "ElementSize"), 3, [1, 1, 1])
    origin = floats(keys, ("Offset", "Position", "Origin"), 3, [0, 0, 0])
    send.format("MetaImage")
    send_volume(send, size, spacing, origin, direction,
                channels_of(values, parts, stem_of(path), count))


NRRD_TYPES = {"i1": ("signed char", "int8", "int8_t"), "u1": ("uchar", "unsigned char", "uint8",
              "uint8_t"), "i2": ("short", "short int", "signed short", "int16", "int16_t"),
              "u2": ("ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"),
              "i4": ("int", "signed int", "int32", "int32_t"),
              "u4": ("uint", "unsigned int", "uint32", "uint32_t"),
              "i8": ("longlong", "long long", "int64", "int64_t"),
              "u8": ("ulonglong", "unsigned long long", "uint64", "uint64_t"),
              "f4": ("float",), "f8": ("double",)}


def nrrd_header(path):
    """Fields of an NRRD header and the offset behind the empty line that ends it."""
    head = read_bytes(path, 0, 1 << 20)
    if not head:
        raise Refusal("is empty")
    if not head.startswith(b"NRRD000"):
        raise Refusal('is no NRRD file (it does not start with "NRRD000")')
    fields, offset = {}, 0
    for line in head.splitlines(keepends=True):
        offset += len(line)
        text = line.decode("utf-8", "replace").strip()
        if not text:
            break
        if text.startswith("#") or ":=" in text:
            continue
        key, colon, value = text.partition(":")
        if colon:
            fields[key.strip().lower().replace(" ", "")] = value.strip()
    return fields, offset


def nrrd_vectors(text):
    """Vectors in brackets; None for "none"."""
    result = []
    for word in re.findall(r"\([^)]*\)|none", text):
        result.append(None if word == "none" else [float(x) for x in word[1:-1].split(",")])
    return result


def nrrd_geometry(fields, first):
    """Spacing, origin and direction of the three axes from `first` on."""
    if "spacedirections" in fields:
        vectors = nrrd_vectors(fields["spacedirections"])
        vectors = [v for v in vectors if v is not None]
        if len(vectors) != 3 or any(len(v) != 3 for v in vectors):
            raise Refusal(f"its space directions {fields['spacedirections']} are not three vectors")
        spacing, direction = unit_axes(vectors)
    else:
        spacing, direction = [1.0, 1.0, 1.0], IDENTITY
        if "spacings" in fields:
            words = fields["spacings"].split()[first:first + 3]
            spacing = [1.0 if math.isnan(float(w)) else abs(float(w)) for w in words]
    origin = [0.0, 0.0, 0.0]
    if "spaceorigin" in fields:
        origin = (nrrd_vectors(fields["spaceorigin"]) or [origin])[0]
    elif "axismins" in fields:
        words = fields["axismins"].split()[first:first + 3]
        origin = [0.0 if math.isnan(float(w)) else float(w) for w in words]
    if len(spacing) != 3 or len(origin) != 3:
        raise Refusal("its spacing or origin does not have three numbers")
    return spacing, origin, direction


def read_nrrd(path, send):
    fields, offset = nrrd_header(path)
    for name in ("type", "dimension", "sizes", "encoding"):
        if name not in fields:
            raise Refusal(f"its header lacks {name}")
    code = next((c for c, names in NRRD_TYPES.items() if fields["type"] in names), None)
    if code is None:
        raise Refusal(f"type {fields['type']} is not known", UNSUPPORTED)
    sizes = [int(word) for word in fields["sizes"].split()]
    if len(sizes) not in (3, 4):
        raise Refusal(f"has {len(sizes)} dimensions, 3 (or 4 with channels) are needed",
                      UNSUPPORTED)
    kinds = fields.get("kinds", "").split()
    spatial = ("domain", "space", "time", "???", "none")
    channel_last = len(sizes) == 4 and len(kinds) == 4 and kinds[0] in ("domain", "space") \
        and kinds[3] not in spatial
    first = 1 if len(sizes) == 4 and not channel_last else 0
    parts = 1 if len(sizes) == 3 else sizes[3 if channel_last else 0]
    size = sizes[first:first + 3]
    count = count_of(size)
    if not 1 <= parts <= 256:
        raise Refusal(f"has {parts} channels, 1 to 256 are read", LIMIT)
    methods = {"raw": "raw", "gzip": "zlib", "gz": "zlib", "bzip2": "bzip2", "bz2": "bzip2"}
    if fields["encoding"].lower() not in methods:
        raise Refusal(f"encoding {fields['encoding']} is not read; raw, gzip and bzip2 are",
                      UNSUPPORTED)
    method = methods[fields["encoding"].lower()]
    name = fields.get("datafile")
    if name and (name.startswith("LIST") or "%" in name):
        raise Refusal("its values lie in several files; only one is read", UNSUPPORTED)
    data_path = beside(path, name) if name else path
    if not os.path.exists(data_path):
        raise Refusal(f"its data file {name} does not exist", NOT_FOUND)
    itemsize = int(code[1])
    check_claim(data_path, count * parts, itemsize, method)
    skip = int(fields.get("byteskip", "0"))
    read = mapped_bytes if method == "raw" else read_bytes
    data = read(data_path, 0 if name else offset)
    data = unpacked(data, method, count * parts * itemsize + max(skip, 0))[max(skip, 0):]
    order = ">" if fields.get("endian", "little") == "big" else "<"
    values = numbers_of(data, order + code, count * parts,
                        f"its data ({os.path.basename(data_path)})", tail=skip == -1)
    spacing, origin, direction = nrrd_geometry(fields, first)
    send.format("NRRD")
    title = fields.get("content") or stem_of(path)
    if channel_last:
        cube = values.reshape(parts, count)
        channels = [(f"{title}_{i}", cube[i]) for i in range(parts)]
    else:
        channels = channels_of(values, parts, title, count)
    send_volume(send, size, spacing, origin, direction, channels)


NIFTI_TYPES = {2: "u1", 4: "i2", 8: "i4", 16: "f4", 64: "f8", 256: "i1", 512: "u2", 768: "u4",
               1024: "i8", 1280: "u8"}


def quaternion_rows(b, c, d, sign):
    """The rotation of a NIfTI qform. Source: nifti1.h, METHOD 2."""
    a = math.sqrt(max(0.0, 1.0 - (b * b + c * c + d * d)))
    return [[a * a + b * b - c * c - d * d, 2 * (b * c - a * d), sign * 2 * (b * d + a * c)],
            [2 * (b * c + a * d), a * a + c * c - b * b - d * d, sign * 2 * (c * d - a * b)],
            [2 * (b * d - a * c), 2 * (c * d + a * b), sign * (a * a + d * d - b * b - c * c)]]


def nifti_geometry(head, order, pixdim):
    qform, sform = struct.unpack_from(order + "2h", head, 252)
    if sform > 0:
        rows = [struct.unpack_from(order + "4f", head, 280 + 16 * r) for r in range(3)]
        spacing, direction = unit_axes([[rows[r][c] for r in range(3)] for c in range(3)])
        return spacing, [row[3] for row in rows], direction
    spacing = [abs(x) or 1.0 for x in pixdim[1:4]]
    if qform > 0:
        b, c, d, x, y, z = struct.unpack_from(order + "6f", head, 256)
        sign = -1.0 if pixdim[0] < 0 else 1.0
        return spacing, [x, y, z], quaternion_rows(b, c, d, sign)
    return spacing, [0.0, 0.0, 0.0], IDENTITY


def nifti_bytes(path, limit):
    """The first `limit` bytes, uncompressed."""
    if not path.lower().endswith(".gz"):
        return read_bytes(path, 0, limit)
    try:
        with gzip.open(path, "rb") as file:
            return file.read(limit)
    except (EOFError, zlib.error, gzip.BadGzipFile) as error:
        raise Refusal(f"its compressed data is damaged ({error})") from error


def read_nifti(path, send):
    if os.path.getsize(path) == 0:
        raise Refusal("is empty")
    head = nifti_bytes(path, 352)
    if len(head) < 348:
        raise Refusal(f"has {len(head)} bytes, a NIfTI header has 348")
    order = "<" if struct.unpack_from("<i", head, 0)[0] == 348 else ">"
    if struct.unpack_from(order + "i", head, 0)[0] != 348 or head[344:348] != b"n+1\0":
        raise Refusal("is no NIfTI-1 file in one piece (n+1)")
    dim = struct.unpack_from(order + "8h", head, 40)
    if not 1 <= dim[0] <= 7:
        raise Refusal(f"says {dim[0]} dimensions")
    extents = [n for n in dim[1:dim[0] + 1]] + [1] * (7 - dim[0])
    size, parts = extents[:3], math.prod(extents[3:])
    count = count_of(size)
    if not 1 <= parts <= 256:
        raise Refusal(f"has {parts} channels and time steps, 1 to 256 are read", LIMIT)
    number = struct.unpack_from(order + "h", head, 70)[0]
    if number not in NIFTI_TYPES:
        raise Refusal(f"data type {number} is not read", UNSUPPORTED)
    pixdim = struct.unpack_from(order + "8f", head, 76)
    offset, slope, intercept = struct.unpack_from(order + "3f", head, 108)
    if not (348 <= offset <= 1 << 20):
        raise Refusal(f"its values start at byte {offset}")
    dtype = order + NIFTI_TYPES[number]
    packed = path.lower().endswith(".gz")
    check_claim(path, count * parts, int(dtype[2:]), "zlib" if packed else "raw")
    end = int(offset) + count * parts * int(dtype[2:])
    data = not_longer(nifti_bytes(path, end + 1), end) if packed else nifti_bytes(path, end)
    values = numbers_of(memoryview(data)[int(offset):], dtype, count * parts, "its data")
    if math.isfinite(slope) and slope != 0 and (slope, intercept) != (1.0, 0.0):
        values = (values.astype("f8") * slope + intercept).astype("f4")
        send.warning(f"voxels are scaled by {slope:g} and shifted by {intercept:g}, as the file "
                     "says, and kept as float32")
    spacing, origin, direction = nifti_geometry(head, order, pixdim)
    send.format("NIfTI")
    cube = values.reshape(parts, count)
    stem = stem_of(path)
    names = [stem] if parts == 1 else [f"{stem}_{i}" for i in range(parts)]
    send_volume(send, size, spacing, origin, direction, list(zip(names, cube)))


def read(path, send):
    name = path.lower()
    if name.endswith((".mhd", ".mha")):
        read_meta(path, send)
    elif name.endswith((".nrrd", ".nhdr")):
        read_nrrd(path, send)
    else:
        read_nifti(path, send)
