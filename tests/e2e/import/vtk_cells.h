#pragma once

#include <glm/glm.hpp>

namespace volcast::test {

/// The field of these meshes; cells of all kinds reproduce it exactly.
inline double linear(const glm::dvec3& p) {
    return 1.0 + 2.0 * p.x - p.y + 0.5 * p.z;
}

/// Python that makes VTK grids of any cells, with a linear field f, and writes them.
inline constexpr const char* kVtkCells = R"py(
import vtkmodules.vtkIOXML, vtkmodules.vtkIOLegacy, vtkmodules.vtkCommonCore as core
import vtkmodules.vtkCommonDataModel as model
f = lambda x, y, z: 1 + 2 * x - y + 0.5 * z
def grid(points, cells):
    p, u = core.vtkPoints(), model.vtkUnstructuredGrid()
    p.SetDataTypeToDouble()
    for q in points: p.InsertNextPoint(q)
    u.SetPoints(p)
    for kind, nodes in cells:
        ids = core.vtkIdList()
        for n in nodes: ids.InsertNextId(n)
        u.InsertNextCell(kind, ids)
    a, v, c = core.vtkDoubleArray(), core.vtkDoubleArray(), core.vtkDoubleArray()
    a.SetName('f'); v.SetName('v'); v.SetNumberOfComponents(3); c.SetName('number')
    for q in points: a.InsertNextValue(f(*q)); v.InsertNextTuple3(3 * q[0], 0, 4 * q[0])
    for i in range(len(cells)): c.InsertNextValue(i)
    u.GetPointData().AddArray(a); u.GetPointData().AddArray(v); u.GetCellData().AddArray(c)
    return u
def write(name, u):
    w = vtkmodules.vtkIOXML.vtkXMLUnstructuredGridWriter() if name.endswith('vtu') \
        else vtkmodules.vtkIOLegacy.vtkUnstructuredGridWriter()
    w.SetFileName(name); w.SetInputData(u); w.Write()
def block(n, order):
    at = lambda i, j, k: i + (n + 1) * (j + (n + 1) * k)
    points = [(i / n, j / n, k / n) for k in range(n + 1) for j in range(n + 1) for i in range(n + 1)]
    import random
    ids = list(range(len(points))); random.Random(7).shuffle(ids)
    shuffled = [None] * len(points)
    for old, new in enumerate(ids): shuffled[new] = points[old]
    cells = []
    for k in range(n):
        for j in range(n):
            for i in range(n):
                c = [ids[at(i + a, j + b, k + d)] for a, b, d in
                     ((0,0,0),(1,0,0),(1,1,0),(0,1,0),(0,0,1),(1,0,1),(1,1,1),(0,1,1))]
                cells += order(c, shuffled)
    return shuffled, cells
)py";

}  // namespace volcast::test
