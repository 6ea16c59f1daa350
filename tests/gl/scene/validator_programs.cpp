// The programs that can be drawn with, in all their variants.
#include <array>
#include <string>

#include "renderer/mesh/projection.h"
#include "renderer/mesh/shared.h"
#include "renderer/mesh/walk.h"
#include "renderer/user_shader/check_text.h"
#include "renderer/user_shader/generate.h"
#include "renderer/volume/march.h"
#include "renderer/volume/slices.h"
#include "tests/gl/scene/validator.h"
#include "tests/support/layer_constants.h"
#include "tests/support/march_variants.h"

namespace volcast::test {

using shading::Constant;

namespace {

/// Bit `i` of `number`.
bool bit(int number, int i) {
    return (number >> i & 1) != 0;
}

}  // namespace

void Validator::addRay(const shading::Recipe& recipe, const std::string& vertex) {
    const std::string label = recipe.evaluator + " + " + recipe.model;
    mains_.insert({recipe.evaluator, vertex});
    ++programs_;
    pairs_.try_emplace(
        vertex + " + " + label,
        std::vector{add("vert", vertex, shading::assembleFile(vertex, recipe.constants, chunks_)),
                    add("frag", label, shading::assemble(recipe, chunks_))});
}

void Validator::addPass(const std::string& vertex, const std::string& fragment,
                        const std::vector<Constant>& constants) {
    mains_.insert({vertex, fragment});
    ++programs_;
    pairs_.try_emplace(
        vertex + " + " + fragment,
        std::vector{add("vert", vertex, shading::assembleFile(vertex, constants, chunks_)),
                    add("frag", fragment, shading::assembleFile(fragment, constants, chunks_))});
}

void Validator::addCompute(const std::string& file, const std::vector<Constant>& constants) {
    mains_.insert(file);
    ++programs_;
    pairs_.try_emplace(
        file, std::vector{add("comp", file, shading::assembleFile(file, constants, chunks_))});
}

void Validator::addMarches() {
    for (const scene::RayModelRow& row : scene::rayModels()) {
        if (!row.onVolumes || row.chunk.empty()) continue;
        for (int variant = 0; variant < support::kMarchVariants; ++variant) {
            addRay(volume::marchRecipe(support::marchTraits(row, variant),
                                       support::layerConstants(variant)),
                   shading::kFullScreenVertex);
            if (row.opaque) continue;
            addRay(volume::sliceRecipe(support::marchTraits(row, variant), variant % 2 == 0,
                                       support::layerConstants(variant)),
                   volume::kSliceVertex);
        }
    }
    for (int variant = 0; variant < support::kMarchVariants; ++variant) {
        addRay(volume::crossSectionRecipe(
                   support::marchTraits(scene::row(scene::RayModel::kCrossSections), variant),
                   support::layerConstants(variant)),
               shading::kFullScreenVertex);
    }
}

/// Code with all kinds of controls, of all types of data.
void Validator::addUserCode() {
    const user_shader::Checked code = user_shader::checkText(
        "#uicontrol float s slider(min=0, max=1)\n#uicontrol int i slider(min=0, max=9)\n"
        "#uicontrol vec3 c color\n#uicontrol bool b checkbox\n#uicontrol uint o "
        "select(options=[1])\n"
        "#uicontrol invlerp n(channel=1)\n#uicontrol transferFunction t\n"
        "void main() { vec4 m = t(getInterpolatedDataValue(2)); emitIntensity(n());\n"
        "if (b && i > 1 && o == 1u) { emitTransparent(); return; }\n"
        "float step = toNormalized(getDataValue()) + float(toRaw(getDataValue(1)));\n"
        "emitGrayscale(step); emitRGB(c * s); emitRGBA(m); }");
    ASSERT_TRUE(code.complaints.empty()) << code.complaints.front().message;
    const auto textsFor = [&code](user_shader::ValueType type, bool gathers) {
        return std::vector<shading::TextChunk>{
            {.path = user_shader::kValuesChunk, .text = user_shader::valuesText(type, gathers)},
            {.path = user_shader::kControlsChunk,
             .text = user_shader::controlsText(code.controls, {1, 2}, type)},
            {.path = user_shader::kBodyChunk, .text = code.body}};
    };
    constexpr std::array kModels{scene::RayModel::kVolume, scene::RayModel::kMip,
                                 scene::RayModel::kMinip, scene::RayModel::kCrossSections};
    for (int variant = 0; variant < 4 * 4 * 3 * 2; ++variant) {
        const auto type = static_cast<user_shader::ValueType>(variant % 4);
        const scene::RayModel model = kModels[variant / 4 % 4];
        const bool bricked = variant % 5 == 0;
        const volume::UserTraits traits{.model = model,
                                        .sampling = static_cast<scene::Sampling>(variant / 16 % 3),
                                        .filterInHardware = bit(variant, 0),
                                        .interval = variant >= 48,
                                        .clipPlanes = bit(variant, 2) ? 2 : 0,
                                        .otherChannels = bricked ? 0 : 2,
                                        .byDistance = !bricked && bit(variant, 3),
                                        .field = {.bricked = bricked,
                                                  .type = static_cast<data::VoxelType>(variant % 4),
                                                  .coarserLevels = 2}};
        addRay(volume::userRecipe(traits, textsFor(type, model != scene::RayModel::kCrossSections),
                                  {{"kEndsAtSurfaces", bit(variant, 1)}}),
               shading::kFullScreenVertex);
    }
    for (int variant = 0; variant < 3 * 3 * 4; ++variant) {
        const bool counts = bit(variant, 0);
        const mesh::WalkTraits traits{
            .model = kModels[variant % 3],
            .valuesAt = variant / 3 % 3,
            .interval = bit(variant, 1),
            .clipPlanes = bit(variant, 2) ? 2 : 0,
            .convex = bit(variant, 3),
            .clipsAtStart = bit(variant, 4),
            .counts = counts,
            .resumes = counts && bit(variant, 1),
            .code = mesh::CodeTraits{.texts = textsFor(user_shader::ValueType::kF32, true),
                                     .othersAt = {variant / 9 % 3, (variant + 1) % 3},
                                     .iterations = variant}};
        addRay(mesh::walkRecipe(traits, {{"kEndsAtSurfaces", bit(variant, 1)}}),
               shading::kFullScreenVertex);
    }
}

void Validator::addWalks() {
    // Every model with every integrator; what else tells programs apart takes turns, so that each
    // meets each of them with both of its values.
    int turn = 0;
    for (const scene::RayModelRow& row : scene::rayModels()) {
        if (!row.onMeshes || row.chunk.empty()) continue;
        for (const scene::IntegratorRow& integrator : row.integrators) {
            for (int variant = 0; variant < kWalkVariants; ++variant) {
                addWalk(row, integrator, variant * 37 + turn++);
            }
        }
    }
}

void Validator::addWalk(const scene::RayModelRow& row, const scene::IntegratorRow& integrator,
                        int bits) {
    const bool counts = bit(bits, 4);
    mesh::WalkTraits traits{.model = row.model,
                            .integrator = integrator.integrator,
                            .valuesAt = bits % 3,
                            .densityAt = (bits / 3) % 4,
                            .interval = bit(bits, 0),
                            .clipPlanes = bit(bits, 1) ? 2 : 0,
                            .convex = bit(bits, 2),
                            .clipsAtStart = bit(bits, 3),
                            .earlyStop = bit(bits, 0),
                            .counts = counts,
                            .resumes = counts && bit(bits, 5),
                            .countsSteps = bit(bits, 6)};
    traits.lit = row.model == scene::RayModel::kIsosurface && bit(bits, 1);
    if (row.model == scene::RayModel::kVolume) {
        traits.levels = bit(bits, 5);
        traits.lit = traits.levels;
        traits.oneColour = !traits.levels && integrator.integrator == scene::Integrator::kExact;
    }
    addRay(mesh::walkRecipe(traits, support::layerConstants(bits)), shading::kFullScreenVertex);
}

void Validator::addProjections() {
    int turn = 0;
    for (const scene::RayModelRow& row : scene::rayModels()) {
        if (!row.onMeshes || row.chunk.empty() || row.opaque) continue;
        for (const scene::IntegratorRow& integrator : row.integrators) {
            for (int variant = 0; variant < 4; ++variant) {
                const int bits = variant * 37 + turn++;
                const bool all =
                    variant == 0 && scene::serves(scene::MeshEvaluator::kProjectionFaces, row.model,
                                                  integrator.integrator);
                const mesh::ProjectionTraits traits{.model = row.model,
                                                    .integrator = integrator.integrator,
                                                    .valuesAt = bits % 3,
                                                    .densityAt = (bits / 3) % 4,
                                                    .interval = bit(bits, 1),
                                                    .clipPlanes = bit(bits, 2) ? 2 : 0,
                                                    .clipsAtStart = variant == 1,
                                                    .sides = all            ? mesh::Sides::kAll
                                                             : variant == 1 ? mesh::Sides::kFar
                                                                            : mesh::Sides::kNear};
                const auto constants = support::layerConstants(bits);
                addRay(mesh::projectionRecipe(traits, constants), mesh::kProjectionVertex);
                addRay(mesh::projectionFinishRecipe(traits, constants), shading::kFullScreenVertex);
            }
        }
    }
}

void Validator::addLevels() {
    for (int variant = 0; variant < 48; ++variant) {
        addRay(mesh::levelRecipe({.valuesAt = variant % 3,
                                  .densityAt = variant % 4,
                                  .lit = bit(variant, 0),
                                  .clipPlanes = bit(variant, 2) ? 2 : 0,
                                  .clipsAtStart = bit(variant, 3)},
                                 support::layerConstants(variant)),
               mesh::kLevelVertex);
    }
    for (int place = 0; place < 3; ++place) {
        addCompute("mesh/level_cells.comp.glsl", {{"kValuesAt", place}});
    }
}

void Validator::addSurfaces() {
    for (int variant = 0; variant < 48; ++variant) {
        std::vector<Constant> constants{{"kEndsAtSurfaces", false}};
        if (bit(variant, 0)) constants = support::layerConstants(variant);
        addRay(mesh::surfaceRecipe({.coloured = bit(variant, 0),
                                    .headlight = bit(variant, 1),
                                    .edges = bit(variant, 2),
                                    .interval = bit(variant, 3),
                                    .clipPlanes = bit(variant, 1) ? 6 : 0,
                                    .valuesAt = variant / 16},
                                   std::move(constants)),
               mesh::kSurfaceVertex);
    }
}

void Validator::addOtherPasses() {
    for (const char* fragment : {"mesh/entry_face.frag.glsl", "mesh/entry_list.frag.glsl"}) {
        addPass("mesh/boundary.vert.glsl", fragment,
                {{"kEndsAtSurfaces", false}, {"kDensityAt", 3}});
    }
    for (const int place : {mesh::shared::kValuesAtVertices, mesh::shared::kValuesAtCells}) {
        addCompute("mesh/transform.comp.glsl", {{"kValuesAt", place}});
    }
    addPass(shading::kFullScreenVertex, "lib/resolve.glsl", {});
    addPass(shading::kFullScreenVertex, "volume/filter_probe.glsl", {});
    for (int variant = 0; variant < 24; ++variant) {
        std::vector<Constant> constants = support::layerConstants(variant);
        constants.insert(constants.end(), {{"kGathers", variant % 4},
                                           {"kSampling", variant / 8},
                                           {"kFilterInHardware", bit(variant, 2)},
                                           {"kChannels", 1 + variant % 4},
                                           {"kChannelSearch", 0xe4},
                                           {"kEarlyStop", bit(variant, 2)},
                                           {"kSkipBricks", bit(variant, 1)},
                                           {"kByDistance", bit(variant, 1) && bit(variant, 3)},
                                           {"kShaded", bit(variant, 2)},
                                           {"kLightAtEye", bit(variant, 3)},
                                           {"kInterval", bit(variant, 3)},
                                           {"kJitters", bit(variant, 4)},
                                           {"kMissing", bit(variant, 0)},
                                           {"kRangeBlock", 4},
                                           {"kRangeReach", 4},
                                           {"kTricubicOvershoot", plan::kTricubicOvershoot},
                                           {"kClipPlanes", bit(variant, 0) ? 6 : 0},
                                           {"kClipsAtStart", true},
                                           {"kMaxRaySamples", plan::kMaxRaySamples}});
        addPass(shading::kFullScreenVertex, "volume/march_channels.glsl", std::move(constants));
    }
}

}  // namespace volcast::test
