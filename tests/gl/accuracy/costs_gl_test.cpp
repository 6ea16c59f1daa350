// What is predicted of the walk, and the file that it is kept in.
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "renderer/accuracy/evidence.h"
#include "renderer/scene/ray_models.h"
#include "tests/support/render_test.h"
#include "tests/support/temporary_folder.h"

namespace volcast::accuracy {
namespace {

using scene::Integrator;
using scene::RayModel;
using support::must;

class CostsTest : public support::RenderTest {
protected:
    /// Frames drawn to know the costs of `model`.
    std::uint64_t framesFor(RayModel model, const std::string& machine = "this one") {
        Costs costs{file(), machine};
        const std::uint64_t before = renderer_->counters().framesDrawn;
        must(costs.prepare(*renderer_, model));
        const std::uint64_t frames = renderer_->counters().framesDrawn - before;
        for (const scene::IntegratorRow& row : scene::row(model).integrators) {
            const Costs::Key key{model, row.integrator};
            EXPECT_GT(costs.predictMs(key, {64, 64}, 10.0), 0.0);
            EXPECT_GT(costs.predictMs(key, {512, 512}, 10.0), costs.predictMs(key, {64, 64}, 10.0));
        }
        return frames;
    }
    [[nodiscard]] std::string file() const { return folder_.path() / "costs.txt"; }

    support::TemporaryFolder folder_;
};

TEST_F(CostsTest, AreMeasuredOnceForEachModelAndMachine) {
    EXPECT_GT(framesFor(RayModel::kMipColour), 0U);
    EXPECT_EQ(framesFor(RayModel::kMipColour), 0U);
    EXPECT_GT(framesFor(RayModel::kXray), 0U);
    // Both are kept.
    EXPECT_EQ(framesFor(RayModel::kMipColour), 0U);
    EXPECT_EQ(framesFor(RayModel::kXray), 0U);
    EXPECT_GT(framesFor(RayModel::kXray, "another"), 0U);
}

TEST_F(CostsTest, OfADamagedFileAreMeasuredAgain) {
    framesFor(RayModel::kMipColour);
    std::ifstream whole{file()};
    std::string text{std::istreambuf_iterator<char>{whole}, {}};
    text.replace(text.rfind(' '), std::string::npos, " -1\n");
    std::ofstream{file()} << text;
    EXPECT_GT(framesFor(RayModel::kMipColour), 0U);
}

}  // namespace
}  // namespace volcast::accuracy
