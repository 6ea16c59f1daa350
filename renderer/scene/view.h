#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "renderer/mesh/projection.h"
#include "renderer/mesh/walk.h"
#include "renderer/scene/channel_table.h"
#include "renderer/scene/map_table.h"
#include "renderer/scene/picture.h"
#include "renderer/scene/user_table.h"
#include "renderer/scene/view_blocks.h"
#include "renderer/volume/bricked_layer.h"
#include "renderer/volume/empty_space.h"
#include "renderer/volume/slices.h"

namespace volcast::scene {

/// What a view keeps on the GPU for one layer.
struct LayerState {
    MapTable map;
    ChannelTable channels;  ///< Of several channels of a volume.
    UserTable controls;
    std::unique_ptr<mesh::WalkState> walk = mesh::WalkState::create();
    volume::SlicesState slices;
    std::unique_ptr<mesh::ProjectionState> projection = mesh::ProjectionState::create();
    bool projected = false;        ///< `projection` is in use, `walk` is empty.
    std::uint64_t generation = 0;  ///< Of the dataset that both belong to.
    volume::EmptySpace emptySpace;
    volume::BrickedLayer bricks;
    std::optional<volume::BrickReport> brickReport;  ///< Where it was last drawn from bricks.
};

/// All that decides where a picture's rays run.
struct Rays {
    Camera camera;
    PictureSize size{0};
    DepthRange depths;
    friend bool operator==(const Rays&, const Rays&) = default;
};

/// How far a picture is that is drawn in parts, and of what it is.
struct Progress {
    Scene scene;
    PictureSize size{0};
    std::string plan;  ///< Its id.
    std::map<std::string, std::uint64_t> generations;
    std::size_t layer = 0;  ///< In the order of drawing; those before are drawn.
    int row = 0;            ///< Of that layer; those above are drawn.
    double uploadMs = 0.0, drawMs = 0.0;
    [[nodiscard]] bool begins() const noexcept { return layer == 0 && row == 0; }
};

/// What the renderer remembers of a view between its pictures.
struct View {
    Scene scene;  ///< As last drawn.
    std::unique_ptr<Picture> picture;
    std::map<std::string, std::uint64_t> generations;  ///< Of the datasets last drawn.
    std::map<std::string, LayerState> layers;          ///< By layer id.
    ViewBlocks blocks;
    Rays rays;
    std::uint64_t cameraVersion = 0;   ///< Grows whenever `rays` changes.
    bool ready = true;                 ///< Its picture shows all bricks that it needs.
    std::optional<Progress> progress;  ///< Of a picture that is not finished.
    bool stale = true;  ///< The 32F layers are not those of `scene`; the resolved picture is.
};

}  // namespace volcast::scene
