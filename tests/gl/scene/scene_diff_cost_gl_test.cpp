// What each kind of change costs: an unchanged part is not uploaded, compiled or drawn again.
#include "tests/support/phantoms.h"
#include "tests/support/render_test.h"

namespace volcast {
namespace {

using scene::RayModel;
using support::must;

constexpr scene::PictureSize kSize{24, 16};

/// A mesh-free scene of two volumes; `volume` has two channels.
class SceneDiffCost : public support::RenderTest {
protected:
    SceneDiffCost() {
        data::VolumeInput input;
        input.size = {20, 20, 20};
        std::vector<float> rising(8000), falling(8000);
        for (std::size_t i = 0; i < 8000; ++i) {
            rising[i] = static_cast<float>(i) / 8000.0F;
            falling[i] = 1.0F - rising[i];
        }
        for (const auto& [name, values] : {std::pair{"rising", &rising}, {"falling", &falling}}) {
            data::ChannelInput channel{.name = name, .unit = "", .voxels = {}};
            const auto bytes = std::as_bytes(std::span{*values});
            channel.voxels.assign(bytes.begin(), bytes.end());
            input.channels.push_back(std::move(channel));
        }
        volume_ = must(data::buildVolume(std::move(input)));
        renderer_->addDataset("volume", volume_);
        scene::Layer layer;
        layer.id = "layer";
        layer.dataset = "volume";
        layer.field = "rising";
        layer.map.points = {{.value = 0.2F, .colour = {1, 0, 0}, .extinction = 0.0F},
                            {.value = 0.9F, .colour = {0, 1, 0}, .extinction = 0.3F}};
        scene_.layers.push_back(layer);
        scene_.camera = {.eye = {50, 40, 60}, .center = {9.5, 9.5, 9.5}};
    }

    scene::FrameInfo drawn(std::uint64_t view = 1) { return draw(scene_, kSize, view).info; }

    data::Volume volume_;
    scene::Scene scene_;
};

TEST_F(SceneDiffCost, TheFirstPictureBringsEverythingOnce) {
    const auto info = drawn();
    EXPECT_TRUE(info.drawn);
    EXPECT_EQ(info.work.textureUploads, 1U) << "voxels";
    EXPECT_EQ(info.work.bufferUploads, 3U) << "the empty space, the map and the blocks";
    EXPECT_EQ(info.work.programsBuilt, 2U) << "the march and the resolve";
    EXPECT_EQ(info.work.drawCalls, 2U);
    EXPECT_EQ(info.work.framesDrawn, 1U);
}

TEST_F(SceneDiffCost, NothingChangedCostsNothing) {
    const auto first = draw(scene_, kSize);
    const auto again = draw(scene_, kSize);
    EXPECT_FALSE(again.info.drawn);
    EXPECT_EQ(again.info.work.bufferUploads, 0U);
    EXPECT_EQ(again.info.work.textureUploads, 0U);
    EXPECT_EQ(again.info.work.programsBuilt, 0U);
    EXPECT_EQ(again.info.work.drawCalls, 0U);
    EXPECT_EQ(again.info.work.framesDrawn, 0U);
    EXPECT_EQ(again.bytes, first.bytes);
    EXPECT_EQ(again.linear, first.linear);
}

TEST_F(SceneDiffCost, ACameraMoveIsOneSmallUpload) {
    drawn();
    scene_.camera.eye.x += 1.0;
    const auto info = drawn();
    EXPECT_EQ(info.work.bufferUploads, 1U);
    EXPECT_LE(info.work.uploadedBytes, 512U);
    EXPECT_EQ(info.work.textureUploads, 0U);
    EXPECT_EQ(info.work.programsBuilt, 0U);
    EXPECT_EQ(info.work.drawCalls, 2U);
}

TEST_F(SceneDiffCost, AMapEditIsOneTable) {
    drawn();
    scene_.layers[0].map.points[1].colour.b = 0.4F;
    const auto info = drawn();
    EXPECT_EQ(info.work.bufferUploads, 1U);
    // Heads of both maps, sections, and three texels for each of the 3 pieces.
    EXPECT_LE(info.work.uploadedBytes, (28U + 3U * 3U) * 16U);
    EXPECT_EQ(info.work.textureUploads, 0U);
    EXPECT_EQ(info.work.programsBuilt, 0U);
}

TEST_F(SceneDiffCost, AFieldSwitchIsItsVoxelsTheFirstTimeAndNothingLater) {
    drawn();
    scene_.layers[0].field = "falling";
    auto info = drawn();
    EXPECT_EQ(info.work.textureUploads, 1U) << "voxels of the other channel";
    EXPECT_EQ(info.work.bufferUploads, 2U) << "its empty space, and the blocks with its box";
    EXPECT_EQ(info.work.programsBuilt, 0U);
    scene_.layers[0].field = "rising";
    info = drawn();
    EXPECT_TRUE(info.drawn);
    EXPECT_EQ(info.work.textureUploads, 0U);
}

TEST_F(SceneDiffCost, AModelSwitchIsAProgramTheFirstTimeAndNothingLater) {
    drawn();
    scene_.layers[0].model = RayModel::kMip;
    auto info = drawn();
    EXPECT_EQ(info.work.programsBuilt, 1U);
    EXPECT_EQ(info.work.bufferUploads, 2U) << "the ranges that extremes follow, and the blocks";
    EXPECT_EQ(info.work.textureUploads, 0U);
    scene_.layers[0].model = RayModel::kVolume;
    info = drawn();
    EXPECT_TRUE(info.drawn);
    EXPECT_EQ(info.work.programsBuilt, 0U);
    EXPECT_EQ(info.work.bufferUploads, 1U) << "the blocks";
}

// Ranges of blocks and empty space are there for the samplings and models that read them.
TEST_F(SceneDiffCost, BlocksOfVoxelsAreUploadedAsSamplesAskForThem) {
    const auto buffers = [&](const char* what, std::size_t blocksAndMap, std::size_t ofVoxels) {
        const auto work = drawn().work;
        EXPECT_EQ(work.bufferUploads, blocksAndMap + ofVoxels) << what;
    };
    scene::Layer& layer = scene_.layers[0];
    const auto sparse = layer.map;
    layer.map.points = {{.value = 0.5F, .extinction = 0.1F}};
    buffers("nothing is empty", 2, 0);
    layer.model = RayModel::kSplat;
    buffers("every value adds", 0, 0);
    layer.model = RayModel::kMip;
    buffers("ranges of trilinear values", 0, 1);
    layer.sampling = scene::Sampling::kNearest;
    buffers("nearest values have the same", 0, 0);
    layer.sampling = scene::Sampling::kTricubic;
    buffers("ranges of tricubic values", 0, 1);
    layer.model = RayModel::kMinip;
    buffers("which minima follow too", 0, 0);
    layer.model = RayModel::kVolume;
    layer.sampling = scene::Sampling::kTrilinear;
    layer.map = sparse;
    buffers("empty space, its box and the map", 2, 1);
    layer.voxelEvaluator = scene::VoxelEvaluator::kSlices;
    buffers("slices pass over nothing; their planes, the blocks without the box", 1, 1);
}

TEST_F(SceneDiffCost, ABackgroundEditOnlyResolvesAgain) {
    drawn();
    scene_.background = {0.5F, 0.5F, 0.5F, 1.0F};
    const auto info = drawn();
    EXPECT_EQ(info.work.bufferUploads, 1U);
    EXPECT_LE(info.work.uploadedBytes, 16U);
    EXPECT_EQ(info.work.drawCalls, 1U);
}

TEST_F(SceneDiffCost, AHiddenOrTransparentLayerIsNeitherUploadedNorDrawn) {
    scene_.layers[0].visible = false;
    auto info = drawn();
    EXPECT_EQ(info.work.textureUploads, 0U);
    EXPECT_EQ(info.work.drawCalls, 1U) << "the resolve";
    scene_.layers[0].visible = true;
    scene_.layers[0].map.points = {{.value = 0.0F, .extinction = 0.0F}};
    info = drawn();
    EXPECT_TRUE(info.drawn);
    EXPECT_EQ(info.work.textureUploads, 0U);
    EXPECT_EQ(info.work.drawCalls, 1U);
}

TEST_F(SceneDiffCost, ViewsShareDataAndPrograms) {
    drawn(1);
    const auto info = drawn(2);
    EXPECT_TRUE(info.drawn);
    EXPECT_EQ(info.work.textureUploads, 0U);
    EXPECT_EQ(info.work.programsBuilt, 0U);
    EXPECT_EQ(info.work.bufferUploads, 3U) << "a view's own map, empty space and blocks";
    EXPECT_FALSE(drawn(1).drawn) << "another view's picture is not this one's";
    renderer_->dropView(1);
    EXPECT_TRUE(drawn(1).drawn);
}

TEST_F(SceneDiffCost, OtherDataUnderTheSameNameIsDrawnAgain) {
    const auto before = draw(scene_, kSize);
    renderer_->addDataset("volume", support::volumeOf({.size = {20, 20, 20}}, [](const auto& p) {
                              return p.x > 9 ? 1.0 : 0.0;
                          }));
    scene_.layers[0].field = "";
    const auto after = draw(scene_, kSize);
    EXPECT_TRUE(after.info.drawn);
    EXPECT_NE(after.linear, before.linear);
    renderer_->removeDataset("volume");
    const auto gone = tryDraw(*renderer_, scene_, kSize);
    ASSERT_TRUE(gone.has_error());
    EXPECT_EQ(gone.error().code, ErrorCode::kNotFound);
}

TEST_F(SceneDiffCost, ARefusedSceneLeavesTheViewAsItWas) {
    const auto good = draw(scene_, kSize);
    scene::Scene bad = scene_;
    bad.layers[0].field = "gone";
    EXPECT_TRUE(tryDraw(*renderer_, bad, kSize).has_error());
    bad = scene_;
    bad.camera.eye.x = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(tryDraw(*renderer_, bad, kSize).has_error());
    EXPECT_TRUE(tryDraw(*renderer_, scene_, {0, 4}).has_error());
    EXPECT_TRUE(tryDraw(*renderer_, scene_, {8193, 4}).has_error());
    const auto again = draw(scene_, kSize);
    EXPECT_FALSE(again.info.drawn);
    EXPECT_EQ(again.bytes, good.bytes);
}

TEST_F(SceneDiffCost, ADrawThatFailsLeavesTheLastPictureReadable) {
    const auto breakable = must(
        scene::Renderer::create(device(), [](std::string_view path) -> std::optional<std::string> {
            if (path == "model/mip.glsl") return "this is no GLSL";
            return shading::embeddedChunks()(path);
        }));
    breakable->addDataset("volume", volume_);
    const auto good = must(tryDraw(*breakable, scene_, kSize));
    scene::Scene broken = scene_;
    broken.layers[0].model = RayModel::kMip;
    for (const scene::PictureSize size : {kSize, scene::PictureSize{9, 9}}) {
        const auto failed = tryDraw(*breakable, broken, size);
        ASSERT_TRUE(failed.has_error());
        EXPECT_EQ(failed.error().code, ErrorCode::kShaderBuild);
        const auto again = must(tryDraw(*breakable, scene_, kSize));
        EXPECT_EQ(again.bytes, good.bytes);
        EXPECT_EQ(again.linear, good.linear);
    }
}

TEST_F(SceneDiffCost, AnotherSizeDrawsAgainAndUploadsNoData) {
    drawn();
    const auto larger = draw(scene_, {40, 30});
    EXPECT_TRUE(larger.info.drawn);
    EXPECT_EQ(larger.info.work.textureUploads, 0U);
    EXPECT_EQ(larger.info.work.bufferUploads, 1U);
    EXPECT_EQ(larger.info.work.programsBuilt, 0U);
}

// State is host-side: a new device gives the same picture to the bit.
TEST_F(SceneDiffCost, ALostDeviceIsReplacedAndGivesTheSamePicture) {
    std::vector<std::byte> expected, repeated;
    std::thread{[&] {
        for (std::vector<std::byte>* picture : {&expected, &repeated}) {
            const auto own = must(gpu::Device::create());
            const auto renderer = must(scene::Renderer::create(*own, shading::embeddedChunks()));
            renderer->addDataset("volume", volume_);
            *picture = must(tryDraw(*renderer, scene_, kSize)).bytes;
            own->abandon();
            const auto lost = tryDraw(*renderer, scene_, kSize);
            ASSERT_TRUE(lost.has_error());
            EXPECT_EQ(lost.error().code, ErrorCode::kDeviceLost);
        }
    }}.join();
    EXPECT_EQ(repeated, expected);
    EXPECT_EQ(draw(scene_, kSize).bytes, expected);
}

}  // namespace
}  // namespace volcast
