#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/data/transfer_function.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/user_shader.h"

namespace volcast::scene {

/// What a ray gathers. Each is one GLSL chunk and one row of ray_models.h, in this order.
enum class RayModel {
    kSurface,        ///< Nearest boundary point of a mesh.
    kWireframe,      ///< The same with the edges of its faces.
    kMip,            ///< Colour of the largest value on the ray (voxels: MAX).
    kMinip,          ///< Colour of the smallest value on the ray.
    kMipColour,      ///< Largest red, green and blue of C(f) on the ray, each by itself.
    kXray,           ///< White through what absorbs: exp(-k int rho(g) ds).
    kSplat,          ///< 2^exposure int C(f) ds.
    kIsosurface,     ///< Nearest point whose value is one of a set of levels.
    kVolume,         ///< Emission and absorption (voxels: ON).
    kCrossSections,  ///< Planes across the axes of a grid (voxels: OFF).
};

/// How a ray's share of one cell is integrated; ray_models.h lists what serves which model.
enum class Integrator {
    kAuto,           ///< Whatever the plan finds best.
    kAverage,        ///< volume: the map at the mean of both ends.
    kLinearOpacity,  ///< volume: linear colour and opacity, by an approximation.
    kPsiTable,       ///< volume: linear extinction and emission, weights from a table.
    kPsi,            ///< volume: linear extinction and emission, in closed form.
    kPreintegrated,  ///< volume: colour and extinction from a table over both ends.
    kExact,          ///< Split where the map bends; all models.
    kFront,          ///< xray, splat: the map at the front end.
    kEnds,           ///< xray, splat, mip_colour: the map at both ends.
    kAdaptive,       ///< voxels: steps as long as the map allows.
};

/// What brings rays and cells of a mesh together.
enum class MeshEvaluator {
    kAuto,             ///< Whatever the plan finds best.
    kWalk,             ///< Rays walk from cell to cell.
    kProjection,       ///< Cells are drawn by their faces towards the eye, exits are computed.
    kProjectionFaces,  ///< Cells are drawn by all faces: only extremes of both ends.
};

/// What brings rays and voxels together.
enum class VoxelEvaluator {
    kAuto,            ///< Whatever the plan finds best.
    kMarch,           ///< Rays march front to back.
    kSlices,          ///< Polygons across the view.
    kSliceInstances,  ///< The same as instances of one.
};

/// How voxels are read between grid points.
enum class Sampling {
    kNearest,
    kTrilinear,
    kTricubic,  ///< Catmull-Rom: through the grid points, with continuous slopes.
};

/// Turns a field's values into those that rays interpolate and maps are linear in. It is applied
/// to the stored values, to control points, levels and intervals alike; all of these stay in the
/// field's own unit in a scene.
struct Scale {
    enum class Kind {
        kLinear,  ///< Values as they are; the domain only clamps.
        kLog,     ///< log; the domain must be above 0.
        kPower,   ///< ((v - min) / (max - min))^exponent.
    };
    Kind kind = Kind::kLinear;
    float exponent = 1.0F;  ///< kPower only; > 0.
    std::optional<data::Range>
        domain{};  ///< Values outside are clamped to it; none: the field's range.
    friend bool operator==(const Scale&, const Scale&) = default;
};

/// The values at which isosurfaces are shown.
struct Levels {
    enum class Spacing { kList, kLinear, kLog, kPower };
    static constexpr int kMaxLevels = 256;

    Spacing spacing = Spacing::kList;
    std::vector<float> values;        ///< kList.
    float first = 0.0F, last = 1.0F;  ///< Others: the ends, both included; kLog: > 0.
    int count = 1;                    ///< Others.
    float exponent = 2.0F;  ///< kPower: first + (last - first) (i / (count - 1))^exponent.
    friend bool operator==(const Levels&, const Levels&) = default;
};

/// Which cells of a mesh are drawn: those whose value in a P0 field is one of `values`.
struct CellMarkers {
    std::string field;  ///< Empty: all cells.
    std::vector<float> values;
    friend bool operator==(const CellMarkers&, const CellMarkers&) = default;
};

/// A point light on matter, which reflects it about the gradient of its field, on both sides alike:
/// C (ambient + diffuse |n.l|) + specular |n.h|^exponent. Where the field is flat there is no
/// highlight, and the rest is as if it faced the light.
struct Light {
    std::optional<glm::dvec3> position{};  ///< World; none: at the eye.
    float ambient = 0.3F;                  ///< These three: >= 0.
    float diffuse = 0.7F;
    float specular = 0.2F;   ///< White.
    float exponent = 32.0F;  ///< > 0.
    friend bool operator==(const Light&, const Light&) = default;
};

/// Three planes across the axes of a volume's grid, which meet in a point.
struct CrossSections {
    std::optional<glm::dvec3> point{};  ///< World; none: the middle of the data.
    glm::bvec3 shown{true};             ///< By the axis that a plane lies across.
    friend bool operator==(const CrossSections&, const CrossSections&) = default;
};

/// One channel of several that are drawn together.
struct ChannelMap {
    std::string field;
    data::TransferFunction map;
    bool visible = true;
    std::optional<data::Range> interval = {};  ///< Only values in it count; min <= max.
    friend bool operator==(const ChannelMap&, const ChannelMap&) = default;
};

/// One data model drawn with one ray model.
struct Layer {
    std::string id;       ///< Unique in its scene; names the layer in diffs and errors.
    std::string dataset;  ///< Catalogue id.
    std::string field;    ///< f: name of a mesh field or voxel channel; empty: the first.
    int timeStep = 0;
    RayModel model = RayModel::kVolume;
    data::TransferFunction map;  ///< C of f; rho too where there is no second field.
    Scale scale = {};            ///< Of `field`.
    bool visible = true;
    // a second field, g: rho(g) in volume and xray, C(g) of an isosurface
    std::string densityField = {};           ///< Empty: f serves as g.
    data::TransferFunction densityMap = {};  ///< Of g; no points: `map`.
    Scale densityScale = {};
    // what part of the data
    std::optional<data::Range> interval{};  ///< Only where min <= f <= max; under any model.
    CellMarkers markers = {};
    // surface, wireframe, isosurface
    bool coloured = false;          ///< Surface: C(f) instead of `surfaceColour`.
    glm::vec3 surfaceColour{0.8F};  ///< Linear RGB.
    bool headlight = true;          ///< c |n.w| instead of c.
    // wireframe
    float edgeWidth = 1.0F;      ///< Pixels; > 0.
    glm::vec3 edgeColour{0.0F};  ///< Linear RGB.
    // isosurface
    Levels levels = {};
    // xray, splat
    float extinctionScale = 1.0F;  ///< xray: k; >= 0.
    float exposure = 0.0F;         ///< splat: stops.
    // how a mesh is evaluated; kAuto: as the scene's `accuracy` asks
    Integrator integrator = Integrator::kAuto;
    MeshEvaluator evaluator = MeshEvaluator::kAuto;
    // voxels
    double stepWorld = 0.0;  ///< World units; 0: half the smallest spacing.
    Sampling sampling = Sampling::kTrilinear;
    std::optional<Light> light{};  ///< volume; none: matter emits its colour alone.
    VoxelEvaluator voxelEvaluator = VoxelEvaluator::kAuto;
    int depthSamples = 0;                   ///< Samples through the volume; 0: as `stepWorld` says.
    float gain = 0.0F;                      ///< volume: extinction times exp(gain).
    std::optional<std::uint32_t> jitter{};  ///< Seed of where rays begin in a step; none: off.
    std::vector<ChannelMap> channels = {};  ///< Empty: `field` by `map`.
    UserShader shader = {};                 ///< No code: the map says what is emitted.
    CrossSections crossSections = {};

    friend bool operator==(const Layer&, const Layer&) = default;
};

/// Half a space: what is kept is where dot(normal, point) >= offset; world.
struct ClipPlane {
    glm::dvec3 normal{1.0, 0.0, 0.0};  ///< Need not have length 1.
    double offset = 0.0;
    friend bool operator==(const ClipPlane&, const ClipPlane&) = default;
};

/// What a picture is to be worth; for layers that name no integrator.
struct Accuracy {
    enum class Kind {
        kAuto,  ///< Exact where that costs little more, as measured.
        kFastest,
        kExact,
        kErrorBound,  ///< The cheapest whose measured error is at most `bound`, in 1/255.
        kTimeBudget,  ///< The most accurate whose predicted time is at most `bound`, in ms.
    };
    Kind kind = Kind::kAuto;
    double bound = 0.0;
    friend bool operator==(const Accuracy&, const Accuracy&) = default;
};

/// All that decides a picture but its size. Host-side truth: GPU state is a cache of it.
struct Scene {
    static constexpr std::size_t kMaxLayers = 16;
    static constexpr std::size_t kMaxClipPlanes = 6;

    Camera camera;
    std::vector<Layer> layers;
    glm::vec4 background{0.0F, 0.0F, 0.0F, 1.0F};  ///< Linear RGB (not premultiplied) and opacity.
    std::vector<ClipPlane> clipPlanes = {};  ///< Of all layers; what all of them keep is drawn.
    Accuracy accuracy = {};

    friend bool operator==(const Scene&, const Scene&) = default;
};

/// Pixels of a picture, width and height.
using PictureSize = glm::ivec2;
inline constexpr int kMaxPictureSide = 8192;

/// What the renderer may ask about the datasets of a scene.
using Summaries = std::map<std::string, data::DatasetSummary>;

}  // namespace volcast::scene
