#pragma once

#include "renderer/base/result.h"
#include "renderer/scene/scene.h"
#include "volcast/v1/scene.pb.h"

namespace volcast::worker {

/// Reads and validates a scene (scene::validate without data); defaults are filled in.
///
/// Errors: as scene::validate; kUnsupported for an enumerator this build does not know.
Result<scene::Scene> sceneFrom(const v1::Scene& message);
Result<scene::Camera> cameraFrom(const v1::Camera& message, const std::string& path = "camera");

v1::Scene toMessage(const scene::Scene& scene);
v1::RayModel toMessage(scene::RayModel model);
v1::Integrator toMessage(scene::Integrator integrator);
v1::MeshEvaluator toMessage(scene::MeshEvaluator evaluator);
/// Errors: kUnsupported for an enumerator this build does not know.
Result<scene::Integrator> integratorFrom(v1::Integrator message);
Result<scene::MeshEvaluator> meshEvaluatorFrom(v1::MeshEvaluator message);

}  // namespace volcast::worker
