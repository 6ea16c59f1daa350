#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "server/session/client_codecs.h"
#include "server/session/draw_pace.h"
#include "server/session/mail.h"
#include "server/session/pacing.h"
#include "server/session/rendition.h"
#include "volcast/v1/session.pb.h"

namespace volcast::session {

/// A frame on its way to the socket; the bytes are shared with other viewers.
struct ReadyFrame {
    std::uint32_t sequence = 0;
    v1::FrameHeader header;
    std::shared_ptr<const std::vector<std::byte>> payload;
};

/// One client's window on a view: what it wants to see, what it has been sent, and how much it may
/// be sent. It takes pictures from its rendition, the newest when it has a credit (Pacing), so that
/// a slow one skips pictures and holds up nobody.
///
/// While inputs come, pictures are as Pacing decides: JPEG or video, smaller or less accurate where
/// the connection is slow. A view left alone is drawn in full and sent losslessly, after
/// max(150 ms, 1.5 round trips), or as long as that picture needs on its way where that is longer:
/// an input that comes meanwhile would wait for it. Nothing is dropped once it is encoded, but a
/// lossless frame that a newer input overtook.
class Viewer {
public:
    static constexpr std::chrono::milliseconds kIdle{150};
    static constexpr std::chrono::seconds kLongestIdle{10};  ///< However slow the way is.

    struct Desc {
        std::uint32_t number = 0;  ///< The client's own for the view.
        ClientCodecs codecs = {};
        scene::PictureSize size{512, 512};
        /// There is a frame or mail to take, or another deadline; called on any thread.
        std::function<void()> wake = {};
    };
    explicit Viewer(Desc desc);

    [[nodiscard]] std::uint32_t number() const noexcept { return desc_.number; }
    [[nodiscard]] const std::function<void()>& wake() const noexcept { return desc_.wake; }

    // What it wants.
    [[nodiscard]] RenditionKey wanted() const;
    /// `seq`: of the update that asked for it, where that is not the scene's; frames of that size
    /// say so.
    void resize(scene::PictureSize size, std::uint64_t seq) {
        desc_.size = size;
        resizedBy_ = seq;
    }
    [[nodiscard]] std::uint64_t resizedBy() const noexcept { return resizedBy_; }
    void setPins(const PacePins& pins, v1::Codec codec);
    void setCodecs(const ClientCodecs& codecs);
    /// What drawing allows while the view moves, and why; what is pinned stays.
    void limitDrawing(const DrawLevel& limit, std::string why) {
        drawLimit_ = limit;
        whyLimited_ = std::move(why);
    }
    [[nodiscard]] const ClientCodecs& codecs() const noexcept { return desc_.codecs; }
    /// Where it has been left alone for long enough, the picture in full is wanted from now on.
    void rest(TimePoint now);
    [[nodiscard]] bool resting() const noexcept { return resting_; }
    /// From now on it takes pictures from here.
    void moveTo(std::shared_ptr<Rendition> to);
    [[nodiscard]] scene::PictureSize size() const noexcept { return desc_.size; }

    /// The newest picture is of this very scene as wanted, was sent, and nothing is on its way
    /// that is to replace it. Not where it is part of a video, which no picture may enter twice.
    [[nodiscard]] bool shows(const std::shared_ptr<const scene::Scene>& scene) const;
    /// Inputs up to `seq` left the scene as it is: frames of it say so.
    void stays(std::shared_ptr<const scene::Scene> scene, std::uint64_t seq) {
        stays_ = {.scene = std::move(scene), .seq = seq};
    }
    /// The newest picture is to be sent once more, as it was.
    void sendAgain() noexcept { sendsAgain_ = true; }
    /// Somebody did something: a lossless frame waits for calm from now on.
    void input(TimePoint now);
    /// A picture drawn now would soon be sent.
    [[nodiscard]] bool mayDraw(TimePoint now) const;
    /// What is to be compressed for it now, if anything; it waits for that until encoded().
    std::shared_ptr<Encoding> takeEncode(TimePoint now);
    [[nodiscard]] bool waitsFor(const Encoding& encoding) const {
        return encoding_.get() == &encoding;
    }
    /// What it waits for is done; false where that failed and nothing else can be tried. Where a
    /// video failed, takeEncode() gives the same picture in another format.
    bool encoded();
    /// The frame to send now, if any; it counts as under way from then on.
    std::optional<ReadyFrame> takeFrame(TimePoint now);
    void acked(const FrameAck& ack, TimePoint now);
    /// Smoothed; 0 before the first ack.
    [[nodiscard]] std::chrono::microseconds roundTrip() const noexcept {
        return pacing_.flow().roundTrip();
    }
    void tick(TimePoint now);
    /// When tick() and takeEncode() should be called again though nothing happened.
    [[nodiscard]] std::optional<TimePoint> deadline(TimePoint now) const;

    /// What a frame was of; `inputSeq` as its header said.
    struct Sent {
        std::uint64_t inputSeq = 0;
        scene::PictureSize size{0};
        std::shared_ptr<const scene::Scene> scene;
    };
    static constexpr std::size_t kSentKept = 8;
    /// The newest last.
    [[nodiscard]] const std::deque<Sent>& sent() const noexcept { return sent_; }
    [[nodiscard]] std::uint32_t framesSent() const noexcept { return sequence_; }

    std::shared_ptr<Rendition> rendition;         ///< Set by moveTo(); of wanted().
    Mail mail;                                    ///< What it is to be told.
    v1::ViewState state = v1::VIEW_STATE_ACTIVE;  ///< As it was told.
    bool opened = false;                          ///< It was told the scene.

private:
    [[nodiscard]] bool credit(TimePoint now) const {
        return pacing_.credit(encoding_ ? 1 : 0, now);
    }
    [[nodiscard]] RenditionKey full() const { return {.size = desc_.size}; }
    /// A picture is to be drawn or sent for an input.
    [[nodiscard]] bool waits() const;
    /// And what is to come when it is left alone.
    [[nodiscard]] bool owes() const;
    /// It shows less than all.
    [[nodiscard]] bool owesFull() const { return !resting_ && wanted() != full(); }
    [[nodiscard]] bool slowWay() const;
    [[nodiscard]] Format interactive() const;
    [[nodiscard]] bool hasNewPicture() const;
    /// What it shows is the newest state, but not yet exact.
    [[nodiscard]] bool owesLossless() const;
    [[nodiscard]] TimePoint calmAt() const;
    [[nodiscard]] v1::FrameHeader headerOf(const Encoding& encoding, TimePoint now) const;
    [[nodiscard]] v1::Pace paceOf(const Encoding& encoding, TimePoint now) const;

    Desc desc_;
    Pacing pacing_;
    PacePins pins_;
    DrawLevel drawLimit_;
    std::string whyLimited_;
    v1::Codec pinnedCodec_ = v1::CODEC_UNSPECIFIED;
    bool resting_ = false;  ///< The picture is wanted in full.
    Rendition::InVideo video_;
    std::size_t losslessBytes_ = 0;  ///< Of its last lossless frame.
    std::uint64_t resizedBy_ = 0;
    struct {
        std::shared_ptr<const scene::Scene> scene;
        std::uint64_t seq = 0;
    } stays_;
    bool sendsAgain_ = false;
    TimePoint lastInput_{};
    std::uint64_t taken_ = 0;             ///< Number of the picture it took last.
    std::uint64_t shownSeq_ = 0;          ///< Newest input that it was sent a picture of.
    bool exact_ = false;                  ///< And took losslessly.
    bool again_ = false;                  ///< encoding_ is of a picture that it has already.
    std::shared_ptr<Encoding> encoding_;  ///< Being compressed for it, or waiting to be sent.
    std::uint32_t sequence_ = 0;
    std::deque<Sent> sent_;
};

}  // namespace volcast::session
