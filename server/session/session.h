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
#include "server/session/shared_view.h"
#include "server/session/views.h"
#include "server/session/wire.h"

namespace volcast::session {

/// One WebSocket message to send: `head`, then `payload`.
struct Outgoing {
    bool text = false;
    std::vector<std::byte> head;
    std::shared_ptr<const std::vector<std::byte>> payload = {};  ///< Null: nothing.
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
    /// A ping was answered after so long.
    void ponged(std::chrono::microseconds roundTrip, TimePoint now) { path_.see(roundTrip, now); }
    void tick(TimePoint now);
    [[nodiscard]] std::optional<TimePoint> deadline(TimePoint now) const;
    /// Set when the connection is to be closed.
    [[nodiscard]] const std::optional<Closing>& closing() const noexcept { return closing_; }
    /// Ends the session from the server's side.
    void end(Closing closing);

private:
    /// This client in a view.
    struct Seat {
        std::shared_ptr<SharedView> view;
        ViewerId viewer = 0;
    };

    Session(Shared& shared, std::uint64_t number, SessionHooks hooks);
    void start();
    void hello(const v1::Hello& message);
    /// False where the connection ends.
    bool identify(const v1::Hello& message);
    /// Where a token is asked for: what it allows; the client is told where it is none.
    void takeAccess(const std::string& token);
    void welcome();
    void comeBack(const std::map<std::uint32_t, std::string>& views);
    void openDataset(const v1::OpenDataset& message);
    void drawDatasetThumbnail(const v1::DrawDatasetThumbnail& message);
    void openView(const v1::OpenView& message, TimePoint now);
    void joinView(const v1::OpenView& message, scene::PictureSize size, TimePoint now);
    void takeSeat(std::uint32_t number, std::shared_ptr<SharedView> view, ViewerId viewer);
    [[nodiscard]] Viewer::Desc viewerDesc(std::uint32_t number, scene::PictureSize size);
    void updateView(const v1::Update& message, TimePoint now);
    void closeView(std::uint32_t number);
    void ack(const v1::Ack& message, TimePoint now);

    // session_pacing.cpp
    static std::vector<v1::Codec> codecsHere();
    /// Errors: kUnsupported where nothing that every server sends is among them.
    Result<void> takeCodecs(const v1::Hello& message);
    std::optional<Outgoing> nextPatch();
    void patchDecoded(const v1::PatchDecoded& message);
    void setPins(const v1::SetPins& message, TimePoint now);
    void shareView(const v1::ShareView& message);
    void takeControl(const v1::TakeControl& message);
    void handOver(const v1::HandOver& message);
    void askControl(const v1::AskControl& message);
    void setName(const v1::SetName& message);
    /// False where the name is too long, which the client is told with `field`.
    bool checkName(const std::string& name, const char* field);
    void undo(const v1::Undo& message, TimePoint now);

    void explain(const v1::Explain& message);
    void measureAccuracy(const v1::MeasureAccuracy& message);
    void measureDifference(const v1::MeasureDifference& message);
    void drawThumbnail(const v1::DrawThumbnail& message);
    void pick(const v1::Pick& message);
    void describeShader(const v1::DescribeShader& message);
    void injectFault(const v1::InjectFault& message);
    [[nodiscard]] std::optional<Error> whyNotInjecting(const Seat& seat) const;

    void datasetChanged(const v1::DatasetInfo& info);
    void send(const v1::ServerMessage& message);
    /// Null where the view is not open, which the client is told.
    const Seat* findOrRefuse(std::uint32_t number, std::uint64_t inputSeq);
    template <class Act>
    auto onStrand(Act act);  // on_strand.h

    Shared& shared_;
    const std::uint64_t number_;
    SessionHooks hooks_;
    TimePoint created_ = Clock::now();
    std::uint64_t subscription_ = 0;
    bool greeted_ = false;
    bool answered_ = false;         ///< Something came behind the hello.
    PersonBook::Arrival who_;       ///< Once greeted.
    bool mayChangeServer_ = false;  ///< Brought a token of ROLE_CONTROL, or none is asked for.
    bool mayUpload_ = false;
    bool resumed_ = false;
    Form form_ = Form::kBinary;
    ClientCodecs codecs_;
    std::vector<v1::Codec> untried_;       ///< The client has not answered their colour patches.
    std::deque<v1::Codec> patches_;        ///< Not sent yet.
    std::map<std::uint32_t, Seat> seats_;  ///< By the client's numbers.
    std::uint32_t lastServed_ = 0;         ///< View whose frame was sent last; views take turns.
    std::deque<v1::ServerMessage> waiting_;
    std::optional<Closing> closing_;
    MessageRate rate_;
    static constexpr std::chrono::milliseconds kPathWindow{30'000};
    Windowed<std::chrono::microseconds, std::less<>> path_{kPathWindow};  ///< Of pings.
};

}  // namespace volcast::session
