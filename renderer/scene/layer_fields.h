#pragma once

#include <optional>
#include <string>

#include "renderer/data/dataset.h"
#include "renderer/scene/scene.h"

namespace volcast::scene {

/// A field as a layer reads it.
struct FieldUse {
    const data::FieldSummary* field = nullptr;
    Scale scale = {};
};

/// The field named `name`; the first where there is none of that name. Null: there is no field.
const data::FieldSummary* findField(const data::DatasetSummary& summary, const std::string& name);

/// The field whose values rays carry: f, but g in an X-ray of all values, which
/// has no use for f.
FieldUse mainField(const Layer& layer, const data::DatasetSummary& summary);

/// g, where its values are not those of the main field.
std::optional<FieldUse> secondField(const Layer& layer, const data::DatasetSummary& summary);

/// A field as code of users reads it.
FieldUse asStored(const data::FieldSummary& field);

/// `map` with extinctions times exp(gain).
data::TransferFunction withGain(data::TransferFunction map, float gain);

/// The maps of both as rays look them up, with scaled values; the second has no points where one
/// map serves.
struct LayerMaps {
    data::TransferFunction main;
    data::TransferFunction density;
};
LayerMaps layerMaps(const Layer& layer, const data::DatasetSummary& summary);

}  // namespace volcast::scene
