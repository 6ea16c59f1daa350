#include "renderer/scene/channels.h"

#include <cmath>

#include <gtest/gtest.h>

#include "renderer/scene/validate.h"

namespace volcast::scene {
namespace {

const data::TransferFunction kMap{{{.value = 0.0F}}};

data::DatasetSummary volume() {
    data::DatasetSummary summary;
    summary.isMesh = false;
    summary.fields = {{.name = "red", .unit = {}, .range = {}},
                      {.name = "green", .unit = {}, .range = {}}};
    return summary;
}

Layer layer() {
    Layer layer;
    layer.id = "main";
    layer.dataset = "data";
    layer.map = kMap;
    layer.channels = {{.field = "red", .map = kMap}, {.field = "green", .map = kMap}};
    return layer;
}

Error errorOf(const Layer& layer, const data::DatasetSummary& summary = volume()) {
    Scene scene;
    scene.layers = {layer};
    Result<void> valid = validate(scene);
    if (valid) valid = validate(scene, {{"data", summary}});
    if (valid) return {};
    EXPECT_NE(valid.error().message.find(valid.error().field), std::string::npos);
    return valid.error();
}

TEST(Channels, SeveralAreFine) {
    EXPECT_EQ(errorOf(layer()).message, "");
    for (const RayModel model : {RayModel::kMip, RayModel::kMinip, RayModel::kXray}) {
        Layer other = layer();
        other.model = model;
        EXPECT_EQ(errorOf(other).message, "");
    }
}

TEST(Channels, HiddenOnesAreNotShown) {
    Layer one = layer();
    one.channels[0].visible = false;
    ASSERT_EQ(shownChannels(one).size(), 1U);
    EXPECT_EQ(shownChannels(one)[0]->field, "green");
}

TEST(Channels, WrongCountsAndNamesAreNamed) {
    Layer wrong = layer();
    wrong.channels[1].field = "blue";
    EXPECT_EQ(errorOf(wrong).code, ErrorCode::kNotFound);
    EXPECT_EQ(errorOf(wrong).field, "layers[0].channels[1].field");
    EXPECT_NE(errorOf(wrong).message.find(R"("red", "green")"), std::string::npos);
    wrong.channels[1].field = "";
    EXPECT_EQ(errorOf(wrong).field, "layers[0].channels[1].field");
    wrong.channels[1].field = "red";
    EXPECT_EQ(errorOf(wrong).code, ErrorCode::kInvalidArgument);
    wrong.channels.assign(kMaxChannels + 1, {.field = "red", .map = kMap});
    EXPECT_EQ(errorOf(wrong).code, ErrorCode::kLimitExceeded);
    EXPECT_EQ(errorOf(wrong).field, "layers[0].channels");
    wrong = layer();
    wrong.channels[1].map.points.clear();
    EXPECT_EQ(errorOf(wrong).field, "layers[0].channels[1].transfer_function.points");
    data::DatasetSummary mesh = volume();
    mesh.isMesh = true;
    EXPECT_EQ(errorOf(layer(), mesh).field, "layers[0].channels");
}

TEST(Channels, EachHasAnIntervalOfFiniteNumbersInOrder) {
    Layer one = layer();
    one.light = Light{};
    one.channels[1].interval = data::Range{.min = 2.0F, .max = 2.0F};
    EXPECT_EQ(errorOf(one).message, "");
    for (const data::Range wrong :
         {data::Range{.min = 3.0F, .max = 2.0F}, data::Range{.min = std::nanf(""), .max = 2.0F},
          data::Range{.min = 0.0F, .max = HUGE_VALF}}) {
        one.channels[1].interval = wrong;
        EXPECT_EQ(errorOf(one).code, ErrorCode::kInvalidArgument);
        EXPECT_EQ(errorOf(one).field, "layers[0].channels[1].interval");
    }
}

TEST(Channels, WhatDrawsOneChannelSaysSo) {
    const auto fieldOf = [](const auto& change) {
        Layer wrong = layer();
        change(wrong);
        const Error error = errorOf(wrong);
        EXPECT_EQ(error.code, ErrorCode::kUnsupported) << error.message;
        return error.field;
    };
    EXPECT_EQ(fieldOf([](Layer& l) { l.model = RayModel::kSplat; }), "layers[0].channels");
    EXPECT_EQ(fieldOf([](Layer& l) { l.interval = data::Range{}; }), "layers[0].interval");
    EXPECT_EQ(fieldOf([](Layer& l) { l.shader.code = "void main() {}"; }), "layers[0].shader");
    EXPECT_EQ(fieldOf([](Layer& l) { l.voxelEvaluator = VoxelEvaluator::kSlices; }),
              "layers[0].voxel_evaluator");
}

}  // namespace
}  // namespace volcast::scene
