#pragma once

#include <memory>
#include <string>

#include <boost/json/value.hpp>
#include <gtest/gtest.h>

#include "tests/e2e/server/test_client.h"

namespace volcast::test {

/// One server for many tests, started at the first use: starting one costs seconds.
///
/// Its folder holds good.node/.ele (a cube with a linear field), again.node/.ele (the same) and
/// broken.vtu.
class SharedServer : public testing::Test {
protected:
    static void SetUpTestSuite();
    static void TearDownTestSuite();
    void SetUp() override { ASSERT_TRUE(server().ready()) << server().log(); }

    static ServerProcess& server();
    static std::uint16_t port() { return server().port(); }
    static const std::filesystem::path& data();
    /// The body of /readyz.
    static boost::json::value readiness();

    /// A client with view 1 of good.node open and its first frame read.
    static std::unique_ptr<TestClient> clientWithView(
        TestClient::Form form = TestClient::Form::kBinary);

private:
    static std::unique_ptr<TemporaryFolder> folder;
    static std::unique_ptr<ServerProcess> process;
};

}  // namespace volcast::test
