#pragma once

#include <string>

#include "renderer/scene/scene.h"

namespace volcast::scene {

/// The scene a dataset is first shown with: everything in view, `volume`, its first field and a
/// map over the field's range; `surface` for a mesh without fields.
Scene defaultScene(const std::string& datasetId, const data::DatasetSummary& summary);

/// As above for one field and ray model; `field` must exist. Whatever the model, all that it reads
/// is set: one level at the middle of the range, exposures as expose() finds them, surfaces and
/// wireframes in the colours of the field.
Layer defaultLayer(const std::string& datasetId, const data::DatasetSummary& summary,
                   const std::string& field, RayModel model);

/// Sets `extinctionScale` and `exposure` for the layer's fields and maps so that the densest body
/// in the data drowns xray and splat neither in black nor in white.
void expose(Layer& layer, const data::DatasetSummary& summary);

}  // namespace volcast::scene
