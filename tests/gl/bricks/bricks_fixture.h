#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <memory>
#include <vector>

#include "renderer/volume/brick_pool.h"
#include "tests/support/edited_renderers.h"
#include "tests/support/phantoms.h"
#include "tests/support/render_test.h"

namespace volcast::support {

// Neither is a multiple of a brick: levels end with shorter intervals.
inline const GridPlace kBricksPlace{.size = {150, 121, 117},
                                    .spacing = {0.4, 0.7, 0.5},
                                    .origin = {-3.0, 900.0, 5.0},
                                    .direction = turn({2, -1, 1}, 63.0)};
inline constexpr int kAllBricks = 5 * 4 * 4 + 3 * 2 * 2 + 2 + 1;
inline const scene::PictureSize kBricksSize{72, 56};

template <class T>
data::Volume volumeAs(data::VoxelType type, const std::function<double(const glm::dvec3&)>& value) {
    data::VolumeInput input;
    input.size = kBricksPlace.size;
    input.spacing = kBricksPlace.spacing;
    input.origin = kBricksPlace.origin;
    input.direction = kBricksPlace.direction;
    input.type = type;
    std::vector<std::byte> voxels(static_cast<std::size_t>(kBricksPlace.size.x) *
                                  kBricksPlace.size.y * kBricksPlace.size.z * sizeof(T));
    std::size_t i = 0;
    for (int z = 0; z < kBricksPlace.size.z; ++z) {
        for (int y = 0; y < kBricksPlace.size.y; ++y) {
            for (int x = 0; x < kBricksPlace.size.x; ++x, i += sizeof(T)) {
                const auto voxel = static_cast<T>(value(glm::dvec3(x, y, z)));
                std::memcpy(&voxels[i], &voxel, sizeof(T));
            }
        }
    }
    input.channels.push_back({.name = "f", .voxels = std::move(voxels)});
    return must(data::buildVolume(std::move(input)));
}

/// Two blobs and a texture of a few voxels; 0 to about 200.
inline double blobs(const glm::dvec3& p) {
    const auto blob = [&](const glm::dvec3& c, double r) {
        const glm::dvec3 d = (p - c) / r;
        return std::exp(-glm::dot(d, d));
    };
    const double texture = std::sin(1.3 * p.x) * std::sin(0.9 * p.y) * std::cos(1.1 * p.z);
    return std::round((90.0 + 20.0 * texture) * blob({38, 30, 40}, 22.0) +
                      (110.0 + 40.0 * texture) * blob({110, 80, 70}, 30.0));
}

inline double linear(const glm::dvec3& p) {
    return 2.0 * p.x - 1.5 * p.y + 0.5 * p.z + 20.0;
}

inline data::TransferFunction mapOver(float from, float to) {
    const auto at = [&](float share) { return from + share * (to - from); };
    return {{{.value = at(0.2F), .colour = {0.1F, 0.1F, 0.9F}, .extinction = 0.0F},
             {.value = at(0.4F), .colour = {0.2F, 0.9F, 0.1F}, .extinction = 0.06F},
             {.value = at(0.7F), .colour = {0.9F, 0.8F, 0.1F}, .extinction = 0.02F},
             {.value = at(1.0F), .colour = {1.0F, 0.1F, 0.1F}, .extinction = 0.3F}}};
}

/// A volume that `renderer_` draws as a whole and other renderers from bricks.
class BricksTest : public RenderTest {
protected:
    BricksTest() {
        // As the shader sums that reads bricks.
        renderer_ = rendererWithoutTextureUnit(device());
        scene::Layer layer;
        layer.id = "layer";
        layer.dataset = "volume";
        layer.map = mapOver(0.0F, 200.0F);
        scene_.layers.push_back(layer);
        center_ = kBricksPlace.origin +
                  kBricksPlace.direction *
                      (0.5 * kBricksPlace.spacing * glm::dvec3(kBricksPlace.size - 1));
        // A pixel is 0.1 wide and a voxel at least 0.4: level 0 everywhere.
        scene_.camera = {.eye = center_ + glm::dvec3(60, 40, 70), .center = center_};
        scene_.camera.projection = scene::Projection::kOrthographic;
        scene_.camera.orthographicHeight = 0.1 * kBricksSize.y;
    }

    void showAll() { scene_.camera.orthographicHeight = 120.0; }

    /// With a pool of `bricks`, or of the least that there is.
    static std::unique_ptr<scene::Renderer> bricked(const data::Volume& volume, int bricks,
                                                    int bricksAPicture = 1000) {
        const std::size_t each = volume::BrickPool::brickBytes(volume.type);
        auto renderer = must(scene::Renderer::create(
            device(), shading::embeddedChunks(),
            {.volumeBytes = each * static_cast<std::size_t>(bricks),
             .pictureBytes = each * static_cast<std::size_t>(bricksAPicture)}));
        renderer->addDataset("volume", volume);
        return renderer;
    }

    /// Draws until it is ready.
    Drawn complete(scene::Renderer& renderer) {
        for (int i = 0; i < 200; ++i) {
            Drawn drawn = must(tryDraw(renderer, scene_, kBricksSize));
            if (drawn.info.ready) return drawn;
        }
        ADD_FAILURE() << "never ready";
        return {};
    }

    static double largestDifference(const Drawn& a, const Drawn& b) {
        double worst = 0.0;
        for (std::size_t i = 0; i < a.linear.size(); ++i) {
            worst = std::max(worst, static_cast<double>(std::abs(a.linear[i] - b.linear[i])));
        }
        return worst;
    }

    /// Of all colours and opacities.
    static float largest(const Drawn& drawn) { return *std::ranges::max_element(drawn.linear); }

    scene::Scene scene_;
    glm::dvec3 center_{0.0};
};

}  // namespace volcast::support
