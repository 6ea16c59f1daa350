// Several viewers of one view: what is drawn, what is encoded, who is told what.
#include <atomic>
#include <condition_variable>
#include <thread>

#include <gtest/gtest.h>

#include "renderer/worker/scene_message.h"
#include "tests/unit/session/scripted_render.h"

namespace volcast::session {
namespace {

using test::drawn;
using test::importCube;
using test::ScriptedRender;

class SharedViewTest : public testing::Test {
protected:
    void SetUp() override {
        CatalogueDesc desc;
        desc.importer = importCube;
        catalogue = *Catalogue::create(std::move(desc), render);
        events = router.events();
        const std::string id = catalogue->list().datasets(0).id();
        ASSERT_TRUE(catalogue->require(id).has_value());
        while (!catalogue->standing(id).loaded) std::this_thread::yield();
        const LinkKey key = *LinkKey::random();
        views = std::make_unique<Views>(ViewsDesc{.parts = {.render = render,
                                                            .catalogue = *catalogue,
                                                            .router = router,
                                                            .encoders = encoders},
                                                  .key = key});
        v1::OpenView open;
        open.set_dataset(id);
        open.set_input_seq(1);
        view = *views->open(open);
    }
    void TearDown() override {
        view.reset();
        views->clear();
        catalogue.reset();
    }
    ViewerId join(scene::PictureSize size = {8, 6}, v1::Role role = v1::ROLE_CONTROL) {
        return *view->join({.number = 1,
                            .codecs = {},
                            .size = size,
                            .wake =
                                [this] {
                                    const std::lock_guard lock{mutex};
                                    ++wakes;
                                    woken.notify_all();
                                }},
                           {.person = ++people, .name = "p" + std::to_string(people), .role = role},
                           Clock::now());
    }
    void look(ViewerId viewer, std::uint64_t seq) { look(viewer, seq, static_cast<double>(seq)); }
    void look(ViewerId viewer, std::uint64_t seq, double x) {
        v1::Update update;
        update.set_input_seq(seq);
        v1::Camera& camera = *update.mutable_camera();
        camera.mutable_eye()->set_x(x);
        camera.mutable_center();
        camera.mutable_up()->set_z(1);
        camera.set_fovy_degrees(40);
        ASSERT_TRUE(view->update(viewer, update, Clock::now()).has_value());
    }
    /// What the renderer was asked for last.
    workers::RenderRequest newest() {
        EXPECT_TRUE(render.has(render.requests, view->counts().drawsAsked));
        const std::lock_guard lock{render.mutex};
        return render.requests.back();
    }
    void drawLast() { events.rendered(drawn(newest())); }
    /// The viewer's next frame, as encoders bring it.
    std::optional<ReadyFrame> frameOf(ViewerId viewer) {
        const auto until = Clock::now() + std::chrono::seconds{30};
        while (Clock::now() < until) {
            view->tick(viewer, Clock::now());
            if (auto frame = view->takeFrame(viewer, Clock::now())) return frame;
            std::unique_lock lock{mutex};
            woken.wait_for(lock, std::chrono::milliseconds{20});
        }
        return std::nullopt;
    }
    void ack(ViewerId viewer, std::uint32_t sequence) {
        view->acked(viewer, {.sequence = sequence}, Clock::now());
    }

    ScriptedRender render;
    ViewRouter router;
    workers::RenderEvents events;
    std::unique_ptr<Catalogue> catalogue;
    std::mutex mutex;
    std::condition_variable woken;
    int wakes = 0;
    std::uint32_t people = 0;
    std::unique_ptr<Views> views;
    std::shared_ptr<SharedView> view;
    EncodePool encoders{2};  // Last: its threads call the view until they have ended.
};

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

TEST_F(SharedViewTest, AnUpdateThatChangesNothingIsAnsweredByThePictureThatIsThere) {
    const ViewerId viewer = join(), watcher = join();
    look(viewer, 2, 5.0);
    drawLast();
    std::shared_ptr<const std::vector<std::byte>> exact;
    for (const ViewerId one : {viewer, watcher}) {
        const auto jpeg = frameOf(one);
        ASSERT_TRUE(jpeg && jpeg->header.codec() == v1::CODEC_JPEG);
        ack(one, jpeg->sequence);
        const auto png = frameOf(one);
        ASSERT_TRUE(png && png->header.final());
        ack(one, png->sequence);
        exact = png->payload;
    }
    const SharedView::Counts before = view->counts();
    look(viewer, 3, 5.0);
    v1::Update whole, nothing, sameSize;
    *whole.mutable_scene() = worker::toMessage(newest().scene);
    sameSize.mutable_viewport()->set_width(8);
    sameSize.mutable_viewport()->set_height(6);
    std::uint64_t seq = 3;
    for (v1::Update* update : {static_cast<v1::Update*>(nullptr), &whole, &nothing, &sameSize}) {
        if (update != nullptr) {
            update->set_input_seq(++seq);
            ASSERT_TRUE(view->update(viewer, *update, Clock::now()).has_value());
        }
        const auto answer = frameOf(viewer);
        ASSERT_TRUE(answer.has_value()) << seq;
        EXPECT_EQ(answer->header.input_seq(), seq);
        EXPECT_TRUE(answer->header.final() && answer->header.lossless()) << seq;
        EXPECT_FALSE(answer->header.redrawn()) << seq;
        EXPECT_EQ(answer->payload, exact) << seq;
        ack(viewer, answer->sequence);
        EXPECT_FALSE(view->takeFrame(watcher, Clock::now()).has_value()) << seq;
    }
    EXPECT_EQ(view->counts().drawsAsked, before.drawsAsked);
    EXPECT_EQ(view->counts().encodes, before.encodes);
    look(viewer, 7, 6.0);
    EXPECT_EQ(view->counts().drawsAsked, before.drawsAsked + 1);
    drawLast();
    const auto moved = frameOf(viewer);
    ASSERT_TRUE(moved.has_value());
    EXPECT_EQ(moved->header.input_seq(), 7U);
    EXPECT_TRUE(moved->header.redrawn());
}

// Before the exact picture is there, the answer is the JPEG once more; the exact one still follows.
TEST_F(SharedViewTest, AnUpdateThatChangesNothingDoesNotPutOffTheExactPicture) {
    const ViewerId viewer = join();
    look(viewer, 2, 5.0);
    drawLast();
    const auto jpeg = frameOf(viewer);
    ASSERT_TRUE(jpeg.has_value());
    ack(viewer, jpeg->sequence);
    look(viewer, 3, 5.0);
    const auto again = frameOf(viewer);
    ASSERT_TRUE(again.has_value());
    EXPECT_EQ(again->header.input_seq(), 3U);
    ack(viewer, again->sequence);
    const auto exact = again->header.final() ? again : frameOf(viewer);
    ASSERT_TRUE(exact.has_value());
    EXPECT_TRUE(exact->header.final());
    EXPECT_EQ(exact->header.input_seq(), 3U);
    EXPECT_EQ(view->counts().drawsAsked, 2U);  // The first as it joined.
}

TEST_F(SharedViewTest, WhatIsBeingDrawnAnswersAnUpdateThatChangesNothing) {
    const ViewerId viewer = join();
    look(viewer, 2, 5.0);
    look(viewer, 3, 5.0);
    drawLast();
    const auto frame = frameOf(viewer);
    ASSERT_TRUE(frame.has_value());
    EXPECT_EQ(frame->header.input_seq(), 3U);
}

TEST_F(SharedViewTest, AnUpdateThatChangesNothingLeavesWhatMayBeRedone) {
    const ViewerId viewer = join();
    look(viewer, 2, 5.0);
    v1::Undo undo;
    view->undo(viewer, undo, Clock::now());
    drawLast();
    const auto scene = newest().scene;
    ASSERT_TRUE(frameOf(viewer).has_value());
    v1::Update whole;
    whole.set_input_seq(4);
    *whole.mutable_scene() = worker::toMessage(scene);
    ASSERT_TRUE(view->update(viewer, whole, Clock::now()).has_value());
    undo.set_redo(true);
    view->undo(viewer, undo, Clock::now());
    EXPECT_EQ(newest().scene.camera.eye.x, 5.0);
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
