#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "gtest/gtest.h"

#include "renderer/reference/reference.h"
#include "tests/support/mesh_scenes.h"

namespace volcast::support {

/// How far a picture is from the reference, over all channels of the pixels compared.
struct Distance {
    double largest = 0.0;
    double rms = 0.0;
    int pixels = 0;     ///< Compared: not near a silhouette or a jump.
    int atEdges = 0;    ///< Left out.
    int off = 0;        ///< Compared, and off by more than 1/1000.
    int notFinite = 0;  ///< Of all pixels.
    glm::ivec2 worst{0};
};

inline Distance distanceTo(const reference::Picture& wanted, const Drawn& drawn) {
    Distance distance;
    double sum = 0.0;
    for (int y = 0; y < drawn.size.y; ++y) {
        for (int x = 0; x < drawn.size.x; ++x) {
            const auto i = static_cast<std::size_t>(y) * drawn.size.x + x;
            const glm::dvec4 pixel{drawn.at(x, y)};
            for (int c = 0; c < 4; ++c) {
                if (!std::isfinite(pixel[c])) ++distance.notFinite;
            }
            if (wanted.nearEdge[i] != 0) {
                ++distance.atEdges;
                continue;
            }
            ++distance.pixels;
            bool isOff = false;
            for (int c = 0; c < 4; ++c) {
                const double off = std::abs(pixel[c] - wanted.pixels[i][c]);
                isOff = isOff || !(off <= 1e-3);
                sum += off * off;
                if (!(off <= distance.largest)) {
                    distance.largest = off;
                    distance.worst = {x, y};
                }
            }
            distance.off += isOff ? 1 : 0;
        }
    }
    distance.rms = std::sqrt(sum / std::max(4 * distance.pixels, 1));
    return distance;
}

/// A test that compares pictures of one mesh with the reference.
class ReferenceTest : public MeshTest {
protected:
    Distance distance(const scene::Scene& scene, scene::PictureSize size) {
        const auto wanted = reference::draw(
            scene, std::map<std::string, const data::Mesh*>{{"mesh", &mesh_}}, size);
        const auto drawn = tryDraw(*renderer_, scene, size);
        EXPECT_TRUE(wanted.has_value()) << wanted.error().message;
        EXPECT_TRUE(drawn.has_value()) << drawn.error().message;
        if (!wanted || !drawn) return {};
        return distanceTo(*wanted, *drawn);
    }

    /// Triangles: the rasteriser's grid of 1/256 pixel puts a pixel beside an edge on the face next
    /// to it, as happens to 2/256 of those on edges; here, where edges are some pixels apart, to
    /// less than one in 200.
    void expectRasterClose(const scene::Scene& scene, scene::PictureSize size,
                           const std::string& what) {
        const Distance found = distance(scene, size);
        EXPECT_LE(found.off, size.x * size.y / 200)
            << what << " at " << found.worst.x << ", " << found.worst.y;
        EXPECT_EQ(found.notFinite, 0) << what;
        EXPECT_GT(found.pixels, size.x * size.y / 4) << what;
    }

    /// Also that most pixels were compared and none is NaN or infinite.
    void expectClose(const scene::Scene& scene, scene::PictureSize size, double tolerance,
                     const std::string& what) {
        const Distance found = distance(scene, size);
        EXPECT_LE(found.largest, tolerance)
            << what << " at " << found.worst.x << ", " << found.worst.y << "; rms " << found.rms;
        EXPECT_EQ(found.notFinite, 0) << what;
        EXPECT_GT(found.pixels, size.x * size.y / 4) << what;
    }
};

}  // namespace volcast::support
