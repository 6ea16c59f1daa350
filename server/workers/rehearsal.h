#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "server/workers/render_service.h"

namespace volcast::workers {

/// What a spare has drawn before it is needed: with a picture like the last one it has the data on
/// its device, the programs built and the memory touched. Of pictures alike, which differ by
/// camera, maps or size alone, one is enough.
///
/// A spare that dies of it is not asked for the like again, and neither is its successor.
class Rehearsal {
public:
    /// Data is on the device twice meanwhile, and on a CPU device in memory.
    static constexpr std::uint64_t kMostBytes = std::uint64_t{256} << 20;

    /// The spare `pid` has not drawn the like of `request`, and may.
    [[nodiscard]] bool wants(int pid, const RenderRequest& request) const;
    /// The spare `pid` was given `request` as `number`.
    void began(int pid, std::uint64_t number, const RenderRequest& request);
    /// True where `number` is the one under way, which it is no longer.
    bool ended(std::uint64_t number);
    void workerLost(int pid);
    [[nodiscard]] bool underWay() const noexcept { return underWay_.has_value(); }

private:
    struct UnderWay {
        int pid = 0;
        std::uint64_t number = 0;
    };
    std::optional<UnderWay> underWay_;
    int pid_ = 0;        ///< Of the spare that knows `kind_`.
    std::string kind_;   ///< Of the last picture that was rehearsed.
    std::string fatal_;  ///< The kind that a spare died of.
};

}  // namespace volcast::workers
