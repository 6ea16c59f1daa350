#include "renderer/data/transfer_function.h"

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace volcast::data {
namespace {

const TransferFunction kMap{{{.value = 0.0F, .colour = {1.0F, 0.0F, 0.0F}, .extinction = 0.0F},
                             {.value = 2.0F, .colour = {0.0F, 1.0F, 0.0F}, .extinction = 4.0F}}};

TEST(TransferFunction, IsLinearBetweenItsPoints) {
    const glm::vec4 quarter = evaluate(kMap, 0.5F);
    EXPECT_FLOAT_EQ(quarter.r, 0.75F);
    EXPECT_FLOAT_EQ(quarter.g, 0.25F);
    EXPECT_FLOAT_EQ(quarter.a, 1.0F);
}

TEST(TransferFunction, IsClampedOutside) {
    EXPECT_EQ(evaluate(kMap, -5.0F), evaluate(kMap, 0.0F));
    EXPECT_EQ(evaluate(kMap, 7.0F), evaluate(kMap, 2.0F));
}

TEST(TransferFunction, TwoEqualValuesMakeAStep) {
    const TransferFunction step{{{.value = 0.0F, .colour = {}, .extinction = 1.0F},
                                 {.value = 1.0F, .colour = {}, .extinction = 1.0F},
                                 {.value = 1.0F, .colour = {}, .extinction = 3.0F},
                                 {.value = 2.0F, .colour = {}, .extinction = 3.0F}}};
    ASSERT_TRUE(validate(step));
    EXPECT_FLOAT_EQ(evaluate(step, 0.999F).a, 1.0F);
    EXPECT_FLOAT_EQ(evaluate(step, 1.001F).a, 3.0F);
    EXPECT_FLOAT_EQ(evaluate(step, 1.0F).a, 3.0F);
}

TEST(TransferFunction, ValidationNamesThePointAtFault) {
    EXPECT_EQ(validate(TransferFunction{}).error().code, ErrorCode::kInvalidArgument);
    TransferFunction map = kMap;
    map.points[1].value = -1.0F;
    EXPECT_EQ(validate(map).error().field, "points[1].value");
    map = kMap;
    map.points[0].colour.g = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(validate(map).error().field, "points[0]");
    map = kMap;
    map.points[1].extinction = -1.0F;
    EXPECT_EQ(validate(map).error().field, "points[1].extinction");
    map.points.assign(TransferFunction::kMaxPoints + 1, kMap.points[0]);
    EXPECT_EQ(validate(map).error().code, ErrorCode::kLimitExceeded);
}

TEST(TransferFunction, TextIsReadWithCommentsAndBlankLines) {
    const auto map = parseTransferFunction("# a map\n\n 0 1 0 0 0\r\n2 0 1 0 4 # the end");
    ASSERT_TRUE(map) << map.error().message;
    EXPECT_EQ(*map, kMap);
}

TEST(TransferFunction, TextAtFaultIsNamedByItsLine) {
    for (const char* text : {"0 1 0 0 0\n1 2 3\n", "0 1 0 0 0\n1 2 3 4 five", "\n0 1 0 0 0 9",
                             "0 1 0 0 0\n-1 0 0 0 0"}) {
        const auto map = parseTransferFunction(text);
        ASSERT_FALSE(map) << text;
        EXPECT_NE(map.error().message.find("line 2"), std::string::npos) << map.error().message;
    }
    EXPECT_FALSE(parseTransferFunction("# nothing\n"));
}

TEST(TransferFunction, DefaultIsHalfOpaqueThroughTheMiddle) {
    const double length = 7.0;
    const TransferFunction map = defaultTransferFunction({.min = -2.0F, .max = 6.0F}, length);
    ASSERT_TRUE(validate(map));
    EXPECT_NEAR(std::exp(-evaluate(map, 2.0F).a * length), 0.5, 1e-6);
    EXPECT_EQ(evaluate(map, -2.0F).a, 0.0F);
}

TEST(TransferFunction, DefaultIsValidForEveryRange) {
    constexpr float kLargest = std::numeric_limits<float>::max();
    for (const Range range : {Range{1.0F, 1.0F}, Range{-kLargest, kLargest}, Range{0.0F, 1e-45F}}) {
        for (const double length : {0.0, 1e-300, 1e300, std::nan("")}) {
            EXPECT_TRUE(validate(defaultTransferFunction(range, length)));
        }
    }
}

}  // namespace
}  // namespace volcast::data
