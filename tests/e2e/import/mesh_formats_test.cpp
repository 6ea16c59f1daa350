#include <sstream>

#include "tests/e2e/import/import_fixture.h"
#include "tests/e2e/import/vtk_cells.h"

namespace volcast::test {
namespace {

/// Meshes of the unit cube; fields are linear in space, which every cell reproduces exactly.
using MeshFormats = Import;

TEST_F(MeshFormats, TetgenWithAttributesFromZeroAndFromOne) {
    for (const bool fromOne : {false, true}) {
        folder.write("cube.ele", cubeEle(fromOne));
        const data::Mesh cube = mesh(folder.write("cube.node", cubeNode(fromOne)));
        EXPECT_EQ(format, "TetGen");
        EXPECT_EQ(cube.cells.size(), 5U);
        EXPECT_EQ(cube.vertices.size(), 8U);
        EXPECT_NEAR(totalVolume(cube), 1.0, 1e-6);
        const data::Field* sum = field(cube, "sum");
        ASSERT_NE(sum, nullptr);
        EXPECT_LT(vertexError(cube, *sum, [](auto p) { return p.x + p.y + p.z; }), 1e-6);
        const data::Field* region = field(cube, "region");
        ASSERT_NE(region, nullptr);
        EXPECT_EQ(region->association, data::Association::kCell);
        EXPECT_EQ(region->range, (data::Range{10.0F, 14.0F}));
    }
}

TEST_F(MeshFormats, APointSetBecomesItsDelaunayMesh) {
    const data::Mesh cloud = mesh(folder.write("cloud.node", cubeNode()));
    EXPECT_NEAR(totalVolume(cloud), 1.0, 1e-6);
    EXPECT_TRUE(cloud.convex);
    ASSERT_NE(field(cloud, "twice_x"), nullptr);
    EXPECT_LT(vertexError(cloud, *field(cloud, "twice_x"), [](auto p) { return 2 * p.x; }), 1e-6);
    EXPECT_EQ(warnings.size(), 1U);
}

TEST_F(MeshFormats, QuadraticTetgenCellsKeepTheirMiddles) {
    folder.write("q.node",
                 "10 3 1\n0 0 0 0 0\n1 2 0 0 4\n2 0 2 0 4\n3 0 0 2 4\n4 0 1 1 2\n5 1 0 1 2\n"
                 "6 0 0 1 1\n7 1 1 0 2\n8 1 0 0 1\n9 0 1 0 1\n");
    folder.write("q.ele", "1 10 0\n0 0 1 2 3 4 5 6 7 8 9\n");
    const data::Mesh cell = mesh(folder.path("q.node"));
    EXPECT_EQ(cell.cells.size(), 8U);
    EXPECT_NEAR(totalVolume(cell), 8.0 / 6.0, 1e-6);
    EXPECT_LT(vertexError(cell, cell.fields.at(0), [](auto p) { return glm::dot(p, p); }), 1e-6);
}

// Two cells that share a face: NaN at the lower apex concerns one of them.
TEST_F(MeshFormats, CellsWithoutAValueAreKeptAndSaid) {
    ASSERT_EQ(folder.python(R"(
import vtk
from vtk.util.numpy_support import numpy_to_vtk
import numpy
grid = vtk.vtkUnstructuredGrid()
points = vtk.vtkPoints()
for p in [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (0, 0, -1)]:
    points.InsertNextPoint(p)
grid.SetPoints(points)
for cell in [(0, 1, 2, 3), (0, 2, 1, 4)]:
    grid.InsertNextCell(vtk.VTK_TETRA, 4, cell)
def put(data, name, values):
    array = numpy_to_vtk(numpy.array(values, 'f8'), deep=True)
    array.SetName(name)
    data.AddArray(array)
nan = float('nan')
put(grid.GetPointData(), 'Temp', [1, 2, 3, 4, nan])
put(grid.GetCellData(), 'Rho', [nan, 7])
put(grid.GetCellData(), 'Id', [1, 2])
writer = vtk.vtkXMLUnstructuredGridWriter()
writer.SetFileName('gaps.vtu')
writer.SetInputData(grid)
writer.Write()
array = grid.GetCellData().GetArray('Rho')
array.SetValue(1, nan)
writer.SetFileName('none.vtu')
writer.Write()
)"),
              "");
    const data::Mesh gaps = mesh(folder.path("gaps.vtu"));
    EXPECT_EQ(gaps.cells.size(), 2U);
    ASSERT_EQ(summary.fields.size(), 3U);
    EXPECT_EQ(field(gaps, "Temp")->range, (data::Range{1.0F, 4.0F}));
    EXPECT_EQ(field(gaps, "Rho")->range, (data::Range{7.0F, 7.0F}));
    for (const data::FieldSummary& one : summary.fields) {
        EXPECT_EQ(one.cellsWithoutValue, one.name == "Id" ? 0U : 1U) << one.name;
    }
    ASSERT_EQ(warnings.size(), 2U);
    EXPECT_EQ(warnings[0],
              "1 cell has no value (NaN) in \"Temp\" and is left out where it is drawn");
    expectRefused(folder.path("none.vtu"), ErrorCode::kInvalidArgument,
                  "field 'Rho': has no value, all 2 are NaN");
}

TEST_F(MeshFormats, BinaryStlAndPly) {
    ASSERT_EQ(folder.python(R"py(
import struct
corners = [(0,0,0),(1,0,0),(1,1,0),(0,1,0),(0,0,1),(1,0,1),(1,1,1),(0,1,1)]
faces = [(0,3,2,1),(4,5,6,7),(0,1,5,4),(1,2,6,5),(2,3,7,6),(3,0,4,7)]
triangles = [t for f in faces for t in ((f[0],f[1],f[2]),(f[0],f[2],f[3]))]
with open('cube.stl', 'wb') as out:
    out.write(b'solid, but binary'.ljust(80) + struct.pack('<I', len(triangles)))
    for t in triangles:
        out.write(struct.pack('<3f', 0, 0, 0))
        for v in t: out.write(struct.pack('<3f', *corners[v]))
        out.write(b'\0\0')
for order, name in (('<', 'little'), ('>', 'big')):
    with open(name + '.ply', 'wb') as out:
        out.write((f'ply\nformat binary_{name}_endian 1.0\nelement vertex 8\nproperty double x\n'
                   'property double y\nproperty double z\nproperty uchar red\nelement face 6\n'
                   'property list uchar int vertex_indices\nend_header\n').encode())
        for p in corners: out.write(struct.pack(order + '3dB', *p, 200))
        for f in faces: out.write(struct.pack(order + 'B4i', 4, *f))
with open('text.ply', 'w') as out:
    out.write('ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\n'
              'property float z\nelement face 6\nproperty list uchar int vertex_index\nend_header\n')
    for p in corners: print(*p, file=out)
    for f in faces: print(4, *f, file=out)
)py"),
              "");
    for (const char* name : {"cube.stl", "little.ply", "big.ply", "text.ply"}) {
        EXPECT_NEAR(totalVolume(mesh(folder.path(name))), 1.0, 1e-6) << name;
    }
}

TEST_F(MeshFormats, ExodusHasTimeSteps) {
    ASSERT_EQ(folder.python(std::string{kVtkCells} + R"py(
import vtkmodules.vtkIOExodus as io
import vtkmodules.vtkCommonExecutionModel as ex
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
class Steps(VTKPythonAlgorithmBase):
    def __init__(self):
        super().__init__(nInputPorts=0, nOutputPorts=1, outputType='vtkUnstructuredGrid')
    def RequestInformation(self, request, ins, outs):
        info = outs.GetInformationObject(0)
        info.Set(ex.vtkStreamingDemandDrivenPipeline.TIME_STEPS(), [0.0, 0.5, 2.0], 3)
        info.Set(ex.vtkStreamingDemandDrivenPipeline.TIME_RANGE(), [0.0, 2.0], 2)
        return 1
    def RequestData(self, request, ins, outs):
        info = outs.GetInformationObject(0)
        key = ex.vtkStreamingDemandDrivenPipeline.UPDATE_TIME_STEP()
        t = info.Get(key) if info.Has(key) else 0.0
        out = model.vtkUnstructuredGrid.GetData(outs, 0)
        u = grid(*block(2, lambda c, p: [(12, c)]))
        a = u.GetPointData().GetArray('f')
        for i in range(a.GetNumberOfTuples()): a.SetValue(i, a.GetValue(i) * (1 + t))
        out.ShallowCopy(u); out.GetInformation().Set(model.vtkDataObject.DATA_TIME_STEP(), t)
        return 1
s = Steps()
w = io.vtkExodusIIWriter(); w.SetFileName('steps.ex2'); w.SetInputConnection(s.GetOutputPort())
w.WriteAllTimeStepsOn(); w.Write()
)py"),
              "");
    const data::Mesh cube = mesh(folder.path("steps.ex2"));
    EXPECT_NEAR(totalVolume(cube), 1.0, 1e-6);
    const data::Field* f = field(cube, "f");
    ASSERT_NE(f, nullptr);
    ASSERT_EQ(f->times, (std::vector<double>{0.0, 0.5, 2.0}));
    EXPECT_LT(vertexError(cube, *f, linear, 0), 1e-5);
    EXPECT_LT(vertexError(
                  cube, *f, [](auto p) { return 3.0 * linear(p); }, 2),
              1e-5);
}

constexpr const char* kTetraCube = R"py(
import numpy as np
n = 2
at = lambda i, j, k: i + (n + 1) * (j + (n + 1) * k)
points = np.array([(i / n, j / n, k / n) for k in range(n + 1) for j in range(n + 1) for i in range(n + 1)], float)
cells = []
for k in range(n):
    for j in range(n):
        for i in range(n):
            c = [at(i + a, j + b, k + d) for a, b, d in
                 ((0,0,0),(1,0,0),(1,1,0),(0,1,0),(0,0,1),(1,0,1),(1,1,1),(0,1,1))]
            cells += [[c[v] for v in t] for t in
                      ((0,1,2,6),(0,2,3,6),(0,3,7,6),(0,7,4,6),(0,4,5,6),(0,5,1,6))]
cells = np.array(cells)
f = 1 + 2 * points[:, 0] - points[:, 1] + 0.5 * points[:, 2]
)py";

TEST_F(MeshFormats, GmshOldAndNewAsTextAndBinary) {
    ASSERT_EQ(folder.python(std::string{kTetraCube} + R"py(
import meshio
for old, version in ((True, '2.2'), (False, '4.1')):
    for binary in (False, True):
        more = [('triangle', np.array([[0, 1, 3]]))] if old else []
        numbers = [np.arange(48.0), np.zeros(1)] if old else [np.arange(48.0)]
        m = meshio.Mesh(points, [('tetra', cells)] + more, point_data={'f': f},
                        cell_data={'number': numbers})
        name = f'{"old" if old else "new"}{"b" if binary else "a"}.msh'
        meshio.gmsh.write(name, m, version, binary=binary)
)py"),
              "");
    for (const char* name : {"olda.msh", "oldb.msh", "newa.msh", "newb.msh"}) {
        const data::Mesh cube = mesh(folder.path(name));
        EXPECT_EQ(cube.cells.size(), 48U) << name;
        EXPECT_NEAR(totalVolume(cube), 1.0, 1e-6) << name;
        ASSERT_NE(field(cube, "f"), nullptr) << name;
        EXPECT_LT(vertexError(cube, *field(cube, "f"), linear), 1e-6) << name;
        ASSERT_NE(field(cube, "number"), nullptr) << name;
        EXPECT_EQ(field(cube, "number")->range, (data::Range{0.0F, 47.0F})) << name;
    }
}

TEST_F(MeshFormats, XdmfAsFenicsWritesIt) {
    ASSERT_EQ(folder.python(std::string{kTetraCube} + R"py(
import h5py
with h5py.File('heat.h5', 'w') as h:
    h['Mesh/mesh/geometry'] = points; h['Mesh/mesh/topology'] = cells
    for step in range(2): h[f'VisualisationVector/{step}'] = (f * (1 + step))[:, None]
    h['cells'] = np.arange(48.0)[:, None]
    h['dg/dofs'] = np.arange(192)[:, None]; h['dg/values'] = (cells * 0 + np.arange(48)[:, None] + f[cells]).reshape(-1, 1)
    h['dg/starts'] = (4 * np.arange(49))[:, None]; h['dg/ids'] = np.arange(48)[:, None]
item = lambda path, dims, kind='Float': f'<DataItem Dimensions="{dims}" NumberType="{kind}" Format="HDF">heat.h5:{path}</DataItem>'
mesh = ('<Topology NumberOfElements="48" TopologyType="Tetrahedron" NodesPerElement="4">' + item('/Mesh/mesh/topology', '48 4', 'UInt') +
        '</Topology><Geometry GeometryType="XYZ">' + item('/Mesh/mesh/geometry', '27 3') + '</Geometry>')
head = '<?xml version="1.0"?><!DOCTYPE Xdmf SYSTEM "Xdmf.dtd" []><Xdmf Version="3.0" xmlns:xi="http://www.w3.org/2001/XInclude"><Domain>'
steps = '<Grid Name="TimeSeries_f" GridType="Collection" CollectionType="Temporal">'
for step, time in enumerate((0.0, 0.25)):
    steps += '<Grid Name="mesh" GridType="Uniform">'
    steps += mesh if step == 0 else '<xi:include xpointer="xpointer(//Grid[@Name=&quot;TimeSeries_f&quot;]/Grid[1]/*[self::Topology or self::Geometry])" />'
    steps += f'<Time Value="{time}" /><Attribute Name="f" AttributeType="Scalar" Center="Node">' + item(f'/VisualisationVector/{step}', '27 1') + '</Attribute></Grid>'
open('heat.xdmf', 'w').write(head + steps + '</Grid></Domain></Xdmf>')
dg = ('<Attribute ItemType="FiniteElementFunction" ElementFamily="DG" ElementDegree="1" ElementCell="tetrahedron" Name="u" Center="Other" AttributeType="Scalar">'
      + item('/dg/dofs', '192 1', 'UInt') + item('/dg/values', '192 1') + item('/dg/starts', '49 1', 'UInt') + item('/dg/ids', '48 1', 'UInt') + '</Attribute>')
cell = '<Attribute Name="number" AttributeType="Scalar" Center="Cell">' + item('/cells', '48 1') + '</Attribute>'
open('more.xdmf', 'w').write(head + '<Grid Name="mesh" GridType="Uniform">' + mesh + dg + cell + '</Grid></Domain></Xdmf>')
)py"),
              "");
    const data::Mesh heat = mesh(folder.path("heat.xdmf"));
    EXPECT_EQ(heat.cells.size(), 48U);
    ASSERT_EQ(heat.fields.size(), 1U);
    EXPECT_EQ(heat.fields[0].times, (std::vector<double>{0.0, 0.25}));
    EXPECT_LT(vertexError(
                  heat, heat.fields[0], [](auto p) { return 2 * linear(p); }, 1),
              1e-6);
    const data::Mesh more = mesh(folder.path("more.xdmf"));
    const data::Field* u = field(more, "u");
    const data::Field* number = field(more, "number");
    ASSERT_NE(u, nullptr);
    ASSERT_NE(number, nullptr);
    ASSERT_EQ(u->association, data::Association::kCellVertex);
    for (std::size_t c = 0; c < more.cells.size(); ++c) {
        for (int v = 0; v < 4; ++v) {
            const auto vertex = static_cast<std::size_t>(more.cells[c][v]);
            const glm::dvec3 p = more.origin + glm::dvec3{more.vertices[vertex]};
            EXPECT_NEAR(u->steps[0][4 * c + static_cast<std::size_t>(v)],
                        number->steps[0][c] + linear(p), 1e-4);
        }
    }
}

}  // namespace
}  // namespace volcast::test
