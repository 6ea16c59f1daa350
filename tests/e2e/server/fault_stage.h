#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <boost/json/value.hpp>

#include "tests/e2e/server/test_client.h"

namespace volcast::test {

/// A server of its own for one test, with the cubes good.node and again.node, which is not asked
/// for until a test does.
struct FaultStage {
    explicit FaultStage(const std::vector<std::string>& options,
                        const ServerProcess::Environment& environment = {});

    /// The body of /readyz.
    [[nodiscard]] boost::json::value readiness() const;
    [[nodiscard]] int number(const char* key) const;
    [[nodiscard]] std::string text(const char* key) const;
    [[nodiscard]] bool waitForSpare() const;

    TemporaryFolder folder;
    std::unique_ptr<ServerProcess> server;
};

void inject(TestClient& client, const std::string& fault);

/// A client with a view of a dataset, the scene it was told, and a lossless picture of it.
struct Looker {
    Looker(std::uint16_t port, TestClient::Form form, const std::string& dataset = "good.node",
           std::uint32_t width = 64, std::uint32_t height = 48);

    void show(const v1::Scene& shown, std::uint64_t inputSeq) const;
    /// What no worker has drawn: it takes uploads, programs, draws and memory.
    [[nodiscard]] v1::Scene otherScene() const;
    /// The picture of `before` is drawn again, as the input after `inputSeq`.
    void expectSamePictureAgain(std::uint64_t inputSeq) const;

    std::unique_ptr<TestClient> client;
    v1::Scene scene;
    std::optional<TestFrame> before;  ///< Of the input 2; empty where something went wrong.
};

}  // namespace volcast::test
