#pragma once

#include <string>

#include "renderer/scene/scene.h"

namespace volcast::scene {

/// The scene a dataset is first shown with: everything in view, `volume`, its first field and a
/// map over the field's range; `surface` for a mesh without fields.
Scene defaultScene(const std::string& datasetId, const data::DatasetSummary& summary);

/// As above for one field and ray model; `field` must exist.
Layer defaultLayer(const std::string& datasetId, const data::DatasetSummary& summary,
                   const std::string& field, RayModel model);

}  // namespace volcast::scene
