// Every family of files with every kind of damage: the error names the file and the reason.
#include <array>
#include <filesystem>
#include <ostream>

#include "tests/e2e/import/import_fixture.h"

namespace volcast::test {
namespace {

constexpr auto kInvalid = ErrorCode::kInvalidArgument;
constexpr auto kUnsupported = ErrorCode::kUnsupported;
constexpr auto kLimit = ErrorCode::kLimitExceeded;

/// What is expected of one damaged file.
struct Cell {
    ErrorCode code = kInvalid;
    const char* reason = "";   ///< Part of the message; empty: there is no such file, and
    const char* because = "";  ///< this says why.
};

constexpr Cell none(const char* because) {
    return {.because = because};
}

/// One family: its maker in damaged_files.py, its files, and what each kind of damage leads to.
struct Family {
    const char* maker;
    const char* suffix;  ///< Of what is imported; empty: a folder of pictures.
    const char* named;   ///< What follows the damage's name where the error names the file.
    Cell empty, cut, nan, absurd, kind, typed;
};

// NOLINTNEXTLINE(readability-identifier-naming): the name that GoogleTest looks for.
void PrintTo(const Family& family, std::ostream* out) {
    *out << family.maker;
}

// Each row: empty, cut off, NaN (infinity among values, where NaN means that there is none), absurd
// size, another kind of file, a value of a wrong type.
const Family kFamilies[] = {
    {"node",
     ".node",
     ".node",
     {kInvalid, "is empty"},
     {kInvalid, "line 8: has 2 words, expected 4 (point 6 of 8)"},
     {kInvalid, "line 4: \"nan\" is not finite"},
     {kLimit, "says 1000000000000 points, which a file of"},
     {kInvalid, "line 1"},
     {kInvalid, "line 4: \"one\" is no number"}},
    {"ele",
     ".node",
     ".ele",
     {kInvalid, "is empty"},
     {kInvalid, "line 2: has 3 words, expected 6 (cell 0)"},
     {kInvalid, "line 2: \"inf\" is not finite"},
     {kLimit, "says 1000000000000 cells, which a file of"},
     {kInvalid, "line 1"},
     {kInvalid, "line 2: \"1.5\" is no whole number"}},
    {"stl_text",
     ".stl",
     ".stl",
     {kInvalid, "is empty"},
     {kInvalid, "ends without endsolid: the file is cut off"},
     {kInvalid, "line 6: \"nan\" is not finite"},
     none("STL as text says no size"),
     {kInvalid, "is no STL file"},
     {kInvalid, "line 6: \"one\" is no number"}},
    {"stl_binary",
     ".stl",
     ".stl",
     {kInvalid, "is empty"},
     {kInvalid, "12 triangles need 684 bytes, it has 654"},
     {kInvalid, "triangle 0 has a coordinate that is not finite"},
     {kInvalid, "4294967295 triangles need"},
     {kInvalid, "is no STL file"},
     none("binary STL holds float32 alone")},
    {"ply_text",
     ".ply",
     ".ply",
     {kInvalid, "is empty"},
     {kInvalid, "ends before its last element"},
     {kInvalid, "\"nan\" is not finite"},
     {kLimit, "says 1000000000000 elements, which a file of"},
     {kInvalid, "is no PLY file"},
     {kInvalid, "\"one\" is no number"}},
    {"ply_binary",
     ".ply",
     ".ply",
     {kInvalid, "is empty"},
     {kInvalid, "ends before its last element"},
     {kInvalid, "vertex 2 has a coordinate that is not finite"},
     {kLimit, "says 1000000000000 elements, which a file of"},
     {kInvalid, "is no PLY file"},
     {kInvalid, "line 4: a property has an unknown type"}},
    {"off",
     ".off",
     ".off",
     {kInvalid, "is empty"},
     {kInvalid, "ends at line 14, expected face 4 of 6"},
     {kInvalid, "line 5: \"nan\" is not finite"},
     {kLimit, "says 1000000000000 points, which a file of"},
     {kInvalid, "does not start with OFF"},
     {kInvalid, "line 5: \"one\" is no number"}},
    {"poly",
     ".poly",
     ".poly",
     {kInvalid, "is empty"},
     {kInvalid, "ends at line 19, expected a polygon"},
     {kInvalid, "line 4: \"nan\" is not finite"},
     {kLimit, "says 1000000000000 facets, which a file of"},
     {kInvalid, "line 1"},
     {kInvalid, "line 12: \"x\" is no whole number"}},
    {"smesh",
     ".smesh",
     ".smesh",
     {kInvalid, "is empty"},
     {kInvalid, "ends at line 14, expected the rest of a polygon"},
     {kInvalid, "line 4: \"nan\" is not finite"},
     {kLimit, "says 1000000000000 facets, which a file of"},
     {kInvalid, "line 1"},
     {kInvalid, "line 11: \"x\" is no whole number"}},
    {"vtu",
     ".vtu",
     ".vtu",
     {kInvalid, "is empty"},
     {kInvalid, "Error parsing XML"},
     {kInvalid, "field \"heat\": value inf at index 1 is infinite"},
     {kLimit, "NumberOfPoints says 1000000000000, which"},
     {kInvalid, "no <VTKFile> in it"},
     {kInvalid, "Unknown data type \"Complex64\""}},
    {"vti",
     ".vti",
     ".vti",
     {kInvalid, "is empty"},
     {kInvalid, "Error parsing XML"},
     {kInvalid, "channel \"heat\": value inf at index 5 is infinite"},
     {kLimit, "WholeExtent says 1000000000000 points, which"},
     {kInvalid, "no <VTKFile> in it"},
     {kInvalid, "Unknown data type \"Complex64\""}},
    {"vtk",
     ".vtk",
     ".vtk",
     {kInvalid, "is empty"},
     {kInvalid, "Error reading binary data"},
     {kInvalid, "channel \"heat\": value inf at index 5 is infinite"},
     {kLimit, "DIMENSIONS says 999700029999 points, which"},
     {kInvalid, "does not start with \"# vtk DataFile\""},
     {kInvalid, "Unsupported data type: complex"}},
    {"exodus",
     ".ex2",
     ".ex2",
     {kInvalid, "is empty"},
     {kInvalid, "is cut off: "},
     {kInvalid, "field \"heat\": value inf at index 2 is infinite"},
     {kLimit, "num_nodes says 2147483647, which"},
     {kInvalid, "neither netCDF nor HDF5"},
     {kInvalid, "Unsupported element type: BLOBS"}},
    {"mhd",
     ".mhd",
     ".mhd",
     {kInvalid, "is empty"},
     {kInvalid, "says 8 values of 4 bytes, its data file cut.raw has 29 bytes"},
     {kInvalid, "channel \"nan\": value inf at index 5 is infinite"},
     {kInvalid, "says 999700029999 values of 4 bytes, its data file good.raw has 32 bytes"},
     {kInvalid, "is no MetaImage header"},
     {kUnsupported, "ElementType MET_STRING is not known"}},
    {"nrrd",
     ".nrrd",
     ".nrrd",
     {kInvalid, "is empty"},
     {kInvalid, "has 29 bytes, 8 values of type float32 need 32"},
     {kInvalid, "channel \"nan\": value inf at index 5 is infinite"},
     {kInvalid, "says 999700029999 values of 4 bytes"},
     {kInvalid, "does not start with \"NRRD000\""},
     {kUnsupported, "type block is not known"}},
    {"nifti",
     ".nii",
     ".nii",
     {kInvalid, "is empty"},
     {kInvalid, "has 29 bytes, 8 values of type float32 need 32"},
     {kInvalid, "channel \"nan\": value inf at index 5 is infinite"},
     {kInvalid, "says 999700029999 values of 4 bytes"},
     {kInvalid, "a NIfTI header has 348"},
     {kUnsupported, "data type 128 is not read"}},
    {"xdmf",
     ".xdmf",
     ".xdmf",
     {kInvalid, "is empty"},
     {kInvalid, "is no well-formed XML"},
     {kInvalid, "field \"heat\": value inf at index 2 is infinite"},
     {kInvalid, "the geometry says 1000000000000 x 3 values, there are 12"},
     {kInvalid, "is no well-formed XML"},
     {kInvalid, "attribute \"heat\" holds something that is no number"}},
    {"xdmf_hdf5",
     ".xdmf",
     ".xdmf",
     {ErrorCode::kIo, "its data file empty.h5: Unable to open file (file signature"},
     {ErrorCode::kIo, "its data file cut.h5: Unable to open file (truncated file"},
     {kInvalid, "field \"heat\": value inf at index 2 is infinite"},
     {kLimit, "/points of absurd.h5 says 3000000000000 values, which"},
     {ErrorCode::kIo, "its data file kind.h5: Unable to open file (file signature"},
     {kInvalid, "/heat of typed.h5 holds no numbers"}},
    {"gmsh",
     ".msh",
     ".msh",
     {kInvalid, "is empty"},
     {kInvalid, "is cut off: $Nodes has no $EndNodes"},
     {kInvalid, "field \"heat\": value inf at index 2 is infinite"},
     {kLimit, "$Nodes says 1000000000000 items, which"},
     {kInvalid, "does not start with $MeshFormat"},
     {kInvalid, "element type 999 is not known"}},
    {"tiff_pages",
     ".tif",
     ".tif",
     {kInvalid, "is empty"},
     {kInvalid, "is cut off: page 1 lies behind its end"},
     {kInvalid, "page 1: pixel (1, 0) is inf; values are finite"},
     {kLimit, "says 9999 x 9999 pixels, which"},
     {kInvalid, "cannot be read as TIFF"},
     {kInvalid, "has pixels of type int16, those of the first slice are float"}},
    {"tiff_stack",
     "",
     "/slice2.tif",
     {kInvalid, "is empty"},
     {kInvalid, "cannot be read as TIFF"},
     {kInvalid, "page 0: pixel (1, 0) is inf; values are finite"},
     {kLimit, "says 9999 x 9999 pixels, which"},
     {kInvalid, "cannot be read as TIFF"},
     {kInvalid, "has pixels of type int16, those of the first slice are float"}},
    {"png_stack",
     "",
     "/slice2.png",
     {kInvalid, "is empty"},
     {kInvalid, "cannot be read"},
     none("PNG holds whole numbers, of which none is infinite"),
     {kLimit, "says 9999 x 9999 pixels, which"},
     {kInvalid, "cannot be read as PNG"},
     {kInvalid, "has pixels of type uint16, those of the first slice are uint8"}},
};

class BadMatrix : public Import, public testing::WithParamInterface<Family> {
protected:
    void SetUp() override {
        const std::string makers =
            content(std::string{VOLCAST_SOURCE_DIR} + "/tests/e2e/import/damaged_files.py");
        ASSERT_EQ(folder.python(makers + "\nmake_" + GetParam().maker + "()\n"), "");
    }

    void expectCell(const std::string& damage, const Cell& cell) {
        const std::string path = folder.path(damage + GetParam().suffix);
        if (*cell.reason == '\0') {
            EXPECT_STRNE(cell.because, "") << damage;
            EXPECT_FALSE(std::filesystem::exists(path)) << path << ": why is it not tried?";
            return;
        }
        const auto imported = import(path);
        ASSERT_FALSE(imported.has_value()) << path << " was imported";
        const std::string& message = imported.error().message;
        EXPECT_EQ(name(imported.error().code), std::string{name(cell.code)}) << message;
        EXPECT_NE(message.find(cell.reason), std::string::npos) << damage << ": " << message;
        EXPECT_NE(message.find("/" + damage + GetParam().named + ": "), std::string::npos)
            << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
};

TEST_P(BadMatrix, EveryDamageIsRefusedWithFileAndReason) {
    const Family& family = GetParam();
    const auto good = import(folder.path(std::string{"good"} + family.suffix));
    ASSERT_TRUE(good.has_value()) << good.error().message;
    expectCell("empty", family.empty);
    expectCell("cut", family.cut);
    expectCell("nan", family.nan);
    expectCell("absurd", family.absurd);
    expectCell("kind", family.kind);
    expectCell("typed", family.typed);
}

INSTANTIATE_TEST_SUITE_P(Families, BadMatrix, testing::ValuesIn(kFamilies),
                         [](const auto& row) { return std::string{row.param.maker}; });

using BadMore = Import;

TEST_F(BadMore, GmshDamagedInOtherPlaces) {
    const std::string makers =
        content(std::string{VOLCAST_SOURCE_DIR} + "/tests/e2e/import/damaged_files.py");
    ASSERT_EQ(folder.python(makers + "\nmake_gmsh()\n"), "");
    expectRefused(folder.path("nan_point.msh"), kInvalid,
                  "the points: value nan at index 2 is not finite");
    expectRefused(folder.path("cut_data.msh"), kInvalid,
                  "is cut off: $NodeData has no $EndNodeData");
    expectRefused(folder.path("typed_value.msh"), kInvalid, "something that is no number");
}

}  // namespace
}  // namespace volcast::test
