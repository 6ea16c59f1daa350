// Which integrator is chosen, and why.
#include "renderer/plan/method.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace volcast::plan {
namespace {

using scene::Accuracy;
using scene::Integrator;
using scene::RayModel;
using ::testing::HasSubstr;

class Choice : public ::testing::Test {
protected:
    [[nodiscard]] Method choose(Accuracy::Kind kind, double bound = 0.0) const {
        return chooseMethod(layer_, scene::row(layer_.model).integrators,
                            {.kind = kind, .bound = bound}, constant_, evidence_);
    }

    scene::Layer layer_;  // A volume.
    bool constant_ = false;
    std::vector<Evidence> evidence_{
        {.integrator = Integrator::kAverage, .predictedMs = 10.0, .error = 4.0},
        {.integrator = Integrator::kPsi, .predictedMs = 20.0, .error = 0.9},
        {.integrator = Integrator::kPreintegrated, .predictedMs = 15.0, .error = 0.5},
        {.integrator = Integrator::kExact, .predictedMs = 17.0, .error = 1e-4}};
};

TEST_F(Choice, ByName) {
    layer_.integrator = Integrator::kPsi;
    for (const auto kind : {Accuracy::Kind::kFastest, Accuracy::Kind::kErrorBound}) {
        EXPECT_EQ(choose(kind, 9.0).integrator, Integrator::kPsi);
    }
}

TEST_F(Choice, FastestAndExactAreTheEndsOfTheRegistry) {
    EXPECT_EQ(choose(Accuracy::Kind::kFastest).integrator, Integrator::kAverage);
    EXPECT_EQ(choose(Accuracy::Kind::kExact).integrator, Integrator::kExact);
    EXPECT_EQ(choose(Accuracy::Kind::kAuto).integrator, Integrator::kExact);
    layer_.model = RayModel::kXray;
    EXPECT_EQ(choose(Accuracy::Kind::kFastest).integrator, Integrator::kFront);
}

TEST_F(Choice, AnErrorBoundTakesTheCheapestThatHolds) {
    EXPECT_EQ(choose(Accuracy::Kind::kErrorBound, 5.0).integrator, Integrator::kAverage);
    const Method one = choose(Accuracy::Kind::kErrorBound, 1.0);
    EXPECT_EQ(one.integrator, Integrator::kPreintegrated) << "cheaper than psi, which holds too";
    EXPECT_THAT(one.reason, HasSubstr("0.5/255"));
    EXPECT_EQ(choose(Accuracy::Kind::kErrorBound, 0.01).integrator, Integrator::kExact);
    EXPECT_EQ(choose(Accuracy::Kind::kErrorBound, 1e-9).integrator, Integrator::kExact);
    evidence_.clear();
    EXPECT_EQ(choose(Accuracy::Kind::kErrorBound, 5.0).integrator, Integrator::kExact);
}

TEST_F(Choice, ATimeBudgetTakesTheMostAccurateThatFits) {
    EXPECT_EQ(choose(Accuracy::Kind::kTimeBudget, 100.0).integrator, Integrator::kExact);
    EXPECT_EQ(choose(Accuracy::Kind::kTimeBudget, 16.0).integrator, Integrator::kPreintegrated);
    EXPECT_EQ(choose(Accuracy::Kind::kTimeBudget, 12.0).integrator, Integrator::kAverage);
    const Method none = choose(Accuracy::Kind::kTimeBudget, 1.0);
    EXPECT_EQ(none.integrator, Integrator::kAverage);
    EXPECT_THAT(none.reason, HasSubstr("even it takes"));
    evidence_.clear();
    EXPECT_EQ(choose(Accuracy::Kind::kTimeBudget, 1.0).integrator, Integrator::kExact);
}

TEST_F(Choice, OneValueACellNeedsNothingDearer) {
    constant_ = true;
    EXPECT_EQ(choose(Accuracy::Kind::kExact).integrator, Integrator::kAverage);
    EXPECT_EQ(choose(Accuracy::Kind::kTimeBudget, 1.0).integrator, Integrator::kAverage);
}

TEST_F(Choice, EvidenceIsGatheredOnlyWhereItDecides) {
    EXPECT_FALSE(needsEvidence(layer_, {.kind = Accuracy::Kind::kAuto}));
    EXPECT_TRUE(needsEvidence(layer_, {.kind = Accuracy::Kind::kTimeBudget, .bound = 1.0}));
    layer_.integrator = Integrator::kPsi;
    EXPECT_FALSE(needsEvidence(layer_, {.kind = Accuracy::Kind::kTimeBudget, .bound = 1.0}));
    layer_.integrator = Integrator::kAuto;
    layer_.model = RayModel::kMip;
    EXPECT_FALSE(needsEvidence(layer_, {.kind = Accuracy::Kind::kErrorBound, .bound = 1.0}));
}

}  // namespace
}  // namespace volcast::plan
