#include "renderer/mesh/walk_user.h"

#include <string>

#include "renderer/mesh/mesh_buffers.h"
#include "renderer/mesh/shared.h"

namespace volcast::mesh {

void showByCode(shading::Recipe& recipe, const WalkTraits& traits) {
    const CodeTraits& code = *traits.code;
    const bool gathers = traits.model == scene::RayModel::kVolume;
    recipe.evaluator = "mesh/walk_user.glsl";
    recipe.classify = "classify/user_code.glsl";
    recipe.segment = gathers ? "segment/user_code.glsl" : "";
    recipe.model = gathers ? "model/volume.glsl" : "model/user_extreme.glsl";
    recipe.constants.insert(recipe.constants.end(),
                            {{"kLargestCounts", traits.model == scene::RayModel::kMip},
                             {"kOtherFields", static_cast<int>(code.othersAt.size())}});
    for (std::size_t i = 0; i < shared::kMostOtherFields; ++i) {
        const int at = i < code.othersAt.size() ? code.othersAt[i] : shared::kValuesNowhere;
        recipe.constants.push_back({"kOtherAt" + std::to_string(i + 1), at});
    }
    recipe.texts.insert(recipe.texts.end(), code.texts.begin(), code.texts.end());
}

void bindOtherFields(const UserInputs& user) {
    for (std::size_t i = 0; i < user.others.size(); ++i) {
        FieldBuffer::of(*user.others[i])
            .values.bindTexels(static_cast<unsigned>(shared::kOtherFieldUnit + i));
    }
}

}  // namespace volcast::mesh
