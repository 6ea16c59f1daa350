#include <filesystem>
#include <fstream>
#include <sys/stat.h>

#include "renderer/base/sandbox.h"
#include "tests/e2e/import/import_fixture.h"

namespace volcast::test {
namespace {

using BadInput = Import;

constexpr auto kInvalid = ErrorCode::kInvalidArgument;
constexpr auto kLimit = ErrorCode::kLimitExceeded;

/// A VTU file as text with one tetrahedron and a field.
std::string vtu(const std::string& points = "4", const std::string& lastValue = "4") {
    return R"(<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">
<UnstructuredGrid><Piece NumberOfPoints=")" +
           points + R"(" NumberOfCells="1">
<PointData><DataArray type="Float32" Name="heat" format="ascii">1 2 3 )" +
           lastValue + R"(</DataArray></PointData>
<Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">
0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points>
<Cells><DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 3</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">4</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">10</DataArray></Cells>
</Piece></UnstructuredGrid></VTKFile>)";
}

std::string mhd(const std::string& size, const std::string& type, const std::string& data) {
    return "ObjectType = Image\nNDims = 3\nDimSize = " + size + "\nElementType = " + type +
           "\nElementDataFile = " + data + "\n";
}

TEST_F(BadInput, AFileThatDoesNotExist) {
    for (const char* name :
         {"a.vtu", "a.node", "a.off", "a.mhd", "a.tif", "a.xdmf", "a.msh", "b"}) {
        expectRefused(folder.path(name), ErrorCode::kNotFound, "No such file");
    }
}

TEST_F(BadInput, EmptyFilesOfEachFormat) {
    for (const char* name :
         {"a.vtu", "a.vtk", "a.vti", "a.ex2", "a.node", "a.off", "a.stl", "a.ply", "a.poly",
          "a.smesh", "a.mhd", "a.nrrd", "a.nii", "a.nii.gz", "a.tif", "a.png", "a.xdmf", "a.msh"}) {
        expectRefused(folder.write(name, ""), kInvalid, "is empty");
    }
}

TEST_F(BadInput, TextInsteadOfEachFormat) {
    const std::string prose = "Dear reader, this is a letter and no dataset at all.\n";
    const std::vector<std::pair<const char*, const char*>> cases{
        {"a.vtu", "VTKFile"},  {"a.vti", "VTKFile"},    {"a.vtk", "vtk DataFile"},
        {"a.ex2", "Exodus"},   {"a.node", "line 1"},    {"a.off", "OFF"},
        {"a.stl", "STL"},      {"a.ply", "PLY"},        {"a.poly", "line 1"},
        {"a.smesh", "line 1"}, {"a.mhd", "MetaImage"},  {"a.nrrd", "NRRD"},
        {"a.nii", "348"},      {"a.nii.gz", "damaged"}, {"a.tif", "TIFF"},
        {"a.png", "PNG"},      {"a.xdmf", "XML"},       {"a.msh", "Gmsh"}};
    for (const auto& [name, reason] : cases) {
        expectRefused(folder.write(name, prose), kInvalid, reason);
    }
}

TEST_F(BadInput, UnknownKindsAndFoldersWithoutPictures) {
    expectRefused(folder.write("a.doc", "x"), ErrorCode::kUnsupported, "no loader");
    std::filesystem::create_directory(folder.path("sub"));
    expectRefused(folder.path("sub"), ErrorCode::kUnsupported, "no TIFF or PNG");
}

TEST_F(BadInput, APipeIsNoFile) {
    ASSERT_EQ(::mkfifo(folder.path("a.vtu").c_str(), 0600), 0);
    expectRefused(folder.path("a.vtu"), kInvalid, "neither a plain file");
}

TEST_F(BadInput, AFileWithoutPermission) {
    const std::string path = folder.write("a.off", cubeOff());
    ASSERT_EQ(::chmod(path.c_str(), 0), 0);
    expectRefused(path, ErrorCode::kIo, "Permission denied");
}

TEST_F(BadInput, VtuTruncatedAbsurdAndNotFinite) {
    const std::string whole = vtu();
    EXPECT_EQ(mesh(folder.write("good.vtu", whole)).cells.size(), 1U);
    expectRefused(folder.write("cut.vtu", whole.substr(0, whole.size() / 2)), kInvalid,
                  "VTK's reader says");
    expectRefused(folder.write("huge.vtu", vtu("1000000000000")), kLimit, "NumberOfPoints");
    expectRefused(folder.write("more.vtu", vtu("40")), kInvalid, "VTK's reader says");
    ASSERT_EQ(folder.python(R"(
import base64, struct
text = open('good.vtu').read().replace('Name="heat" format="ascii">1 2 3 4', 'Name="heat" '
    'format="binary">' + base64.b64encode(struct.pack('<I', 16)
                                         + struct.pack('<4f', 1, 2, 3, float('inf'))).decode())
open('inf.vtu', 'w').write(text)
)"),
              "");
    expectRefused(folder.path("inf.vtu"), kInvalid, "field \"heat\": value inf at index 3");
}

TEST_F(BadInput, LegacyVtkTruncatedAbsurdAndNotFinite) {
    const std::string head = "# vtk DataFile Version 3.0\nx\nASCII\nDATASET STRUCTURED_POINTS\n";
    const auto points = [&](const std::string& dims, const std::string& values) {
        return head + "DIMENSIONS " + dims + "\nORIGIN 0 0 0\nSPACING 1 1 1\nPOINT_DATA 8\n" +
               "SCALARS v float 1\nLOOKUP_TABLE default\n" + values + "\n";
    };
    EXPECT_EQ(volume(folder.write("good.vtk", points("2 2 2", "1 2 3 4 5 6 7 8"))).size,
              glm::ivec3(2));
    expectRefused(folder.write("cut.vtk", points("2 2 2", "1 2 3 4 5")), kInvalid, "VTK");
    expectRefused(folder.write("huge.vtk", points("100000 100000 100", "1")), kLimit, "DIMENSIONS");
    const std::string binary =
        "# vtk DataFile Version 3.0\nx\nBINARY\n"
        "DATASET STRUCTURED_POINTS\nDIMENSIONS 2 1 1\nORIGIN 0 0 0\n"
        "SPACING 1 1 1\nPOINT_DATA 2\nSCALARS v float 1\n"
        "LOOKUP_TABLE default\n";
    const std::string oneAndInfinity{"\x3f\x80\x00\x00\x7f\x80\x00\x00\n", 9};  // Big-endian.
    expectRefused(folder.write("inf.vtk", binary + oneAndInfinity), kInvalid,
                  "\"v\": value inf at index 1");
    const std::string nanAndNan{"\x7f\xc0\x00\x00\x7f\xc0\x00\x00\n", 9};
    expectRefused(folder.write("nan.vtk", binary + nanAndNan), kInvalid,
                  "channel 'v': has no value, all 2 voxels are NaN");
}

TEST_F(BadInput, TetgenFiles) {
    const auto pair = [&](const std::string& name, const std::string& node,
                          const std::string& ele) {
        folder.write(name + ".ele", ele);
        return folder.write(name + ".node", node);
    };
    const std::string node = cubeNode();
    const std::string ele = cubeEle();
    expectRefused(pair("cut", node.substr(0, node.size() - 60), ele), kInvalid, "cut.node");
    const std::string cutEle = ele.substr(0, 30);
    const auto cells = import(pair("cells", node, cutEle));
    ASSERT_FALSE(cells.has_value());
    EXPECT_NE(cells.error().message.find("cells.ele: "), std::string::npos)
        << cells.error().message;
    expectRefused(pair("huge", "1000000000000 3 0 0\n0 0 0 0\n", ele), kLimit, "1000000000000");
    expectRefused(pair("nan", "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 nan 0\n3 0 0 1\n", ele), kInvalid,
                  "line 4");
    expectRefused(pair("index", "4 3 0 0\n0 0 0 0\n1 1 0 0\n3 0 1 0\n2 0 0 1\n", ele), kInvalid,
                  "stands where 2 is expected");
    const auto wrong = import(pair("wrong", node, "1 4 0\n0 0 1 2 99\n"));
    ASSERT_FALSE(wrong.has_value());
    EXPECT_NE(wrong.error().message.find("names point 99"), std::string::npos);
}

TEST_F(BadInput, Surfaces) {
    const std::string off = cubeOff();
    expectRefused(folder.write("cut.off", off.substr(0, 80)), kInvalid, "line");
    expectRefused(folder.write("huge.off", "OFF\n1000000000000 6 0\n0 0 0\n"), kLimit,
                  "1000000000000");
    std::string open = off.substr(0, off.rfind("4 3 0 4 7"));
    open.replace(open.find("8 6 12"), 6, "8 5 12");
    expectRefused(folder.write("open.off", open), kInvalid, "not closed");
    expectRefused(folder.write("nan.off", "OFF\n4 4 6\n0 0 0\n1 0 nan\n0 1 0\n0 0 1\n"), kInvalid,
                  "line 4");
    // A second cube whose corner sticks through a face of the first.
    std::string crossing = "OFF\n16 12 24\n";
    for (const double shift : {0.0, 0.5}) {
        for (const auto& p :
             {glm::dvec3{0, 0, 0}, glm::dvec3{1, 0, 0}, glm::dvec3{1, 1, 0}, glm::dvec3{0, 1, 0},
              glm::dvec3{0, 0, 1}, glm::dvec3{1, 0, 1}, glm::dvec3{1, 1, 1}, glm::dvec3{0, 1, 1}}) {
            crossing += std::to_string(p.x + shift) + " " + std::to_string(p.y + shift) + " " +
                        std::to_string(p.z + shift) + "\n";
        }
    }
    for (const int base : {0, 8}) {
        for (const auto& f :
             {glm::ivec4{0, 3, 2, 1}, glm::ivec4{4, 5, 6, 7}, glm::ivec4{0, 1, 5, 4},
              glm::ivec4{1, 2, 6, 5}, glm::ivec4{2, 3, 7, 6}, glm::ivec4{3, 0, 4, 7}}) {
            crossing += "4 " + std::to_string(f.x + base) + " " + std::to_string(f.y + base) + " " +
                        std::to_string(f.z + base) + " " + std::to_string(f.w + base) + "\n";
        }
    }
    expectRefused(folder.write("crossing.off", crossing), kInvalid, "intersects itself");
    const std::string stl = cubeStlText();
    expectRefused(folder.write("cut.stl", stl.substr(0, 300)), kInvalid, "cut.stl");
    request.tetgenSwitches = "pk";
    expectRefused(folder.write("switches.off", off), kInvalid, "'k'");
}

TEST_F(BadInput, Grids) {
    folder.write("eight.raw", std::string(8, 'x'));
    EXPECT_EQ(volume(folder.write("good.mhd", mhd("2 2 2", "MET_UCHAR", "eight.raw"))).size,
              glm::ivec3(2));
    expectRefused(folder.write("cut.mhd", mhd("2 2 3", "MET_UCHAR", "eight.raw")), kInvalid,
                  "eight.raw");
    expectRefused(folder.write("huge.mhd", mhd("30000 30000 30000", "MET_FLOAT", "eight.raw")),
                  kInvalid, "eight.raw has 8 bytes");
    expectRefused(folder.write("wide.mhd", mhd("1000000 1 1", "MET_FLOAT", "eight.raw")), kLimit,
                  "size");
    expectRefused(folder.write("missing.mhd", mhd("2 2 2", "MET_UCHAR", "none.raw")),
                  ErrorCode::kNotFound, "none.raw");
    expectRefused(folder.write("outside.mhd", mhd("2 2 2", "MET_UCHAR", "/etc/hostname")),
                  ErrorCode::kUnsupported, "outside");
    expectRefused(folder.write("type.mhd", mhd("2 2 2", "MET_STRING", "eight.raw")),
                  ErrorCode::kUnsupported, "MET_STRING");
    std::string values(32, '\0');
    values.replace(20, 4, std::string{"\x00\x00\x80\x7f", 4});
    folder.write("inf.raw", values);
    expectRefused(folder.write("inf.mhd", mhd("2 2 2", "MET_FLOAT", "inf.raw")), kInvalid,
                  "value inf at index 5");
    values.replace(20, 4, std::string{"\x00\x00\xc0\x7f", 4});
    folder.write("nan.raw", values);
    EXPECT_EQ(volume(folder.write("nan.mhd", mhd("2 2 2", "MET_FLOAT", "nan.raw")))
                  .channels[0]
                  .voxelsWithoutValue,
              1U);
    EXPECT_EQ(warnings.size(), 1U);
    const std::string nrrd = "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 2\n";
    expectRefused(folder.write("cut.nrrd", nrrd + "encoding: raw\n\n1234"), kInvalid, "bytes");
    expectRefused(folder.write("packed.nrrd", nrrd + "encoding: gzip\n\n12345678"), kInvalid,
                  "damaged");
    expectRefused(folder.write("lacks.nrrd", "NRRD0004\ntype: uchar\n\n"), kInvalid, "dimension");
}

TEST_F(BadInput, XdmfAndGmsh) {
    const std::string xdmf =
        R"(<Xdmf Version="3.0"><Domain><Grid><Topology TopologyType="Tetrahedron">
<DataItem Dimensions="1 4" NumberType="Int" Format="XML">0 1 2 3</DataItem></Topology>
<Geometry GeometryType="XYZ"><DataItem Dimensions="4 3" Format="HDF">none.h5:/mesh</DataItem>
</Geometry></Grid></Domain></Xdmf>)";
    expectRefused(folder.write("missing.xdmf", xdmf), ErrorCode::kNotFound, "none.h5");
    expectRefused(folder.write("cut.xdmf", xdmf.substr(0, 200)), kInvalid, "XML");
    const std::string msh = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n";
    expectRefused(folder.write("huge.msh", msh + "1000000000000\n1 0 0 0\n$EndNodes\n"), kLimit,
                  "1000000000000");
    expectRefused(folder.write("cut.msh", msh + "4\n1 0 0 0\n2 1 0 0\n"), kInvalid,
                  "is cut off: $Nodes has no $EndNodes");
}

TEST_F(BadInput, Pictures) {
    ASSERT_EQ(folder.python(R"(
import struct, zlib
def png(name, w, h, claim=None):
    chunk = lambda k, d: struct.pack('>I', len(d)) + k + d + struct.pack('>I', zlib.crc32(k + d))
    rows = b''.join(b'\0' + bytes(w) for _ in range(h))
    cw, ch = claim or (w, h)
    head = struct.pack('>IIBBBBB', cw, ch, 8, 0, 0, 0, 0)
    open(name, 'wb').write(b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', head) +
                           chunk(b'IDAT', zlib.compress(rows)) + chunk(b'IEND', b''))
import os
for d in ('one', 'sizes', 'huge', 'cut', 'wrong'): os.mkdir(d)
png('one/a1.png', 4, 4)
png('sizes/a1.png', 4, 4); png('sizes/a2.png', 5, 4)
png('huge/a1.png', 4, 4, (30000, 30000)); png('huge/a2.png', 4, 4)
png('cut/a1.png', 64, 64); open('cut/a2.png', 'wb').write(open('cut/a1.png', 'rb').read()[:60])
png('wrong/a1.png', 4, 4); os.rename('wrong/a1.png', 'wrong/a1.tif')
)"),
              "");
    expectRefused(folder.path("one"), ErrorCode::kUnsupported, "one slice");
    expectRefused(folder.path("sizes"), kInvalid, "a2.png: is 5 x 4");
    expectRefused(folder.path("huge"), kLimit, "a1.png: says 30000 x 30000");
    expectRefused(folder.path("cut"), kInvalid, "a2.png");
    expectRefused(folder.path("wrong"), kInvalid, "cannot be read as TIFF");
}

// TetGen would fill this cube with some 1e12 cells.
TEST_F(BadInput, AnImportPastItsDeadlineIsEnded) {
    settings.deadline = std::chrono::milliseconds{1500};
    request.tetgenSwitches = "pqa0.0000000001";
    expectRefused(folder.write("a.off", cubeOff()), ErrorCode::kTimeout, "1500 ms");
}

TEST_F(BadInput, AnImportPastItsMemoryIsEnded) {
    if (!base::kLimitsAddressSpace) {
        GTEST_SKIP() << "a sanitizer needs more addresses than any limit";
    }
    settings.maxMemoryBytes = std::uint64_t{16} << 20;
    folder.write("zeros.raw", "");
    std::filesystem::resize_file(folder.path("zeros.raw"), std::uintmax_t{1} << 30);
    expectRefused(folder.write("big.mhd", mhd("1024 1024 1024", "MET_UCHAR", "zeros.raw")), kLimit,
                  "memory");
    request.tetgenSwitches = "pqa0.0000001";  // Some 1e7 cells.
    expectRefused(folder.write("a.off", cubeOff()), kLimit, "memory");
}

// The sandbox leaves the dataset's own folder alone readable.
TEST_F(BadInput, ALinkOutOfTheFolderIsNotFollowed) {
    if (base::sandboxFeatures().landlockAbi == 0) GTEST_SKIP() << "this kernel has no Landlock";
    const TempFolder elsewhere;
    elsewhere.write("secret.raw", std::string(8, 's'));
    elsewhere.write("cube.ele", cubeEle());
    std::filesystem::create_symlink(elsewhere.path("secret.raw"), folder.path("secret.raw"));
    std::filesystem::create_symlink(elsewhere.path("cube.ele"), folder.path("cube.ele"));
    expectRefused(folder.write("a.mhd", mhd("2 2 2", "MET_UCHAR", "secret.raw")), ErrorCode::kIo,
                  "Permission denied");
    const auto cells = import(folder.write("cube.node", cubeNode()));
    ASSERT_FALSE(cells.has_value());
    EXPECT_EQ(cells.error().code, ErrorCode::kIo) << cells.error().message;
}

TEST_F(BadInput, ALinkToADatasetIsFollowed) {
    const TempFolder elsewhere;
    elsewhere.write("good.raw", std::string(8, 's'));
    elsewhere.write("good.mhd", mhd("2 2 2", "MET_UCHAR", "good.raw"));
    std::filesystem::create_symlink(elsewhere.path("good.mhd"), folder.path("good.mhd"));
    std::filesystem::create_symlink(elsewhere.path("good.raw"), folder.path("good.raw"));
    EXPECT_EQ(volume(folder.path("good.mhd")).size, glm::ivec3(2));
}

// As a server imports: whatever has become of the path since it looked.
TEST_F(BadInput, BeneathAFolderNoLinkLeadsOut) {
    const TempFolder elsewhere;
    elsewhere.write("good.raw", std::string(8, 's'));
    elsewhere.write("good.mhd", mhd("2 2 2", "MET_UCHAR", "good.raw"));
    std::filesystem::create_directory(folder.path("data"));
    settings.beneath = folder.path("data");
    folder.write("data/own.raw", std::string(8, 's'));
    const std::string own = folder.write("data/own.mhd", mhd("2 2 2", "MET_UCHAR", "own.raw"));
    EXPECT_EQ(volume(own).size, glm::ivec3(2));
    EXPECT_FALSE(mesh("demo:mesh").cells.empty()) << "what is built in lies nowhere";
    std::filesystem::create_symlink(elsewhere.path(), folder.path("data/out"));
    expectRefused(folder.path("data/out/good.mhd"), ErrorCode::kIo, "leads out of");
    std::filesystem::create_symlink(elsewhere.path("good.mhd"), folder.path("data/link.mhd"));
    expectRefused(folder.path("data/link.mhd"), ErrorCode::kIo, "leads out of");
    std::filesystem::create_symlink(own, folder.path("data/within.mhd"));
    EXPECT_EQ(volume(folder.path("data/within.mhd")).size, glm::ivec3(2));
    folder.write("data2.mhd", mhd("2 2 2", "MET_UCHAR", "data/own.raw"));
    expectRefused(folder.path("data2.mhd"), ErrorCode::kIo, "leads out of");
}

TEST_F(BadInput, AMissingImporterIsNamed) {
    settings.importPath = folder.path("no-such-program");
    request.path = "demo:volume";
    const auto imported = workers::runImport(request, settings, nullptr);
    ASSERT_FALSE(imported.has_value());
    EXPECT_EQ(imported.error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace volcast::test
