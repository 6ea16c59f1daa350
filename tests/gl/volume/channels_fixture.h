#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/phantoms.h"
#include "tests/support/render_test.h"
#include "tests/support/volume_reference.h"

namespace volcast::support {

inline const GridPlace kChannelsPlace{.size = {19, 14, 23},
                                      .spacing = {0.4, 0.7, 0.3},
                                      .origin = {-3.0, 90.0, 5.0},
                                      .direction = turn({2, -1, 1}, 63.0)};

inline double blob(const glm::dvec3& p, const glm::dvec3& centre, double radius) {
    const glm::dvec3 d = (p - centre) / radius;
    return std::exp(-glm::dot(d, d));
}

using ChannelField = std::pair<std::string, std::function<double(const glm::dvec3&)>>;

inline const std::vector<ChannelField> kChannelFields{
    {"c0",
     [](const glm::dvec3& p) {
         return 80.0 * blob(p, {7, 6, 8}, 5.0);
     }},
    {"c1",
     [](const glm::dvec3& p) {
         return 3.0 * blob(p, {11, 8, 14}, 6.0) - 1.0;
     }},
    {"c2", [](const glm::dvec3& p) { return std::sin(p.x) + 0.1 * p.z; }},
    {"c3", [](const glm::dvec3& p) { return p.x * p.y / 100.0; }}};

/// A float32 volume of several channels.
inline data::Volume channelsOf(const GridPlace& place, const std::vector<ChannelField>& fields) {
    data::VolumeInput input;
    input.size = place.size;
    input.spacing = place.spacing;
    input.origin = place.origin;
    input.direction = place.direction;
    for (const auto& [name, value] : fields) {
        const data::Volume alone = volumeOf(place, value);
        const auto bytes = alone.channels[0].voxels.span();
        input.channels.push_back(
            {.name = name, .unit = "", .voxels = {bytes.begin(), bytes.end()}});
    }
    return must(data::buildVolume(std::move(input)));
}

/// Few points and many of them, so that every way to find a value is met.
inline data::TransferFunction channelMap(std::size_t channel) {
    switch (channel) {
        case 0:
            return {{{.value = 10.0F, .colour = {1, 0, 0}, .extinction = 0.0F},
                     {.value = 60.0F, .colour = {1, 0.5F, 0}, .extinction = 0.9F}}};
        case 1: {
            data::TransferFunction map;
            for (int i = 0; i < 60; ++i) {
                const float t = static_cast<float>(i) / 59.0F;
                map.points.push_back({.value = -1.0F + 3.0F * t,
                                      .colour = {0, t, 1.0F - t},
                                      .extinction = 0.3F * t * t});
            }
            return map;
        }
        case 2: {
            data::TransferFunction map;
            for (int i = 0; i < 40; ++i) {  // Too uneven for a grid.
                const float t = std::exp2(static_cast<float>(i) - 37.0F);
                map.points.push_back(
                    {.value = t, .colour = {0, 0, std::min(t, 1.0F)}, .extinction = 0.05F * t});
            }
            return map;
        }
        default:
            return {{{.value = 0.5F, .colour = {0.1F, 0.2F, 0.3F}, .extinction = 0.1F},
                     {.value = 0.5F, .colour = {0.3F, 0.1F, 0.1F}, .extinction = 0.4F}}};
    }
}

/// Within the values of each channel.
inline constexpr data::Range kChannelIntervals[4] = {{.min = 20.0F, .max = 70.0F},
                                                     {.min = -0.5F, .max = 1.5F},
                                                     {.min = 0.25F, .max = 2.0F},
                                                     {.min = 0.1F, .max = 1.0F}};

/// A layer of four channels, and what its rays show in double.
class ChannelsTest : public RenderTest {
protected:
    static constexpr double kStep = 0.11;

    ChannelsTest() {
        for (const auto& [name, value] : kChannelFields) {
            alone_.push_back(volumeOf(kChannelsPlace, value));
        }
        renderer_->addDataset("volume", channelsOf(kChannelsPlace, kChannelFields));
        scene::Layer layer;
        layer.id = "layer";
        layer.dataset = "volume";
        layer.map = channelMap(0);
        layer.stepWorld = kStep;
        for (std::size_t i = 0; i < kChannelFields.size(); ++i) {
            layer.channels.push_back({.field = kChannelFields[i].first, .map = channelMap(i)});
        }
        scene_.layers.push_back(layer);
        const glm::dvec3 centre = kChannelsPlace.origin +
                                  kChannelsPlace.direction * (0.5 * kChannelsPlace.spacing *
                                                              glm::dvec3(kChannelsPlace.size - 1));
        scene_.camera = {.eye = centre + glm::dvec3(11, 7, 9), .center = centre};
    }

    [[nodiscard]] scene::Layer& layer() { return scene_.layers[0]; }

    std::vector<data::Volume> alone_;
    scene::Scene scene_;
};

}  // namespace volcast::support
