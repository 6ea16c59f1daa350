#include "renderer/accuracy/measurement.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/scene/ray_models.h"

namespace volcast::accuracy {

std::vector<Candidate> candidates(const scene::Scene& scene, const std::set<std::string>& volumes) {
    using scene::MeshEvaluator;
    constexpr std::array kEvaluators{MeshEvaluator::kWalk, MeshEvaluator::kProjection,
                                     MeshEvaluator::kProjectionFaces};
    std::vector<Candidate> found;
    for (std::size_t i = 0; i < scene.layers.size(); ++i) {
        const scene::Layer& layer = scene.layers[i];
        // Of users' code there is no reference.
        if (!layer.visible || !layer.shader.code.empty()) continue;
        const bool mesh = !volumes.contains(layer.dataset);
        for (const scene::IntegratorRow& row : scene::row(layer.model).integratorsOf(mesh)) {
            bool served = false;
            for (const MeshEvaluator evaluator : kEvaluators) {
                if (!mesh || !scene::serves(evaluator, layer.model, row.integrator)) continue;
                served = true;
                found.push_back({.layer = i, .integrator = row.integrator, .evaluator = evaluator});
            }
            if (!served) found.push_back({.layer = i, .integrator = row.integrator});
        }
    }
    return found;
}

scene::Scene withCandidate(const scene::Scene& scene, const Candidate& candidate) {
    scene::Scene changed = scene;
    changed.accuracy = {.kind = scene::Accuracy::Kind::kExact};
    changed.layers.at(candidate.layer).integrator = candidate.integrator;
    changed.layers.at(candidate.layer).evaluator = candidate.evaluator;
    return changed;
}

std::vector<glm::ivec2> gridPixels(scene::PictureSize size, const Grid& grid) {
    std::vector<glm::ivec2> pixels;
    const int twice = 2 * grid.step;
    const int first = (grid.firstRow + grid.step - 1) / grid.step * grid.step;
    for (int y = first; y < std::min(grid.endRow, size.y); y += grid.step) {
        const bool coarse = grid.refines && y % twice == 0;
        for (int x = coarse ? grid.step : 0; x < size.x; x += coarse ? twice : grid.step) {
            pixels.emplace_back(x, y);
        }
    }
    return pixels;
}

std::vector<glm::ivec2> samplePixels(scene::PictureSize size, std::uint64_t count) {
    const std::uint64_t all = static_cast<std::uint64_t>(size.x) * size.y;
    std::vector<glm::ivec2> pixels;
    if (count == 0 || count >= all) {
        pixels.reserve(all);
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) pixels.emplace_back(x, y);
        }
        return pixels;
    }
    // The additive sequence of the plastic number: low discrepancy in the plane. M. Roberts, The
    // Unreasonable Effectiveness of Quasirandom Sequences, 2018. Pixels that come up twice are
    // taken once.
    constexpr double kPlastic = 1.32471795724474602596;
    std::vector<char> taken(all, 0);
    double x = 0.5;
    double y = 0.5;
    // Far more tries than a low-discrepancy sequence needs to meet `count` of the pixels.
    for (std::uint64_t i = 0; pixels.size() < count && i < 64 * all; ++i) {
        x = std::fmod(x + 1.0 / kPlastic, 1.0);
        y = std::fmod(y + 1.0 / (kPlastic * kPlastic), 1.0);
        const glm::ivec2 pixel(static_cast<int>(x * size.x), static_cast<int>(y * size.y));
        char& seen = taken[static_cast<std::size_t>(pixel.y) * size.x + pixel.x];
        if (seen == 0) pixels.push_back(pixel);
        seen = 1;
    }
    return pixels;
}

}  // namespace volcast::accuracy
