#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "renderer/scene/ray_models.h"
#include "renderer/shading/embedded_chunks.h"
#include "renderer/shading/program_cache.h"
#include "tests/support/import_files.h"

namespace volcast::test {

constexpr int kWalkVariants = 12;

/// One stage as it was written for the compiler.
struct Stage {
    std::string file;
    std::string label;  ///< The chunks that it is made for.
    shading::Assembled assembled;
};

/// Writes the stages of programs into files and has them compiled.
class Validator : public ::testing::Test {
protected:
    void SetUp() override;

    /// Runs the compiler over written stages; what it complains about, by chunk and line.    ///
    /// Runs the compiler over written stages; what it complains about, by chunk and line.
    std::string complaint(const std::string& options, const std::vector<std::string>& files);
    /// All stages, each by itself.
    [[nodiscard]] std::vector<std::string> files() const;

    void addMarches();
    void addUserCode();
    void addWalks();
    void addProjections();
    void addLevels();
    void addSurfaces();
    void addOtherPasses();

    // NOLINTBEGIN(readability-identifier-naming): members of a fixture
    TempFolder folder_;
    shading::ChunkSource chunks_ = shading::embeddedChunks();
    std::set<std::string> mains_;  ///< Files with a main() that were compiled.
    int programs_ = 0;
    std::map<std::string, std::string> fileOf_;              ///< By suffix and text.
    std::map<std::string, Stage> stages_;                    ///< By file.
    std::map<std::string, std::vector<std::string>> pairs_;  ///< What is linked, by its chunks.
    // NOLINTEND(readability-identifier-naming)

private:
    /// Writes a stage, the same text once; the name of its file. `suffix`: vert, frag, comp.
    std::string add(const std::string& suffix, const std::string& label,
                    const Result<shading::Assembled>& assembled);
    /// A ray program, or a pass that is made like one.
    void addRay(const shading::Recipe& recipe, const std::string& vertex);
    void addPass(const std::string& vertex, const std::string& fragment,
                 const std::vector<shading::Constant>& constants);
    void addCompute(const std::string& file, const std::vector<shading::Constant>& constants);
    void addWalk(const scene::RayModelRow& row, const scene::IntegratorRow& integrator, int bits);
    [[nodiscard]] const Stage* stageIn(const std::string& line) const;
};

}  // namespace volcast::test
