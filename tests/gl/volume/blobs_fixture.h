#pragma once

#include <cmath>

#include "tests/support/phantoms.h"
#include "tests/support/render_test.h"

namespace volcast::support {

inline const GridPlace kBlobsPlace{.size = {37, 21, 50},
                                   .spacing = {0.4, 0.7, 0.25},
                                   .origin = {-3.0, 900.0, 5.0},
                                   .direction = turn({2, -1, 1}, 63.0)};

/// Blobs in an empty box, so that some bricks hold nothing.
inline double blobs(const glm::dvec3& p) {
    const auto blob = [&](const glm::dvec3& c, double r) {
        const glm::dvec3 d = (p - c) / r;
        return std::exp(-glm::dot(d, d));
    };
    return 80.0 * blob({8, 7, 9}, 5.0) + 100.0 * blob({28, 15, 40}, 6.0) + 0.5 * std::sin(p.x);
}

inline data::TransferFunction blobsMap(float lowest) {
    return {{{.value = 10.0F, .colour = {0.1F, 0.1F, 0.9F}, .extinction = lowest},
             {.value = 30.0F, .colour = {0.2F, 0.9F, 0.1F}, .extinction = 0.3F},
             {.value = 60.0F, .colour = {0.9F, 0.8F, 0.1F}, .extinction = 0.1F},
             {.value = 90.0F, .colour = {1.0F, 0.1F, 0.1F}, .extinction = 2.0F}}};
}

/// A volume of blobs, seen from a corner.
class BlobsTest : public RenderTest {
protected:
    BlobsTest() : volume_{volumeOf(kBlobsPlace, blobs)} {
        renderer_->addDataset("volume", volume_);
        scene::Layer layer;
        layer.id = "layer";
        layer.dataset = "volume";
        layer.map = blobsMap(0.0F);
        scene_.layers.push_back(layer);
        center_ = kBlobsPlace.origin + kBlobsPlace.direction * (0.5 * kBlobsPlace.spacing *
                                                                glm::dvec3(kBlobsPlace.size - 1));
        scene_.camera = {.eye = center_ + glm::dvec3(21, 14, 25), .center = center_};
        scene_.camera.orthographicHeight = 18.0;
    }

    data::Volume volume_;
    scene::Scene scene_;
    glm::dvec3 center_{0.0};
};

}  // namespace volcast::support
