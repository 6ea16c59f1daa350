#pragma once

#include "renderer/scene/scene.h"
#include "volcast/v1/session.pb.h"

namespace volcast::session {

/// The controls of a user's code, and what is wrong with it. `summaries`: of the dataset it names,
/// where that is known.
v1::ShaderDescription shaderDescription(const v1::DescribeShader& message,
                                        const scene::Summaries& summaries);

}  // namespace volcast::session
