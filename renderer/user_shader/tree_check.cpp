#include "renderer/user_shader/tree_check.h"

#include <algorithm>

#include <glslang/MachineIndependent/localintermediate.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>

#include "renderer/user_shader/check_text.h"
#include "renderer/user_shader/glslang_log.h"
#include "renderer/user_shader/parameters.h"
#include "renderer/user_shader/tree_cost.h"

namespace volcast::user_shader {
namespace {

/// Once a process; what it makes is freed at its end.
void initializeGlslang() {
    struct Process {
        Process() { glslang::InitializeProcess(); }
        ~Process() { glslang::FinalizeProcess(); }
        Process(const Process&) = delete;
        Process& operator=(const Process&) = delete;
        Process(Process&&) = delete;
        Process& operator=(Process&&) = delete;
    };
    static const Process kProcess;
}

void checkWork(const Work& work, TreeReport& report) {
    report.cost = work.cost;
    if (work.iterations > kMaxIterations) {
        report.complaints.push_back({.message = "all loops of a sample together run " +
                                                textOf(work.iterations) + " times, at most " +
                                                std::to_string(kMaxIterations)});
        return;
    }
    report.iterations = static_cast<int>(work.iterations);
    if (work.cost > kMaxCost) {
        report.complaints.push_back({.message = "a sample takes " + textOf(work.cost) +
                                                " operations, at most " + textOf(kMaxCost)});
    }
}

}  // namespace

TreeReport checkTree(const TreeInput& input) {
    initializeGlslang();
    TreeReport report;
    glslang::TShader shader{EShLangFragment};
    const char* text = input.source.data();
    const auto length = static_cast<int>(input.source.size());
    shader.setStringsWithLengths(&text, &length, 1);
    constexpr int kVersion = 450;
    if (!shader.parse(GetDefaultResources(), kVersion, ECoreProfile, false, false, EShMsgDefault)) {
        report.complaints = complaintsOfLog(shader.getInfoLog(), input.userLine);
        return report;
    }
    TIntermNode* root = shader.getIntermediate()->getTreeRoot();
    if (root == nullptr) {
        report.complaints.push_back({.message = "there is no code"});
        return report;
    }
    TreeWalk walk{input, *root, report.complaints};
    walk.everything();
    const Work work = walk.function(std::string{kPrefix} + "main(", *root);
    if (report.complaints.empty()) checkWork(work, report);
    std::ranges::stable_sort(report.complaints, {}, &Complaint::line);
    return report;
}

}  // namespace volcast::user_shader
