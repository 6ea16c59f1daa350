#include "renderer/data/packed_dataset.h"

#include <cstring>
#include <functional>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "renderer/base/memfd.h"
#include "renderer/data/mesh_builder.h"
#include "renderer/data/packed_format.h"
#include "renderer/data/volume_builder.h"
#include "tests/support/mesh_phantoms.h"

namespace volcast::data {
namespace {

Mesh someMesh() {
    MeshInput input =
        support::latticeMesh({.cubes = {3, 2, 2}, .low = {1e6, 0, 0}, .high = {1e6 + 3, 2, 2}});
    const auto f = [](const glm::dvec3& p) { return p.x - 1e6 + p.y * p.z; };
    support::addField(input, "p1", Association::kVertex, f);
    support::addField(input, "p0", Association::kCell, f);
    support::addField(input, "d1", Association::kCellVertex, f);
    input.fields[1].steps.push_back(input.fields[1].steps[0]);
    input.fields[1].unit = "\xC2\xB5m";
    return buildMesh(input).value();
}

Volume someVolume() {
    std::vector<std::byte> voxels(std::size_t{20} * 18 * 2 * sizeof(float));
    for (std::size_t i = 0; i < 720; ++i) {
        const auto value = static_cast<float>(i) * 0.5F;
        std::memcpy(voxels.data() + i * sizeof(float), &value, sizeof(float));
    }
    return buildVolume({.size = {20, 18, 2},
                        .spacing = {1, 2, 3},
                        .origin = {4, 5, 6},
                        .type = VoxelType::kF32,
                        .channels = {{.name = "c", .unit = "HU", .voxels = voxels}}})
        .value();
}

/// A sealed copy of a packed dataset after `change`.
base::FileDescriptor changed(const base::FileDescriptor& fd,
                             const std::function<void(std::vector<std::byte>&)>& change) {
    const auto mapping = base::map(fd, false).value();
    std::vector<std::byte> bytes{mapping.bytes.begin(), mapping.bytes.end()};
    change(bytes);
    auto copy = base::createMemfd("test", bytes.size()).value();
    {
        auto target = base::map(copy, true).value();
        std::memcpy(target.bytes.data(), bytes.data(), bytes.size());
    }
    EXPECT_TRUE(base::sealReadOnly(copy));
    return copy;
}

template <class T>
void poke(std::vector<std::byte>& bytes, std::size_t offset, T value) {
    ASSERT_LE(offset + sizeof(T), bytes.size());
    std::memcpy(bytes.data() + offset, &value, sizeof(T));
}

packed::Entry entryAt(const std::vector<std::byte>& bytes, std::size_t i) {
    packed::Entry entry;
    std::memcpy(&entry, bytes.data() + sizeof(packed::Header) + i * sizeof(entry), sizeof(entry));
    return entry;
}

/// Pokes `value` into element `index` of section `section`.
template <class T>
base::FileDescriptor poked(const base::FileDescriptor& fd, std::size_t section, std::size_t index,
                           T value) {
    return changed(fd, [&](std::vector<std::byte>& bytes) {
        poke(bytes, entryAt(bytes, section).offset + index * sizeof(T), value);
    });
}

TEST(PackedDataset, MeshComesBackBitwise) {
    const Mesh mesh = someMesh();
    const auto fd = pack(mesh);
    ASSERT_TRUE(fd);
    EXPECT_TRUE(base::isSealedReadOnly(*fd));
    const auto back = unpack(*fd);
    ASSERT_TRUE(back) << back.error().message;
    const Mesh& copy = std::get<Mesh>(*back);
    EXPECT_EQ(copy.origin, mesh.origin);
    EXPECT_EQ(copy.convex, mesh.convex);
    const auto same = [](const auto& a, const auto& b) {
        return a.bytes().size() == b.bytes().size() &&
               std::memcmp(a.bytes().data(), b.bytes().data(), a.bytes().size()) == 0;
    };
    EXPECT_TRUE(same(copy.vertices, mesh.vertices));
    EXPECT_TRUE(same(copy.cells, mesh.cells));
    EXPECT_TRUE(same(copy.neighbours, mesh.neighbours));
    EXPECT_TRUE(same(copy.boundaryFaces, mesh.boundaryFaces));
    EXPECT_TRUE(same(copy.boundaryNeighbours, mesh.boundaryNeighbours));
    ASSERT_EQ(copy.fields.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(copy.fields[i].name, mesh.fields[i].name);
        EXPECT_EQ(copy.fields[i].unit, mesh.fields[i].unit);
        EXPECT_EQ(copy.fields[i].range, mesh.fields[i].range);
        EXPECT_EQ(copy.fields[i].times, mesh.fields[i].times);
        for (std::size_t s = 0; s < mesh.fields[i].steps.size(); ++s) {
            EXPECT_TRUE(same(copy.fields[i].steps[s], mesh.fields[i].steps[s]));
        }
    }
}

TEST(PackedDataset, ArraysOutliveTheDescriptor) {
    Mesh copy;
    {
        const auto fd = pack(someMesh()).value();
        copy = std::get<Mesh>(unpack(fd).value());
    }
    EXPECT_EQ(copy.cells.size(), 72U);
    EXPECT_GE(copy.cells[71].x, 0);
}

TEST(PackedDataset, VolumeComesBackBitwise) {
    const Volume volume = someVolume();
    const auto back = unpack(pack(volume).value());
    ASSERT_TRUE(back) << back.error().message;
    const auto& copy = std::get<Volume>(*back);
    EXPECT_EQ(copy.size, volume.size);
    EXPECT_EQ(copy.spacing, volume.spacing);
    EXPECT_EQ(copy.origin, volume.origin);
    EXPECT_EQ(copy.direction, volume.direction);
    EXPECT_EQ(copy.type, volume.type);
    const auto& a = copy.channels.at(0);
    const auto& b = volume.channels.at(0);
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.range, b.range);
    EXPECT_TRUE(std::equal(a.voxels.begin(), a.voxels.end(), b.voxels.begin(), b.voxels.end()));
    EXPECT_TRUE(std::equal(a.bricks.begin(), a.bricks.end(), b.bricks.begin(), b.bricks.end()));
}

TEST(PackedDataset, BytesThatMayStillChangeAreRefused) {
    auto fd = base::createMemfd("test", 4096).value();
    EXPECT_EQ(unpack(fd).error().code, ErrorCode::kInvalidArgument);
}

TEST(PackedDataset, DamagedHeadersAndTablesAreRefused) {
    const auto fd = pack(someMesh()).value();
    using Bytes = std::vector<std::byte>;
    const std::vector<std::function<void(Bytes&)>> damages{
        [](Bytes& b) { b.resize(7); },
        [](Bytes& b) { b.resize(b.size() / 2); },
        [](Bytes& b) { b.resize(b.size() + 64); },
        [](Bytes& b) { b[7] = std::byte{'9'}; },
        [](Bytes& b) { poke(b, offsetof(packed::Header, kind), std::uint64_t{3}); },
        [](Bytes& b) { poke(b, offsetof(packed::Header, kind), packed::Kind::kVolume); },
        [](Bytes& b) { poke(b, offsetof(packed::Header, sections), ~std::uint64_t{0}); },
        [](Bytes& b) { poke(b, offsetof(packed::Header, sections), std::uint64_t{3}); },
    };
    for (std::size_t i = 0; i < damages.size(); ++i) {
        EXPECT_FALSE(unpack(changed(fd, damages[i]))) << "damage " << i;
    }
    for (const std::uint64_t wild :
         {std::uint64_t{1} << 63, ~std::uint64_t{0}, std::uint64_t{1} << 62}) {
        for (const std::size_t member :
             {offsetof(packed::Entry, offset), offsetof(packed::Entry, count),
              offsetof(packed::Entry, elementBytes)}) {
            EXPECT_FALSE(unpack(changed(fd, [&](Bytes& b) {
                poke(b, sizeof(packed::Header) + sizeof(packed::Entry) + member, wild);
            })));
        }
    }
}

TEST(PackedDataset, CellsWithoutAValueSurviveAndMustBeCountedRight) {
    MeshInput input = support::latticeMesh({.cubes = {2, 1, 1}});
    support::addField(input, "p0", Association::kCell, [](const auto& p) { return p.x; });
    input.fields[0].steps[0][3] = std::nan("");
    const auto fd = pack(Dataset{buildMesh(input).value()}).value();
    const auto read = unpack(fd);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(std::get<Mesh>(*read).fields[0].cellsWithoutValue, 1U);
    constexpr std::size_t kCount = offsetof(packed::FieldHeader, cellsWithoutValue) / 8;
    EXPECT_FALSE(unpack(poked(fd, 6, kCount, std::uint64_t{2})));
    EXPECT_FALSE(unpack(poked(fd, 6, kCount, std::uint64_t{0})));
    EXPECT_FALSE(unpack(poked(fd, 10, 0, std::numeric_limits<float>::infinity())));
}

TEST(PackedDataset, DamagedMeshesAreRefused) {
    const auto fd = pack(someMesh()).value();
    const float nan = std::nanf("");
    // Sections: 0 header, 1 vertices, 2 cells, 3 neighbours, 4 faces, 5 face neighbours, 6 field,
    // 7 name, 8 unit, 9 times, 10 values.
    EXPECT_TRUE(unpack(changed(fd, [](auto&) {})));
    EXPECT_FALSE(unpack(poked(fd, 0, 0, std::nan(""))));
    EXPECT_FALSE(unpack(poked(fd, 1, 4, nan)));
    for (const std::int32_t id : {-1, 36, 1 << 30}) EXPECT_FALSE(unpack(poked(fd, 2, 5, id)));
    for (const std::int32_t id : {-2, 72, 1 << 30}) EXPECT_FALSE(unpack(poked(fd, 3, 5, id)));
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_FALSE(unpack(poked(fd, 3, 40 + i, std::int32_t{50}))) << "not its neighbour";
    }
    EXPECT_FALSE(unpack(poked(fd, 4, 0, std::int32_t{-1})));
    EXPECT_FALSE(unpack(poked(fd, 4, 1, std::int32_t{99})));
    EXPECT_FALSE(unpack(poked(fd, 5, 1, std::int32_t{1 << 20})));
    EXPECT_FALSE(unpack(poked(fd, 6, 1, nan)));
    EXPECT_FALSE(unpack(poked(fd, 6, 1, 0.5F))) << "values beyond the range";
    EXPECT_FALSE(unpack(poked(fd, 7, 0, char{'\xFF'})));
    EXPECT_FALSE(unpack(poked(fd, 9, 0, std::nan(""))));
    EXPECT_FALSE(unpack(poked(fd, 10, 3, nan)));
}

TEST(PackedDataset, DamagedVolumesAreRefused) {
    const auto fd = pack(someVolume()).value();
    // Sections: 0 header, 1 channel, 2 name, 3 unit, 4 voxels, 5 bricks.
    EXPECT_FALSE(unpack(poked(fd, 0, 0, -1.0))) << "spacing";
    EXPECT_FALSE(unpack(poked(fd, 0, 4, std::nan("")))) << "origin";
    EXPECT_FALSE(unpack(poked(fd, 0, 7, 1.0))) << "direction";
    for (const int size : {0, -1, 19, 1 << 30}) {
        EXPECT_FALSE(unpack(poked(fd, 0, offsetof(packed::VolumeHeader, size) / 4, size)));
    }
    EXPECT_FALSE(unpack(poked(fd, 4, 700, std::nanf("")))) << "not counted";
    constexpr std::size_t kCount = offsetof(packed::ChannelHeader, voxelsWithoutValue) / 8;
    EXPECT_FALSE(unpack(poked(fd, 1, kCount, std::uint64_t{1})));
    EXPECT_FALSE(unpack(poked(fd, 4, 700, 1e9F)));
    EXPECT_FALSE(unpack(poked(fd, 5, 1, std::nanf(""))));
    const float infinity = std::numeric_limits<float>::infinity();
    const auto empty = poked(poked(fd, 5, 0, infinity), 5, 1, -infinity);
    EXPECT_FALSE(unpack(empty)) << "a brick without a value, but no such voxels";
}

// Whatever a byte turns into, reading it ends with a dataset or an error; sanitizers watch.
TEST(PackedDataset, RandomDamageNeverCrashes) {
    const auto fd = pack(someMesh()).value();
    std::mt19937 random{1};
    int refused = 0;
    for (int round = 0; round < 300; ++round) {
        const auto copy = changed(fd, [&random](std::vector<std::byte>& bytes) {
            for (int i = 0; i < 4; ++i) {
                bytes[random() % bytes.size()] = static_cast<std::byte>(random());
            }
        });
        refused += unpack(copy) ? 0 : 1;
    }
    EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace volcast::data
