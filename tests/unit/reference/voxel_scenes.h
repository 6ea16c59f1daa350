#pragma once

#include <cstring>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "renderer/data/volume_builder.h"
#include "tests/unit/reference/scenes.h"

/// Scenes of one volume of voxels for the reference.
namespace volcast::reference::test {

struct GridDesc {
    glm::ivec3 size{5};
    glm::dvec3 spacing{1.0};
    glm::dvec3 origin{0.0};
    glm::dmat3 direction{1.0};
};

/// Grid point (i, j, k) holds `value(glm::dvec3(i, j, k))`.
inline data::Volume gridOf(const GridDesc& desc,
                           const std::function<double(const glm::dvec3&)>& value) {
    std::vector<float> voxels;
    for (int k = 0; k < desc.size.z; ++k) {
        for (int j = 0; j < desc.size.y; ++j) {
            for (int i = 0; i < desc.size.x; ++i) {
                voxels.push_back(static_cast<float>(value(glm::dvec3(i, j, k))));
            }
        }
    }
    data::VolumeInput input{.size = desc.size,
                            .spacing = desc.spacing,
                            .origin = desc.origin,
                            .direction = desc.direction};
    auto& channel = input.channels.emplace_back(data::ChannelInput{.name = "f"});
    channel.voxels.resize(voxels.size() * sizeof(float));
    std::memcpy(channel.voxels.data(), voxels.data(), channel.voxels.size());
    auto volume = data::buildVolume(std::move(input));
    EXPECT_TRUE(volume.has_value()) << volume.error().message;
    return volume ? std::move(*volume) : data::Volume{};
}

inline Result<Picture> tryDrawn(const scene::Scene& scene, const data::Volume& volume,
                                scene::PictureSize size = {1, 1}) {
    return draw(scene, Bodies{{"mesh", Body{.mesh = nullptr, .volume = &volume}}}, size);
}

inline Picture drawn(const scene::Scene& scene, const data::Volume& volume,
                     scene::PictureSize size = {1, 1}) {
    auto picture = tryDrawn(scene, volume, size);
    EXPECT_TRUE(picture.has_value()) << picture.error().message;
    if (picture) return std::move(*picture);
    return {.size = size, .pixels = {glm::dvec4{-1.0}}, .nearEdge = {0}};
}

/// The one pixel of `layer` from `eye` to `center`.
inline glm::dvec4 seen(const data::Volume& volume, const scene::Layer& layer, const glm::dvec3& eye,
                       const glm::dvec3& center) {
    return drawn(sceneOf(along(eye, center), {layer}), volume).pixels.at(0);
}

}  // namespace volcast::reference::test
