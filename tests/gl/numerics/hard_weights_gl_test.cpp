// The rows of hard_cases.csv that are about one formula: psi, its invariants, opacity correction.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/support/gl_test.h"
#include "tests/support/numerics/hard_cases.h"
#include "tests/support/numerics/weights_probe.h"

namespace volcast {
namespace {

using support::after;
using support::allowed;
using support::Row;
using support::rowsOf;

glm::vec2 depthsOf(const Row& row) {
    const std::string input = row[1] + " " + row[2];
    if (input.find("tau_f*D=") != std::string::npos) {
        return {static_cast<float>(after(input, "tau_f*D=")),
                static_cast<float>(after(input, "tau_b*D="))};
    }
    const auto length = static_cast<float>(after(input, " D="));
    return {static_cast<float>(after(input, "tau_f=")) * length,
            static_cast<float>(after(input, "tau_b=")) * length};
}

class HardWeights : public support::GlTest {
protected:
    static std::vector<glm::vec3> run(const std::string& chunk,
                                      const std::vector<glm::vec2>& pairs) {
        return support::must(support::must(support::WeightsProbe::create(device(), chunk))(pairs));
    }
    static std::vector<glm::vec2> psiDepths() {
        std::vector<glm::vec2> pairs;
        for (const Row& row : rowsOf("psi")) pairs.push_back(depthsOf(row));
        return pairs;
    }
};

TEST_F(HardWeights, Psi) {
    const auto rows = rowsOf("psi");
    ASSERT_EQ(rows.size(), 32U);
    const auto answers = run("weights_psi.glsl", psiDepths());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Row& row = rows[i];
        const double front = after(row[3], "w_front=");
        const double back = after(row[3], "w_back=");
        const double alpha = after(row[3], "alpha=");
        EXPECT_NEAR(answers[i].x, front, allowed(row[4], front)) << row[1] << row[2];
        EXPECT_NEAR(answers[i].y, back, allowed(row[4], back)) << row[1] << row[2];
        if (std::isnan(alpha)) continue;
        EXPECT_NEAR(answers[i].z, alpha, allowed(row[4], alpha)) << row[1] << row[2];
    }
}

TEST_F(HardWeights, Invariants) {
    const auto rows = rowsOf("invariant");
    ASSERT_EQ(rows.size(), 3U);
    ASSERT_EQ(rows[0][1] + rows[1][1] + rows[2][1], "sumpositivitysplit");
    const auto depths = psiDepths();
    const auto whole = run("weights_psi.glsl", depths);
    for (std::size_t i = 0; i < whole.size(); ++i) {
        const double front = whole[i].x, back = whole[i].y, alpha = whole[i].z;
        const double depth =
            0.5 * static_cast<double>(depths[i].x) + 0.5 * static_cast<double>(depths[i].y);
        EXPECT_NEAR(front + back, -std::expm1(-depth), 0x1p-23) << depths[i].x;
        EXPECT_TRUE(front >= 0.0 && back >= 0.0) << depths[i].x << ' ' << depths[i].y;
        EXPECT_TRUE(3.0 * back <= 2.0 * alpha && 3.0 * front >= alpha) << depths[i].x;
    }
    // Colours 1 in front and 1/4 at the back. Depths of the halves round by 2^-24 each.
    for (const float s : {0.125F, 0.5F, 0.9F}) {
        std::vector<glm::vec2> halves;
        for (const glm::vec2& d : depths) {
            const float middle = d.x * (1.0F - s) + d.y * s;
            halves.emplace_back(d.x * s, middle * s);
            halves.emplace_back(middle * (1.0F - s), d.y * (1.0F - s));
        }
        const auto parts = run("weights_psi.glsl", halves);
        for (std::size_t i = 0; i < whole.size(); ++i) {
            const auto light = [](const glm::vec3& w, double front, double back) {
                return static_cast<double>(w.x) * front + static_cast<double>(w.y) * back;
            };
            const double middle = 1.0 - 0.75 * static_cast<double>(s);
            const double left = 1.0 - static_cast<double>(parts[2 * i].z);
            const double split =
                light(parts[2 * i], 1.0, middle) + left * light(parts[2 * i + 1], middle, 0.25);
            const double one = light(whole[i], 1.0, 0.25);
            EXPECT_NEAR(split, one, 1e-5 * one + 1e-36) << s << ": " << depths[i].x;
        }
    }
}

TEST_F(HardWeights, OpacityCorrection) {
    const auto rows = rowsOf("opacity correction");
    ASSERT_EQ(rows.size(), 12U);
    std::vector<glm::vec2> pairs;
    for (const Row& row : rows) {
        pairs.emplace_back(static_cast<float>(after(row[1], "a=float32(")),
                           static_cast<float>(after(row[1], "r=float32(")));
    }
    const auto answers = run("corrected_opacity.glsl", pairs);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const double right = std::stod(rows[i][3]);
        EXPECT_NEAR(answers[i].x, right, allowed(rows[i][4], right)) << rows[i][1];
    }
}

}  // namespace
}  // namespace volcast
