// Every program that can be drawn with passes the reference compiler for GLSL, glslangValidator:
// Mesa and NVIDIA each take things that the other one, and the language, refuse.
#include <algorithm>
#include <cstdio>
#include <optional>
#include <sstream>
#include <sys/wait.h>

#include "renderer/shading/glsl_scan.h"
#include "tests/gl/scene/validator.h"
#include "tests/support/march_variants.h"

namespace volcast::test {

namespace {

/// Runs a command; its status and what it printed.
std::pair<int, std::string> run(const std::string& command) {
    std::FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
    if (pipe == nullptr) return {-1, "popen failed"};
    std::string printed;
    for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) {
        printed.push_back(static_cast<char>(c));
    }
    const int status = ::pclose(pipe);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, printed};
}

void replaceFirst(std::string& text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    if (at != std::string::npos) text.replace(at, from.size(), to);
}

}  // namespace

void Validator::SetUp() {
    if (run("command -v glslangValidator").first != 0) {
        GTEST_SKIP() << "glslangValidator is not installed (Debian package glslang-tools)";
    }
}

std::string Validator::complaint(const std::string& options,
                                 const std::vector<std::string>& files) {
    std::string command = "cd '" + folder_.path() + "' && glslangValidator " + options;
    for (const std::string& file : files) command += " " + file;
    const auto [status, printed] = run(command);
    if (status == 0) return {};
    std::string mapped;
    const Stage* stage = nullptr;
    std::istringstream lines{printed};
    for (std::string line; std::getline(lines, line);) {
        // A file's complaints follow its name; where programs are linked, lines hold the name.
        if (const auto found = stages_.find(line); found != stages_.end()) {
            stage = &found->second;
        } else if (const Stage* named = stageIn(line)) {
            replaceFirst(line, named->file + ":", "0:");
            mapped += named->label + ": " + named->assembled.translate(line) + "\n";
        } else if (stage != nullptr && line.find("0:") != std::string::npos) {
            mapped += stage->label + ": " + stage->assembled.translate(line) + "\n";
        }
    }
    return mapped.empty() ? printed : mapped;
}

std::string Validator::add(const std::string& suffix, const std::string& label,
                           const Result<shading::Assembled>& assembled) {
    if (!assembled) {
        ADD_FAILURE() << assembled.error().message;
        return {};
    }
    const auto [known, isNew] = fileOf_.try_emplace(suffix + assembled->source);
    if (isNew) {
        known->second = "stage" + std::to_string(fileOf_.size()) + "." + suffix;
        folder_.write(known->second, assembled->source);
        stages_[known->second] = {known->second, label, *assembled};
    }
    return known->second;
}

std::vector<std::string> Validator::files() const {
    std::vector<std::string> names;
    for (const auto& [name, stage] : stages_) names.push_back(name);
    return names;
}

const Stage* Validator::stageIn(const std::string& line) const {
    for (const auto& [name, stage] : stages_) {
        if (line.find(" " + name + ":") != std::string::npos) return &stage;
    }
    return nullptr;
}

namespace {

TEST_F(Validator, EveryProgramIsGlslToAnIndependentCompiler) {
    addMarches();
    // The march of 7 models, slices of all but isosurfaces, and cross-sections.
    constexpr int kMarchPrograms = (7 + 6 + 1) * support::kMarchVariants;
    EXPECT_EQ(programs_, kMarchPrograms);
    addWalks();
    EXPECT_EQ(programs_, kMarchPrograms + 17 * kWalkVariants);
    addUserCode();
    addProjections();
    addLevels();
    addSurfaces();
    addOtherPasses();
    EXPECT_GT(stages_.size(), 300U);
    EXPECT_EQ(complaint("", files()), "");
    for (const auto& [label, stages] : pairs_) EXPECT_EQ(complaint("-l", stages), "") << label;
    std::set<std::string> all;
    for (const shading::EmbeddedChunk& chunk : shading::embeddedChunkTable()) {
        for (const auto& function : shading::functionDefinitions(chunk.text)) {
            if (function.name == "main") all.emplace(chunk.path);
        }
    }
    EXPECT_TRUE(std::ranges::includes(mains_, all)) << "a file with a main() is not compiled here";
}

TEST_F(Validator, ComplaintsNameChunkAndLine) {
    const shading::ChunkSource sound = chunks_;
    int line = 0;
    chunks_ = [&](std::string_view path) {
        std::optional<std::string> text = sound(path);
        if (text && path == "model/mip.glsl") {
            line = 1 + static_cast<int>(std::count(text->begin(), text->end(), '\n'));
            *text += "const float kBroken = nobodyKnows;\n";
        }
        return text;
    };
    addWalks();
    ASSERT_GT(line, 0);
    const std::string expected = "model/mip.glsl:" + std::to_string(line) + ": 'nobodyKnows'";
    for (const char* options : {"", "-l"}) {
        for (const auto& [label, stages] : pairs_) {
            const std::string said = complaint(options, stages);
            if (label.find("model/mip.glsl") == std::string::npos) {
                EXPECT_EQ(said, "");
            } else {
                EXPECT_NE(said.find(expected), std::string::npos) << said;
            }
        }
    }
}

}  // namespace
}  // namespace volcast::test
