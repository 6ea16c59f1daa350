#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "server/session/message_rate.h"
#include "server/session/shared.h"
#include "server/session/view_accuracy.h"
#include "server/session/view_frames.h"
#include "server/session/view_scene.h"
#include "server/session/wire.h"

namespace volcast::session {

/// One WebSocket message to send: `head`, then `payload`.
struct Outgoing {
    bool text = false;
    std::vector<std::byte> head;
    std::vector<std::byte> payload;
};

/// How a connection is to be closed, once all that waits has been sent.
struct Closing {
    std::uint16_t code = 1000;  ///< RFC 6455, section 7.4.
    std::string reason;
};

/// What a session needs of whoever owns its connection.
struct SessionHooks {
    /// Runs something on the connection's strand, later. Called from any thread.
    std::function<void(std::function<void()>)> post;
    /// There may be something to send, or another deadline. Called on the strand.
    std::function<void()> wake;
};

/// One client: its messages in, replies and frames out. Knows no socket: the connection feeds
/// receive() and tick() and drains next().
///
/// All methods on the connection's strand.
class Session : public std::enable_shared_from_this<Session> {
public:
    static constexpr std::chrono::seconds kHelloWithin{30};

    static std::shared_ptr<Session> create(Shared& shared, std::uint64_t number,
                                           SessionHooks hooks);
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;
    Session(Session&&) = delete;
    Session& operator=(Session&&) = delete;
    ~Session();

    void receive(std::span<const std::byte> message, Form form, TimePoint now);
    /// The next message to send; control messages before frames.
    std::optional<Outgoing> next(TimePoint now);
    void tick(TimePoint now);
    [[nodiscard]] std::optional<TimePoint> deadline(TimePoint now) const;
    /// Set when the connection is to be closed.
    [[nodiscard]] const std::optional<Closing>& closing() const noexcept { return closing_; }
    /// Ends the session from the server's side.
    void end(Closing closing);

private:
    static constexpr std::size_t kDrawnKept = 8;
    /// What a picture was drawn of.
    struct Drawn {
        std::uint64_t inputSeq = 0;
        scene::Scene scene;
        scene::PictureSize size{0};
    };
    struct View {
        std::uint32_t number = 0;
        std::uint64_t global = 0;  ///< Its number in the whole server.
        ViewScene scene;
        ViewFrames frames;
        ViewAccuracy accuracy = {};
        std::optional<v1::Plan> plan = {};  ///< Of the newest picture.
        v1::ViewState state = v1::VIEW_STATE_ACTIVE;
        bool opened = false;  ///< The client was told the scene.
        TimePoint inputAt{};
        std::deque<Drawn> drawn = {};  ///< Newest last; pixels are picked of these.
        v1::Pick picking = {};         ///< The newest that was asked for.
        std::uint64_t pickTag = 0;     ///< Of it.
    };

    Session(Shared& shared, std::uint64_t number, SessionHooks hooks);
    void start();
    void hello(const v1::Hello& message);
    void welcome();
    void openDataset(const v1::OpenDataset& message);
    void openView(const v1::OpenView& message, TimePoint now);
    void updateView(const v1::Update& message, TimePoint now);
    void closeView(std::uint32_t number);
    void ack(const v1::Ack& message, TimePoint now);

    void explain(const v1::Explain& message);
    void measureAccuracy(const v1::MeasureAccuracy& message);
    void pick(const v1::Pick& message);
    void describeShader(const v1::DescribeShader& message);

    void datasetChanged(const v1::DatasetInfo& info);
    // News come with the view's number in the whole server: its own may be in use again.
    void rendered(const workers::RenderedFrame& frame);
    void failed(std::uint64_t global, std::uint64_t tag, const Error& error);
    void measured(std::uint64_t global, std::uint64_t tag,
                  const Result<accuracy::Measurement>& result);
    void picked(std::uint64_t global, std::uint64_t tag,
                const Result<std::optional<scene::Picked>>& result);
    void recovering(std::uint64_t global);
    void encoded(std::uint64_t global, EncodedPicture picture);

    void apply(View& view, SceneChange change);
    void refuse(View& view, const Error& error, v1::ErrorCode code);
    void setState(View& view, v1::ViewState state, const std::string& text);
    void advance(View& view, TimePoint now);
    static void remember(View& view, const DrawState& state);
    void measureNext(View& view);
    void stopMeasuring(View& view, const std::string& why);
    void startEncode(View& view, EncodeTask task);
    void send(const v1::ServerMessage& message);
    View* find(std::uint32_t number);
    View* findGlobal(std::uint64_t global);
    View* findOrRefuse(std::uint32_t number, std::uint64_t inputSeq);
    template <class Act>
    auto onStrand(Act act);  // on_strand.h

    Shared& shared_;
    const std::uint64_t number_;
    SessionHooks hooks_;
    TimePoint created_ = Clock::now();
    std::uint64_t subscription_ = 0;
    bool greeted_ = false;
    Form form_ = Form::kBinary;
    ViewFrames::Codecs codecs_;
    std::map<std::uint32_t, std::unique_ptr<View>> views_;
    std::uint32_t lastServed_ = 0;  ///< View whose frame was sent last; views take turns.
    std::deque<v1::ServerMessage> waiting_;
    std::optional<Closing> closing_;
    MessageRate rate_;
};

}  // namespace volcast::session
