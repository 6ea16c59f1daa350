"""Gmsh 2.2 and 4.1 through meshio."""

KINDS = {"tetra", "pyramid", "wedge", "hexahedron", "tetra10", "pyramid13", "pyramid14", "wedge15",
         "wedge18", "hexahedron20", "hexahedron27"}


def check_claims(path):
    size = os.path.getsize(path)
    if size == 0:
        raise Refusal("is empty")
    with open(path, "rb") as file:
        head = file.read(1 << 26)
    if b"$MeshFormat" not in head[:4096]:
        raise Refusal("is no Gmsh file (it does not start with $MeshFormat)")
    version = head.split(b"$MeshFormat", 1)[1].split()[:2]
    import re
    if size <= len(head):
        for name in re.findall(rb"^\$(Nodes|Elements|NodeData|ElementData)\s", head, re.M):
            if b"$End" + name not in head:
                raise Refusal(f"is cut off: ${name.decode()} has no $End{name.decode()}")
    for name, text in re.findall(rb"\$(Nodes|Elements|NodeData|ElementData)\r?\n([^\r\n]{0,80})",
                                 head):
        for word in text.split()[:2]:
            if version and version[1:2] == [b"0"] and word.isdigit() and int(word) > size:
                raise Refusal(f"${name.decode()} says {int(word)} items, which {size} bytes "
                              "cannot hold", LIMIT)


def values_by_block(cells, raw):
    """Element data, taken apart by blocks of cells.

    Replaces a function of meshio 5.0 that fails where there is more than one block. Gmsh may write
    data for the solid elements alone; the others then get zeros, and are left out later.
    """
    import numpy
    pairs = [(c.type, c.data) if hasattr(c, "type") else (c[0], c[-1]) for c in cells]
    sizes = [len(nodes) for _, nodes in pairs]
    solid = [size if kind in KINDS else 0 for (kind, _), size in zip(pairs, sizes)]
    result = {}
    for name, values in raw.items():
        values = numpy.asarray(values)
        if len(values) == sum(solid) != sum(sizes):
            whole = numpy.zeros((sum(sizes), *values.shape[1:]))
            whole[numpy.repeat([size > 0 for size in solid], sizes)] = values
            values = whole
        if len(values) != sum(sizes):
            raise Refusal(f'element data "{name}" has {len(values)} values, there are {sum(sizes)} '
                          f"elements ({sum(solid)} of them solid)", UNSUPPORTED)
        result[name] = numpy.split(values, numpy.cumsum(sizes)[:-1])
    return result


def reason_of(error):
    """What an exception of meshio means to whoever made the file."""
    if isinstance(error, KeyError):
        return f"element type {error} is not known"
    if "cannot reshape" in str(error):
        return "a section holds fewer numbers than it says, or something that is no number"
    return str(error) or type(error).__name__


def read(path, send):
    check_claims(path)
    import io
    import numpy
    said = sys.stdout = io.StringIO()
    from meshio.gmsh import _gmsh22, _gmsh40, _gmsh41, read as read_gmsh
    for module in (_gmsh22, _gmsh40, _gmsh41):
        module.cell_data_from_raw = values_by_block
    try:
        mesh = read_gmsh(path)
    except Refusal:
        raise
    except Exception as error:
        raise Refusal(f"meshio cannot read it ({reason_of(error)})") from error
    send.format("Gmsh")
    for line in said.getvalue().splitlines():
        send.warning(line.strip())
    if len(mesh.points) == 0:
        raise Refusal("has no points")
    points = numpy.asarray(mesh.points, "f8")
    if points.ndim != 2 or points.shape[1] != 3:
        raise Refusal("its points do not have three coordinates", UNSUPPORTED)
    solid = [i for i, block in enumerate(mesh.cells) if block.type in KINDS]
    flat = sum(len(block.data) for block in mesh.cells if block.type not in KINDS)
    if not solid:
        raise Refusal(f"has no cells with a volume (only {flat} others)", UNSUPPORTED)
    if flat:
        send.warning(f"{flat} vertices, lines and flat cells are left out")
    send.points(points)
    for i in solid:
        nodes = numpy.asarray(mesh.cells[i].data)
        if nodes.min() < 0 or nodes.max() >= len(points):
            raise Refusal(f"a cell names point {nodes.max()}, there are {len(points)}")
        send.cells(mesh.cells[i].type, nodes)
    for name, values in mesh.point_data.items():
        if name != "gmsh:dim_tags":
            send.field(name, "point", numpy.asarray(values))
    for name, blocks in mesh.cell_data.items():
        values = numpy.concatenate([numpy.asarray(blocks[i]) for i in solid])
        send.field(name, "cell", values)
