// Who may let workers and imports fail.
#include "tests/support/temporary_folder.h"
#include "tests/unit/session/session_people_fixture.h"

namespace volcast::session {
namespace {

using test::SessionClient;

class SessionFault : public test::SessionPeople {
protected:
    void SetUp() override {
        SessionPeople::SetUp();
        server.shared->faults = &faults;
    }
    static v1::ClientMessage fault(const std::string& name) {
        v1::ClientMessage message;
        message.mutable_inject_fault()->set_view(1);
        message.mutable_inject_fault()->set_fault(name);
        return message;
    }
    /// The field that is named; empty where the next import fails.
    std::string refusedFor(SessionClient& client) {
        client.send(fault("import-crash"));
        if (faults.takeForImport()) return {};
        const auto error = client.error();
        EXPECT_TRUE(error.has_value());
        EXPECT_EQ(error->code(), v1::ERROR_CODE_NOT_PERMITTED);
        EXPECT_EQ(error->view(), 1U);
        message = error->message();
        return error->field();
    }
    workers::FaultSwitch faults;
    std::string message;
};

TEST_F(SessionFault, AWatcherIsRefusedAndToldTheRole) {
    const auto ben = join("Ben", v1::ROLE_WATCH), cy = join("Cy", v1::ROLE_CONTROL);
    EXPECT_EQ(refusedFor(*ben), "view");
    EXPECT_EQ(message, "you have ROLE_WATCH in this view; faults need ROLE_CONTROL");
    EXPECT_EQ(refusedFor(*ann), "");
    EXPECT_EQ(refusedFor(*cy), "");
    cy->takeControl();
    EXPECT_EQ(refusedFor(*ann), "") << "who may steer need not steer";
}

TEST_F(SessionFault, WhereTokensAreAskedForOneOfRoleControlIsNeeded) {
    const support::TemporaryFolder folder;
    UploadLimits limits;
    limits.needToken = true;
    const auto uploads = UploadFolder::create(folder.path().string(), limits);
    ASSERT_TRUE(uploads.has_value()) << uploads.error().message;
    server.shared->uploads = uploads->get();
    const auto expires = std::chrono::system_clock::now() + std::chrono::hours{1};
    const auto refusedWith = [&](const std::string& access) {
        const auto client = server.client();
        v1::ClientMessage hello;
        hello.mutable_hello()->set_major(protocol::kMajor);
        hello.mutable_hello()->set_access(access);
        client->send(hello);
        client->openView();
        EXPECT_TRUE(client->wait(hasOpened).has_value());
        return refusedFor(*client);
    };
    EXPECT_EQ(refusedWith(""), "hello.access");
    EXPECT_NE(message.find("ROLE_CONTROL"), std::string::npos) << message;
    EXPECT_EQ(refusedWith(*signAccess({.role = v1::ROLE_WATCH, .expires = expires}, key)),
              "hello.access");
    EXPECT_EQ(refusedWith(*signAccess({.role = v1::ROLE_CONTROL, .expires = expires}, key)), "");
}

}  // namespace
}  // namespace volcast::session
