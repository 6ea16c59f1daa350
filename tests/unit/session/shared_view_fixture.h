#pragma once

#include <atomic>
#include <condition_variable>

#include <gtest/gtest.h>

#include "tests/unit/session/scripted_render.h"

namespace volcast::session::test {

/// One view with a renderer that draws when it is told to, and as many viewers as join.
class SharedViewTest : public testing::Test {
protected:
    void SetUp() override {
        catalogue = cubes(render);
        events = router.events();
        const std::string id = loadedFirst(*catalogue);
        ASSERT_NE(id, "");
        const LinkKey key = *LinkKey::random();
        views = std::make_unique<Views>(
            ViewsDesc{.parts = {.render = render,
                                .catalogue = *catalogue,
                                .router = router,
                                .encoders = encoders,
                                .changed = [this](const auto&) { ++saves; }},
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
    void look(ViewerId viewer, std::uint64_t seq, double x, TimePoint now = Clock::now()) {
        v1::Update update;
        update.set_input_seq(seq);
        v1::Camera& camera = *update.mutable_camera();
        camera.mutable_eye()->set_x(x);
        camera.mutable_center();
        camera.mutable_up()->set_z(1);
        camera.set_fovy_degrees(40);
        ASSERT_TRUE(view->update(viewer, update, now).has_value());
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
    std::atomic<int> saves = 0;  ///< How often there was something new to save.
    std::uint32_t people = 0;
    std::unique_ptr<Views> views;
    std::shared_ptr<SharedView> view;
    EncodePool encoders{2};  // Last: its threads call the view until they have ended.
};

}  // namespace volcast::session::test
