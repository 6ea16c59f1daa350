// Small pictures of other scenes, such as what another ray model would show; by turns of viewers,
// each when no view waits for a picture.
#include <utility>

#include "renderer/scene/user_controls.h"
#include "server/session/shared_view.h"

namespace volcast::session {

namespace {

constexpr int kMostThumbnailSide = 256;
constexpr int kThumbnailQuality = 90;

Result<int> sideFrom(std::uint32_t pixels, const char* name) {
    if (pixels >= 1 && pixels <= kMostThumbnailSide) return static_cast<int>(pixels);
    return fail(pixels == 0 ? ErrorCode::kInvalidArgument : ErrorCode::kLimitExceeded,
                std::string{"a thumbnail's "} + name + " of " + std::to_string(pixels) +
                    " pixels; 1 to " + std::to_string(kMostThumbnailSide) + " are drawn",
                std::string{"draw_thumbnail."} + name);
}

v1::Codec codecFor(const ClientCodecs& codecs) {
    if (codecs.jpeg) return v1::CODEC_JPEG;
    return codecs.png ? v1::CODEC_PNG : v1::CODEC_WEBP;
}

}  // namespace

Result<void> SharedView::drawThumbnail(ViewerId id, const v1::DrawThumbnail& message) {
    const auto width = sideFrom(message.width(), "width");
    if (!width) return width.error();
    const auto height = sideFrom(message.height(), "height");
    if (!height) return height.error();
    if (message.scene().layers().empty()) {
        return fail(ErrorCode::kInvalidArgument, "a thumbnail needs a scene with a layer",
                    "draw_thumbnail.scene");
    }
    auto scene = readyScene(message.scene(), parts_.catalogue);
    if (!scene) {
        Error error = std::move(scene).error();
        error.field = "draw_thumbnail.scene" + (error.field.empty() ? "" : "." + error.field);
        return error;
    }
    for (std::size_t i = 0; i < scene->layers.size(); ++i) {
        if (!scene::runsUserCode(scene->layers[i])) continue;
        return fail(ErrorCode::kUnsupported, "thumbnails run no code",
                    "draw_thumbnail.scene.layers[" + std::to_string(i) + "].shader");
    }
    const Turn turn{*this};
    if (ended_ || find(id) == nullptr) {
        return fail(ErrorCode::kNotFound, "the view is not open", "view");
    }
    thumbnails_[id] = {
        .request = message.request(), .scene = *std::move(scene), .size = {*width, *height}};
    if (thumbnailOf_ == 0 || thumbnailOf_ == id) askThumbnail(id);
    return boost::system::in_place_value;
}

/// Viewers take turns.
void SharedView::thumbnailNext() {
    auto next = thumbnails_.upper_bound(thumbnailOf_);
    if (next == thumbnails_.end()) next = thumbnails_.begin();
    thumbnailOf_ = 0;
    if (next != thumbnails_.end()) askThumbnail(next->first);
}

void SharedView::askThumbnail(ViewerId id) {
    thumbnailOf_ = id;
    if (thumbnailView_ == 0) {
        thumbnailView_ = parts_.router.reserve();
        const auto weak = weak_from_this();
        parts_.router.add(thumbnailView_, {.rendered =
                                               [weak](const workers::RenderedFrame& frame) {
                                                   if (const auto self = weak.lock())
                                                       self->thumbnailDrawn(frame);
                                               },
                                           .failed =
                                               [weak](std::uint64_t tag, const Error& error) {
                                                   if (const auto self = weak.lock()) {
                                                       self->thumbnailFailed(tag, error);
                                                   }
                                               }});
    }
    const Sketch& sketch = thumbnails_.at(id);
    workers::RenderRequest request{.view = thumbnailView_,
                                   .tag = ++thumbnailTag_,
                                   .scene = sketch.scene,
                                   .size = sketch.size,
                                   .viewId = id_,
                                   .background = true,
                                   .patient = true};
    outbox_.put([&render = parts_.render, request = std::move(request)]() mutable {
        render.submit(std::move(request));
    });
}

void SharedView::thumbnailDrawn(const workers::RenderedFrame& frame) {
    const Turn turn{*this};
    if (thumbnailOf_ == 0 || frame.tag != thumbnailTag_ || !frame.picture) return;
    const v1::Codec codec = codecFor(find(thumbnailOf_)->codecs());
    outbox_.put([weak = weak_from_this(), &encoders = parts_.encoders, tag = frame.tag,
                 picture = frame.picture, codec] {
        encoders.run([weak, tag, picture, codec] {
            const auto bytes = compress({.size = picture->size, .rgba = picture->rgba8},
                                        {.codec = codec, .quality = kThumbnailQuality});
            if (const auto self = weak.lock()) self->thumbnailEncoded(tag, codec, bytes);
        });
    });
}

void SharedView::thumbnailEncoded(std::uint64_t tag, v1::Codec codec,
                                  const Result<std::vector<std::byte>>& bytes) {
    const Turn turn{*this};
    if (thumbnailOf_ == 0 || tag != thumbnailTag_) return;
    v1::Thumbnail answer;
    answer.set_codec(codec);
    if (bytes) answer.set_picture(bytes->data(), bytes->size());
    if (!bytes) answer.set_refusal(bytes.error().message);
    tellThumbnail(std::move(answer));
}

void SharedView::thumbnailFailed(std::uint64_t tag, const Error& error) {
    const Turn turn{*this};
    if (thumbnailOf_ == 0 || tag != thumbnailTag_) return;
    v1::Thumbnail answer;
    answer.set_refusal(error.message);
    tellThumbnail(std::move(answer));
}

void SharedView::tellThumbnail(v1::Thumbnail answer) {
    Viewer& viewer = *find(thumbnailOf_);  // A thumbnail goes with its viewer.
    answer.set_view(viewer.number());
    answer.set_request(thumbnails_.at(thumbnailOf_).request);
    thumbnails_.erase(thumbnailOf_);
    v1::ServerMessage message;
    *message.mutable_thumbnail() = std::move(answer);
    tell(viewer, std::move(message));
    thumbnailNext();
}

void SharedView::forgetThumbnails(ViewerId id) {
    thumbnails_.erase(id);
    if (thumbnailOf_ == id) thumbnailNext();
}

void SharedView::dropThumbnails() {
    if (thumbnailView_ == 0) return;
    parts_.router.remove(thumbnailView_);
    outbox_.put([&render = parts_.render, view = std::exchange(thumbnailView_, 0)] {
        render.dropView(view);
    });
}

}  // namespace volcast::session
