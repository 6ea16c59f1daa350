// Cells that are no tetrahedra: cut, filled, left out.
#include "tests/e2e/import/import_fixture.h"
#include "tests/e2e/import/vtk_cells.h"

namespace volcast::test {
namespace {

using MeshCells = Import;

TEST_F(MeshCells, SurfacesAreFilledWithTheSwitchesOfTheUser) {
    for (const auto& [name, text] :
         {std::pair{"cube.off", cubeOff()}, std::pair{"cube.stl", cubeStlText()}}) {
        const std::string path = folder.write(name, text);
        request.tetgenSwitches = "pq1.414";
        const data::Mesh coarse = mesh(path);
        EXPECT_NEAR(totalVolume(coarse), 1.0, 1e-6) << name;
        EXPECT_TRUE(coarse.fields.empty()) << name;
        request.tetgenSwitches = "pq1.414a0.001";
        const data::Mesh fine = mesh(path);
        EXPECT_NEAR(totalVolume(fine), 1.0, 1e-6) << name;
        EXPECT_GT(fine.cells.size(), 1000U) << name;
        EXPECT_LT(coarse.cells.size(), 200U) << name;
    }
}

TEST_F(MeshCells, PolyAndSmeshWithHolesAndRegions) {
    // A cube in a cube; the inner one is a hole, then a region of its own.
    std::string nodes = "16 3 0 0\n";
    int next = 0;
    for (const double half : {1.0, 0.5}) {
        for (const auto& p : {glm::dvec3{-1, -1, -1}, glm::dvec3{1, -1, -1}, glm::dvec3{1, 1, -1},
                              glm::dvec3{-1, 1, -1}, glm::dvec3{-1, -1, 1}, glm::dvec3{1, -1, 1},
                              glm::dvec3{1, 1, 1}, glm::dvec3{-1, 1, 1}}) {
            std::ostringstream line;
            line << next++ << ' ' << half * p.x << ' ' << half * p.y << ' ' << half * p.z << '\n';
            nodes += line.str();
        }
    }
    std::string rings;
    std::string facets;
    for (const int base : {0, 8}) {
        for (const auto& f :
             {glm::ivec4{0, 3, 2, 1}, glm::ivec4{4, 5, 6, 7}, glm::ivec4{0, 1, 5, 4},
              glm::ivec4{1, 2, 6, 5}, glm::ivec4{2, 3, 7, 6}, glm::ivec4{3, 0, 4, 7}}) {
            std::ostringstream ring;
            ring << "4 " << f.x + base << ' ' << f.y + base << ' ' << f.z + base << ' '
                 << f.w + base;
            rings += ring.str() + "\n";
            facets += "1 0 1 # one polygon\n" + ring.str() + "\n";
        }
    }
    const data::Mesh hollow =
        mesh(folder.write("hollow.smesh", nodes + "12 0\n" + rings + "1\n0 0 0 0\n0\n"));
    EXPECT_NEAR(totalVolume(hollow), 7.0, 1e-5);
    EXPECT_FALSE(hollow.convex);
    const data::Mesh two = mesh(folder.write(
        "two.poly", nodes + "12 1\n" + facets + "0\n2\n0 0 0 0 7 -1\n1 0.9 0.9 0.9 3 -1\n"));
    EXPECT_NEAR(totalVolume(two), 8.0, 1e-5);
    ASSERT_NE(field(two, "region"), nullptr);
    EXPECT_EQ(field(two, "region")->range, (data::Range{3.0F, 7.0F}));
}

// Points are numbered at random, so that diagonals fall every way.
TEST_F(MeshCells, HexahedraVoxelsWedgesAndPyramidsAreSplitWithoutGaps) {
    ASSERT_EQ(folder.python(std::string{kVtkCells} + R"py(
hexes = lambda c, p: [(12, c)]
voxels = lambda c, p: [(11, [c[0], c[1], c[3], c[2], c[4], c[5], c[7], c[6]])]
wedges = lambda c, p: [(13, [c[0], c[1], c[3], c[4], c[5], c[7]]), (13, [c[1], c[2], c[3], c[5], c[6], c[7]])]
def pyramids(c, p):
    p.append(tuple(sum(p[v][a] for v in c) / 8 for a in range(3)))
    m = len(p) - 1
    return [(14, [c[a], c[b], c[d], c[e], m]) for a, b, d, e in
            ((0,1,2,3),(4,7,6,5),(0,4,5,1),(1,5,6,2),(2,6,7,3),(3,7,4,0))]
for name, order in (('hexes', hexes), ('voxels', voxels), ('wedges', wedges), ('pyramids', pyramids)):
    write(name + '.vtu', grid(*block(4, order)))
    write(name + '.vtk', grid(*block(4, order)))
)py"),
              "");
    for (const auto& [name, cells, numbers] :
         {std::tuple{"hexes", 64 * 6, 63.0F}, std::tuple{"voxels", 64 * 6, 63.0F},
          std::tuple{"wedges", 64 * 6, 127.0F}, std::tuple{"pyramids", 64 * 12, 383.0F}}) {
        for (const char* suffix : {".vtu", ".vtk"}) {
            const data::Mesh cube = mesh(folder.path(std::string{name} + suffix));
            EXPECT_EQ(cube.cells.size(), static_cast<std::size_t>(cells)) << name << suffix;
            EXPECT_NEAR(totalVolume(cube), 1.0, 1e-6) << name << suffix;
            // 6 sides of 16 squares of 2 triangles; a gap inside would add to them.
            EXPECT_EQ(cube.boundaryFaces.size(), 192U) << name << suffix;
            EXPECT_TRUE(cube.convex) << name << suffix;
            ASSERT_NE(field(cube, "f"), nullptr);
            EXPECT_LT(vertexError(cube, *field(cube, "f"), linear), 1e-6) << name << suffix;
            EXPECT_EQ(field(cube, "number")->range, (data::Range{0.0F, numbers})) << name;
            EXPECT_LT(vertexError(cube, *field(cube, "v"), [](auto p) { return 5 * p.x; }), 1e-6);
            EXPECT_LT(vertexError(cube, *field(cube, "v_z"), [](auto p) { return 4 * p.x; }), 1e-6);
        }
    }
}

TEST_F(MeshCells, QuadraticCellsAreCutAtTheirMiddles) {
    ASSERT_EQ(folder.python(std::string{kVtkCells} + R"py(
edges = {'hex': [(0,1),(1,2),(2,3),(3,0),(4,5),(5,6),(6,7),(7,4),(0,4),(1,5),(2,6),(3,7)],
         'wedge': [(0,1),(1,2),(2,0),(3,4),(4,5),(5,3),(0,3),(1,4),(2,5)],
         'tetra': [(0,1),(1,2),(2,0),(0,3),(1,3),(2,3)],
         'pyramid': [(0,1),(1,2),(2,3),(3,0),(0,4),(1,4),(2,4),(3,4)]}
known = {}
def with_middles(kind, c, p):
    ids = list(c)
    for a, b in edges[kind]:
        q = tuple((p[c[a]][i] + p[c[b]][i]) / 2 for i in range(3))
        if q not in known:
            known[q] = len(p); p.append(q)
        ids.append(known[q])
    return ids
def hexes(c, p): return [(25, with_middles('hex', c, p))]
def wedges(c, p):
    return [(26, with_middles('wedge', [c[i] for i in w], p)) for w in ((0,1,3,4,5,7),(1,2,3,5,6,7))]
def tetra(c, p):
    return [(24, with_middles('tetra', [c[i] for i in t], p)) for t in
            ((0,1,2,6),(0,2,3,6),(0,3,7,6),(0,7,4,6),(0,4,5,6),(0,5,1,6))]
def pyramids(c, p):
    q = tuple(sum(p[v][a] for v in c) / 8 for a in range(3)); p.append(q); m = len(p) - 1
    return [(27, with_middles('pyramid', [c[i] for i in s] + [m], p)) for s in
            ((0,1,2,3),(4,7,6,5),(0,4,5,1),(1,5,6,2),(2,6,7,3),(3,7,4,0))]
for name, order in (('hexes', hexes), ('wedges', wedges), ('tetra', tetra), ('pyramids', pyramids)):
    known.clear()
    write(name + '.vtu', grid(*block(2, order)))
)py"),
              "");
    for (const auto& [name, cells] :
         {std::pair{"hexes", 8 * 8 * 6}, std::pair{"wedges", 16 * 8 * 3},
          std::pair{"tetra", 48 * 8}, std::pair{"pyramids", 48 * (6 * 2 + 4)}}) {
        const data::Mesh cube = mesh(folder.path(std::string{name} + ".vtu"));
        EXPECT_EQ(cube.cells.size(), static_cast<std::size_t>(cells)) << name;
        EXPECT_NEAR(totalVolume(cube), 1.0, 1e-6) << name;
        EXPECT_EQ(cube.boundaryFaces.size(), 192U) << name;  // 4 x 4 squares a side.
        EXPECT_LT(vertexError(cube, *field(cube, "f"), linear), 1e-6) << name;
    }
}

TEST_F(MeshCells, FlatCellsAreLeftOutAndSaid) {
    ASSERT_EQ(folder.python(std::string{kVtkCells} + R"py(
write('a.vtu', grid([(0,0,0),(1,0,0),(0,1,0),(0,0,1)], [(5, [0,1,2]), (10, [0,1,2,3]), (3, [0,1])]))
write('flat.vtu', grid([(0,0,0),(1,0,0),(0,1,0)], [(5, [0,1,2])]))
)py"),
              "");
    const data::Mesh cell = mesh(folder.path("a.vtu"));
    EXPECT_EQ(cell.cells.size(), 1U);
    EXPECT_EQ(field(cell, "number")->range.max, 1.0F);
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_NE(warnings[0].find("2 vertices, lines and flat cells"), std::string::npos);
    expectRefused(folder.path("flat.vtu"), ErrorCode::kUnsupported, "no cells with a volume");
}
}  // namespace
}  // namespace volcast::test
