// Several viewers of one view: what is drawn, what is encoded, who is told what.
#include <atomic>
#include <map>

#include "renderer/worker/scene_message.h"
#include "tests/unit/session/shared_view_fixture.h"

namespace volcast::session {
namespace {

using test::drawn;
using test::SharedViewTest;

TEST_F(SharedViewTest, FiftyWatchersOfOneSizeCostOneDrawAndOneEncodeAFrame) {
    std::vector<ViewerId> viewers;
    for (int i = 0; i < 50; ++i) viewers.push_back(join());
    for (std::uint64_t seq = 2; seq <= 6; ++seq) {
        look(viewers[0], seq);
        drawLast();
        const void* bytes = nullptr;
        for (const ViewerId viewer : viewers) {
            const auto frame = frameOf(viewer);
            ASSERT_TRUE(frame.has_value()) << viewer;
            EXPECT_EQ(frame->header.input_seq(), seq);
            if (bytes == nullptr) bytes = frame->payload.get();
            EXPECT_EQ(frame->payload.get(), bytes);
            ack(viewer, frame->sequence);
        }
    }
    // The first draw was asked for when the first of them came, and overtaken.
    EXPECT_EQ(view->counts().drawsAsked, 6U);
    EXPECT_EQ(view->counts().encodes, 5U);
}

TEST_F(SharedViewTest, AWatcherWhoComesLateGetsThePictureThatIsThere) {
    const ViewerId first = join();
    drawLast();
    ASSERT_TRUE(frameOf(first).has_value());
    const ViewerId late = join();
    const auto frame = frameOf(late);
    ASSERT_TRUE(frame.has_value());
    EXPECT_EQ(frame->sequence, 1U);
    EXPECT_EQ(view->counts().drawsAsked, 1U);
    EXPECT_EQ(view->counts().encodes, 1U);
}

TEST_F(SharedViewTest, OtherSizesAreDrawnForThemselvesOneAtATime) {
    const ViewerId small = join({8, 6}), large = join({16, 12});
    ASSERT_TRUE(render.has(render.requests, 1)) << "one request of a view at a time";
    EXPECT_EQ(render.requests[0].size, glm::ivec2(8, 6));
    drawLast();
    ASSERT_TRUE(render.has(render.requests, 2));
    EXPECT_EQ(render.requests[1].size, glm::ivec2(16, 12));
    // While the large one is drawn, the small one's news wait; then both had their turn.
    look(small, 2);
    EXPECT_EQ(newest().size, glm::ivec2(16, 12));
    drawLast();
    EXPECT_EQ(newest().size, glm::ivec2(8, 6));
    drawLast();
    EXPECT_EQ(frameOf(small)->header.width(), 8U);
    EXPECT_EQ(frameOf(large)->header.width(), 16U);
}

// Inputs that come faster than pictures: whenever one is drawn, a newer one waits already.
TEST_F(SharedViewTest, ADragThatIsDrawnSlowlyLeavesOtherSizesTheirTurns) {
    const ViewerId small = join({8, 6}), large = join({16, 12});
    std::map<int, int> drawnOf;
    workers::RenderRequest inFlight = newest();
    for (std::uint64_t seq = 2; seq < 20; ++seq) {
        // Later than any wait for the highest rate of frames.
        look(small, seq, static_cast<double>(seq), Clock::now() + std::chrono::seconds{1});
        events.rendered(drawn(inFlight));
        ++drawnOf[inFlight.size.x];
        const ViewerId shown = inFlight.size.x == 8 ? small : large;
        const auto frame = frameOf(shown);
        ASSERT_TRUE(frame.has_value());
        // Acked as from far away, so that several pictures may be under way.
        view->acked(shown, {.sequence = frame->sequence},
                    Clock::now() + std::chrono::milliseconds{200});
        inFlight = newest();
    }
    EXPECT_GE(drawnOf[8], 5);
    EXPECT_GE(drawnOf[16], 5);
}

TEST_F(SharedViewTest, APictureAtRestWaitsForOthersAndIsEndedByThem) {
    constexpr scene::PictureSize kFull{640, 480};
    const ViewerId one = join(kFull);
    for (std::uint64_t seq = 2; newest().size == kFull && !newest().hurried; ++seq) {
        ASSERT_LT(seq, 50U) << "slow pictures cost nothing";
        workers::RenderedFrame slow = drawn(newest());
        slow.drawMs = 300;
        events.rendered(slow);
        const auto frame = frameOf(one);
        ASSERT_TRUE(frame.has_value());
        ack(one, frame->sequence);
        look(one, seq, static_cast<double>(seq), Clock::now() + std::chrono::seconds{1});
    }
    EXPECT_FALSE(newest().patient);
    drawLast();
    ack(one, frameOf(one)->sequence);
    view->tick(one, Clock::now() + std::chrono::seconds{5});
    ASSERT_TRUE(newest().patient);
    EXPECT_EQ(newest().size, kFull);
    EXPECT_FALSE(newest().hurried);
    // Another one comes while it is drawn: their first picture does not wait for it.
    const ViewerId other = join({16, 12});
    ASSERT_FALSE(newest().patient);
    EXPECT_LE(newest().size.x, 16);
    drawLast();
    EXPECT_TRUE(frameOf(other).has_value());
    view->tick(one, Clock::now() + std::chrono::seconds{5});
    EXPECT_TRUE(newest().patient) << "it is asked for again";
    EXPECT_EQ(newest().size, kFull);
    look(one, 60);
    EXPECT_FALSE(newest().patient) << "an input does not wait for it either";
}

TEST_F(SharedViewTest, ARefusedSceneIsToldToWhoSentItThoughAnotherSizeFailed) {
    const ViewerId large = join({16, 12});
    drawLast();
    const ViewerId author = join({8, 6});
    view->takeControl(author);
    drawLast();
    for (const ViewerId viewer : {large, author}) {
        ASSERT_TRUE(frameOf(viewer).has_value());
        while (view->takeMail(viewer)) {
        }
    }
    v1::Update update;
    update.set_input_seq(5);
    scene::Scene bad = newest().scene;
    bad.layers[0].gain = 1;
    *update.mutable_scene() = worker::toMessage(bad);
    ASSERT_TRUE(view->update(author, update, Clock::now()).has_value());
    const workers::RenderRequest asked = newest();
    ASSERT_EQ(asked.scene.layers[0].gain, 1);
    events.failed(asked.view, asked.tag, fail(ErrorCode::kInvalidArgument, "no", "layers[0].gain"));
    const auto told = [this](ViewerId viewer) {
        std::string all;
        while (const auto mail = view->takeMail(viewer)) all += mail->ShortDebugString() + "\n";
        return all;
    };
    const std::string byAuthor = told(author), byOther = told(large);
    EXPECT_NE(byAuthor.find("scene.layers[0].gain"), std::string::npos) << byAuthor;
    EXPECT_EQ(byAuthor.find("scene_changed"), std::string::npos) << byAuthor;
    EXPECT_NE(byOther.find("scene.layers[0].gain"), std::string::npos) << byOther;
    EXPECT_NE(byOther.find("scene_changed"), std::string::npos) << byOther;
    EXPECT_EQ(newest().scene.layers[0].gain, 0);
}

TEST_F(SharedViewTest, ASlowWatcherLeavesTheOthersTheirFrames) {
    const ViewerId steers = join(), slow = join();
    for (std::uint64_t seq = 2; seq <= 12; ++seq) {
        look(steers, seq);
        drawLast();
        const auto frame = frameOf(steers);
        ASSERT_TRUE(frame.has_value());
        EXPECT_EQ(frame->header.input_seq(), seq);
        ack(steers, frame->sequence);
        if (seq <= 3) {
            ASSERT_TRUE(frameOf(slow).has_value());  // And never acks.
        }
    }
    EXPECT_EQ(view->framesSent(slow), 2U);
    ack(slow, 1);
    EXPECT_EQ(frameOf(slow)->header.input_seq(), 12U);
}

TEST_F(SharedViewTest, AViewWithoutViewersDrawsNothing) {
    const ViewerId one = join();
    ASSERT_TRUE(render.has(render.requests, 1));
    const workers::RenderRequest asked = newest();
    view->leave(one);
    EXPECT_EQ(render.dropped, std::vector<std::uint64_t>{view->global()});
    events.rendered(drawn(asked));  // Was in flight: nobody wants it.
    EXPECT_TRUE(render.has(render.requests, 1));
    const ViewerId again = join();
    ASSERT_TRUE(render.has(render.requests, 2));
    drawLast();
    EXPECT_TRUE(frameOf(again).has_value());
}

TEST_F(SharedViewTest, ARendererThatRefusesAtOnceIsHeard) {
    const ViewerId one = join();
    drawLast();
    events.failed(view->global(), newest().tag + 1, fail(ErrorCode::kIo, "unknown"));
    look(one, 2);
    events.failed(view->global(), newest().tag, fail(ErrorCode::kIo, "no"));
    std::optional<v1::ServerMessage> error;
    while (auto mail = view->takeMail(one)) {
        if (mail->has_error()) error = std::move(mail);
    }
    ASSERT_TRUE(error.has_value());
    EXPECT_EQ(error->error().message(), "no");
    look(one, 3);
    EXPECT_TRUE(render.has(render.requests, 3));
}

TEST_F(SharedViewTest, PicksOfTwoViewersAreBothAnswered) {
    const ViewerId one = join(), two = join();
    drawLast();
    ASSERT_TRUE(frameOf(one) && frameOf(two));
    v1::Pick pick;
    pick.set_x(1);
    ASSERT_TRUE(view->pick(one, pick).has_value());
    pick.set_x(2);
    ASSERT_TRUE(view->pick(two, pick).has_value());
    ASSERT_TRUE(render.has(render.picks, 1)) << "the render service keeps one of a view";
    for (std::size_t i = 0; i < 2; ++i) {
        events.picked(view->global(), render.picks.at(i).tag, std::optional<scene::Picked>{});
    }
    for (const auto& [viewer, x] : {std::pair{one, 1U}, std::pair{two, 2U}}) {
        std::optional<v1::ServerMessage> mail;
        while ((mail = view->takeMail(viewer)) && !mail->has_picked()) {
        }
        ASSERT_TRUE(mail.has_value());
        EXPECT_EQ(mail->picked().x(), x);
    }
}

TEST_F(SharedViewTest, ThumbnailsOfTwoViewersAreDrawnOneAfterTheOtherInAViewOfTheirOwn) {
    const ViewerId one = join(), two = join();
    drawLast();
    v1::DrawThumbnail asked;
    asked.set_width(4);
    asked.set_height(3);
    *asked.mutable_scene() = worker::toMessage(render.requests[0].scene);
    for (const ViewerId viewer : {one, two}) {
        asked.set_request(static_cast<std::uint32_t>(10 + viewer));
        ASSERT_TRUE(view->drawThumbnail(viewer, asked).has_value());
    }
    ASSERT_TRUE(render.has(render.requests, 2)) << "the second waits for the first";
    for (std::size_t i = 1; i <= 2; ++i) {
        ASSERT_TRUE(render.has(render.requests, i + 1));
        const workers::RenderRequest request = [&] {
            const std::lock_guard lock{render.mutex};
            return render.requests[i];
        }();
        EXPECT_NE(request.view, view->global());
        EXPECT_TRUE(request.background);
        EXPECT_EQ(request.size, glm::ivec2(4, 3));
        if (i == 2) {
            events.failed(request.view, request.tag,
                          fail(ErrorCode::kShaderBuild, "no such model"));
            break;
        }
        events.rendered(drawn(request));
    }
    const auto answer = [&](ViewerId viewer) -> std::optional<v1::Thumbnail> {
        const auto until = Clock::now() + std::chrono::seconds{30};
        while (Clock::now() < until) {
            while (const auto mail = view->takeMail(viewer)) {
                if (mail->has_thumbnail()) return mail->thumbnail();
            }
            std::this_thread::yield();
        }
        return std::nullopt;
    };
    const auto first = answer(one), second = answer(two);
    ASSERT_TRUE(first && second);
    EXPECT_EQ(first->request(), 10 + one);
    EXPECT_EQ(first->codec(), v1::CODEC_JPEG);
    EXPECT_FALSE(first->picture().empty());
    EXPECT_EQ(second->request(), 10 + two);
    EXPECT_EQ(second->refusal(), "no such model");
    const std::uint64_t own = render.requests[1].view;
    view->leave(one);
    view->leave(two);
    EXPECT_EQ(render.dropped, (std::vector<std::uint64_t>{view->global(), own}));
}

/// Draws at once, on a thread of its own, as the real one does.
TEST_F(SharedViewTest, ManyThreadsAtOnceLoseNoFrame) {
    constexpr std::uint64_t kInputs = 200;
    constexpr int kWatchers = 4;
    std::atomic<bool> done = false;
    std::vector<ViewerId> watchers;
    const ViewerId steers = join();
    for (int i = 0; i < kWatchers; ++i) watchers.push_back(join());
    std::vector<std::thread> threads;
    std::vector<std::uint64_t> seen(kWatchers + 1, 0);
    const auto watch = [&](ViewerId viewer, std::uint64_t& newest) {
        const auto until = Clock::now() + std::chrono::seconds{60};
        while (newest < kInputs && Clock::now() < until) {
            const auto frame = frameOf(viewer);
            if (!frame) break;
            EXPECT_GE(frame->header.input_seq(), newest);
            newest = frame->header.input_seq();
            ack(viewer, frame->sequence);
        }
    };
    std::thread renderer{[&] {
        std::size_t next = 0;
        while (!done) {
            std::optional<workers::RenderedFrame> frame;
            {
                const std::lock_guard lock{render.mutex};
                if (render.requests.size() > next) {
                    next = render.requests.size();
                    frame = drawn(render.requests.back());
                }
            }
            if (frame) {
                events.rendered(*frame);
            } else {
                std::this_thread::sleep_for(std::chrono::microseconds{200});
            }
        }
    }};
    for (int i = 0; i < kWatchers; ++i) {
        threads.emplace_back(watch, watchers[static_cast<std::size_t>(i)],
                             std::ref(seen[static_cast<std::size_t>(i)]));
    }
    threads.emplace_back(watch, steers, std::ref(seen[kWatchers]));
    for (std::uint64_t seq = 2; seq <= kInputs; ++seq) look(steers, seq);
    for (std::thread& thread : threads) thread.join();
    done = true;
    renderer.join();
    for (const std::uint64_t newest : seen) EXPECT_EQ(newest, kInputs);
}

}  // namespace
}  // namespace volcast::session
