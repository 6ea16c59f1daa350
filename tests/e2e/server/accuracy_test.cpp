// How a live view is drawn, why, and what accuracy costs there, over a real socket.
#include <csignal>

#include "tests/e2e/server/shared_server.h"

namespace volcast::test {
namespace {

class LiveAccuracy : public SharedServer {
protected:
    static v1::ClientMessage explain(std::uint32_t view) {
        v1::ClientMessage message;
        message.mutable_explain()->set_view(view);
        return message;
    }

    static v1::ClientMessage measure(std::uint32_t view, std::uint32_t pixels = 100) {
        v1::ClientMessage message;
        message.mutable_measure_accuracy()->set_view(view);
        message.mutable_measure_accuracy()->set_max_pixels(pixels);
        return message;
    }

    static std::optional<v1::AccuracyReport> waitForReport(TestClient& client, bool done) {
        const auto found = client.waitFor([done](const v1::ServerMessage& one) {
            return one.has_accuracy_report() && (!done || one.accuracy_report().done());
        });
        if (!found) return std::nullopt;
        return found->accuracy_report();
    }
};

TEST_F(LiveAccuracy, ThePlanOfTheNewestPictureSaysWhatIsOnAndWhy) {
    for (const auto form : {TestClient::Form::kBinary, TestClient::Form::kJson}) {
        TestClient client{port(), form};
        ASSERT_TRUE(client.ok());
        client.openView(3, "good.node", 64, 48, 9);
        const auto frame = client.waitForFrame(3, 9);
        ASSERT_TRUE(frame.has_value());
        client.send(explain(3));
        const auto found = client.waitFor([](const auto& one) { return one.has_plan(); });
        ASSERT_TRUE(found.has_value());
        const v1::Plan& plan = found->plan();
        EXPECT_EQ(plan.view(), 3U);
        EXPECT_EQ(plan.plan_id(), frame->header.plan_id());
        EXPECT_EQ(plan.input_seq(), 9U);
        ASSERT_EQ(plan.layers_size(), 1);
        EXPECT_EQ(plan.layers(0).evaluator(), "mesh walk");
        EXPECT_GT(plan.layers(0).effects_size(), 8);
        for (const v1::Effect& effect : plan.layers(0).effects()) {
            EXPECT_FALSE(effect.name().empty());
            EXPECT_FALSE(effect.reason().empty()) << effect.name();
        }
    }
}

TEST_F(LiveAccuracy, EveryWayToDrawALiveViewIsMeasured) {
    const auto client = clientWithView();
    ASSERT_TRUE(client);
    client->look(1, 2, 0.5);
    ASSERT_TRUE(client->waitForFrame(1, 2).has_value());
    client->send(measure(1));
    const auto first = waitForReport(*client, false);
    ASSERT_TRUE(first.has_value());
    EXPECT_EQ(first->rows_size(), 1);
    EXPECT_GT(first->progress(), 0.0);
    const auto last = waitForReport(*client, true);
    ASSERT_TRUE(last.has_value());
    EXPECT_EQ(last->stopped(), "");
    EXPECT_EQ(last->progress(), 1.0);
    ASSERT_EQ(last->rows_size(), 12) << "six integrators, two evaluators";
    bool front = false;
    for (const v1::AccuracyRow& row : last->rows()) {
        EXPECT_EQ(row.refusal(), "");
        EXPECT_EQ(row.model(), v1::RAY_MODEL_VOLUME);
        EXPECT_GT(row.median_ms(), 0.0);
        EXPECT_LE(row.min_ms(), row.max_ms());
        if (row.integrator() == v1::INTEGRATOR_EXACT) {
            EXPECT_LT(row.max_error(), 1e-4);
        }
        front = front || row.on_front();
    }
    EXPECT_TRUE(front);
    // Frames go on as before.
    client->look(1, 3, 0.6);
    EXPECT_TRUE(client->waitForFrame(1, 3).has_value());
}

TEST_F(LiveAccuracy, AChangeOfTheViewEndsTheMeasurement) {
    const auto client = clientWithView();
    ASSERT_TRUE(client);
    client->look(1, 2, 0.5);
    ASSERT_TRUE(client->waitForFrame(1, 2).has_value());
    client->send(measure(1, 60'000));
    client->look(1, 3, 0.9);
    const auto report = waitForReport(*client, true);
    ASSERT_TRUE(report.has_value());
    EXPECT_EQ(report->stopped(), "the view changed");
    EXPECT_LT(report->rows_size(), 12);
    EXPECT_TRUE(client->waitForFrame(1, 3).has_value());
}

TEST_F(LiveAccuracy, ALostWorkersMeasurementIsDoneAgainAndTheViewLivesOn) {
    const auto client = clientWithView();
    ASSERT_TRUE(client);
    client->look(1, 2, 0.5);
    ASSERT_TRUE(client->waitForLossless(1, 2).has_value());
    client->send(measure(1, 60'000));
    ASSERT_TRUE(waitForReport(*client, false).has_value());
    // The server has asked for the next way to draw by now.
    const auto pid = static_cast<pid_t>(readiness().at("worker_pid").to_number<double>());
    ASSERT_EQ(::kill(pid, SIGKILL), 0);
    ASSERT_TRUE(client->waitForState(1, v1::VIEW_STATE_RECOVERING).has_value()) << server().log();
    const auto report = waitForReport(*client, true);
    ASSERT_TRUE(report.has_value()) << server().log();
    EXPECT_EQ(report->stopped(), "");
    ASSERT_EQ(report->rows_size(), 12);
    for (const v1::AccuracyRow& row : report->rows()) {
        EXPECT_EQ(row.refusal(), "");
        EXPECT_GT(row.median_ms(), 0.0);
    }
    client->look(1, 3, 0.7);
    EXPECT_TRUE(client->waitForFrame(1, 3).has_value());
}

TEST_F(LiveAccuracy, WhatCannotBeExplainedOrMeasuredIsRefused) {
    TestClient client{port()};
    ASSERT_TRUE(client.ok());
    for (const auto& message : {explain(8), measure(8)}) {
        client.send(message);
        const auto error = client.waitForError();
        ASSERT_TRUE(error.has_value());
        EXPECT_EQ(error->code(), v1::ERROR_CODE_NOT_FOUND);
        EXPECT_EQ(error->view(), 8U);
        EXPECT_EQ(error->field(), "view");
    }
}

}  // namespace
}  // namespace volcast::test
