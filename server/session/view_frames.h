#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/session/frame_flow.h"
#include "server/workers/render_service.h"
#include "volcast/v1/frame.pb.h"

namespace volcast::session {

/// The newest state of a view, as it is to be drawn.
struct DrawState {
    scene::Scene scene;
    scene::PictureSize size{0};
    std::uint64_t inputSeq = 0;
    std::uint64_t dataVersion = 0;
    TimePoint inputAt{};   ///< When its newest input came.
    bool refines = false;  ///< The same once more, because the last picture was not ready.
};

/// One picture to compress; the header is complete but for the times of encoding and queueing.
struct EncodeTask {
    std::uint64_t number = 0;  ///< Comes back with the result.
    std::shared_ptr<const workers::Picture> picture;
    v1::FrameHeader header;
};

/// A compressed picture; `bytes` is empty where `error` says why it could not be compressed.
struct EncodedPicture {
    std::uint64_t task = 0;
    v1::FrameHeader header;
    std::vector<std::byte> bytes;
    TimePoint at{};
    std::optional<Error> error = {};
};

/// Compresses `task`'s picture as its header says; blocks.
EncodedPicture encode(const EncodeTask& task);

/// A frame on its way to the socket.
struct ReadyFrame {
    std::uint32_t sequence = 0;
    v1::FrameHeader header;
    std::vector<std::byte> payload;
};

/// The way of one view's pictures: input -> render -> encode -> send, each a slot for one, where
/// the newest replaces what waits. Nothing is dropped once it is encoded, but a lossless picture
/// that a newer input overtook.
///
/// Rendering starts only when the client has a credit (FrameFlow). While inputs come, frames are
/// JPEG; a view left alone for max(150 ms, 1.5 round trips) gets the same picture losslessly. A
/// picture that is not ready is asked for again, as long as no newer state is, and only the one
/// that is becomes final.
class ViewFrames {
public:
    static constexpr std::chrono::milliseconds kIdle{150};

    struct Codecs {
        bool jpeg = true;
        bool png = true;
    };
    explicit ViewFrames(Codecs codecs) : codecs_{codecs} {}

    /// New state to draw; replaces one that waits.
    void want(DrawState state);
    /// The client did something: a lossless picture waits for calm from now on.
    void input(TimePoint now);

    /// What to give to the render service now, if anything. `tag` is unique in this view.
    std::optional<DrawState> takeDraw(TimePoint now, std::uint64_t& tag);
    /// What to compress now, if anything.
    std::optional<EncodeTask> takeEncode(TimePoint now);
    /// The frame to send now, if any; it counts as under way from then on.
    std::optional<ReadyFrame> takeFrame(TimePoint now);

    /// False for a picture that nobody asked for.
    bool rendered(const workers::RenderedFrame& frame);
    /// True where the failed request was the newest.
    bool failed(std::uint64_t tag);
    /// Returns the error where compressing failed.
    std::optional<Error> encoded(EncodedPicture picture);
    void acked(const FrameAck& ack, TimePoint now) { flow_.acked(ack, now); }
    void tick(TimePoint now);

    /// When tick() and the take functions should be called again though nothing happened.
    [[nodiscard]] std::optional<TimePoint> deadline(TimePoint now) const;
    [[nodiscard]] const FrameFlow& flow() const noexcept { return flow_; }
    /// Input that the newest picture shows; 0 before the first.
    [[nodiscard]] std::uint64_t shownSeq() const {
        return picture_ ? picture_->header.input_seq() : shown_ ? shown_->header.input_seq() : 0;
    }
    [[nodiscard]] std::uint32_t framesSent() const noexcept { return sequence_; }

private:
    /// What was asked of the render service.
    struct Asked {
        std::uint64_t tag = 0, inputSeq = 0, dataVersion = 0;
        TimePoint inputAt{}, at{};
    };
    struct Shown {
        std::shared_ptr<const workers::Picture> picture;
        v1::FrameHeader header;
    };
    [[nodiscard]] std::size_t committed() const;
    [[nodiscard]] bool credit(TimePoint now) const { return committed() < flow_.window(now); }
    /// The picture on the client's screen is the newest state, but not yet exact.
    [[nodiscard]] bool owesLossless() const;
    [[nodiscard]] TimePoint calmAt() const;
    [[nodiscard]] v1::FrameHeader headerOf(const workers::RenderedFrame& frame,
                                           const Asked& asked) const;

    Codecs codecs_;
    FrameFlow flow_;
    TimePoint lastInput_{};
    std::optional<DrawState> wanted_;  ///< Slot: input -> render.
    std::optional<DrawState> newest_;  ///< What the newest of asked_ is to show.
    std::deque<Asked> asked_;          ///< The newest last; older ones may still be drawn.
    bool drawing_ = false;             ///< The newest of asked_ has not come back.
    std::uint64_t lastTag_ = 0;
    std::optional<Shown> picture_;  ///< Slot: render -> encode.
    std::optional<Shown> shown_;    ///< What was encoded last, kept for the lossless form.
    bool exact_ = false;            ///< shown_ was encoded losslessly.
    std::optional<std::uint64_t> encoding_;
    bool encodingExact_ = false;  ///< What is being encoded is an idle picture: inputs cancel it.
    std::uint64_t lastTask_ = 0;
    std::optional<EncodedPicture> encoded_;  ///< Slot: encode -> send.
    std::uint32_t sequence_ = 0;
};

}  // namespace volcast::session
