#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "renderer/scene/dataset_cache.h"
#include "renderer/scene/ray_models.h"
#include "renderer/scene/user_code.h"
#include "renderer/scene/view.h"

namespace volcast::scene {

/// One layer that is drawn, and all its draw needs.
struct LayerDraw {
    std::size_t index = 0;  ///< In the scene.
    const Layer* layer = nullptr;
    const plan::LayerPlan* plan = nullptr;
    CachedDataset* dataset = nullptr;
    LayerState* state = nullptr;
    const MeshPart* part = nullptr;  // Of a mesh.
    const mesh::FieldGpu* field = nullptr;
    const mesh::FieldGpu* density = nullptr;
    std::vector<const mesh::FieldGpu*> otherFields;  // That its code reads besides `field`.
    const volume::ChannelGpu* channel = nullptr;
    const volume::ChannelsGpu* channels = nullptr;   // Instead, where several are drawn together.
    const volume::BrickPool* pool = nullptr;         // Instead, of voxels in bricks.
    const volume::EmptySpace* emptySpace = nullptr;  // Of these two the one that rays read.
    const volume::RangeTable* ranges = nullptr;
    std::vector<const volume::RawChannel*> rawChannels;  // That its code reads, its own first.
    std::optional<UserCode> code;
    std::vector<float> levels;  // Of an isosurface.
    std::vector<shading::Constant> constants;
};

/// Rows of a picture, from `first` to before `end`.
struct Rows {
    int first = 0, end = 0;
};

/// One call of render(), from validation to pixels.
struct Frame {
    View* view = nullptr;
    const Scene* scene = nullptr;
    PictureSize size{0};
    const plan::FramePlan* plan = nullptr;
    std::vector<LayerDraw> draws;
    std::map<std::string, std::uint64_t> generations;
    Picture* picture = nullptr;
    DepthRange depths;
    std::uint64_t cameraVersion = 0;
    bool countsSteps = false;
    double partMs = 0.0;  ///< As FrameTarget::partMs.
};

inline bool isProjected(const LayerDraw& draw) {
    return draw.plan->evaluator == plan::Evaluator::kMeshProjection ||
           draw.plan->evaluator == plan::Evaluator::kMeshProjectionFaces;
}

/// Rows of it can be drawn by themselves.
inline bool goesByRows(const LayerDraw& draw) {
    return !draw.dataset->summary().isMesh &&
           draw.plan->evaluator != plan::Evaluator::kVolumeSlices &&
           draw.plan->evaluator != plan::Evaluator::kVolumeSliceInstances;
}

inline bool isOpaque(const LayerDraw& draw) {
    return row(draw.layer->model).opaque;
}

}  // namespace volcast::scene
