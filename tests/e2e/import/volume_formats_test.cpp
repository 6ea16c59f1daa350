#include <cstring>

#include "renderer/base/sandbox.h"
#include "tests/e2e/import/import_fixture.h"

namespace volcast::test {
namespace {

/// Volumes whose voxel (i, j, k) is i + 10 j + 100 k.
class VolumeFormats : public Import {
protected:
    template <class T>
    static T voxel(const data::Volume& volume, glm::ivec3 at, std::size_t channel = 0) {
        const int index = at.x + volume.size.x * (at.y + volume.size.y * at.z);
        const std::size_t offset = static_cast<std::size_t>(index) * sizeof(T);
        T value{};
        std::memcpy(&value, volume.channels.at(channel).voxels.data() + offset, sizeof(T));
        return value;
    }
    template <class T>
    static void expectRamp(const data::Volume& volume, glm::ivec3 size, const std::string& what) {
        ASSERT_EQ(volume.size, size) << what;
        for (int k = 0; k < size.z; ++k) {
            for (int j = 0; j < size.y; ++j) {
                for (int i = 0; i < size.x; ++i) {
                    ASSERT_EQ(voxel<T>(volume, {i, j, k}), static_cast<T>(i + 10 * j + 100 * k))
                        << what << " at " << i << ' ' << j << ' ' << k;
                }
            }
        }
    }
};

constexpr const char* kRamp = R"py(
import numpy as np, gzip, struct, zlib
size = (5, 4, 3)
k, j, i = np.meshgrid(np.arange(3), np.arange(4), np.arange(5), indexing='ij')
ramp = i + 10 * j + 100 * k
)py";

TEST_F(VolumeFormats, MetaImageInEachType) {
    ASSERT_EQ(folder.python(std::string{kRamp} + R"py(
def meta(name, values, kind, more=''):
    head = f'ObjectType = Image\nNDims = 3\nDimSize = 5 4 3\nElementSpacing = 1 2 3\nOffset = 7 8 9\n{more}ElementType = {kind}\nElementDataFile = '
    if name.endswith('.mha'): open(name, 'wb').write(head.encode() + b'LOCAL\n' + values)
    else:
        open(name, 'w').write(head + name[:-3] + 'raw\n'); open(name[:-3] + 'raw', 'wb').write(values)
meta('u8.mhd', ramp.astype('u1').tobytes(), 'MET_UCHAR')
meta('u16.mhd', ramp.astype('<u2').tobytes(), 'MET_USHORT')
meta('i16.mha', ramp.astype('<i2').tobytes(), 'MET_SHORT')
meta('big.mha', ramp.astype('>i2').tobytes(), 'MET_SHORT', 'BinaryDataByteOrderMSB = True\n')
meta('f32.mhd', ramp.astype('<f4').tobytes(), 'MET_FLOAT')
meta('f64.mhd', ramp.astype('<f8').tobytes(), 'MET_DOUBLE')
meta('packed.mha', zlib.compress(ramp.astype('<f4').tobytes()), 'MET_FLOAT', 'CompressedData = True\n')
meta('turned.mhd', ramp.astype('<u2').tobytes(), 'MET_USHORT', 'TransformMatrix = 0 1 0 -1 0 0 0 0 1\n')
)py"),
              "");
    const data::Volume bytes = volume(folder.path("u8.mhd"));
    EXPECT_EQ(bytes.type, data::VoxelType::kU8);
    EXPECT_EQ(bytes.spacing, glm::dvec3(1, 2, 3));
    EXPECT_EQ(bytes.origin, glm::dvec3(7, 8, 9));
    EXPECT_EQ(bytes.channels.at(0).name, "u8");
    expectRamp<std::uint8_t>(bytes, {5, 4, 3}, "u8");
    expectRamp<std::uint16_t>(volume(folder.path("u16.mhd")), {5, 4, 3}, "u16");
    expectRamp<std::int16_t>(volume(folder.path("i16.mha")), {5, 4, 3}, "i16");
    expectRamp<std::int16_t>(volume(folder.path("big.mha")), {5, 4, 3}, "big");
    expectRamp<float>(volume(folder.path("f32.mhd")), {5, 4, 3}, "f32");
    EXPECT_TRUE(warnings.empty());
    expectRamp<float>(volume(folder.path("packed.mha")), {5, 4, 3}, "packed");
    expectRamp<float>(volume(folder.path("f64.mhd")), {5, 4, 3}, "f64");
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_NE(warnings[0].find("float64"), std::string::npos);
    const data::Volume turned = volume(folder.path("turned.mhd"));
    EXPECT_NEAR(glm::distance(turned.direction[0], glm::dvec3(0, 1, 0)), 0.0, 1e-12);
    EXPECT_NEAR(glm::distance(turned.direction[1], glm::dvec3(-1, 0, 0)), 0.0, 1e-12);
}

TEST_F(VolumeFormats, NrrdRawPackedDetachedAndWithChannels) {
    ASSERT_EQ(folder.python(std::string{kRamp} + R"py(
head = ('NRRD0004\n# a comment\ntype: {0}\ndimension: 3\nsizes: 5 4 3\nspace: left-posterior-superior\n'
        'space directions: (0,0.5,0) (1,0,0) (0,0,2)\nspace origin: (1,2,3)\nendian: {2}\nencoding: {1}\n')
open('raw.nrrd', 'wb').write(head.format('ushort', 'raw', 'big').encode() + b'\n' + ramp.astype('>u2').tobytes())
open('packed.nrrd', 'wb').write(head.format('float', 'gzip', 'little').encode() + b'\n' + gzip.compress(ramp.astype('<f4').tobytes()))
open('skip.nrrd', 'wb').write(head.format('short', 'gzip', 'little').encode() + b'byte skip: 3\n\n' + gzip.compress(b'xyz' + ramp.astype('<i2').tobytes()))
open('apart.nhdr', 'w').write(head.format('short', 'raw', 'little') + 'data file: apart.raw\n\n')
open('apart.raw', 'wb').write(ramp.astype('<i2').tobytes())
two = np.stack([ramp, ramp * 2], -1)
open('two.nrrd', 'wb').write(b'NRRD0004\ntype: int16\ndimension: 4\nsizes: 2 5 4 3\nkinds: vector domain domain domain\nspacings: nan 1 2 3\nendian: little\nencoding: raw\n\n' + two.astype('<i2').tobytes())
)py"),
              "");
    const data::Volume raw = volume(folder.path("raw.nrrd"));
    expectRamp<std::uint16_t>(raw, {5, 4, 3}, "raw");
    EXPECT_EQ(raw.spacing, glm::dvec3(0.5, 1, 2));
    EXPECT_EQ(raw.origin, glm::dvec3(1, 2, 3));
    EXPECT_NEAR(glm::distance(raw.direction[0], glm::dvec3(0, 1, 0)), 0.0, 1e-12);
    expectRamp<float>(volume(folder.path("packed.nrrd")), {5, 4, 3}, "packed");
    expectRamp<std::int16_t>(volume(folder.path("skip.nrrd")), {5, 4, 3}, "skip");
    expectRamp<std::int16_t>(volume(folder.path("apart.nhdr")), {5, 4, 3}, "apart");
    const data::Volume two = volume(folder.path("two.nrrd"));
    expectRamp<std::int16_t>(two, {5, 4, 3}, "two");
    ASSERT_EQ(two.channels.size(), 2U);
    EXPECT_EQ(voxel<std::int16_t>(two, {4, 3, 2}, 1), 2 * 234);
    EXPECT_EQ(two.spacing, glm::dvec3(1, 2, 3));
}

TEST_F(VolumeFormats, NiftiPlainPackedScaledAndTurned) {
    ASSERT_EQ(folder.python(std::string{kRamp} + R"py(
def nifti(values, code, bits, slope=0.0, inter=0.0, sform=None, quaternion=None):
    h = bytearray(352)
    struct.pack_into('<i', h, 0, 348); struct.pack_into('<8h', h, 40, 3, 5, 4, 3, 1, 1, 1, 1)
    struct.pack_into('<2h', h, 70, code, bits); struct.pack_into('<8f', h, 76, 1, 1.5, 2, 2.5, 0, 0, 0, 0)
    struct.pack_into('<3f', h, 108, 352, slope, inter)
    if quaternion: struct.pack_into('<h', h, 252, 1); struct.pack_into('<6f', h, 256, *quaternion)
    if sform: struct.pack_into('<h', h, 254, 1); struct.pack_into('<12f', h, 280, *sform)
    h[344:348] = b'n+1\0'
    return bytes(h) + values
open('plain.nii', 'wb').write(nifti(ramp.astype('<i2').tobytes(), 4, 16))
with gzip.open('packed.nii.gz', 'wb') as f: f.write(nifti(ramp.astype('<f4').tobytes(), 16, 32, sform=(0, -2, 0, 10, 1.5, 0, 0, 20, 0, 0, 2.5, 30)))
open('scaled.nii', 'wb').write(nifti(ramp.astype('<i2').tobytes(), 4, 16, 0.5, 3.0))
# Half a turn around z: quaternion (0, 0, 0, 1).
open('turned.nii', 'wb').write(nifti(ramp.astype('u1').tobytes(), 2, 8, quaternion=(0, 0, 1, 4, 5, 6)))
cut = nifti(ramp.astype('<i2').tobytes(), 4, 16)
open('cut.nii', 'wb').write(cut[:400])
bad = nifti(np.where(ramp == 12, np.nan, ramp).astype('<f4').tobytes(), 16, 32)
open('nan.nii', 'wb').write(bad)
)py"),
              "");
    const data::Volume plain = volume(folder.path("plain.nii"));
    expectRamp<std::int16_t>(plain, {5, 4, 3}, "plain");
    EXPECT_EQ(plain.spacing, glm::dvec3(1.5, 2, 2.5));
    const data::Volume packed = volume(folder.path("packed.nii.gz"));
    expectRamp<float>(packed, {5, 4, 3}, "packed");
    EXPECT_EQ(packed.origin, glm::dvec3(10, 20, 30));
    EXPECT_NEAR(glm::distance(packed.direction[0], glm::dvec3(0, 1, 0)), 0.0, 1e-7);
    EXPECT_NEAR(glm::distance(packed.direction[1], glm::dvec3(-1, 0, 0)), 0.0, 1e-7);
    EXPECT_NEAR(packed.spacing.y, 2.0, 1e-7);
    const data::Volume scaled = volume(folder.path("scaled.nii"));
    EXPECT_EQ(voxel<float>(scaled, {4, 3, 2}), 234 * 0.5F + 3.0F);
    const data::Volume turned = volume(folder.path("turned.nii"));
    EXPECT_NEAR(glm::distance(turned.direction[0], glm::dvec3(-1, 0, 0)), 0.0, 1e-7);
    EXPECT_NEAR(glm::distance(turned.direction[2], glm::dvec3(0, 0, 1)), 0.0, 1e-7);
    expectRefused(folder.path("cut.nii"), ErrorCode::kInvalidArgument, "has 48 bytes, 60 values");
    EXPECT_EQ(volume(folder.path("nan.nii")).channels[0].voxelsWithoutValue, 1U);
}

TEST_F(VolumeFormats, VtiOnPointsAndInCells) {
    ASSERT_EQ(folder.python(std::string{kRamp} + R"py(
import vtkmodules.vtkIOXML as io, vtkmodules.vtkCommonDataModel as model
from vtkmodules.util.numpy_support import numpy_to_vtk
def write(name, dims, attributes, values):
    image = model.vtkImageData(); image.SetDimensions(*dims); image.SetSpacing(1, 2, 3); image.SetOrigin(7, 8, 9)
    array = numpy_to_vtk(values.reshape(-1), deep=True); array.SetName('ramp')
    getattr(image, attributes)().AddArray(array)
    w = io.vtkXMLImageDataWriter(); w.SetFileName(name); w.SetInputData(image); w.Write()
write('points.vti', size, 'GetPointData', ramp.astype('u2'))
write('cells.vti', (6, 5, 4), 'GetCellData', ramp.astype('f4'))
)py"),
              "");
    const data::Volume points = volume(folder.path("points.vti"));
    expectRamp<std::uint16_t>(points, {5, 4, 3}, "points");
    EXPECT_EQ(points.origin, glm::dvec3(7, 8, 9));
    const data::Volume cells = volume(folder.path("cells.vti"));
    expectRamp<float>(cells, {5, 4, 3}, "cells");
    EXPECT_EQ(cells.origin, glm::dvec3(7.5, 9, 10.5));
}

constexpr const char* kPictures = R"py(
import os
def png(name, rows):
    chunk = lambda kind, d: struct.pack('>I', len(d)) + kind + d + struct.pack('>I', zlib.crc32(kind + d))
    bits = 16 if rows.dtype.itemsize == 2 else 8
    data = b''.join(b'\0' + row.astype('>u2' if bits == 16 else 'u1').tobytes() for row in rows)
    open(name, 'wb').write(b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', struct.pack('>IIBBBBB', rows.shape[1], rows.shape[0], bits, 0, 0, 0, 0)) + chunk(b'IDAT', zlib.compress(data)) + chunk(b'IEND', b''))
def tiff(name, pages):
    out, at = bytearray(b'II*\0\0\0\0\0'), 4
    for rows in pages:
        data = len(out); out += rows.tobytes(); struct.pack_into('<I', out, at, len(out) + len(out) % 2)
        out += b'\0' * (len(out) % 2)
        h, w = rows.shape; kind = {'u': 1, 'i': 2, 'f': 3}[rows.dtype.kind]
        tags = [(256, 4, w), (257, 4, h), (258, 3, 8 * rows.dtype.itemsize), (259, 3, 1), (262, 3, 1), (273, 4, data),
                (277, 3, 1), (278, 4, h), (279, 4, rows.nbytes), (339, 3, kind)]
        out += struct.pack('<H', len(tags)) + b''.join(struct.pack('<HHII', t, k, 1, v) for t, k, v in tags)
        at = len(out); out += b'\0\0\0\0'
    open(name, 'wb').write(bytes(out))
)py";

// A file of pages of tiles: more tiles than the cache of the import has room for. Its voxels are
// there once, in what is handed over; before that they are read tile by tile.
TEST_F(VolumeFormats, PagesOfTilesAreReadWithoutBeingHeldTwice) {
    ASSERT_EQ(folder.python(R"py(
import numpy as np, struct
def tiled(name, side, pages, tile):
    out, at = bytearray(b'II*\0\0\0\0\0'), 4
    for z in range(pages):
        y, x = np.mgrid[0:side, 0:side]
        rows = ((x + 3 * y + 7 * z) % 60000).astype('<u2')
        offsets = []
        for row in range(0, side, tile):
            for column in range(0, side, tile):
                offsets.append(len(out))
                block = np.zeros((tile, tile), '<u2')
                part = rows[row:row + tile, column:column + tile]
                block[:part.shape[0], :part.shape[1]] = part
                out += block.tobytes()
        count, size = len(offsets), 2 * tile * tile
        where = len(out); out += struct.pack(f'<{count}I', *offsets)
        sizes = len(out); out += struct.pack(f'<{count}I', *[size] * count)
        struct.pack_into('<I', out, at, len(out))
        tags = [(256, 4, 1, side), (257, 4, 1, side), (258, 3, 1, 16), (259, 3, 1, 1), (262, 3, 1, 1),
                (277, 3, 1, 1), (322, 4, 1, tile), (323, 4, 1, tile), (324, 4, count, where),
                (325, 4, count, sizes), (339, 3, 1, 1)]
        out += struct.pack('<H', len(tags)) + b''.join(struct.pack('<HHII', *tag) for tag in tags)
        at = len(out); out += b'\0\0\0\0'
    open(name, 'wb').write(bytes(out))
tiled('small.tif', 100, 3, 64)
tiled('large.tif', 1000, 32, 256)
)py"),
              "");
    const auto small = import(folder.path("small.tif"));
    ASSERT_TRUE(small.has_value()) << small.error().message;
    const auto large = import(folder.path("large.tif"));
    ASSERT_TRUE(large.has_value()) << large.error().message;
    const auto dataset = data::unpack(large->packed);
    const auto& read = std::get<data::Volume>(*dataset);
    ASSERT_EQ(read.size, glm::ivec3(1000, 1000, 32));
    for (const glm::ivec3 at :
         {glm::ivec3{0, 0, 0}, {999, 999, 31}, {255, 256, 7}, {640, 63, 30}}) {
        EXPECT_EQ(voxel<std::uint16_t>(read, at), (at.x + 3 * at.y + 7 * at.z) % 60000);
    }
    if (!base::kLimitsAddressSpace) GTEST_SKIP() << "a sanitizer holds on to freed memory";
    const double mebibytes = static_cast<double>(large->summary.bytes) / (1 << 20);
    EXPECT_GT(mebibytes, 61.0);
    // Beside them: the cache of 16 MiB, a strip, and what programs differ by from run to run.
    EXPECT_LT(large->peakMb - small->peakMb, mebibytes + 40.0);
}

TEST_F(VolumeFormats, StacksOfPicturesAndPages) {
    ASSERT_EQ(folder.python(std::string{kRamp} + kPictures + R"py(
for d in ('png', 'tif', 'many'): os.mkdir(d)
for z in range(3):
    png(f'png/slice{8 + z}.png', ramp[z].astype('u2'))  # 8, 9, 10: not in the order of letters
    tiff(f'tif/s_{z:03}.tif', [ramp[z].astype('<i2')])
    png(f'many/a{z}.png', ramp[z].astype('u1')); png(f'many/b{z}.png', ramp[z].astype('u1'))
tiff('pages.tiff', [ramp[z].astype('<f4') for z in range(3)])
tiff('cut.tif', [ramp[z].astype('<f4') for z in range(3)])
data = open('cut.tif', 'rb').read(); open('cut.tif', 'wb').write(data[:-150])
tiff('nan.tiff', [np.where(ramp[z] == 112, np.nan, ramp[z]).astype('<f4') for z in range(3)])
)py"),
              "");
    request.spacing = {0.5, 0.25, 2.0};
    const data::Volume folderOfPng = volume(folder.path("png"));
    expectRamp<std::uint16_t>(folderOfPng, {5, 4, 3}, "png");
    EXPECT_EQ(folderOfPng.spacing, request.spacing);
    expectRamp<std::int16_t>(volume(folder.path("tif/s_000.tif")), {5, 4, 3}, "series");
    expectRamp<std::uint8_t>(volume(folder.path("many/b0.png")), {5, 4, 3}, "one series of two");
    expectRamp<float>(volume(folder.path("pages.tiff")), {5, 4, 3}, "pages");
    expectRefused(folder.path("cut.tif"), ErrorCode::kInvalidArgument, "page 2");
    EXPECT_EQ(volume(folder.path("nan.tiff")).channels[0].voxelsWithoutValue, 1U);
    EXPECT_EQ(warnings,
              std::vector<std::string>{"1 of 60 voxels of \"value\" is NaN and is drawn as empty"});
    EXPECT_TRUE(workers::isImportable(folder.path("png")));
    EXPECT_TRUE(workers::isImportable(folder.path("tif/s_000.tif")));
    EXPECT_FALSE(workers::isImportable(folder.path("tif/s_001.tif")));
    EXPECT_FALSE(workers::isImportable(folder.path("png/slice10.png")));
    EXPECT_FALSE(workers::isImportable(folder.path("make_file.py")));
    EXPECT_TRUE(workers::isImportable("A.VTU"));
    EXPECT_FALSE(workers::isImportable("a.ele"));
    EXPECT_FALSE(workers::isImportable("a.raw"));
}

}  // namespace
}  // namespace volcast::test
