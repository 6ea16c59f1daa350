#include "renderer/data/volume_packer.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include "renderer/data/packed_dataset.h"

namespace volcast::data {
namespace {

VolumeInput inputOf(glm::ivec3 size) {
    VolumeInput input{.size = size,
                      .spacing = {1, 2, 3},
                      .origin = {4, 5, 6},
                      .direction = glm::dmat3{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}},
                      .type = VoxelType::kF32};
    for (const char* name : {"a", "b"}) {
        std::vector<std::byte> voxels(static_cast<std::size_t>(size.x) * size.y * size.z * 4);
        for (std::size_t i = 0; i < voxels.size(); i += 4) {
            const auto value = static_cast<float>(i * (name[0] == 'a' ? 7 : 13) % 1009);
            std::memcpy(&voxels[i], &value, sizeof value);
        }
        input.channels.push_back({.name = name, .unit = "K", .voxels = std::move(voxels)});
    }
    return input;
}

/// A packer that has the voxels of `input`.
VolumePacker filled(const VolumeInput& input) {
    VolumeInput names = input;
    for (ChannelInput& channel : names.channels) channel.voxels.clear();
    VolumePacker packer = VolumePacker::create(std::move(names)).value();
    EXPECT_EQ(packer.channels(), input.channels.size());
    for (std::size_t i = 0; i < packer.channels(); ++i) {
        EXPECT_EQ(packer.name(i), input.channels[i].name);
        EXPECT_EQ(packer.voxels(i).size(), input.channels[i].voxels.size());
        std::ranges::copy(input.channels[i].voxels, packer.voxels(i).begin());
    }
    return packer;
}

TEST(VolumePacker, MakesWhatBuildingAndPackingMakes) {
    for (const glm::ivec3 size : {glm::ivec3{131, 128, 126}, glm::ivec3{17, 5, 1}}) {
        const VolumeInput input = inputOf(size);
        double progress = 0.0;
        const auto packed = filled(input).finish([&progress](double share) {
            EXPECT_GE(share, progress);
            progress = share;
        });
        ASSERT_TRUE(packed);
        const auto expected = pack(buildVolume(input).value()).value();
        const auto a = base::map(*packed, false).value();
        const auto b = base::map(expected, false).value();
        ASSERT_EQ(a.bytes.size(), b.bytes.size());
        EXPECT_EQ(std::memcmp(a.bytes.data(), b.bytes.data(), a.bytes.size()), 0);
        EXPECT_TRUE(unpack(*packed));
    }
}

TEST(VolumePacker, VoxelsWithoutAValueAreKept) {
    VolumeInput input = inputOf({131, 128, 126});
    const float missing = std::numeric_limits<float>::quiet_NaN();
    for (std::size_t i = 0; i < 100; ++i) {
        std::memcpy(input.channels[1].voxels.data() + i * i * sizeof(float), &missing, 4);
    }
    const auto packed = filled(input).finish({});
    ASSERT_TRUE(packed);
    const auto read = unpack(*packed);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(std::get<Volume>(*read).channels[0].voxelsWithoutValue, 0U);
    EXPECT_EQ(std::get<Volume>(*read).channels[1].voxelsWithoutValue, 100U);
    const auto expected = pack(buildVolume(input).value()).value();
    const auto a = base::map(*packed, false).value(), b = base::map(expected, false).value();
    ASSERT_EQ(a.bytes.size(), b.bytes.size());
    EXPECT_EQ(std::memcmp(a.bytes.data(), b.bytes.data(), a.bytes.size()), 0);
}

TEST(VolumePacker, InfinityIsRefusedByItsPlace) {
    VolumeInput input = inputOf({4, 3, 2});
    const float bad = std::numeric_limits<float>::infinity();
    std::memcpy(input.channels[1].voxels.data() + (12 + 4 + 2) * sizeof(float), &bad, sizeof(bad));
    const auto error = filled(input).finish({}).error();
    EXPECT_EQ(error.code, ErrorCode::kInvalidArgument);
    EXPECT_NE(error.message.find("channel 'b': voxel (2, 1, 1)"), std::string::npos)
        << error.message;
}

TEST(VolumePacker, BadGridsAreRefusedBeforeThereIsRoom) {
    VolumeInput input = inputOf({4, 3, 2});
    input.size = glm::ivec3(kMaxVolumeSide);
    EXPECT_EQ(VolumePacker::create(input).error().code, ErrorCode::kLimitExceeded);
    input = inputOf({4, 3, 2});
    input.channels[1].name = "a";
    EXPECT_EQ(VolumePacker::create(input).error().code, ErrorCode::kInvalidArgument);
}

}  // namespace
}  // namespace volcast::data
