// Code of users in a session: its description, and what a view does after code that failed.
#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "renderer/base/memfd.h"
#include "renderer/worker/scene_message.h"
#include "server/session/catalogue.h"
#include "server/session/shader_description.h"
#include "server/session/view_scene.h"

namespace volcast::session {
namespace {

/// Draws nothing: these tests say what was drawn.
class NoRender final : public workers::RenderService {
public:
    void addDataset(const std::string&, base::FileDescriptor) override {}
    void removeDataset(const std::string&) override {}
    void submit(workers::RenderRequest) override {}
    void measure(workers::MeasureRequest) override {}
    void stopMeasuring(std::uint64_t) override {}
    void pick(workers::PickRequest) override {}
    void dropView(std::uint64_t) override {}
    [[nodiscard]] workers::RenderStatus status() const override { return {}; }
};

v1::ShaderDescription described(const std::string& code, const scene::Summaries& summaries = {}) {
    v1::DescribeShader message;
    message.set_request(7);
    message.set_code(code);
    message.set_dataset("d");
    return shaderDescription(message, summaries);
}

TEST(ShaderDescription, ListsControlsWithTheirDefaults) {
    const auto description = described(
        "#uicontrol float s slider(min=-1, max=1)\n#uicontrol vec3 c color(default=\"red\")\n"
        "#uicontrol bool b checkbox(default=true)\n"
        "#uicontrol string_t o select(options={\"A\": \"x\", \"B\": \"y\"}, default=\"y\")\n"
        "#uicontrol invlerp n(range=[9, 1], channel=2)\n#uicontrol transferFunction t\n"
        "void main() {}\n");
    EXPECT_EQ(description.request(), 7U);
    EXPECT_TRUE(description.complaints().empty());
    ASSERT_EQ(description.controls_size(), 6);
    EXPECT_EQ(description.controls(0).name(), "s");
    EXPECT_EQ(description.controls(0).slider().type(), "float");
    EXPECT_EQ(description.controls(0).slider().min(), -1.0);
    EXPECT_EQ(description.controls(0).slider().step(), 0.02);
    EXPECT_EQ(description.controls(1).color().r(), 1.0F);
    EXPECT_TRUE(description.controls(2).checkbox());
    EXPECT_EQ(description.controls(3).select().options(1).label(), "B");
    EXPECT_EQ(description.controls(3).select().options(1).text(), "y");
    EXPECT_EQ(description.controls(3).select().initial(), 1U);
    EXPECT_EQ(description.controls(4).line(), 5U);
    EXPECT_EQ(description.controls(4).invlerp().range().min(), 9.0) << "inverted";
    EXPECT_EQ(description.controls(4).invlerp().window().min(), 1.0) << "in order";
    EXPECT_EQ(description.controls(4).invlerp().channel(), 2);
    EXPECT_EQ(description.controls(5).transfer_function().points_size(), 2);
    EXPECT_EQ(description.controls(5).transfer_function().window().max(), 1.0);
}

TEST(ShaderDescription, RangesAreThoseOfTheDatasetsType) {
    data::DatasetSummary summary;
    summary.voxelType = data::VoxelType::kI16;
    const auto description = described("#uicontrol invlerp n\nvoid main() {}", {{"d", summary}});
    ASSERT_EQ(description.controls_size(), 1);
    EXPECT_EQ(description.controls(0).invlerp().range().min(), -32768.0);
    EXPECT_EQ(description.controls(0).invlerp().range().max(), 32767.0);
}

TEST(ShaderDescription, ComplaintsHaveTheUsersPlace) {
    const auto description = described("#uicontrol float s slider(min=2, max=1)\nvoid main() {}");
    EXPECT_TRUE(description.controls().empty());
    ASSERT_EQ(description.complaints_size(), 1);
    EXPECT_EQ(description.complaints(0).line(), 1U);
    EXPECT_EQ(description.complaints(0).column(), 31U);
    EXPECT_EQ(description.complaints(0).message(), "min must not be above max: 2 to 1");
}

/// A view of a volume that is there, whose scenes differ in code and in one control.
class CodeOfAView : public ::testing::Test {
protected:
    void SetUp() override {
        CatalogueDesc desc;
        desc.importer = [](const workers::ImportRequest&, const workers::ImportSettings&,
                           const std::function<void(const std::string&, double)>&)
            -> Result<workers::ImportedDataset> {
            workers::ImportedDataset imported;
            imported.packed = *base::createMemfd("cube", 1);
            imported.summary.isMesh = false;
            imported.summary.bounds = {.min = glm::dvec3{0.0}, .max = glm::dvec3{1.0}};
            imported.summary.voxels = glm::ivec3{4};
            imported.summary.spacing = glm::dvec3{0.25};
            data::FieldSummary field;
            field.name = "f";
            field.range = {.min = 0.0F, .max = 1.0F};
            imported.summary.fields.push_back(field);
            return imported;
        };
        catalogue_ = *Catalogue::create(std::move(desc), render_);
        view_ = std::make_unique<ViewScene>(*catalogue_);
        v1::OpenView message;
        message.set_dataset("demo:volume");
        message.set_input_seq(1);
        message.mutable_viewport()->set_width(64);
        message.mutable_viewport()->set_height(64);
        ASSERT_TRUE(view_->open(message));
        const auto until = std::chrono::steady_clock::now() + std::chrono::seconds{30};
        while (!view_->scene() && std::chrono::steady_clock::now() < until) {
            std::this_thread::sleep_for(std::chrono::milliseconds{1});
            ASSERT_TRUE(view_->datasetChanged("demo:volume"));
        }
        ASSERT_TRUE(view_->scene());
        view_->drawn(1);
    }

    void show(const std::string& code, double control = 0.5) {
        scene::Scene scene = *view_->scene();
        scene.layers[0].shader = {};
        scene.layers[0].visible = true;
        if (!code.empty()) {
            scene.layers[0].shader = {.code = "#uicontrol float s slider(min=0, max=1)\n" + code,
                                      .controls = {{.name = "s", .value = control}}};
        }
        v1::Update message;
        message.set_input_seq(++seq_);
        *message.mutable_scene() = worker::toMessage(scene);
        const auto change = view_->update(message);
        ASSERT_TRUE(change) << change.error().message;
    }
    void look() {
        v1::Update message;
        message.set_input_seq(++seq_);
        scene::Scene scene = *view_->scene();
        scene.camera.eye.x += 1.0;
        *message.mutable_camera() = worker::toMessage(scene).camera();
        ASSERT_TRUE(view_->update(message));
    }
    [[nodiscard]] const scene::Layer& layer() const { return view_->scene()->layers[0]; }
    [[nodiscard]] double control() const {
        return std::get<double>(layer().shader.controls[0].value);
    }

    NoRender render_;
    std::unique_ptr<Catalogue> catalogue_;
    std::unique_ptr<ViewScene> view_;
    std::uint64_t seq_ = 1;
};

constexpr const char* kA = "void main() { emitRGB(vec3(s)); }";
constexpr const char* kB = "void main() { emitGrayscale(s); }";

TEST_F(CodeOfAView, GoesBackToTheControlsThatWereDrawnLast) {
    show(kA, 0.25);
    view_->drawn(seq_);
    show(kA, 0.75);
    look();
    const scene::Camera camera = view_->scene()->camera;
    EXPECT_TRUE(view_->revert());
    EXPECT_EQ(control(), 0.25);
    EXPECT_EQ(view_->scene()->camera, camera) << "seen from where the person is now";
}

TEST_F(CodeOfAView, GoesBackToWhatWasBeforeCodeThatFailsLater) {
    show(kA, 0.25);
    view_->drawn(seq_);
    show(kA, 0.75);
    view_->drawn(seq_);
    look();
    view_->drawn(seq_);
    look();
    EXPECT_TRUE(view_->revert());
    EXPECT_EQ(layer().shader, scene::UserShader{}) << "the map, as before the code";
    EXPECT_TRUE(layer().visible);
    EXPECT_FALSE(view_->revert()) << "no code runs now";
}

TEST_F(CodeOfAView, CodesThatFailOneAfterTheOtherEndWithoutCode) {
    show(kA);
    view_->drawn(seq_);
    show(kB);
    view_->drawn(seq_);
    EXPECT_TRUE(view_->revert());
    EXPECT_NE(layer().shader.code.find("emitRGB"), std::string::npos) << "the code before";
    EXPECT_TRUE(view_->revert()) << "that fails now, too";
    EXPECT_FALSE(layer().visible);
    EXPECT_FALSE(view_->revert());
}

TEST_F(CodeOfAView, CodeThatNeverDrewIsTakenBackToTheMap) {
    show(kA);
    EXPECT_TRUE(view_->revert());
    EXPECT_EQ(layer().shader, scene::UserShader{});
}

}  // namespace
}  // namespace volcast::session
