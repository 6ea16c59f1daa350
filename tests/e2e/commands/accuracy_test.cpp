#include <algorithm>
#include <map>
#include <set>

#include <boost/json.hpp>

#include "renderer/scene/ray_models.h"
#include "tests/e2e/commands/program.h"

namespace volcast::test {
namespace {

namespace json = boost::json;

Outcome measure(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"accuracy", "demo:mesh"});
    return runVolcast(arguments);
}

std::string textOf(const json::object& row, const char* key) {
    return std::string{row.at(key).as_string()};
}

double rmsOf(const json::object& row) {
    return row.at("error").as_object().at("rms").to_number<double>();
}

TEST(AccuracyCommand, MeasuresEveryModelWithAllThatServesIt) {
    const Folder folder;
    const Outcome run = measure({"--size", "48", "40", "--frames", "1", "--json",
                                 folder.file("a.json"), "--svg", folder.file("a.svg")});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    const json::value all = json::parse(contentOf(folder.file("a.json")));
    std::map<std::string, std::set<std::string>> integrators;
    for (const json::value& value : all.at("rows").as_array()) {
        const json::object& row = value.as_object();
        ASSERT_TRUE(row.contains("error")) << json::serialize(row);
        integrators[textOf(row, "model")].insert(textOf(row, "integrator"));
        EXPECT_EQ(row.at("error").as_object().at("pixels").to_number<int>(), 48 * 40);
        EXPECT_GT(row.at("median_ms").to_number<double>(), 0.0);
        EXPECT_GT(row.at("cells_per_ray").to_number<double>(), 0.0);
        const std::string evaluator = textOf(row, "evaluator");
        EXPECT_EQ(row.contains("walk_steps"), evaluator == "walk") << json::serialize(row);
        const bool projected = evaluator.starts_with("projection");
        ASSERT_EQ(row.contains("cells_drawn"), projected) << json::serialize(row);
        if (projected) {  // Of an isosurface only the cells that meet the level.
            const bool some = textOf(row, "model") == "isosurface";
            EXPECT_EQ(row.at("cells_drawn") != all.at("cells"), some) << json::serialize(row);
        }
        EXPECT_NE(run.out.find(textOf(row, "integrator")), std::string::npos);
    }
    const json::value& reference = all.at("reference");
    // One picture a model; each ray's neighbours are looked along, too.
    EXPECT_GT(reference.at("rays").to_number<double>(),
              48.0 * 40.0 * static_cast<double>(integrators.size()));
    EXPECT_GT(reference.at("us_per_ray").to_number<double>(), 0.0);
    EXPECT_GT(reference.at("tree_ms").to_number<double>(), 0.0);
    EXPECT_NE(run.out.find("reference: "), std::string::npos);
    for (const scene::RayModelRow& model : scene::rayModels()) {
        if (!model.onMeshes) continue;
        EXPECT_EQ(integrators[std::string{model.name}].size(), model.integrators.size())
            << model.name;
    }
    EXPECT_NE(run.out.find("volcast accuracy demo:mesh --size 48 40"), std::string::npos)
        << run.out;
    const std::string svg = contentOf(folder.file("a.svg"));
    EXPECT_EQ(svg.rfind("<svg ", 0), 0U);
    EXPECT_NE(svg.find("median time of a frame [ms]"), std::string::npos);
    // Every row is a mark with its numbers, every element ends.
    const auto count = [&svg](const std::string& text) {
        std::size_t found = 0;
        for (auto at = svg.find(text); at != std::string::npos; at = svg.find(text, at + 1))
            ++found;
        return found;
    };
    EXPECT_EQ(count("<title>"), all.at("rows").as_array().size());
    EXPECT_EQ(count("<text"), count("</text>"));
    EXPECT_EQ(count("<g>"), count("</g>"));
}

TEST(AccuracyCommand, ExactIsNeverWorseThanTheOthers) {
    const Folder folder;
    const Outcome run = measure({"--size", "40", "40", "--frames", "1", "--evaluator", "walk",
                                 "--model", "volume", "--model", "splat", "--model", "mip_colour",
                                 "--sample", "all", "--json", folder.file("a.json")});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    const json::value all = json::parse(contentOf(folder.file("a.json")));
    std::map<std::string, double> exact;
    for (const json::value& row : all.at("rows").as_array()) {
        if (textOf(row.as_object(), "integrator") == "exact") {
            exact[textOf(row.as_object(), "model")] = rmsOf(row.as_object());
        }
    }
    ASSERT_EQ(exact.size(), 3U);
    // Where another one is exact for this data too, both are off by rounding alone: float32 has
    // 2^-24 a step, and rays here take less than 100.
    const double rounding = 100.0 * 0x1p-24;
    for (const json::value& value : all.at("rows").as_array()) {
        const json::object& row = value.as_object();
        EXPECT_LE(exact[textOf(row, "model")], rmsOf(row) + rounding) << json::serialize(row);
    }
}

TEST(AccuracyCommand, MeasuresVoxelsWithEverySamplingAndStep) {
    const Folder folder;
    const Outcome run = runVolcast({"accuracy", "demo:volume", "--size", "24", "20", "--frames",
                                    "1", "--model", "volume", "--model", "mip", "--json",
                                    folder.file("a.json"), "--svg", folder.file("a.svg")});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    const json::value all = json::parse(contentOf(folder.file("a.json")));
    const json::array& rows = all.at("rows").as_array();
    const std::size_t ways = scene::row(scene::RayModel::kVolume).voxelIntegrators.size() + 1;
    EXPECT_EQ(rows.size(), 3 * 4 * ways);
    std::map<std::string, double> best, cheapest;
    for (const json::value& value : rows) {
        const json::object& row = value.as_object();
        ASSERT_TRUE(row.contains("error")) << json::serialize(row);
        if (row.at("step_spacings").to_number<double>() != 0.5) continue;
        if (textOf(row, "integrator") == "adaptive") best[textOf(row, "sampling")] = rmsOf(row);
        if (textOf(row, "integrator") == "average") cheapest[textOf(row, "sampling")] = rmsOf(row);
    }
    ASSERT_EQ(best.size(), 3U);
    for (const auto& [sampling, rms] : best) EXPECT_LT(rms, cheapest[sampling]) << sampling;
    EXPECT_NE(run.out.find("trilinear, step 0.5"), std::string::npos) << run.out;
    EXPECT_NE(contentOf(folder.file("a.svg")).find("volume, tricubic"), std::string::npos);
}

TEST(AccuracyCommand, TakesASampleOfPixelsAndLayersOfADocument) {
    const Folder folder;
    const std::string scene = folder.write("scene.json", R"({
        "camera": {"eye": {"x": 0, "y": 0, "z": 9}, "center": {}, "up": {"y": 1}},
        "layers": [{"id": "skin", "model": "RAY_MODEL_SURFACE", "hidden": true},
                   {"id": "inside", "model": "RAY_MODEL_MIP"}]})");
    const Outcome run = measure({"--scene", scene, "--size", "32", "32", "--sample", "100",
                                 "--frames", "1", "--json", folder.file("a.json")});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    const json::value all = json::parse(contentOf(folder.file("a.json")));
    const json::array& rows = all.at("rows").as_array();
    ASSERT_EQ(rows.size(), 3U);  // mip: walk, projection, projection of all faces.
    for (const json::value& row : rows) {
        EXPECT_EQ(textOf(row.as_object(), "layer"), "inside");
        EXPECT_EQ(row.at("error").at("pixels").to_number<int>(), 100);
    }
}

struct Wrong {
    std::vector<std::string> words;
    int exitCode;
    const char* named;
};

TEST(AccuracyCommand, RefusesWhatCannotBeMeasured) {
    for (const Wrong& wrong : std::vector<Wrong>{
             {{"accuracy", "demo:volume", "--model", "surface"}, 1, "surface"},
             {{"accuracy", "demo:mesh", "--model", "surface", "--integrator", "psi"}, 1, "serves"},
             {{"accuracy", "demo:mesh", "--json", "/nowhere/a.json"}, 1, "/nowhere/a.json"},
             {{"accuracy", "demo:mesh", "--model", "volume", "--field", "nothing"}, 1, "it has"},
             {{"accuracy", "/nowhere.vtu"}, 1, "/nowhere.vtu"},
             {{"accuracy", "demo:mesh", "--model", "hologram"}, 2, "hologram"},
             {{"accuracy", "demo:mesh", "--frames", "0"}, 2, "--frames"},
             {{"accuracy", "demo:mesh", "--sample", "some"}, 2, "--sample"},
             {{"accuracy"}, 2, "dataset"}}) {
        const Outcome run = runVolcast(wrong.words);
        EXPECT_EQ(run.exitCode, wrong.exitCode) << run.err;
        EXPECT_NE(run.err.find(wrong.named), std::string::npos) << run.err;
    }
}

}  // namespace
}  // namespace volcast::test
