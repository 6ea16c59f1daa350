// The picture of differences of a live view, over a real socket from a real worker.
#include <cmath>
#include <map>

#include <glm/gtc/packing.hpp>

#include "tests/e2e/server/shared_server.h"

namespace volcast::test {
namespace {

class LiveDifference : public SharedServer {
protected:
    static v1::ClientMessage compare(std::uint32_t pixels = 0, std::uint32_t ms = 0) {
        v1::ClientMessage message;
        message.mutable_measure_difference()->set_view(1);
        message.mutable_measure_difference()->set_max_pixels(pixels);
        message.mutable_measure_difference()->set_max_ms(ms);
        return message;
    }

    /// View 1 of the cube, drawn by the cheapest integrator: it is visibly off.
    static std::unique_ptr<TestClient> roughView() {
        auto client = clientWithView();
        if (!client) return client;
        client->look(1, 2, 0.5);
        const auto frame = client->waitForLossless(1, 2);
        v1::ClientMessage update;
        update.mutable_update()->set_view(1);
        update.mutable_update()->set_input_seq(3);
        client->openView(2, "good.node");
        const auto opened = client->waitForOpened(2);
        if (!opened) return nullptr;
        v1::Scene& scene = *update.mutable_update()->mutable_scene();
        scene = opened->scene();
        scene.mutable_layers(0)->set_integrator(v1::INTEGRATOR_AVERAGE);
        scene.mutable_layers(0)->set_evaluator(v1::MESH_EVALUATOR_WALK);
        client->send(update);
        return client->waitForLossless(1, 3) ? std::move(client) : nullptr;
    }

    static std::vector<v1::DifferenceReport> reports(TestClient& client) {
        std::vector<v1::DifferenceReport> all;
        while (all.empty() || !all.back().done()) {
            const auto next =
                client.waitFor([](const auto& one) { return one.has_difference_report(); });
            if (!next) return {};
            all.push_back(next->difference_report());
        }
        return all;
    }

    /// By x and y, what the reports say together; each pixel once.
    static std::map<std::pair<std::uint32_t, std::uint32_t>, float> pixelsOf(
        const std::vector<v1::DifferenceReport>& all) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, float> pixels;
        for (const v1::DifferenceReport& one : all) {
            const std::uint32_t step = one.step();
            std::size_t at = 0;
            for (std::uint32_t y = (one.first_row() + step - 1) / step * step;
                 at < one.off().size(); y += step) {
                const bool coarse = one.refines() && y % (2 * step) == 0;
                for (std::uint32_t x = coarse ? step : 0; x < one.width();
                     x += coarse ? 2 * step : step, at += 2) {
                    const auto low = static_cast<unsigned char>(one.off()[at]);
                    const auto high = static_cast<unsigned char>(one.off()[at + 1]);
                    const auto half = static_cast<std::uint16_t>(low | high << 8U);
                    EXPECT_TRUE(pixels.emplace(std::pair{x, y}, glm::unpackHalf1x16(half)).second);
                }
            }
        }
        return pixels;
    }
};

TEST_F(LiveDifference, OfAllPixelsHasTheFiguresOfTheAccuracyRow) {
    const auto client = roughView();
    ASSERT_TRUE(client);
    client->send(compare(64 * 48));
    const auto all = reports(*client);
    ASSERT_FALSE(all.empty());
    const v1::DifferenceReport& last = all.back();
    EXPECT_EQ(last.stopped(), "");
    EXPECT_EQ(last.input_seq(), 3U);
    EXPECT_GT(all.size(), 2U) << "from coarse to fine";
    const auto pixels = pixelsOf(all);
    ASSERT_EQ(pixels.size(), 64U * 48U);
    double largest = 0.0;
    double over = 0.0;
    for (const auto& [place, off] : pixels) {
        largest = std::max<double>(largest, off);
        over += off > 1.0 / 255.0 ? 1.0 : 0.0;
    }
    EXPECT_NEAR(largest, last.max_error(), last.max_error() * 0x1p-11) << "as float16";
    EXPECT_NEAR(over / (64.0 * 48.0), last.share_over_255(), 1e-12);

    v1::ClientMessage measure;
    measure.mutable_measure_accuracy()->set_view(1);
    measure.mutable_measure_accuracy()->set_max_pixels(64 * 48);
    client->send(measure);
    const auto report = client->waitFor([](const v1::ServerMessage& one) {
        return one.has_accuracy_report() && one.accuracy_report().done();
    });
    ASSERT_TRUE(report.has_value());
    for (const v1::AccuracyRow& row : report->accuracy_report().rows()) {
        if (row.integrator() != v1::INTEGRATOR_AVERAGE) continue;
        if (row.evaluator() != v1::MESH_EVALUATOR_WALK) continue;
        EXPECT_GT(row.max_error(), 1.0 / 255.0) << "nothing to see";
        EXPECT_EQ(last.max_error(), row.max_error());
        EXPECT_NEAR(last.rms_error(), row.rms_error(), 1e-12);
        EXPECT_NEAR(last.share_over_255(), row.share_over_255(), 1e-12);
        return;
    }
    FAIL() << "no such row";
}

TEST_F(LiveDifference, FramesOfOtherViewsComeWhileItRuns) {
    const auto client = clientWithView();
    ASSERT_TRUE(client);
    v1::ClientMessage large;
    large.mutable_update()->set_view(1);
    large.mutable_update()->set_input_seq(2);
    large.mutable_update()->mutable_viewport()->set_width(1024);
    large.mutable_update()->mutable_viewport()->set_height(768);
    client->send(large);
    ASSERT_TRUE(client->waitForLossless(1, 2).has_value());
    const auto other = clientWithView();
    ASSERT_TRUE(other);
    client->send(compare(1024 * 768, 120'000));
    ASSERT_TRUE(client->waitFor([](const auto& one) { return one.has_difference_report(); }));
    for (std::uint64_t seq = 2; seq <= 6; ++seq) {
        other->look(1, seq, 0.1 * static_cast<double>(seq));
        ASSERT_TRUE(other->waitForFrame(1, seq).has_value());
    }
    client->look(1, 3, 0.9);
    for (const v1::DifferenceReport& one : reports(*client)) {
        if (!one.done()) continue;
        EXPECT_EQ(one.stopped(), "the view changed") << "or all pixels were done before";
        EXPECT_LT(one.pixels(), 1024U * 768U);
    }
    EXPECT_TRUE(client->waitForFrame(1, 3).has_value());
}

TEST_F(LiveDifference, StopsOnRequestAndAMeasurementTakesItsPlace) {
    const auto client = clientWithView();
    ASSERT_TRUE(client);
    client->look(1, 2, 0.4);
    ASSERT_TRUE(client->waitForLossless(1, 2).has_value());
    client->send(compare());
    v1::ClientMessage stop;
    stop.mutable_measure_difference()->set_view(1);
    stop.mutable_measure_difference()->set_stop(true);
    client->send(stop);
    const auto stopped = reports(*client);
    ASSERT_FALSE(stopped.empty());
    EXPECT_EQ(stopped.back().stopped(), "stopped by the client");
    client->send(compare());
    v1::ClientMessage measure;
    measure.mutable_measure_accuracy()->set_view(1);
    measure.mutable_measure_accuracy()->set_estimate(true);
    client->send(measure);
    const auto replaced = reports(*client);
    ASSERT_FALSE(replaced.empty());
    EXPECT_EQ(replaced.back().stopped(), "measured anew");
    const auto report = client->waitFor([](const auto& one) { return one.has_accuracy_report(); });
    ASSERT_TRUE(report.has_value());
    EXPECT_TRUE(report->accuracy_report().done());
    EXPECT_TRUE(report->accuracy_report().estimated());
}

TEST_F(LiveDifference, EstimatesAreOfEachIntegrator) {
    const auto client = clientWithView();
    ASSERT_TRUE(client);
    client->look(1, 2, 0.4);
    ASSERT_TRUE(client->waitForLossless(1, 2).has_value());
    v1::ClientMessage measure;
    measure.mutable_measure_accuracy()->set_view(1);
    measure.mutable_measure_accuracy()->set_estimate(true);
    client->send(measure);
    const auto found = client->waitFor([](const auto& one) { return one.has_accuracy_report(); });
    ASSERT_TRUE(found.has_value());
    const v1::AccuracyReport& report = found->accuracy_report();
    EXPECT_EQ(report.stopped(), "");
    EXPECT_EQ(report.progress(), 1.0);
    ASSERT_EQ(report.rows_size(), 6);
    for (const v1::AccuracyRow& row : report.rows()) {
        EXPECT_GT(row.median_ms(), 0.0);
        EXPECT_EQ(row.evaluator(), v1::MESH_EVALUATOR_AUTO);
        EXPECT_FALSE(row.on_front());
    }
    EXPECT_EQ(report.rows(5).integrator(), v1::INTEGRATOR_EXACT);
    EXPECT_LT(report.rows(5).max_error(), 1e-4);
    EXPECT_GT(report.rows(0).max_error(), report.rows(5).max_error());
}

}  // namespace
}  // namespace volcast::test
