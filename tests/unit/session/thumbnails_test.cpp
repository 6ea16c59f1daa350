#include "server/session/thumbnails.h"

#include <algorithm>
#include <condition_variable>

#include <gtest/gtest.h>

#include "tests/unit/session/scripted_render.h"

namespace volcast::session {
namespace {

using test::cubes;
using test::drawn;
using test::ScriptedRender;

class ThumbnailsTest : public testing::Test {
protected:
    void SetUp() override {
        catalogue = cubes(render);
        events = router.events();
        thumbnails = std::make_unique<Thumbnails>(render, *catalogue, router, encoders);
        catalogue->subscribe([this](const v1::DatasetInfo& info) {
            const std::lock_guard lock{mutex};
            told.push_back(info);
            came.notify_all();
        });
    }
    void TearDown() override { thumbnails->stop(); }
    /// Waits for news of `id` that `accept`s.
    template <class Accept>
    std::optional<v1::DatasetInfo> wait(const Accept& accept) {
        std::unique_lock lock{mutex};
        std::optional<v1::DatasetInfo> found;
        came.wait_for(lock, std::chrono::seconds{30}, [&] {
            const auto at = std::ranges::find_if(told, accept);
            if (at == told.end()) return false;
            found = *at;
            return true;
        });
        return found;
    }
    void load(const std::string& id) {
        ASSERT_TRUE(catalogue->open(id).has_value());
        ASSERT_TRUE(wait([&](const v1::DatasetInfo& info) {
                        return info.id() == id && info.state() == v1::DATASET_STATE_READY;
                    }).has_value());
    }
    static auto pictureOf(const std::string& id) {
        return [id](const v1::DatasetInfo& info) {
            return info.id() == id && !info.thumbnail().empty();
        };
    }
    workers::RenderRequest request(std::size_t number) {
        EXPECT_TRUE(render.has(render.requests, number));
        const std::lock_guard lock{render.mutex};
        return render.requests.back();
    }

    ScriptedRender render;
    ViewRouter router;
    workers::RenderEvents events;
    EncodePool encoders{1};
    std::mutex mutex;
    std::condition_variable came;
    std::vector<v1::DatasetInfo> told;
    std::unique_ptr<Catalogue> catalogue;
    std::unique_ptr<Thumbnails> thumbnails;
};

TEST_F(ThumbnailsTest, AreDrawnWhenAskedForAndOnce) {
    load("demo:volume");
    EXPECT_TRUE(render.requests.empty()) << "nobody asked";
    thumbnails->draw("demo:volume");
    thumbnails->draw("demo:volume");
    const auto asked = request(1);
    EXPECT_EQ(asked.size, Thumbnails::kSize);
    ASSERT_EQ(asked.scene.layers.size(), 1U);
    events.rendered(drawn(asked));
    const auto info = wait(pictureOf("demo:volume"));
    ASSERT_TRUE(info.has_value());
    EXPECT_EQ(info->thumbnail().substr(0, 3), "\xff\xd8\xff");
    EXPECT_EQ(info->state(), v1::DATASET_STATE_READY);
    thumbnails->draw("demo:volume");
    EXPECT_EQ(render.requests.size(), 1U);
    EXPECT_TRUE(catalogue->list().datasets(1).has_log()) << "the list has all of it";
    EXPECT_EQ(catalogue->list().datasets(1).thumbnail(), info->thumbnail());
}

TEST_F(ThumbnailsTest, AreDrawnOneAtATime) {
    load("demo:volume");
    load("demo:mesh");
    thumbnails->draw("demo:volume");
    thumbnails->draw("demo:mesh");
    const auto first = request(1);
    events.rendered(drawn(first));
    ASSERT_TRUE(wait(pictureOf("demo:volume")).has_value());
    events.rendered(drawn(request(2)));
    EXPECT_TRUE(wait(pictureOf("demo:mesh")).has_value());
}

TEST_F(ThumbnailsTest, WaitForThePartsOfALargeVolume) {
    load("demo:volume");
    thumbnails->draw("demo:volume");
    workers::RenderedFrame coarse = drawn(request(1));
    coarse.ready = false;
    events.rendered(std::move(coarse));
    events.rendered(drawn(request(2)));
    EXPECT_TRUE(wait(pictureOf("demo:volume")).has_value());
}

TEST_F(ThumbnailsTest, OneThatFailedIsNotTriedAgain) {
    load("demo:volume");
    load("demo:mesh");
    thumbnails->draw("demo:volume");
    thumbnails->draw("demo:mesh");
    const auto first = request(1);
    events.failed(first.view, first.tag, fail(ErrorCode::kDeviceLost, "two workers lost"));
    events.rendered(drawn(request(2)));
    EXPECT_TRUE(wait(pictureOf("demo:mesh")).has_value());
    thumbnails->draw("demo:volume");
    EXPECT_EQ(render.requests.size(), 2U);
}

TEST_F(ThumbnailsTest, OfWhatIsNotLoadedAreNotDrawn) {
    thumbnails->draw("demo:volume");
    thumbnails->draw("nothing");
    EXPECT_TRUE(render.requests.empty());
    thumbnails->stop();
    load("demo:volume");
    thumbnails->draw("demo:volume");
    EXPECT_TRUE(render.requests.empty());
}

}  // namespace
}  // namespace volcast::session
