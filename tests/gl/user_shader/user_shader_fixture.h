#pragma once

#include <cstring>
#include <string>
#include <vector>

#include "tests/support/phantoms.h"
#include "tests/support/render_test.h"

namespace volcast::support {

/// Volumes drawn by code.
class UserShaderTest : public RenderTest {
protected:
    /// `volume` from a corner, by `code`.
    scene::Scene sceneOf(data::Volume volume, const std::string& code,
                         scene::RayModel model = scene::RayModel::kVolume) {
        renderer_->addDataset("volume", std::move(volume));
        scene::Layer layer;
        layer.id = "layer";
        layer.dataset = "volume";
        layer.model = model;
        layer.shader.code = code;
        scene::Scene scene;
        scene.layers.push_back(layer);
        scene.camera = {.eye = {50, 40, 60}, .center = {8, 8, 8}};
        scene.camera.fovyDegrees = 20.0;
        return scene;
    }

    /// Straight through the slab of sceneOf(slab(), ..).
    scene::Scene slabScene(data::Volume volume, const std::string& code,
                           scene::RayModel model = scene::RayModel::kVolume) {
        scene::Scene scene = sceneOf(std::move(volume), code, model);
        scene.camera = {.eye = {4.1, 3.9, 10}, .center = {4.1, 3.9, 0}};
        scene.camera.projection = scene::Projection::kOrthographic;
        scene.camera.orthographicHeight = 2.0;
        return scene;
    }

    /// 9 x 9 x 5 grid points of one type; channel c holds `base + c` everywhere.
    template <class T>
    static data::Volume slab(data::VoxelType type, T base, int channels = 1) {
        data::VolumeInput input;
        input.size = {9, 9, 5};
        input.type = type;
        for (int c = 0; c < channels; ++c) {
            const std::vector<T> values(std::size_t{9} * 9 * 5,
                                        static_cast<T>(base + static_cast<T>(c)));
            data::ChannelInput channel{.name = "c" + std::to_string(c), .unit = "", .voxels = {}};
            const auto bytes = std::as_bytes(std::span{values});
            channel.voxels.assign(bytes.begin(), bytes.end());
            input.channels.push_back(std::move(channel));
        }
        return must(data::buildVolume(std::move(input)));
    }

    static double largestDifference(const Drawn& a, const Drawn& b) {
        double largest = 0.0;
        for (std::size_t i = 0; i < a.linear.size(); ++i) {
            largest = std::max(largest, std::abs(double{a.linear[i]} - b.linear[i]));
        }
        return largest;
    }

    static double drawnShare(const Drawn& picture) {
        std::size_t drawn = 0;
        for (std::size_t i = 3; i < picture.linear.size(); i += 4) {
            if (picture.linear[i] > 0.01F) ++drawn;
        }
        return static_cast<double>(drawn) / (static_cast<double>(picture.linear.size()) / 4.0);
    }
};

}  // namespace volcast::support
