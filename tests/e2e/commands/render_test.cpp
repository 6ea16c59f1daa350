#include <algorithm>
#include <cstring>

#include "tests/e2e/commands/program.h"

namespace volcast::test {
namespace {

std::vector<float> floatsOf(const std::string& path) {
    const std::string bytes = contentOf(path);
    std::vector<float> values(bytes.size() / sizeof(float));
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(float));
    return values;
}

Outcome render(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "render");
    return runVolcast(arguments);
}

constexpr const char* kCamera =
    R"({"eye": [0, 0, 9], "center": [0, 0, 0], "up": [0, 1, 0], "fovy": 30, "near": 1, "far": 99})";

TEST(RenderCommand, WritesAPngAndFloatsOfTheSizeAskedFor) {
    const Folder folder;
    const Outcome run = render({"demo:volume", "--size", "60", "40", "--png", folder.file("a.png"),
                                "--raw", folder.file("a.f32")});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    const std::string png = contentOf(folder.file("a.png"));
    ASSERT_GT(png.size(), 24U);
    EXPECT_EQ(png.substr(1, 3), "PNG");
    EXPECT_EQ(static_cast<unsigned char>(png[19]), 60);
    EXPECT_EQ(static_cast<unsigned char>(png[23]), 40);
    const std::vector<float> raw = floatsOf(folder.file("a.f32"));
    ASSERT_EQ(raw.size(), 60U * 40U * 4U);
    float most = 0.0F;
    for (std::size_t i = 3; i < raw.size(); i += 4) most = std::max(most, raw[i]);
    EXPECT_GT(most, 0.01F);
    EXPECT_LE(most, 1.0F);
    EXPECT_EQ(raw[3], 0.0F);  // The corner shows the transparent background.
}

TEST(RenderCommand, UsesTheTransferFunctionOfTheFile) {
    const Folder folder;
    const std::string map = folder.write("red.tf", "# only red\n-1e30 1 0 0 5\n1e30 1 0 0 5\n");
    const Outcome run =
        render({"demo:mesh", "--size", "40", "40", "--tf", map, "--raw", folder.file("a.f32")});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    const std::vector<float> raw = floatsOf(folder.file("a.f32"));
    for (std::size_t i = 0; i < raw.size(); i += 4) {
        EXPECT_NEAR(raw[i], raw[i + 3], 1e-5F);  // Premultiplied red is alpha.
        EXPECT_EQ(raw[i + 1], 0.0F);
        EXPECT_EQ(raw[i + 2], 0.0F);
    }
}

TEST(RenderCommand, AMapThatIsDrawnIsTheSameMapInPoints) {
    const Folder folder;
    const std::string drawn = folder.write(
        "drawn.json",
        R"({"linear": [1, 1, 1], "opacity": 0.75, "window": [0, 2], "distance": 0.5})");
    const std::string table = folder.write(
        "table.json",
        R"({"rgba": [[1, 1, 1, 0.75], [0, 0, 0, 0]], "window": [2, 0], "distance": 0.5})");
    const auto picture = [&](const std::string& map) {
        const Outcome run = render({"demo:volume", "--model", "mip", "--size", "40", "40", "--tf",
                                    map, "--raw", folder.file("a.f32")});
        EXPECT_EQ(run.exitCode, 0) << run.err;
        return floatsOf(folder.file("a.f32"));
    };
    const std::vector<float> one = picture(drawn), other = picture(table);
    ASSERT_EQ(one.size(), other.size());
    float most = 0.0F;
    for (std::size_t i = 0; i < one.size(); ++i) {
        EXPECT_NEAR(one[i], other[i], 1e-6F);  // Sums of float32 in another order.
        most = std::max(most, one[i]);
    }
    EXPECT_GT(most, 0.1F);
}

TEST(RenderCommand, FramesPrintOneJsonLineWithTheKeysOfTheOtherPrograms) {
    const Outcome run = render({"demo:mesh", "--size", "32", "32", "--frames", "3"});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    EXPECT_EQ(std::count(run.out.begin(), run.out.end(), '\n'), 1);
    for (const char* key :
         {"median_ms", "min_ms", "max_ms", "cpu_ms", "first_ms", "peak_mb", "size", "model", "data",
          "readback_ms", "load_ms", "gl", "cells", "plan"}) {
        EXPECT_NE(run.out.find(std::string{'"'}.append(key).append("\":")), std::string::npos)
            << key;
    }
    EXPECT_NE(run.out.find(R"("size":[32,32])"), std::string::npos) << run.out;
}

TEST(RenderCommand, ExplainSaysWhatIsOnAndOffAndWhy) {
    const Outcome run = render({"demo:mesh", "--size", "16", "16", "--explain"});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    EXPECT_NE(run.out.find("layer main: mesh walk"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("  off "), std::string::npos) << run.out;
}

TEST(RenderCommand, CountsSamplesByTheUsualNumberWhereNoneIsGiven) {
    const auto explained = [](const std::vector<std::string>& more) {
        std::vector<std::string> words{"demo:volume", "--size", "16", "16", "--explain"};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome run = render(words);
        EXPECT_EQ(run.exitCode, 0) << run.err;
        return run.out;
    };
    const std::string usual = "64 samples over the depth of the data";
    EXPECT_NE(explained({"--depth-samples"}).find(usual), std::string::npos);
    EXPECT_NE(explained({"--depth-samples", "--sampling", "nearest"}).find(usual),
              std::string::npos);
    EXPECT_NE(explained({"--depth-samples", "80"}).find("80 samples"), std::string::npos);
    EXPECT_EQ(explained({}).find("samples over"), std::string::npos);
    EXPECT_NE(render({"demo:volume", "--depth-samples", "0"}).exitCode, 0);
    EXPECT_NE(render({"demo:volume", "--depth-samples", "--step", "1"}).exitCode, 0);
}

TEST(RenderCommand, RefusesBudgetsThatAreNone) {
    for (const char* budget : {"15", "1048577", "-1", "lots", ""}) {
        for (const char* command : {"render", "serve"}) {
            const std::string what = std::string{command} + " --volume-budget=" + budget;
            const Outcome run =
                runVolcast({command, command == std::string{"render"} ? "demo:volume" : "--port=0",
                            "--volume-budget=" + std::string{budget}});
            EXPECT_NE(run.exitCode, 0) << what;
            EXPECT_NE(run.err.find("--volume-budget"), std::string::npos) << what << run.err;
        }
    }
    EXPECT_NE(render({"demo:volume", "--volume-budget", "15"}).err.find("16"), std::string::npos);
    EXPECT_EQ(render({"demo:volume", "--volume-budget", "16", "--size", "8", "8"}).exitCode, 0);
}

TEST(RenderCommand, DrawsASceneDocument) {
    const Folder folder;
    const std::string scene = folder.write("scene.json", R"({
        "camera": {"eye": {"x": 0, "y": 0, "z": 9}, "center": {}, "up": {"y": 1}},
        "layers": [{"id": "a", "dataset": "anything", "model": "RAY_MODEL_SURFACE"}],
        "background": {"r": 0, "g": 1, "b": 0}, "editor": {"density": 2}})");
    const Outcome run =
        render({"demo:mesh", "--size", "8", "8", "--scene", scene, "--png", folder.file("a.png")});
    EXPECT_EQ(run.exitCode, 0) << run.err;
    EXPECT_GT(contentOf(folder.file("a.png")).size(), 60U);
    const std::string broken = folder.write("broken.json", R"({"kamera": 1})");
    const Outcome refused = render({"demo:mesh", "--scene", broken});
    EXPECT_EQ(refused.exitCode, 1);
    EXPECT_NE(refused.err.find("broken.json"), std::string::npos) << refused.err;
    EXPECT_NE(refused.err.find("kamera"), std::string::npos) << refused.err;
}

TEST(RenderCommand, WrongOptionsAreUsageErrors) {
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"demo:mesh", "--size", "0", "10"},
             {"demo:mesh", "--size", "10", "-3"},
             {"demo:mesh", "--size", "100000", "10"},
             {"demo:mesh", "--size", "10"},
             {"demo:mesh", "--model", "hologram"},
             {"demo:mesh", "--step", "nan"},
             {"demo:mesh", "--step", "-1"},
             {"demo:mesh", "--background", "0", "nan", "0"},
             {"demo:mesh", "--orbit", "inf"},
             {"demo:mesh", "--frames", "-1"},
             {"demo:mesh", "--no-such-option"},
             {"demo:mesh", "--scene", "a", "--levels", "1"},
             {"demo:mesh", "--integrator", "guess"},
             {"demo:mesh", "--evaluator", "guess"},
             {"demo:mesh", "--scale", "cubic"},
             {"demo:mesh", "--scale-domain", "1"},
             {"demo:mesh", "--interval", "1", "nan"},
             {"demo:mesh", "--levels", "inf"},
             {"demo:mesh", "--level-step", "1"},
             {"demo:mesh", "--levels", "1", "--level-step", "nan"},
             {"demo:mesh", "--level-spacing", "log"},
             {"demo:mesh", "--edge-width", "0"},
             {"demo:mesh", "--extinction-scale", "-1"},
             {"demo:mesh", "--clip", "1", "0", "0"},
             {"demo:mesh", "--accuracy", "error"},
             {"demo:mesh", "--accuracy", "error:-1"},
             {"demo:mesh", "--accuracy", "time:nan"},
             {"demo:mesh", "--accuracy", "best"},
             {}}) {
        const Outcome run = render(words);
        EXPECT_EQ(run.exitCode, 2) << run.err;
        EXPECT_FALSE(run.err.empty());
    }
}

struct Refusal {
    std::vector<std::string> words;
    const char* named;    // The option or the part of a scene.
    const char* allowed;  // What would have been right, or the limit.
};

TEST(RenderCommand, SaysWhatIsAllowedWhereOptionsDoNotFitTogether) {
    for (const Refusal& wrong : std::vector<Refusal>{
             {{"--model", "volume", "--integrator", "ends"}, "--integrator", "psi_table"},
             {{"--model", "surface", "--integrator", "psi"}, "--integrator", "exact"},
             {{"--model", "volume", "--evaluator", "projection_faces"}, "evaluator", "mip"},
             {{"--model", "isosurface", "--level-range", "0", "1", "2.5"}, "--level-range", "256"},
             {{"--model", "isosurface", "--level-range", "-1", "1", "3", "--level-spacing", "log"},
              "levels",
              "0"},
             {{"--markers", "region", "one"}, "--markers", "number"},
             {{"--markers", "nowhere", "1"}, "nowhere", "it has "},
             {{"--density-field", "nowhere"}, "nowhere", "it has "},
             {{"--scale-exponent", "2"}, "--scale-exponent", "power"},
             {{"--scale", "log", "--scale-domain", "-1", "1"}, "scale.domain", "0"},
             {{"--interval", "2", "1"}, "interval", "order"},
             {{"--exposure", "100"}, "exposure", "64"},
             {{"--clip", "0", "0", "0", "1"}, "clip_planes[0].normal", "above 0"}}) {
        std::vector<std::string> words{"demo:mesh", "--size", "8", "8"};
        words.insert(words.end(), wrong.words.begin(), wrong.words.end());
        const Outcome run = render(words);
        EXPECT_EQ(run.exitCode, 1) << run.err;
        EXPECT_NE(run.err.find(wrong.named), std::string::npos) << run.err;
        EXPECT_NE(run.err.find(wrong.allowed), std::string::npos) << run.err;
    }
}

TEST(RenderCommand, NamesTheFieldsThereAre) {
    const Outcome run = render({"demo:mesh", "--field", "temperature"});
    EXPECT_EQ(run.exitCode, 1);
    EXPECT_NE(run.err.find("temperature"), std::string::npos) << run.err;
    EXPECT_NE(run.err.find("it has "), std::string::npos) << run.err;
}

TEST(RenderCommand, NamesTheKeyOfABrokenCamera) {
    const Folder folder;
    struct Case {
        const char* json;
        const char* named;
    };
    for (const Case& wrong :
         {Case{R"({"eye": [0, 0, 1]})", "center"},
          Case{R"({"eye": [0, 0, "x"], "center": [0,0,0], "up": [0,1,0]})", "eye"},
          Case{R"({"eye": [0, 0], "center": [0,0,0], "up": [0,1,0]})", "eye"},
          Case{R"({"eye": [0,0,NaN], "center": [0,0,0], "up": [0,1,0]})", "JSON"},
          Case{R"({"eye": [0,0,1], "center": [0,0,1], "up": [0,1,0]})", "eye"},
          Case{R"({"eye": [0,0,1], "center": [0,0,0], "up": [0,0,1]})", "up"},
          Case{R"({"eye": [0,0,1], "center": [0,0,0], "up": [0,1,0],)"
               R"( "fovy": 180})",
               "fovy"},
          Case{R"({"eye": [0,0,1], "center": [0,0,0], "up": [0,1,0],)"
               R"( "zoom": 2})",
               "zoom"},
          Case{R"({"eye": )", "JSON"}, Case{"[]", "object"}}) {
        const std::string camera = folder.write("camera.json", wrong.json);
        const Outcome run = render({"demo:volume", "--camera", camera});
        EXPECT_EQ(run.exitCode, 1) << wrong.json;
        EXPECT_NE(run.err.find("camera.json"), std::string::npos) << run.err;
        EXPECT_NE(run.err.find(wrong.named), std::string::npos) << run.err;
    }
}

TEST(RenderCommand, NamesFilesThatCannotBeReadOrWritten) {
    const Folder folder;
    const std::string camera = folder.write("camera.json", kCamera);
    const std::string map = folder.write("broken.tf", "0 1 1 1 1\n0.5 red\n");
    const std::string flat =
        folder.write("flat.json", R"({"linear": "#fff000", "window": [3, 3]})");
    struct Case {
        std::vector<std::string> words;
        std::string named;
    };
    for (const Case& wrong :
         {Case{{"/nonexistent/data.vtu"}, "/nonexistent/data.vtu"},
          Case{{"demo:volume", "--camera", "/nonexistent/c.json"}, "/nonexistent/c.json"},
          Case{{"demo:volume", "--camera", camera, "--tf", "/nonexistent/a.tf"},
               "/nonexistent/a.tf"},
          Case{{"demo:volume", "--tf", map}, "broken.tf"},
          Case{{"demo:volume", "--tf", flat}, "flat.json: window: 3"},
          Case{{"demo:volume", "--scene", "/nonexistent/s.json"}, "/nonexistent/s.json"},
          Case{{"demo:volume", "--png", "/nonexistent/a.png"}, "/nonexistent/a.png"},
          Case{{"demo:volume", "--raw", "/proc/a.f32"}, "/proc/a.f32"},
          Case{{"demo:volume", "--png", "/tmp"}, "/tmp"},
          Case{{"demo:volume", "--gpu", "77"}, "77"},
          Case{{"demo:volume", "--model", "surface"}, "surface"}}) {
        const Outcome run = render(wrong.words);
        EXPECT_EQ(run.exitCode, 1) << wrong.named;
        EXPECT_NE(run.err.find(wrong.named), std::string::npos) << run.err;
    }
}

TEST(RenderCommand, SaysThatThereIsNoEgl) {
    const Outcome run =
        runVolcast({"render", "demo:volume"}, {"__EGL_VENDOR_LIBRARY_DIRS=/nonexistent"});
    EXPECT_EQ(run.exitCode, 1);
    EXPECT_NE(run.err.find("EGL"), std::string::npos) << run.err;
}

/// Children of a process, by /proc.
std::vector<int> childrenOf(int parent) {
    std::vector<int> children;
    for (const auto& entry : std::filesystem::directory_iterator{"/proc"}) {
        const std::string name = entry.path().filename();
        if (name.find_first_not_of("0123456789") != std::string::npos) continue;
        const std::string stat = contentOf(entry.path() / "stat");
        const std::size_t end = stat.rfind(')');
        if (end == std::string::npos || end + 4 > stat.size()) continue;
        if (std::stoi(stat.substr(end + 4)) == parent) children.push_back(std::stoi(name));
    }
    return children;
}

TEST(RenderCommand, TakesItsWorkerAlongWhenItIsKilled) {
    const Folder cache;
    workers::SpawnDesc desc;
    desc.program = workers::besideThisProgram("volcast");
    desc.arguments = {"render",  "demo:volume", "--size",
                      "64",      "64",          "--frames",
                      "1000000", "--cache-dir", cache.file("shaders")};
    auto volcast = workers::ChildProcess::spawn(desc);
    ASSERT_TRUE(volcast.has_value());
    int worker = 0;
    const auto workerName = [](int pid) {
        return contentOf("/proc/" + std::to_string(pid) + "/comm");
    };
    ASSERT_TRUE(eventually([&] {
        for (const int child : childrenOf(volcast->pid())) {
            if (workerName(child) == "volcast-worker\n") worker = child;
        }
        return worker != 0;
    }));
    volcast->kill();
    volcast->reap();
    EXPECT_TRUE(eventually([&] {
        const std::string stat = contentOf("/proc/" + std::to_string(worker) + "/stat");
        // A zombie that nobody has reaped yet is dead, too.
        return stat.empty() || stat.find(") Z ") != std::string::npos;
    }));
}

TEST(DoctorCommand, FindsEverythingThatTheServiceNeeds) {
    const Outcome run = runVolcast({"doctor", "--json"});
    EXPECT_EQ(run.exitCode, 0) << run.out;
    EXPECT_NE(run.out.find(R"("can_serve":true)"), std::string::npos);
    for (const char* group : {"graphics", "codecs", "import", "sandbox"}) {
        EXPECT_NE(run.out.find(std::string{R"("group":")"}.append(group)), std::string::npos)
            << group;
    }
}

TEST(DoctorCommand, SaysWhatMissingGraphicsCost) {
    const Outcome run = runVolcast({"doctor"}, {"__EGL_VENDOR_LIBRARY_DIRS=/nonexistent"});
    EXPECT_EQ(run.exitCode, 1);
    EXPECT_NE(run.out.find("there are no pictures"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("cannot serve"), std::string::npos) << run.out;
}

TEST(VolcastProgram, HasHelpAndAVersion) {
    EXPECT_EQ(runVolcast({"--help"}).exitCode, 0);
    EXPECT_TRUE(runVolcast({"--version"}).out.starts_with("volcast "));
    for (const char* command : {"serve", "render", "import", "doctor"}) {
        const Outcome run = runVolcast({command, "--help"});
        EXPECT_EQ(run.exitCode, 0) << command;
        EXPECT_GT(run.out.size(), 100U) << command;
    }
    EXPECT_EQ(runVolcast({}).exitCode, 2);
}

}  // namespace
}  // namespace volcast::test
