#pragma once

#include "renderer/mesh/walk.h"

namespace volcast::mesh {

/// Loop iterations that a sample takes, by the code's own loops at most.
inline int iterationsAPart(const CodeTraits& code) {
    return 1 + code.iterations;
}

/// Makes `recipe`, a walk's of `traits`, ask their code what samples show.
void showByCode(shading::Recipe& recipe, const WalkTraits& traits);

/// Binds the fields that a code reads besides the layer's own.
void bindOtherFields(const UserInputs& user);

}  // namespace volcast::mesh
