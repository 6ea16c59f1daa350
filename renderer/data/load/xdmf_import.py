"""XDMF as FEniCS writes it: a mesh and its functions, in HDF5 or in the XML itself.

Understands vertex (P1) and cell (P0) attributes, functions of degree 0 and 1 (write_checkpoint:
DG0, CG1, DG1) and temporal collections. meshio's own reader knows neither such functions nor the
joining of time steps.
"""

import re
import xml.etree.ElementTree as tree

KINDS = {"tetrahedron": ("tetra", 4), "pyramid": ("pyramid", 5), "wedge": ("wedge", 6),
         "hexahedron": ("hexahedron", 8), "tetrahedron_10": ("tetra10", 10),
         "tet_10": ("tetra10", 10), "hexahedron_20": ("hexahedron20", 20),
         "hexahedron_27": ("hexahedron27", 27), "wedge_15": ("wedge15", 15),
         "pyramid_13": ("pyramid13", 13)}
MIXED = {6: ("tetra", 4), 7: ("pyramid", 5), 8: ("wedge", 6), 9: ("hexahedron", 8),
         38: ("tetra10", 10), 48: ("hexahedron20", 20)}
MIXED_FLAT = {1: 1, 2: 2, 4: 3, 5: 4, 34: 3, 36: 6}


class Items:
    """Arrays of <DataItem>; HDF5 files are opened once."""

    def __init__(self, path):
        self.folder = os.path.dirname(path) or "."
        self.files = {}

    def array(self, item, what):
        import numpy
        if item is None:
            raise Refusal(f"{what} has no DataItem")
        dims = [int(word) for word in (item.get("Dimensions") or "").split()]
        text = (item.text or "").strip()
        kind = (item.get("Format") or "XML").upper()
        if kind == "HDF":
            values = self.hdf(text, what)
        elif kind == "XML":
            if not re.fullmatch(r"[\s0-9eEinfaINFA+.\-]*", text):
                raise Refusal(f"{what} holds something that is no number")
            words = text.split()
            whole = (item.get("NumberType") or item.get("DataType") or "Float").lower()
            values = numpy.array([int(w) for w in words], "i8") if whole in ("int", "uint") \
                else numpy.array([float(w) for w in words], "f8")
        else:
            raise Refusal(f"{what} has the format {kind}; HDF and XML are read", UNSUPPORTED)
        if dims:
            count = 1
            for n in dims:
                count *= n
            if count != values.size:
                raise Refusal(f"{what} says {' x '.join(map(str, dims))} values, there are "
                              f"{values.size}")
            values = values.reshape(dims)
        return values

    def hdf(self, text, what):
        import h5py
        name, colon, inside = text.partition(":")
        name = name.strip()
        if not colon or os.path.isabs(name) or ".." in name.split("/"):
            raise Refusal(f"{what}: {text!r} is no array of a file in its folder", UNSUPPORTED)
        if name not in self.files:
            path = os.path.join(self.folder, name)
            if not os.path.exists(path):
                raise Refusal(f"its data file {name} does not exist", NOT_FOUND)
            try:
                self.files[name] = h5py.File(path, "r")
            except OSError as error:
                raise Refusal(f"its data file {name}: {error}", IO) from error
        try:
            data = self.files[name][inside.strip()]
        except KeyError as error:
            raise Refusal(f"its data file {name} has no {inside.strip()}") from error
        if not isinstance(data, h5py.Dataset):
            raise Refusal(f"{inside.strip()} of {name} is no array")
        if data.external or data.is_virtual:
            raise Refusal(f"{inside.strip()} of {name} lies in other files", UNSUPPORTED)
        if data.dtype.kind not in "iuf":
            raise Refusal(f"{inside.strip()} of {name} holds no numbers")
        claimed = data.size * data.dtype.itemsize
        size = os.path.getsize(os.path.join(self.folder, name))
        if claimed > 1100 * size:
            raise Refusal(f"{inside.strip()} of {name} says {data.size} values, which {size} bytes "
                          "cannot hold", LIMIT)
        try:
            return data[()]
        except OSError as error:
            raise Refusal(f"its data file {name}: {inside.strip()}: {error}", IO) from error


def local(tag):
    return tag.rsplit("}", 1)[-1] if isinstance(tag, str) else ""


def children(node, tag):
    return [child for child in node if local(child.tag) == tag]


def first(node, tag):
    found = children(node, tag)
    return found[0] if found else None


def grids_of(domain):
    """Grids in the order of time, with their times."""
    result = []
    for grid in children(domain, "Grid"):
        if (grid.get("CollectionType") or "").lower() == "temporal":
            steps = children(grid, "Grid")
            for i, step in enumerate(steps):
                result.append((step, time_of(step, i)))
        elif (grid.get("GridType") or "Uniform").lower() in ("collection", "tree"):
            raise Refusal("has a spatial collection of grids; one grid and collections in time "
                          "are read", UNSUPPORTED)
        else:
            result.append((grid, time_of(grid, 0)))
    return result


def time_of(grid, default):
    time = first(grid, "Time")
    return float(time.get("Value", default)) if time is not None else float(default)


def mixed_cells(values):
    """Blocks of a topology whose cells each start with their type."""
    import numpy
    blocks, order, flat, at, values = {}, {}, 0, 0, values.reshape(-1)
    number = 0
    while at < len(values):
        kind = int(values[at])
        if kind in MIXED_FLAT:
            skip = MIXED_FLAT[kind] + (2 if kind in (1, 2) else 1)
            at, flat, number = at + skip, flat + 1, number + 1
            continue
        if kind not in MIXED:
            raise Refusal(f"has a cell of XDMF type {kind}", UNSUPPORTED)
        name, vertices = MIXED[kind]
        blocks.setdefault(name, []).append(values[at + 1:at + 1 + vertices])
        order.setdefault(name, []).append(number)
        at, number = at + 1 + vertices, number + 1
    for name, rows in blocks.items():
        if len(rows[-1]) != len(rows[0]):
            raise Refusal("its topology ends within a cell")
    return ([(name, numpy.array(rows)) for name, rows in blocks.items()],
            [i for name in blocks for i in order[name]], flat)


def send_mesh(grid, items, send):
    """Sends points and cells; returns (points, tetrahedra or None, order of the cells)."""
    import numpy
    topology, geometry = first(grid, "Topology"), first(grid, "Geometry")
    if topology is None or geometry is None:
        raise Refusal("its first grid lacks a topology or a geometry")
    points = items.array(first(geometry, "DataItem"), "the geometry")
    if points.ndim != 2 or points.shape[1] != 3:
        raise Refusal(f"its geometry is {' x '.join(map(str, points.shape))}, n x 3 is needed",
                      UNSUPPORTED)
    kind = (topology.get("TopologyType") or topology.get("Type") or "").lower()
    cells = items.array(first(topology, "DataItem"), "the topology").astype("i8")
    if kind == "mixed":
        blocks, order, flat = mixed_cells(cells)
        if flat:
            send.warning(f"{flat} vertices, lines and flat cells are left out")
    elif kind in KINDS:
        name, vertices = KINDS[kind]
        if cells.size % vertices:
            raise Refusal(f"its topology is no multiple of {vertices} points a cell")
        blocks, order = [(name, cells.reshape(-1, vertices))], None
    else:
        raise Refusal(f"has the topology {kind or 'of no type'}, which has no volume cells that "
                      "can be drawn", UNSUPPORTED)
    if not blocks or not len(points):
        raise Refusal("has no cells with a volume", UNSUPPORTED)
    for name, nodes in blocks:
        if nodes.min() < 0 or nodes.max() >= len(points):
            raise Refusal(f"a {name} names point {nodes.max()}, there are {len(points)}")
    send.points(points)
    for name, nodes in blocks:
        send.cells(name, nodes)
    tetra = blocks[0][1] if len(blocks) == 1 and blocks[0][0] == "tetra" else None
    return len(points), tetra, None if order is None else numpy.array(order)


def send_function(attribute, items, send, points, tetra, step, time):
    """A finite element function: cell dofs, values, and where each cell's dofs start.

    Source: FEniCS 2019, XDMFFile::write_checkpoint: DataItems are the dofs of the cells, the
    values, the offsets and the cell ids, in this order.
    """
    import numpy
    name = attribute.get("Name") or "f"
    family, degree = attribute.get("ElementFamily", ""), attribute.get("ElementDegree", "")
    if degree not in ("0", "1") or tetra is None or "ector" in attribute.get("AttributeType", ""):
        send.warning(f'function "{name}" ({family}{degree}) is left out: scalar functions of '
                     "degree 0 and 1 on tetrahedra are read")
        return
    arrays = [items.array(item, f'function "{name}"') for item in children(attribute, "DataItem")]
    if len(arrays) < 4:
        raise Refusal(f'function "{name}" has {len(arrays)} arrays, 4 are needed')
    dofs, values = arrays[0].reshape(-1).astype("i8"), arrays[1].reshape(-1)
    starts, cells = arrays[2].reshape(-1).astype("i8"), arrays[3].reshape(-1).astype("i8")
    each = 1 if degree == "0" else 4
    count = len(tetra)
    if len(cells) != count or len(starts) < count or len(dofs) != each * count:
        raise Refusal(f'function "{name}" does not fit its mesh of {count} cells')
    if dofs.min() < 0 or dofs.max() >= len(values) or sorted(cells.tolist()) != list(range(count)) \
            or starts[:count].min() < 0 or starts[:count].max() > len(dofs) - each:
        raise Refusal(f'function "{name}" names a value or a cell that does not exist')
    table = numpy.empty((count, each), "f8")
    table[cells] = values[dofs[starts[:count, None] + numpy.arange(each)[None, :]]]
    if each == 1:
        send.field(name, "cell", table[:, 0], step, time)
    elif family in ("CG", "Lagrange", "P", "Q"):
        vertex = numpy.zeros(points)
        vertex[tetra.reshape(-1)] = table.reshape(-1)
        send.field(name, "point", vertex, step, time)
    else:
        send.field(name, "cellpoint", table.reshape(-1), step, time)


def send_attributes(grid, items, send, mesh, step, time):
    points, tetra, order = mesh
    for attribute in children(grid, "Attribute"):
        name = attribute.get("Name") or "f"
        if attribute.get("ItemType") == "FiniteElementFunction":
            send_function(attribute, items, send, points, tetra, step, time)
            continue
        centre = (attribute.get("Center") or "Node").lower()
        if centre not in ("node", "cell"):
            send.warning(f'attribute "{name}" with centre {centre} is left out')
            continue
        values = items.array(first(attribute, "DataItem"), f'attribute "{name}"')
        if values.ndim > 2:
            values = values.reshape(values.shape[0], -1)
        if centre == "cell" and order is not None:
            values = values[order]
        send.field(name, "point" if centre == "node" else "cell", values, step, time)


def read(path, send):
    if os.path.getsize(path) == 0:
        raise Refusal("is empty")
    try:
        root = tree.parse(path).getroot()
    except tree.ParseError as error:
        raise Refusal(f"is no well-formed XML ({error})") from error
    if local(root.tag) != "Xdmf" or first(root, "Domain") is None:
        raise Refusal("is no XDMF file (there is no <Xdmf> with a <Domain>)")
    grids = grids_of(first(root, "Domain"))
    if not grids:
        raise Refusal("has no grid")
    items = Items(path)
    send.format("XDMF")
    mesh = send_mesh(grids[0][0], items, send)
    carrying = [(g, t) for g, t in grids if children(g, "Attribute")]
    for step, (grid, time) in enumerate(carrying):
        send_attributes(grid, items, send, mesh, step, time)
        send.progress("read", (step + 1) / len(carrying))
