#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "volcast/v1/session.pb.h"

namespace volcast::load {

/// What a scripted client does.
enum class Kind { kOrbit, kMap, kModel, kJoin, kIdle, kSlow, kShaped };

inline constexpr std::array kKinds{Kind::kOrbit, Kind::kMap,  Kind::kModel, Kind::kJoin,
                                   Kind::kIdle,  Kind::kSlow, Kind::kShaped};

/// As the command line spells it, such as "orbit".
const char* name(Kind kind) noexcept;
std::optional<Kind> kindFrom(const std::string& name);
/// True where it sends updates all the time.
bool moves(Kind kind) noexcept;

/// Makes the inputs of one client from the scene that its view was opened with.
class Script {
public:
    /// `models`: what the view's data can be drawn as.
    Script(Kind kind, v1::Scene scene, std::vector<v1::RayModel> models)
        : kind_{kind}, scene_{std::move(scene)}, models_{std::move(models)} {}

    /// Fills in the next state: a camera, or a whole scene. Not of a kind that does not move.
    void next(v1::Update& update);

private:
    [[nodiscard]] v1::Camera turned() const;
    [[nodiscard]] v1::Scene withMap() const;
    [[nodiscard]] v1::Scene withModel() const;

    Kind kind_;
    v1::Scene scene_;
    std::vector<v1::RayModel> models_;
    std::uint64_t step_ = 0;
};

}  // namespace volcast::load
