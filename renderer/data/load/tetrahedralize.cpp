#include "renderer/data/load/tetrahedralize.h"

#ifndef TETLIBRARY
#define TETLIBRARY  // The header then declares the library's functions.
#endif
#include <algorithm>
#include <exception>
#include <future>
#include <new>
#include <thread>
#include <unistd.h>
#include <utility>

#include <tetgen.h>

namespace volcast::data::load {

namespace {

constexpr std::size_t kMaxSwitches = 64;
/// Switches that choose how to mesh. Others choose files, print, or change what comes back.
constexpr const char* kAllowedSwitches = "pqaAYSTMXOCDR/.0123456789";

Error refused(const std::string& message) {
    return fail(ErrorCode::kInvalidArgument, message);
}

/// What TetGen means by the number it throws.
/// Source: tetgen.h 1.5, terminatetetgen().
Error meaning(int thrown) {
    switch (thrown) {
        case 1: return fail(ErrorCode::kLimitExceeded, "TetGen ran out of memory");
        case 3: return refused("the surface intersects itself (TetGen)");
        case 4:
            return refused(
                "the surface has a feature too small for the tolerance (TetGen; the "
                "switch T sets a smaller one)");
        case 5:
            return refused(
                "two facets of the surface nearly coincide (TetGen; the switch Y may "
                "help)");
        case 10:
            return refused(
                "TetGen does not accept the points or facets (all in one plane, or "
                "facets that are not flat)");
        default: return refused("TetGen failed with its error " + std::to_string(thrown));
    }
}

Result<void> checkSwitches(const std::string& switches) {
    if (switches.size() > kMaxSwitches) {
        return refused("TetGen switches: " + std::to_string(switches.size()) +
                       " characters, at most " + std::to_string(kMaxSwitches));
    }
    const std::size_t wrong = switches.find_first_not_of(kAllowedSwitches);
    if (wrong == std::string::npos) return {};
    return refused("TetGen switches: '" + switches.substr(wrong, 1) + "' is not among " +
                   kAllowedSwitches);
}

Result<void> checkIndices(const Surface& surface) {
    const auto points = static_cast<std::int64_t>(surface.points.size());
    constexpr std::int64_t kMaxPoints = 1 << 28;
    if (points > kMaxPoints || surface.facets.size() > static_cast<std::size_t>(kMaxPoints)) {
        return fail(ErrorCode::kLimitExceeded, "has too many points or facets for TetGen");
    }
    for (std::size_t f = 0; f < surface.facets.size(); ++f) {
        for (const auto& polygon : surface.facets[f].polygons) {
            for (const std::int64_t vertex : polygon) {
                if (vertex >= 0 && vertex < points) continue;
                return refused("facet " + std::to_string(f) + " names point " +
                               std::to_string(vertex) + ", there are " + std::to_string(points));
            }
        }
    }
    return {};
}

void copyPoints(const std::vector<glm::dvec3>& from, double*& to, int& count) {
    count = static_cast<int>(from.size());
    if (from.empty()) return;
    to = new double[from.size() * 3];  // NOLINT: tetgenio frees it with delete[]
    for (std::size_t i = 0; i < from.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) to[3 * i + axis] = from[i][axis];
    }
}

void copyFacet(const Facet& from, tetgenio::facet& to) {
    tetgenio::init(&to);
    to.numberofpolygons = static_cast<int>(from.polygons.size());
    to.polygonlist = new tetgenio::polygon[from.polygons.size()];  // NOLINT: as above
    for (std::size_t p = 0; p < from.polygons.size(); ++p) {
        tetgenio::polygon& polygon = to.polygonlist[p];
        tetgenio::init(&polygon);
        polygon.numberofvertices = static_cast<int>(from.polygons[p].size());
        polygon.vertexlist = new int[from.polygons[p].size()];  // NOLINT: as above
        std::transform(from.polygons[p].begin(), from.polygons[p].end(), polygon.vertexlist,
                       [](std::int64_t v) { return static_cast<int>(v); });
    }
    copyPoints(from.holes, to.holelist, to.numberofholes);
}

void copySurface(const Surface& surface, tetgenio& in) {
    copyPoints(surface.points, in.pointlist, in.numberofpoints);
    in.numberofpointattributes = static_cast<int>(surface.attributes.size());
    if (!surface.attributes.empty()) {
        const std::size_t each = surface.attributes.size();
        in.pointattributelist = new double[surface.points.size() * each];  // NOLINT: as above
        for (std::size_t i = 0; i < surface.points.size(); ++i) {
            for (std::size_t a = 0; a < each; ++a) {
                in.pointattributelist[i * each + a] = surface.attributes[a].steps[0][i];
            }
        }
    }
    if (!surface.facets.empty()) {
        in.numberoffacets = static_cast<int>(surface.facets.size());
        in.facetlist = new tetgenio::facet[surface.facets.size()];  // NOLINT: as above
        for (std::size_t f = 0; f < surface.facets.size(); ++f) {
            copyFacet(surface.facets[f], in.facetlist[f]);
        }
    }
    copyPoints(surface.holes, in.holelist, in.numberofholes);
    if (surface.regions.empty()) return;
    in.numberofregions = static_cast<int>(surface.regions.size());
    in.regionlist = new double[surface.regions.size() * 5];  // NOLINT: as above
    for (std::size_t r = 0; r < surface.regions.size(); ++r) {
        const Region& region = surface.regions[r];
        for (int axis = 0; axis < 3; ++axis) in.regionlist[5 * r + axis] = region.inside[axis];
        in.regionlist[5 * r + 3] = region.attribute;
        in.regionlist[5 * r + 4] = region.maxVolume;
    }
}

Tetrahedra copyResult(const Surface& surface, const tetgenio& out) {
    Tetrahedra result;
    MeshInput& mesh = result.mesh;
    const auto points = static_cast<std::size_t>(out.numberofpoints);
    result.addedPoints = points - std::min(points, surface.points.size());
    mesh.points.resize(points);
    for (std::size_t i = 0; i < points; ++i) {
        for (int axis = 0; axis < 3; ++axis) mesh.points[i][axis] = out.pointlist[3 * i + axis];
    }
    const auto cells = static_cast<std::size_t>(out.numberoftetrahedra);
    mesh.cells.resize(cells);
    for (std::size_t c = 0; c < cells; ++c) {
        const int* corners =
            out.tetrahedronlist + c * static_cast<std::size_t>(out.numberofcorners);
        for (std::size_t v = 0; v < 4; ++v) mesh.cells[c].at(v) = corners[v] - out.firstnumber;
    }
    const auto attributes = static_cast<std::size_t>(out.numberoftetrahedronattributes);
    if (attributes > 0) {
        std::vector<double> values(cells);
        for (std::size_t c = 0; c < cells; ++c) {
            values[c] = out.tetrahedronattributelist[c * attributes];
        }
        mesh.fields.push_back({.name = "region",
                               .association = Association::kCell,
                               .steps = {std::move(values)},
                               .times = {0.0}});
    }
    if (result.addedPoints == 0 && points == surface.points.size()) {
        for (const FieldInput& attribute : surface.attributes) mesh.fields.push_back(attribute);
    }
    return result;
}

/// Where the thread that runs TetGen leaves how it ended.
std::promise<Result<void>>* ending = nullptr;  // NOLINT: a terminate handler has no arguments

/// Called for an exception that nobody catches, before any destructor ran.
[[noreturn]] void reportAndPark() {
    Error error = meaning(0);
    try {
        std::rethrow_exception(std::current_exception());
    } catch (int thrown) {
        error = meaning(thrown);
    } catch (const std::bad_alloc&) {
        error = meaning(1);
    }
    ending->set_value(std::move(error));
    for (;;) ::pause();
}

/// Runs TetGen on a thread of its own and leaves it there if it throws: TetGen 1.5 frees its
/// memory before it throws and once more in its destructors, so its stack must not be unwound.
Result<void> runTetgen(std::string& switches, tetgenio& in, tetgenio& out) {
    std::promise<Result<void>> promise;
    auto ended = promise.get_future();
    ending = &promise;
    const std::terminate_handler before = std::set_terminate(&reportAndPark);
    std::thread runner{[&] {
        ::tetrahedralize(switches.data(), &in, &out);
        promise.set_value(Result<void>{});
    }};
    auto result = ended.get();
    std::set_terminate(before);
    if (result) {
        runner.join();
    } else {
        runner.detach();
    }
    return result;
}

Result<Tetrahedra> run(const Surface& surface, std::string switches) {
    tetgenio in;
    tetgenio out;
    copySurface(surface, in);
    switches += "Qz";  // Quiet; indices from 0.
    auto ended = runTetgen(switches, in, out);
    if (!ended) return ended.error();
    if (out.numberoftetrahedra <= 0) {
        return refused(
            "TetGen made no cells: the surface is not closed, or the points lie in one "
            "plane");
    }
    return copyResult(surface, out);
}

}  // namespace

Result<Tetrahedra> tetrahedralize(const Surface& surface, const std::string& switches) {
    auto checked = checkSwitches(switches);
    if (checked) checked = checkIndices(surface);
    if (!checked) return checked.error();
    if (surface.points.size() < 4 || surface.facets.empty()) {
        return refused("has " + std::to_string(surface.points.size()) + " points and " +
                       std::to_string(surface.facets.size()) + " facets, too few for a solid");
    }
    std::string all = switches.find('p') == std::string::npos ? "p" : "";
    all += switches;
    if (!surface.regions.empty() && all.find('A') == std::string::npos) all += "A";
    return run(surface, all);
}

Result<Tetrahedra> delaunay(const Surface& points) {
    if (points.points.size() < 4) {
        return refused("has " + std::to_string(points.points.size()) +
                       " points, at least 4 are needed");
    }
    return run(points, "");
}

}  // namespace volcast::data::load
