#include "server/session/thumbnails.h"

#include <algorithm>

#include <spdlog/spdlog.h>

#include "renderer/base/printable.h"
#include "renderer/scene/default_scene.h"
#include "server/video/encoder.h"

namespace volcast::session {

namespace {

constexpr int kQuality = 85;
/// Of a volume that is loaded piece by piece the first pictures are coarse.
constexpr int kMostTries = 32;

}  // namespace

Thumbnails::Thumbnails(workers::RenderService& render, Catalogue& catalogue, ViewRouter& router,
                       EncodePool& encoders)
    : render_{render},
      catalogue_{catalogue},
      router_{router},
      encoders_{encoders},
      view_{router.reserve()} {
    router_.add(view_,
                {.rendered = [this](const workers::RenderedFrame& frame) { rendered(frame); },
                 .failed = [this](std::uint64_t tag, const Error& error) { failed(tag, error); }});
}

void Thumbnails::stop() {
    {
        const std::lock_guard lock{mutex_};
        if (std::exchange(stopped_, true)) return;
        waiting_.clear();
        current_.reset();
        hold_ = {};
    }
    router_.remove(view_);
    render_.dropView(view_);
}

void Thumbnails::draw(const std::string& dataset) {
    std::optional<workers::RenderRequest> first;
    {
        const std::lock_guard lock{mutex_};
        const bool known = std::ranges::find(waiting_, dataset) != waiting_.end() ||
                           (current_ && current_->first == dataset);
        if (stopped_ || known || catalogue_.hasThumbnail(dataset)) return;
        waiting_.push_back(dataset);
        first = next();
    }
    submit(std::move(first));
}

std::optional<workers::RenderRequest> Thumbnails::next() {
    while (!current_ && !waiting_.empty() && !stopped_) {
        const std::string id = std::move(waiting_.front());
        waiting_.pop_front();
        hold_ = catalogue_.hold({id});
        const DatasetStanding standing = catalogue_.standing(id);
        const Version version{id, standing.version};
        if (!standing.loaded || failed_.contains(version)) continue;
        current_ = version;
        tries_ = 0;
        return request();
    }
    if (!current_) hold_ = {};
    return std::nullopt;
}

workers::RenderRequest Thumbnails::request() {
    const auto summaries = catalogue_.summaries({current_->first});
    workers::RenderRequest request;
    request.view = view_;
    request.tag = ++tag_;
    request.scene = scene::defaultScene(current_->first, summaries.at(current_->first));
    request.size = kSize;
    request.background = request.patient = true;
    ++tries_;
    return request;
}

void Thumbnails::submit(std::optional<workers::RenderRequest> request) {
    if (request) render_.submit(*std::move(request));
}

void Thumbnails::rendered(const workers::RenderedFrame& frame) {
    std::optional<workers::RenderRequest> again;
    {
        const std::lock_guard lock{mutex_};
        if (!current_ || frame.tag != tag_ || !frame.picture) return;
        if (!frame.ready && tries_ < kMostTries) again = request();
    }
    if (again) return submit(std::move(again));
    encoders_.run([this, picture = frame.picture, tag = frame.tag] {
        auto jpeg = video::encodeJpeg({picture->size, picture->rgba8}, kQuality);
        std::optional<workers::RenderRequest> following;
        {
            const std::lock_guard lock{mutex_};
            if (!current_ || tag != tag_) return;
            if (jpeg) {
                const auto* bytes = reinterpret_cast<const char*>(jpeg->data());
                catalogue_.setThumbnail(current_->first, current_->second, {bytes, jpeg->size()});
            }
            current_.reset();
            following = next();
        }
        submit(std::move(following));
    });
}

void Thumbnails::failed(std::uint64_t tag, const Error& error) {
    std::optional<workers::RenderRequest> following;
    {
        const std::lock_guard lock{mutex_};
        if (!current_ || tag != tag_) return;
        spdlog::warn(R"(event=thumbnail_failed dataset="{}" error="{}")",
                     base::printable(current_->first), base::printable(error.message, 1000));
        failed_.insert(*current_);
        current_.reset();
        following = next();
    }
    submit(std::move(following));
}

}  // namespace volcast::session
