#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "server/session/frame_flow.h"
#include "server/session/video_group.h"
#include "server/video/encoder.h"
#include "server/workers/render_service.h"
#include "volcast/v1/frame.pb.h"

namespace volcast::session {

/// What pictures of one view may differ in; viewers that want the same share them.
struct RenditionKey {
    scene::PictureSize size{512, 512};
    bool fullAccuracy = true;  ///< As Scene.accuracy asks; else as fast as can be.
    friend bool operator==(const RenditionKey&, const RenditionKey&) = default;
};

/// The newest state of a view, as it is to be drawn.
struct DrawState {
    std::shared_ptr<const scene::Scene> scene;
    std::uint64_t inputSeq = 0;
    std::uint64_t dataVersion = 0;
    TimePoint inputAt{};  ///< When its newest input came.
};

/// A drawn picture; its header is complete but for what depends on codec and viewer.
struct ViewPicture {
    std::uint64_t number = 0;  ///< Unique in its view, growing.
    RenditionKey key;          ///< It was drawn for.
    std::shared_ptr<const workers::Picture> pixels;
    std::shared_ptr<const scene::Scene> scene;
    v1::FrameHeader header;
};

/// One picture in one format, made once for all viewers that want it.
struct Encoding {
    std::shared_ptr<const ViewPicture> picture;
    Format format;
    std::shared_ptr<VideoGroup> group = {};  ///< Of a video picture.
    std::uint64_t after = 0;                 ///< The picture of the group before this one.
    bool keyframe = false;                   ///< Asked for, and when done: what it is.
    bool begun = false;
    bool done = false;
    // Below: set when done, and constant from then on.
    std::shared_ptr<const std::vector<std::byte>> bytes = {};  ///< Null where `error` says why.
    std::optional<Error> error = {};
    std::uint32_t pixelHash = 0;  ///< Of a lossless picture: XXH32.
    double encodeMs = 0;
    TimePoint at{};
};

/// One size and accuracy of a view: what is to be drawn, what is being drawn, and the newest
/// picture with its encodings. Newer states replace older ones that wait.
///
/// A picture that is not ready is asked for again, as long as no newer state is.
class Rendition {
public:
    explicit Rendition(RenditionKey key) : key_{key} {}

    [[nodiscard]] const RenditionKey& key() const noexcept { return key_; }
    /// Its viewers want another size: pictures of the old one still come, then those of the new.
    void change(RenditionKey key);

    /// There is something new to draw.
    void want();
    [[nodiscard]] bool wants() const noexcept { return wanted_ && asked_.size() < kMaxAsked; }
    [[nodiscard]] bool drawing() const noexcept { return drawing_; }
    /// The newest picture shows the newest state.
    [[nodiscard]] bool settled() const noexcept { return picture_ && !wanted_ && !drawing_; }

    /// `state` is given to the render service as `tag`, which grows.
    void asked(std::uint64_t tag, const DrawState& state, TimePoint now);
    /// Takes a picture as the newest, to be number `number`; false where nobody asked for it.
    bool rendered(const workers::RenderedFrame& frame, std::uint64_t number);
    /// False for an unknown tag; `newest` is set where nothing newer was asked for.
    bool failed(std::uint64_t tag, bool& newest);

    [[nodiscard]] const std::shared_ptr<const ViewPicture>& picture() const noexcept {
        return picture_;
    }
    /// The newest picture in `format`; made when first asked for.
    std::shared_ptr<Encoding> encoding(const Format& format);

    /// What a viewer keeps of the video that it is sent.
    struct InVideo {
        std::shared_ptr<VideoGroup> group = {};
        std::uint64_t last = 0;  ///< Number of the picture it was sent last.
        bool alone = false;      ///< It could not keep step: its group is its own.
    };
    /// The newest picture as the next of a video in `format`. Viewers that were sent the same
    /// pictures share it; who comes new joins them at a keyframe; who missed a picture gets a group
    /// of its own, so that it costs the others nothing.
    std::shared_ptr<Encoding> videoEncoding(const Format& format, InVideo& viewer);

private:
    /// Requests whose answer may still come. When so many were overtaken while one is drawn, newer
    /// states wait here instead: forgetting the one that is drawn would throw its picture away.
    static constexpr std::size_t kMaxAsked = 256;

    struct Asked {
        std::uint64_t tag = 0;
        DrawState state;
        RenditionKey key;
        TimePoint at{};
    };
    static v1::FrameHeader headerOf(const workers::RenderedFrame& frame, const Asked& asked);

    RenditionKey key_;
    bool wanted_ = true;
    bool refines_ = false;     ///< What is wanted is the same once more: nobody waits for it.
    bool drawing_ = false;     ///< The newest of asked_ has not come back.
    std::deque<Asked> asked_;  ///< The newest last; older ones may still be drawn.
    std::shared_ptr<const ViewPicture> picture_;
    std::vector<std::shared_ptr<Encoding>> encodings_;  ///< Of picture_.
    std::vector<std::weak_ptr<VideoGroup>> groups_;     ///< That new viewers may join.
};

/// Compresses a picture alone, as JPEG, PNG or WebP; blocks. Errors: as video::encodeJpeg.
Result<std::vector<std::byte>> compress(const video::ImageView& image, const Format& format);

/// Compresses `encoding`'s picture as its format says and returns the encoding done; blocks.
/// Reads only what is constant in `encoding`.
Encoding encode(const Encoding& encoding);

}  // namespace volcast::session
