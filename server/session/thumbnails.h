#pragma once

#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include <glm/glm.hpp>

#include "server/session/catalogue.h"
#include "server/session/encode_pool.h"
#include "server/session/view_router.h"

namespace volcast::session {

/// Small pictures of datasets as they are first shown, for lists of them: drawn when somebody asks,
/// one at a time, once for each version, and handed to the catalogue.
///
/// Any thread. What it is made of must outlive it.
class Thumbnails {
public:
    static constexpr glm::ivec2 kSize{128, 96};

    Thumbnails(workers::RenderService& render, Catalogue& catalogue, ViewRouter& router,
               EncodePool& encoders);
    Thumbnails(const Thumbnails&) = delete;
    Thumbnails& operator=(const Thumbnails&) = delete;
    Thumbnails(Thumbnails&&) = delete;
    Thumbnails& operator=(Thumbnails&&) = delete;
    ~Thumbnails() { stop(); }

    /// Draws one of a loaded dataset, unless it has one, is about to get one, or cannot have one.
    void draw(const std::string& dataset);
    /// Draws no more; to be called before the encoders end.
    void stop();

private:
    using Version = std::pair<std::string, std::uint64_t>;  ///< Dataset and version.

    /// The next request, where none is under way.
    std::optional<workers::RenderRequest> next();
    [[nodiscard]] workers::RenderRequest request();
    void submit(std::optional<workers::RenderRequest> request);
    void rendered(const workers::RenderedFrame& frame);
    void failed(std::uint64_t tag, const Error& error);

    workers::RenderService& render_;
    Catalogue& catalogue_;
    ViewRouter& router_;
    EncodePool& encoders_;
    const std::uint64_t view_;
    std::mutex mutex_;
    std::deque<std::string> waiting_;
    std::optional<Version> current_;
    DatasetHold hold_;          ///< Of the current one.
    std::set<Version> failed_;  ///< A picture that costs workers is not tried twice.
    std::uint64_t tag_ = 0;
    int tries_ = 0;
    bool stopped_ = false;
};

}  // namespace volcast::session
