"""VTU, legacy VTK, VTI and Exodus through VTK's readers. Modules are imported one by one: all of
`vtk` takes a second. Long because it is one program text: it travels as a whole into the child."""

import re

CELL_KINDS = {10: ("tetra", 4), 11: ("voxel", 8), 12: ("hexahedron", 8), 13: ("wedge", 6),
              14: ("pyramid", 5), 24: ("tetra10", 10), 25: ("hexahedron20", 20),
              26: ("wedge15", 15), 27: ("pyramid13", 13), 29: ("hexahedron27", 27),
              32: ("wedge18", 18)}
FLAT_KINDS = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 21, 22, 23, 28, 30, 34, 35, 36}
LARGEST_RATIO = 1100  # zlib packs at most 1032 : 1


class Errors:
    """What VTK says instead of raising."""

    def __init__(self):
        from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkStringOutputWindow
        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
        self.window = vtkStringOutputWindow()
        vtkOutputWindow.SetInstance(self.window)

    def first(self):
        """The first error. Some are only warnings to VTK, such as values that are missing."""
        for kind, text in re.findall(r"(ERROR|Warning): In [^\n]*\n(.*?)(?:\n\n|\Z)",
                                     self.window.GetOutput(), re.S):
            text = re.sub(r"^\w+ \(0x[0-9a-f]+\): ", "", text)
            if kind == "ERROR" or "rror" in text:
                return " ".join(text.split())
        return None

    def check(self, what):
        message = self.first()
        if message:
            raise Refusal(f"{what}: {message}")


def update(reader, send, errors, what):
    reader.AddObserver("ProgressEvent",
                       lambda source, _: send.progress("read", source.GetProgress()))
    reader.Update()
    errors.check(what)


def check_xml_claims(path):
    """Refuses counts that a file of this size cannot hold, before VTK reserves memory for them."""
    size = os.path.getsize(path)
    if size == 0:
        raise Refusal("is empty")
    with open(path, "rb") as file:
        head = file.read(1 << 20).split(b"<AppendedData")[0]
    if b"<VTKFile" not in head:
        raise Refusal("is no VTK XML file (there is no <VTKFile> in it)")
    ratio = LARGEST_RATIO if b"compressor=" in head else 1
    for name, text in re.findall(rb'(NumberOfPoints|NumberOfCells)\s*=\s*"\s*(\d+)', head):
        if int(text) > size * ratio:
            raise Refusal(f"{name.decode()} says {int(text)}, which {size} bytes cannot hold", LIMIT)
    for text in re.findall(rb'WholeExtent\s*=\s*"([-\d\s]+)"', head):
        e = [int(word) for word in text.split()]
        count = 1
        for low, high in zip(e[0::2], e[1::2]):
            count *= max(high - low + 1, 1)
        if count > size * ratio:
            raise Refusal(f"WholeExtent says {count} points, which {size} bytes cannot hold", LIMIT)


def check_legacy_claims(path):
    size = os.path.getsize(path)
    if size == 0:
        raise Refusal("is empty")
    with open(path, "rb") as file:
        head = file.read(1 << 26)
    if not head.startswith(b"# vtk DataFile"):
        raise Refusal('is no legacy VTK file (it does not start with "# vtk DataFile")')
    pattern = rb"^(POINTS|CELLS|CELL_TYPES|POINT_DATA|CELL_DATA)[ \t]+(\d+)"
    for name, text in re.findall(pattern, head, re.M):
        if int(text) > size:
            raise Refusal(f"{name.decode()} says {int(text)}, which {size} bytes cannot hold", LIMIT)
    for text in re.findall(rb"^DIMENSIONS[ \t]+([\d \t]+)", head, re.M):
        count = 1
        for word in text.split():
            count *= int(word)
        if count > size:
            raise Refusal(f"DIMENSIONS says {count} points, which {size} bytes cannot hold", LIMIT)


def arrays_of(data):
    """(name, numpy array n or n x k, unit) of point or cell data; strings are left out."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    for i in range(data.GetNumberOfArrays()):
        array = data.GetArray(i)
        if array is None or data.GetArrayName(i) in ("vtkGhostType", "vtkOriginalPointIds",
                                                     "vtkOriginalCellIds"):
            continue
        yield data.GetArrayName(i) or f"array {i}", vtk_to_numpy(array)


def split_by_kind(grid):
    """[(kind, indices of the cells, connectivity)] of an unstructured grid, and what is flat."""
    import numpy
    from vtkmodules.util.numpy_support import vtk_to_numpy
    if grid.GetNumberOfCells() == 0:
        return [], 0
    types = vtk_to_numpy(grid.GetCellTypesArray())
    offsets = vtk_to_numpy(grid.GetCells().GetOffsetsArray()).astype("i8")
    connectivity = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    blocks, flat = [], 0
    for number in numpy.unique(types):
        cells = numpy.flatnonzero(types == number)
        if number in FLAT_KINDS:
            flat += len(cells)
            continue
        if number not in CELL_KINDS:
            raise Refusal(f"has {len(cells)} cells of VTK type {number}; tetrahedra, hexahedra, "
                          "voxels, wedges, pyramids and their quadratic forms can be drawn",
                          UNSUPPORTED)
        kind, vertices = CELL_KINDS[number]
        counts = offsets[cells + 1] - offsets[cells]
        if (counts != vertices).any():
            wrong = cells[numpy.flatnonzero(counts != vertices)[0]]
            raise Refusal(f"cell {wrong} is a {kind} with a wrong number of points")
        nodes = connectivity[offsets[cells][:, None] + numpy.arange(vertices)[None, :]]
        if kind == "voxel":
            kind, nodes = "hexahedron", nodes[:, [0, 1, 3, 2, 4, 5, 7, 6]]
        blocks.append((kind, cells, nodes))
    return blocks, flat


def send_cells(send, blocks, flat, points):
    if not blocks:
        seen = f"only {flat} vertices, lines or flat cells" if flat else "no cells"
        raise Refusal(f"has no cells with a volume ({seen})", UNSUPPORTED)
    if flat:
        send.warning(f"{flat} vertices, lines and flat cells are left out")
    for kind, _, nodes in blocks:
        if nodes.min() < 0 or nodes.max() >= points:
            wrong = nodes.min() if nodes.min() < 0 else nodes.max()
            raise Refusal(f"a {kind} names point {wrong}, there are {points}")
        send.cells(kind, nodes)


def send_unstructured(send, grid):
    import numpy
    from vtkmodules.util.numpy_support import vtk_to_numpy
    if grid.GetNumberOfPoints() == 0:
        raise Refusal("has no points")
    send.points(vtk_to_numpy(grid.GetPoints().GetData()))
    blocks, flat = split_by_kind(grid)
    send_cells(send, blocks, flat, grid.GetNumberOfPoints())
    order = numpy.concatenate([cells for _, cells, _ in blocks])
    for name, values in arrays_of(grid.GetPointData()):
        send.field(name, "point", values)
    point_names = {name for name, _ in arrays_of(grid.GetPointData())}
    for name, values in arrays_of(grid.GetCellData()):
        require_not_infinite(f'cell field "{name}"', values)
        send.field(name + " (cells)" if name in point_names else name, "cell", values[order])


def send_structured_grid(send, grid):
    """A curvilinear grid: its cells are hexahedra."""
    from vtkmodules.vtkFiltersCore import vtkAppendFilter
    append = vtkAppendFilter()
    append.AddInputData(grid)
    append.Update()
    send_unstructured(send, append.GetOutput())


def volume_channels(data):
    for name, values in arrays_of(data):
        if values.ndim == 1:
            yield name, values
        else:
            for i in range(values.shape[1]):
                yield f"{name}_{i}", values[:, i]


def send_image(send, image):
    """Values on points are voxels; with none, values on cells are voxels at their centres."""
    size = list(image.GetDimensions())
    spacing = list(image.GetSpacing())
    matrix = image.GetDirectionMatrix()
    direction = [[matrix.GetElement(r, c) for c in range(3)] for r in range(3)]
    first = [image.GetExtent()[2 * i] for i in range(3)]
    channels = list(volume_channels(image.GetPointData()))
    if not channels:
        channels = list(volume_channels(image.GetCellData()))
        size = [max(n - 1, 1) for n in size]
        first = [f + 0.5 for f in first]
    if not channels:
        raise Refusal("has no values")
    origin = [image.GetOrigin()[r] + sum(direction[r][c] * spacing[c] * first[c] for c in range(3))
              for r in range(3)]
    send_volume(send, size, spacing, origin, direction, channels)


def send_any(send, data):
    if data is None:
        raise Refusal("VTK found no dataset in it")
    kinds = {"vtkUnstructuredGrid": send_unstructured, "vtkStructuredGrid": send_structured_grid,
             "vtkImageData": send_image, "vtkStructuredPoints": send_image,
             "vtkUniformGrid": send_image}
    kind = data.GetClassName()
    if kind not in kinds:
        raise Refusal(f"holds a {kind}; unstructured grids, structured grids and images can be "
                      "drawn", UNSUPPORTED)
    if data.GetNumberOfPoints() == 0:
        raise Refusal("has no points")
    kinds[kind](send, data)


def read_vtu(path, send):
    check_xml_claims(path)
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
    errors = Errors()
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    send.format("VTU")
    update(reader, send, errors, "VTK's reader says")
    send_unstructured(send, reader.GetOutput())


def read_vti(path, send):
    check_xml_claims(path)
    from vtkmodules.vtkIOXML import vtkXMLImageDataReader
    errors = Errors()
    reader = vtkXMLImageDataReader()
    reader.SetFileName(path)
    send.format("VTI")
    update(reader, send, errors, "VTK's reader says")
    send_any(send, reader.GetOutput())


def read_legacy(path, send):
    check_legacy_claims(path)
    from vtkmodules.vtkIOLegacy import vtkGenericDataObjectReader
    errors = Errors()
    reader = vtkGenericDataObjectReader()
    reader.SetFileName(path)
    for switch in ("Scalars", "Vectors", "Tensors", "Normals", "Fields", "TCoords",
                   "ColorScalars"):
        getattr(reader, f"ReadAll{switch}On")()
    send.format("VTK")
    update(reader, send, errors, "VTK's reader says")
    send_any(send, reader.GetOutput())


def exodus_leaves(data):
    """The unstructured grids of a tree of blocks, with their names."""
    for i in range(data.GetNumberOfBlocks()):
        block = data.GetBlock(i)
        if block is None:
            continue
        if block.IsA("vtkMultiBlockDataSet"):
            yield from exodus_leaves(block)
        elif block.GetNumberOfCells():
            yield block


def exodus_cell_values(leaves, blocks, send, step):
    """Cell fields of all blocks joined; where a block has none, 0, which is said once."""
    import numpy
    names = {}
    for leaf in leaves:
        for name, values in arrays_of(leaf.GetCellData()):
            names.setdefault(name, values.shape[1:])
    for name, shape in names.items():
        parts = []
        for leaf, own in zip(leaves, blocks):
            held = dict(arrays_of(leaf.GetCellData())).get(name)
            if held is None or held.shape[1:] != shape:
                if step == 0:
                    send.warning(f'cell field "{name}" is missing in a block and is 0 there')
                held = numpy.zeros((leaf.GetNumberOfCells(), *shape))
            parts += [held[cells] for _, cells, _ in own]
        yield name, numpy.concatenate(parts)


NETCDF_BYTES = {1: 1, 2: 1, 3: 2, 4: 4, 5: 4, 6: 8, 7: 1, 8: 2, 9: 4, 10: 8, 11: 8}


class NetcdfHeader:
    """Dimensions and variables of a classic netCDF file, read from its first bytes.

    Source: netCDF classic format specification (Unidata), versions 1, 2 and 5.
    """

    def __init__(self, head):
        self.head, self.at, version = head, 4, head[3]
        self.count_form = ">q" if version == 5 else ">i"
        self.offset_form = ">i" if version == 1 else ">q"
        self.records = self.take(self.count_form)
        self.dimensions = [(self.name(), self.take(self.count_form)) for _ in self.listed()]
        self.skip_attributes()
        self.variables = [self.variable() for _ in self.listed()]

    def take(self, form):
        value = struct.unpack_from(form, self.head, self.at)[0]
        self.at += struct.calcsize(form)
        return value

    def listed(self):
        self.take(">i")
        return range(self.take(self.count_form))

    def name(self):
        length = self.take(self.count_form)
        text = self.head[self.at:self.at + length].decode("utf-8", "replace")
        self.skip(length)
        return text

    def skip(self, length):
        if length < 0:
            raise struct.error
        self.at += (length + 3) // 4 * 4

    def skip_attributes(self):
        for _ in self.listed():
            self.name()
            each = NETCDF_BYTES[self.take(">i")]
            self.skip(each * self.take(self.count_form))

    def variable(self):
        """(name, bytes of it, or of one record of it; first byte; whether it has records)."""
        name = self.name()
        lengths = [self.dimensions[self.take(self.count_form)][1]
                   for _ in range(self.take(self.count_form))]
        self.skip_attributes()
        size = NETCDF_BYTES[self.take(">i")]
        self.take(self.count_form)
        has_records = lengths[:1] == [0]
        for length in lengths[1:] if has_records else lengths:
            size *= length
        return name, size, self.take(self.offset_form), has_records


def check_netcdf_claims(path):
    """Refuses what the netCDF library does not: it reads values behind a file's end as zeros."""
    most = 1 << 24
    size = os.path.getsize(path)
    with open(path, "rb") as file:
        head = file.read(most)
    try:
        header = NetcdfHeader(head)
    except (struct.error, IndexError, KeyError) as error:
        if size > most:
            return
        raise Refusal("is cut off or damaged within its netCDF header") from error
    for name, length in header.dimensions:
        if length > size:
            raise Refusal(f"{name} says {length}, which {size} bytes cannot hold", LIMIT)
    repeated = [each for _, each, _, has_records in header.variables if has_records]
    record = repeated[0] if len(repeated) == 1 else sum((n + 3) // 4 * 4 for n in repeated)
    for name, each, start, has_records in header.variables:
        if has_records and header.records < 1:
            continue
        end = start + each + (record * (header.records - 1) if has_records else 0)
        if end > size:
            raise Refusal(f"is cut off: {name} ends at byte {end}, the file has {size} bytes")


def read_exodus(path, send):
    if os.path.getsize(path) == 0:
        raise Refusal("is empty")
    with open(path, "rb") as file:
        magic = file.read(8)
    if not (magic.startswith(b"CDF") or magic.startswith(b"\x89HDF")):
        raise Refusal("is no Exodus file (neither netCDF nor HDF5)")
    if magic.startswith(b"CDF"):
        check_netcdf_claims(path)
    from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
    from vtkmodules.vtkIOExodus import vtkExodusIIReader
    from vtkmodules.util.numpy_support import vtk_to_numpy
    errors = Errors()
    reader = vtkExodusIIReader()
    reader.SetFileName(path)
    reader.UpdateInformation()
    errors.check("VTK's reader says")
    reader.SetApplyDisplacements(0)
    reader.SetSqueezePoints(0)
    reader.SetGenerateObjectIdCellArray(0)
    reader.SetGenerateGlobalElementIdArray(0)
    reader.SetGenerateGlobalNodeIdArray(0)
    for kind in (reader.NODAL, reader.ELEM_BLOCK):
        reader.SetAllArrayStatus(kind, 1)
    send.format("Exodus")
    info = reader.GetOutputInformation(0)
    steps_key = vtkStreamingDemandDrivenPipeline.TIME_STEPS()
    times = list(info.Get(steps_key)) if info.Has(steps_key) else [0.0]
    points = 0
    for step, time in enumerate(times):
        reader.UpdateTimeStep(time)
        errors.check("VTK's reader says")
        leaves = list(exodus_leaves(reader.GetOutput()))
        if not leaves:
            raise Refusal("has no cells")
        split = [split_by_kind(leaf) for leaf in leaves]
        blocks = [own for own, _ in split]
        if step == 0:
            points = leaves[0].GetNumberOfPoints()
            send.points(vtk_to_numpy(leaves[0].GetPoints().GetData()))
            joined = [block for own in blocks for block in own]
            send_cells(send, joined, sum(flat for _, flat in split), points)
        if any(leaf.GetNumberOfPoints() != points for leaf in leaves):
            raise Refusal("its blocks have different points")
        for name, values in arrays_of(leaves[0].GetPointData()):
            send.field(name, "point", values, step, time)
        for name, values in exodus_cell_values(leaves, blocks, send, step):
            send.field(name, "cell", values, step, time)
        send.progress("read", (step + 1) / len(times))


def read(path, send):
    name = path.lower()
    if name.endswith(".vtu"):
        read_vtu(path, send)
    elif name.endswith(".vti"):
        read_vti(path, send)
    elif name.endswith(".vtk"):
        read_legacy(path, send)
    else:
        read_exodus(path, send)
