#pragma once

#include "tests/unit/session/scripted_render.h"
#include "tests/unit/session/session_client.h"

namespace volcast::session::test {

/// A server without sockets.
struct TestServer {
    explicit TestServer(const LinkKey& key, std::chrono::seconds keep = std::chrono::seconds{60},
                        std::unique_ptr<StateFolder> state = {}) {
        EXPECT_NE(loadedFirst(*catalogue), "");
        views = std::make_unique<Views>(ViewsDesc{.parts = {.render = render,
                                                            .catalogue = *catalogue,
                                                            .router = router,
                                                            .encoders = encoders,
                                                            .maxPeople = 4},
                                                  .key = key,
                                                  .keep = keep,
                                                  .maxViews = 3,
                                                  .state = std::move(state)});
        shared = std::make_unique<Shared>(Shared{.render = render,
                                                 .catalogue = *catalogue,
                                                 .views = *views,
                                                 .limits = {},
                                                 .server = "test",
                                                 .sourceUrl = {}});
    }
    std::unique_ptr<SessionClient> client() {
        return std::make_unique<SessionClient>(*shared, ++clients);
    }

    ScriptedRender render;
    ViewRouter router;
    std::unique_ptr<Catalogue> catalogue = cubes(render);
    EncodePool encoders{1};
    std::unique_ptr<Views> views;
    std::unique_ptr<Shared> shared;
    std::uint64_t clients = 0;
};

class SessionPeople : public testing::Test {
protected:
    void SetUp() override {
        ann->hello("Ann");
        welcome = ann->wait([](const auto& one) { return one.has_welcome(); })->welcome();
        ann->openView();
        opened = ann->wait([](const auto& one) { return one.has_view_opened(); });
        ASSERT_TRUE(opened.has_value());
    }
    std::unique_ptr<SessionClient> join(const std::string& name, v1::Role role,
                                        std::uint32_t width = 8) {
        auto client = server.client();
        client->hello(name);
        const std::string link = ann->share(role);
        client->openView(link, 1, width);
        EXPECT_TRUE(client->wait([](const auto& one) { return one.has_view_opened(); }));
        return client;
    }
    static bool hasOpened(const v1::ServerMessage& one) { return one.has_view_opened(); }
    static bool hasWelcome(const v1::ServerMessage& one) { return one.has_welcome(); }

    LinkKey key = *LinkKey::random();
    TestServer server{key};
    std::unique_ptr<SessionClient> ann = server.client();
    v1::Welcome welcome;
    std::optional<v1::ServerMessage> opened;
};

}  // namespace volcast::session::test
