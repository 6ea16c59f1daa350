"""What every Python reader of volcast-import shares: its own sandbox, and the way to send results.

A reader runs as a child of volcast-import, inside its sandbox, and writes records to a pipe:
`kind` u32, `text bytes` u32, `data bytes` u64 (little-endian), then text and data. The other end
(python_reader.cpp) trusts nothing of it. The arguments are: path, descriptor to write to,
descriptor with a seccomp program to load before anything of the file is read, process id of the
parent.
"""

import ctypes
import os
import struct
import sys

PROGRESS, WARNING, REFUSED, FORMAT, POINTS, CELLS, FIELD, GRID, CHANNEL, END = range(1, 11)
# Numbers of volcast::ErrorCode.
INVALID, NOT_FOUND, UNSUPPORTED, IO, LIMIT = range(5)


class Refusal(Exception):
    """The file cannot be imported; the message says why without naming the file."""

    def __init__(self, message, code=INVALID):
        super().__init__(message)
        self.code = code


def give_up_rights(program_fd, parent):
    """Dies with the parent, and refuses to execute anything from here on."""
    libc = ctypes.CDLL(None, use_errno=True)
    parent_death_signal, set_seccomp, filter_mode, sigkill = 1, 22, 2, 9
    libc.prctl(parent_death_signal, sigkill, 0, 0, 0)
    if os.getppid() != parent:  # It has died before that.
        os._exit(1)
    program = os.read(program_fd, 1 << 16)
    os.close(program_fd)
    buffer = ctypes.create_string_buffer(program, len(program))

    class Fprog(ctypes.Structure):
        _fields_ = [("length", ctypes.c_ushort), ("filter", ctypes.c_void_p)]

    loaded = Fprog(len(program) // 8, ctypes.addressof(buffer))
    if libc.prctl(set_seccomp, filter_mode, ctypes.byref(loaded), 0, 0) != 0:
        raise OSError(ctypes.get_errno(), "cannot load the seccomp filter")


def memory_limit():
    """Bytes of memory that this import may use; no file, none in memory either, may be longer."""
    import resource
    return resource.getrlimit(resource.RLIMIT_FSIZE)[0]


class Sender:
    """Writes records; one method a kind."""

    def __init__(self, fd):
        self.file = os.fdopen(fd, "wb", buffering=0)

    def record(self, kind, text="", data=b""):
        view = memoryview(data).cast("B") if len(data) else memoryview(b"")
        self.head(kind, text, view.nbytes)
        self.write(view)

    def head(self, kind, text, size):
        """What stands before `size` bytes of data."""
        words = text.encode("utf-8", "replace")
        self.write(memoryview(struct.pack("<IIQ", kind, len(words), size) + words))

    def write(self, view):
        while view.nbytes:
            view = view[self.file.write(view[: 1 << 20]):]

    def progress(self, stage, fraction):
        self.record(PROGRESS, stage, struct.pack("<d", fraction))

    def warning(self, text):
        self.record(WARNING, text)

    def format(self, text):
        self.record(FORMAT, text)

    def points(self, points):
        """`points`: n x 3."""
        require_finite("the points", points)
        self.record(POINTS, "", little(points, "<f8"))

    def cells(self, kind, connectivity):
        """Cells of one kind, in VTK's vertex order: n x vertices."""
        self.record(CELLS, kind, little(connectivity, "<i8"))

    def field(self, name, where, values, step=0, time=0.0, unit=""):
        """`values`: n or n x k, at `where`: "point", "cell" or "cellpoint".

        Of a vector `v` come its length as `v` and its parts as `v_x`, `v_y`, `v_z`; other arrays
        with k parts become `v_0` to `v_(k-1)`.
        """
        for part_name, part in scalars_of(name, values):
            text = "\x1f".join([part_name, unit, where, str(step), repr(float(time))])
            require_not_infinite(f'field "{part_name}"', part)
            self.record(FIELD, text, little(part, "<f8"))

    def grid(self, size, spacing, origin, direction, kind, names):
        """`direction`: 3 x 3, its columns are the grid's axes; `kind`: u8, u16, i16 or f32; `names`
        of the channels that follow."""
        numbers = [*size, *spacing, *origin, *[x for row in direction for x in row]]
        self.record(GRID, "\x1f".join([kind, *names]), struct.pack("<18d", *[float(x) for x in numbers]))

    def channel(self, name, voxels):
        """Part by part: a whole copy of a large array is never made."""
        length = 1 << 24
        starts = range(0, voxels.size, length)
        for start in starts:  # All before the first is sent: a record that has begun must end.
            require_not_infinite(f'channel "{name}"', voxels[start:start + length], start)
        self.head(CHANNEL, name, voxels.size * voxels.dtype.itemsize)
        for start in starts:
            part = voxels[start:start + length]
            self.write(memoryview(little(part, voxels.dtype.newbyteorder("<"))))


def little(values, dtype):
    """The values as contiguous little-endian bytes."""
    import numpy
    return numpy.ascontiguousarray(values, dtype=dtype).reshape(-1).view("u1").data


def require_finite(what, values):
    import numpy
    if values.dtype.kind == "f":
        refuse_bad(what, values, ~numpy.isfinite(values), "not finite")


def require_not_infinite(what, values, first=0):
    """For fields and voxels, where NaN stands for no value; `first`: index of the first value in its
    array."""
    import numpy
    if values.dtype.kind == "f":
        refuse_bad(what, values, numpy.isinf(values), "infinite", first)


def refuse_bad(what, values, bad, adjective, first=0):
    """Refuses the first of `values` where `bad` is true."""
    import numpy
    places = numpy.flatnonzero(bad.reshape(-1))
    if len(places):
        item = first + places[0] // (values.shape[1] if values.ndim > 1 else 1)
        value = values.reshape(-1)[places[0]]
        raise Refusal(f"{what}: value {value} at index {item} is {adjective}")


def scalars_of(name, values):
    """Names and values of the scalar fields that an array of n x k numbers becomes."""
    import numpy
    if values.ndim == 1 or values.shape[1] == 1:
        return [(name, values.reshape(-1))]
    parts = values.shape[1]
    letters = "xyz"[:parts] if parts <= 3 else [str(i) for i in range(parts)]
    result = [(f"{name}_{letter}", values[:, i]) for i, letter in enumerate(letters)]
    if parts <= 3:
        length = numpy.sqrt((values.astype("f8") ** 2).sum(axis=1))
        result.insert(0, (name, length))
    return result


def send_volume(send, size, spacing, origin, direction, channels):
    """`channels`: (name, flat array, x fastest). Types other than u8, u16, i16, f32 become f32."""
    import numpy
    kinds = {"u1": "u8", "u2": "u16", "i2": "i16", "f4": "f32"}
    own = {kinds.get(f"{a.dtype.kind}{a.dtype.itemsize}") for _, a in channels}
    kind = own.pop() if len(own) == 1 else None
    if kind is None:
        kind = "f32"
        types = ", ".join(sorted({a.dtype.name for _, a in channels}))
        send.warning(f"voxels of type {types} are kept as float32")
    send.grid(size, spacing, origin, direction, kind, [name for name, _ in channels])
    for name, values in channels:
        if values.size != size[0] * size[1] * size[2]:
            raise Refusal(f'channel "{name}": has {values.size} values, the grid of '
                          f"{size[0]} x {size[1]} x {size[2]} needs {size[0] * size[1] * size[2]}")
        if kind == "f32" and values.dtype != numpy.float32:
            require_not_infinite(f'channel "{name}"', values)
            with numpy.errstate(over="ignore"):
                values = values.astype("f4")
        send.channel(name, values)


def run(read):
    """Runs `read(path, send)` and turns whatever it raises into one refusal."""
    path, out, program, parent = sys.argv[1], *(int(word) for word in sys.argv[2:5])
    send = Sender(out)
    try:
        give_up_rights(program, parent)
        read(path, send)
        send.record(END)
    except Refusal as refusal:
        send.record(REFUSED, str(refusal), struct.pack("<i", refusal.code))
    except MemoryError:
        send.record(REFUSED, "needs more memory than the import may use", struct.pack("<i", LIMIT))
    except OSError as error:
        send.record(REFUSED, error.strerror or str(error), struct.pack("<i", IO))
    except ImportError as error:
        send.record(REFUSED, f"a Python package is missing: {error}", struct.pack("<i", UNSUPPORTED))
    except Exception as error:  # A reader's bug or a file that it did not foresee: one refusal.
        text = f"{type(error).__name__}: {error}" if str(error) else type(error).__name__
        send.record(REFUSED, f"cannot be read ({text})", struct.pack("<i", INVALID))
