// A whole session without a socket: the renderer is a script, everything else is real.
#include "server/session/session.h"

#include <condition_variable>
#include <mutex>

#include <gtest/gtest.h>

#include "protocol/framing.h"
#include "tests/unit/session/scripted_render.h"

namespace volcast::session {
namespace {

using test::cubes;
using test::drawn;
using test::ScriptedRender;

class SessionTest : public testing::Test {
protected:
    void SetUp() override {
        catalogue = cubes(render);
        events = router.events();
        const LinkKey key = *LinkKey::random();
        views = std::make_unique<Views>(ViewsDesc{.parts = {.render = render,
                                                            .catalogue = *catalogue,
                                                            .router = router,
                                                            .encoders = encoders},
                                                  .key = key});
        shared = std::make_unique<Shared>(Shared{.render = render,
                                                 .catalogue = *catalogue,
                                                 .views = *views,
                                                 .limits = {},
                                                 .server = "test",
                                                 .sourceUrl = {}});
        session = Session::create(*shared, 1,
                                  {.post =
                                       [this](std::function<void()> act) {
                                           const std::lock_guard lock{mutex};
                                           posted.push_back(std::move(act));
                                           came.notify_all();
                                       },
                                   .wake = [] {}});
    }
    void TearDown() override {
        session.reset();
        views->clear();
        catalogue.reset();
    }
    void say(const std::string& json) {
        session->receive(std::as_bytes(std::span{json}), Form::kJson, Clock::now());
    }
    /// Runs what other threads posted until `text` is in what the session says.
    std::string waitFor(const std::string& text) {
        const auto until = Clock::now() + std::chrono::seconds{30};
        while (Clock::now() < until) {
            while (const auto out = session->next(Clock::now())) {
                std::string said{reinterpret_cast<const char*>(out->head.data()), out->head.size()};
                if (said.find(text) != std::string::npos) return said;
            }
            session->tick(Clock::now());
            std::unique_lock lock{mutex};
            came.wait_for(lock, std::chrono::milliseconds{20}, [this] { return !posted.empty(); });
            std::deque<std::function<void()>> now;
            now.swap(posted);
            lock.unlock();
            for (auto& act : now) act();
        }
        return {};
    }
    void drawLast() { events.rendered(drawn(render.requests.back())); }
    void openView() {
        say(R"({"hello":{"major":1}})");
        say(R"({"openView":{"view":4,"viewport":{"width":8,"height":6},"inputSeq":"1"}})");
        ASSERT_NE(waitFor("viewOpened"), "");
        ASSERT_TRUE(render.has(render.requests, 1));
    }

    ScriptedRender render;
    ViewRouter router;
    workers::RenderEvents events;
    std::unique_ptr<Catalogue> catalogue;
    std::unique_ptr<Views> views;
    std::unique_ptr<Shared> shared;
    std::mutex mutex;
    std::condition_variable came;
    std::deque<std::function<void()>> posted;
    std::shared_ptr<Session> session;
    EncodePool encoders{1};  // Last: its thread posts until it has ended.
};

TEST_F(SessionTest, ADefaultViewIsOpenedDrawnAndMadeExact) {
    openView();
    EXPECT_EQ(render.requests[0].size, glm::ivec2(8, 6));
    EXPECT_EQ(render.requests[0].scene.layers.at(0).field, "f");
    drawLast();
    EXPECT_NE(waitFor(R"("codec":"CODEC_JPEG")"), "");
    EXPECT_NE(waitFor(R"("final":true)"), "");
    EXPECT_TRUE(render.has(render.requests, 1));  // The lossless picture was not drawn again.
}

TEST_F(SessionTest, ALossIsToldAndTheNextPictureEndsIt) {
    openView();
    drawLast();
    ASSERT_NE(waitFor("CODEC_JPEG"), "");
    events.recovering({render.requests[0].view});
    ASSERT_NE(waitFor("VIEW_STATE_RECOVERING"), "");
    drawLast();
    EXPECT_NE(waitFor("VIEW_STATE_ACTIVE"), "");
    EXPECT_NE(waitFor("CODEC_JPEG"), "");
}

TEST_F(SessionTest, AFailedDrawIsToldAndTheNextInputIsDrawn) {
    openView();
    events.failed(render.requests[0].view, render.requests[0].tag,
                  fail(ErrorCode::kOutOfGpuMemory, "no memory for 8 x 6"));
    EXPECT_NE(waitFor("ERROR_CODE_OUT_OF_GPU_MEMORY"), "");
    EXPECT_NE(waitFor("VIEW_STATE_FAILED"), "");
    say(R"({"update":{"view":4,"inputSeq":"2","viewport":{"width":9,"height":9}}})");
    ASSERT_TRUE(render.has(render.requests, 2));
    drawLast();
    EXPECT_NE(waitFor("VIEW_STATE_ACTIVE"), "");
}

TEST_F(SessionTest, DescribesCodeWithoutARenderer) {
    say(R"({"hello":{"major":1}})");
    say(R"({"describeShader":{"request":9,"code":"#uicontrol bool b checkbox\nvoid main() {}"}})");
    const std::string said = waitFor("shaderDescription");
    EXPECT_NE(said.find(R"("request":9)"), std::string::npos) << said;
    EXPECT_NE(said.find(R"("name":"b")"), std::string::npos) << said;
    EXPECT_TRUE(render.requests.empty());
}

TEST_F(SessionTest, CodeThatFailsGivesTheLastDrawnSceneBack) {
    openView();
    drawLast();
    ASSERT_NE(waitFor(R"("final":true)"), "");
    say(R"({"ack":{"view":4,"sequence":1}})");
    say(R"({"ack":{"view":4,"sequence":2}})");
    const scene::Scene good = render.requests[0].scene;
    const std::string layer = R"({"id":"l","dataset":")" + good.layers[0].dataset +
                              R"(","model":"RAY_MODEL_VOLUME","shader":{"code":")";
    const std::string camera =
        R"("camera":{"eye":{"x":5},"center":{},"up":{"z":1},"fovyDegrees":30})";
    const auto update = [&](int seq, const std::string& code) {
        say(R"({"update":{"view":4,"inputSeq":")" + std::to_string(seq) + R"(","scene":{)" +
            camera + R"(,"layers":[)" + layer + code + R"("}}]}}})");
    };
    update(2, "void main() { while (true) {} }");
    const std::string refused = waitFor("while is not allowed");
    EXPECT_NE(refused.find("scene.layers[0].shader.code"), std::string::npos) << refused;
    EXPECT_TRUE(render.has(render.requests, 1)) << "refused before any worker sees it";

    update(3, "void main() { emitRGB(x); }");
    ASSERT_TRUE(render.has(render.requests, 2));
    events.failed(render.requests[1].view, render.requests[1].tag,
                  fail(ErrorCode::kInvalidArgument, "line 1: 'x'", "layers[0].shader.code"));
    const std::string told = waitFor("line 1: 'x'");
    EXPECT_NE(told.find("ERROR_CODE_INVALID_ARGUMENT"), std::string::npos) << told;
    EXPECT_NE(told.find("scene.layers[0].shader.code"), std::string::npos) << told;
    ASSERT_TRUE(render.has(render.requests, 3));
    EXPECT_EQ(render.requests[2].scene.layers, good.layers);
    EXPECT_EQ(render.requests[2].scene.camera.eye.x, 5.0) << "seen by the newest camera";
    drawLast();
    EXPECT_NE(waitFor("CODEC_JPEG"), "");
}

TEST_F(SessionTest, ANewViewOfAnOldNumberHearsNothingOfTheOldOne) {
    openView();
    const workers::RenderRequest old = render.requests.back();
    say(R"({"closeView":{"view":4}})");
    EXPECT_EQ(render.dropped, std::vector<std::uint64_t>{old.view});
    say(R"({"openView":{"view":4,"viewport":{"width":5,"height":5},"inputSeq":"1"}})");
    ASSERT_TRUE(render.has(render.requests, 2));
    EXPECT_NE(render.requests[1].view, old.view);
    events.failed(old.view, old.tag, fail(ErrorCode::kIo, "late"));
    drawLast();
    const std::string said = waitFor("CODEC_JPEG");
    EXPECT_NE(said.find(R"("width":5)"), std::string::npos) << said;
}

TEST_F(SessionTest, AChangeOfTheViewStopsItsMeasurement) {
    openView();
    drawLast();
    ASSERT_NE(waitFor("CODEC_JPEG"), "");
    say(R"({"measureAccuracy":{"view":4}})");
    ASSERT_TRUE(render.has(render.measures, 1));
    EXPECT_TRUE(render.stopped.empty());
    say(R"({"update":{"view":4,"inputSeq":"2","viewport":{"width":9,"height":9}}})");
    EXPECT_NE(waitFor("the view changed"), "");
    EXPECT_EQ(render.stopped, std::vector<std::uint64_t>{render.measures[0].view});
}

TEST_F(SessionTest, WhatFailsToBeMeasuredIsARowWithTheReasonAndTheNextIsMeasured) {
    openView();
    drawLast();
    ASSERT_NE(waitFor("CODEC_JPEG"), "");
    say(R"({"measureAccuracy":{"view":4}})");
    ASSERT_TRUE(render.has(render.measures, 1));
    events.measured(render.measures[0].view, render.measures[0].tag,
                    fail(ErrorCode::kTimeout, "missed its deadline of 5 ms"));
    EXPECT_NE(waitFor("missed its deadline of 5 ms"), "");
    ASSERT_TRUE(render.has(render.measures, 2));
    EXPECT_NE(render.measures[1].job.candidate, render.measures[0].job.candidate);
    say(R"({"update":{"view":4,"inputSeq":"2","viewport":{"width":9,"height":9}}})");
    drawLast();
    EXPECT_NE(waitFor("CODEC_JPEG"), "");
}

TEST_F(SessionTest, APixelIsPickedOfTheFrameThatIsNamed) {
    openView();
    drawLast();
    ASSERT_NE(waitFor("CODEC_JPEG"), "");
    say(R"({"update":{"view":4,"inputSeq":"2","viewport":{"width":20,"height":10}}})");
    ASSERT_TRUE(render.has(render.requests, 2));
    say(R"({"pick":{"view":4,"inputSeq":"1","x":7,"y":5}})");
    ASSERT_TRUE(render.has(render.picks, 1));
    EXPECT_EQ(render.picks[0].job.size, glm::ivec2(8, 6));
    EXPECT_EQ(render.picks[0].job.pixel, glm::ivec2(7, 5));
    EXPECT_EQ(render.picks[0].job.scene, render.requests[0].scene);
    const scene::Picked picked{.layer = "main", .values = {{.field = "f", .value = 0.25}}};
    events.picked(render.picks[0].view, render.picks[0].tag, std::optional{picked});
    const std::string said = waitFor("picked");
    EXPECT_NE(said.find(R"("view":4)"), std::string::npos) << said;
    EXPECT_NE(said.find(R"("inputSeq":"1")"), std::string::npos) << said;
    EXPECT_NE(said.find(R"("value":0.25)"), std::string::npos) << said;
}

TEST_F(SessionTest, OfSeveralPixelsTheNewestAloneIsAnswered) {
    openView();
    drawLast();
    ASSERT_NE(waitFor("CODEC_JPEG"), "");
    say(R"({"pick":{"view":4,"x":1}})");
    say(R"({"pick":{"view":4,"x":2}})");
    ASSERT_TRUE(render.has(render.picks, 2));
    for (const auto& asked : render.picks) {
        events.picked(asked.view, asked.tag, std::optional<scene::Picked>{});
    }
    EXPECT_NE(waitFor("picked").find(R"("x":2)"), std::string::npos);
    say(R"({"pick":{"view":4,"x":3}})");
    events.picked(render.picks[2].view, render.picks[2].tag,
                  fail(ErrorCode::kDeviceLost, "the GL worker was lost: killed"));
    EXPECT_NE(waitFor("the GL worker was lost"), "");
}

TEST_F(SessionTest, OnlyTheNewestPicturesCanBePicked) {
    openView();
    for (int input = 2; input < 12; ++input) {
        drawLast();
        ASSERT_NE(waitFor("CODEC_"), "");
        say(R"({"ack":{"view":4,"sequence":)" + std::to_string(input - 1) + "}}");
        say(R"({"update":{"view":4,"inputSeq":")" + std::to_string(input) +
            R"(","viewport":{"width":)" + std::to_string(input) + R"(,"height":9}}})");
        ASSERT_TRUE(render.has(render.requests, static_cast<std::size_t>(input)));
    }
    say(R"({"pick":{"view":4,"inputSeq":"2"}})");
    EXPECT_NE(waitFor("is none of the newest 8 pictures of view 4"), "");
    say(R"({"pick":{"view":4,"inputSeq":"5"}})");
    EXPECT_TRUE(render.has(render.picks, 1));
    say(R"({"pick":{"view":4,"inputSeq":"5","x":5}})");
    EXPECT_NE(waitFor("lies outside of a picture of 5 x 9"), "");
}

TEST_F(SessionTest, RepliesThatNobodyReadsAreBounded) {
    say(R"({"hello":{"major":1}})");
    for (int i = 0; i < 2000 && !session->closing(); ++i) say(R"({"ping":{"token":"1"}})");
    ASSERT_TRUE(session->closing().has_value());
    EXPECT_EQ(session->closing()->code, 1008);
}

TEST_F(SessionTest, ASessionThatEndsDropsItsViews) {
    openView();
    const std::uint64_t view = render.requests[0].view;
    session.reset();
    EXPECT_EQ(render.dropped, std::vector<std::uint64_t>{view});
    drawLast();  // Goes nowhere.
}

TEST_F(SessionTest, WithoutAHelloTheConnectionEnds) {
    session->tick(Clock::now() + Session::kHelloWithin + std::chrono::seconds{1});
    ASSERT_TRUE(session->closing().has_value());
    EXPECT_EQ(session->closing()->code, 1008);
}

TEST_F(SessionTest, AClientWithVideoIsSentPatchesAndItsAnswersAreChecked) {
    say(R"({"hello":{"major":1,"codecs":["CODEC_JPEG","CODEC_PNG","CODEC_VP9"]}})");
    const std::string welcome = waitFor("welcome");
    EXPECT_NE(welcome.find("CODEC_WEBP"), std::string::npos) << welcome;
    const std::string patch = waitFor(R"("patch":true)");
    EXPECT_NE(patch.find(R"("codec":"CODEC_VP9")"), std::string::npos) << patch;
    EXPECT_NE(patch.find(R"("keyframe":true)"), std::string::npos) << patch;
    say(R"({"openView":{"view":4,"viewport":{"width":8,"height":6},"inputSeq":"1"}})");
    ASSERT_NE(waitFor("viewOpened"), "");
    say(R"({"setPins":{"view":4,"pins":{"codec":"CODEC_VP9"}}})");
    EXPECT_NE(waitFor("ERROR_CODE_UNSUPPORTED").find("pins.codec"), std::string::npos)
        << "it was not tried yet";
    say(R"({"patchDecoded":{"codec":"CODEC_H264","rgb":"AAAA"}})");
    EXPECT_NE(waitFor("patch_decoded.codec").find("CODEC_H264"), std::string::npos);
    // Black, white, red, green, blue, grey, and two more: as they were sent.
    say(R"({"patchDecoded":{"codec":"CODEC_VP9","rgb":"AAAA/////wAAAP8AAAD/gICAQKBg4IAg"}})");
    say(R"({"setPins":{"view":4,"pins":{"codec":"CODEC_VP9","quality":80}}})");
    drawLast();
    const std::string frame = waitFor(R"("codec":"CODEC_VP9")");
    EXPECT_NE(frame.find(R"("keyframe":true)"), std::string::npos) << frame;
    EXPECT_NE(frame.find(R"("quality":80)"), std::string::npos) << frame;
    say(R"({"patchDecoded":{"codec":"CODEC_VP9","rgb":"AAAA"}})");
    EXPECT_NE(waitFor("patch_decoded.codec"), "") << "each patch is answered once";
}

TEST_F(SessionTest, ADecoderWithWrongColoursIsNotUsed) {
    say(R"({"hello":{"major":1,"codecs":["CODEC_JPEG","CODEC_VP9"]}})");
    ASSERT_NE(waitFor(R"("patch":true)"), "");
    say(R"({"openView":{"view":4,"viewport":{"width":8,"height":6},"inputSeq":"1"}})");
    ASSERT_NE(waitFor("viewOpened"), "");
    // All black, as a decoder without colours would make it.
    say(R"({"patchDecoded":{"codec":"CODEC_VP9","rgb":"AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA"}})");
    say(R"({"setPins":{"view":4,"pins":{"codec":"CODEC_VP9"}}})");
    EXPECT_NE(waitFor("ERROR_CODE_UNSUPPORTED").find("pins.codec"), std::string::npos);
}

TEST_F(SessionTest, PinsOutOfRangeAreRefusedByName) {
    openView();
    for (const auto& [pins, field] : {std::pair{R"("quality":29)", "pins.quality"},
                                      {R"("quality":101)", "pins.quality"},
                                      {R"("scale":0.2)", "pins.scale"},
                                      {R"("scale":"NaN")", "pins.scale"},
                                      {R"("framesPerS":0)", "pins.frames_per_s"},
                                      {R"("framesPerS":241)", "pins.frames_per_s"},
                                      {R"("codec":"CODEC_WEBP")", "pins.codec"}}) {
        say(std::string{R"({"setPins":{"view":4,"pins":{)"} + pins + "}}}");
        EXPECT_NE(waitFor(R"("error")").find(field), std::string::npos) << pins;
    }
    say(R"({"setPins":{"view":9,"pins":{}}})");
    EXPECT_NE(waitFor("ERROR_CODE_NOT_FOUND"), "");
    say(R"({"setPins":{"view":4,"pins":{"quality":30,"scale":0.25}}})");
    ASSERT_EQ(render.requests.size(), 2U);
    EXPECT_EQ(render.requests.back().size, glm::ivec2(2, 2)) << "8 x 6 at a quarter, rounded";
}

}  // namespace
}  // namespace volcast::session
