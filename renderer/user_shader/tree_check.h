#pragma once

#include <functional>
#include <string>
#include <vector>

#include "renderer/user_shader/complaint.h"
#include "renderer/user_shader/control.h"

namespace volcast::user_shader {

// What one sample of user code may take; counted as loops say at most, with all branches.
inline constexpr int kMaxIterations = 256;  ///< Of all loops together.
inline constexpr double kMaxCost =
    20000.0;  ///< Operations; tree_cost.cpp says what counts as how many.
inline constexpr int kMaxTreeDepth = 200;
inline constexpr double kMaxArrayComponents = 1024.0;  ///< Numbers in one variable.

/// GLSL that holds a user's code.
struct TreeInput {
    std::string source;
    /// The user's line that line `number` of `source` is; 0: the renderer's own.
    std::function<int(int number)> userLine;
    std::vector<Control> controls;
};

struct TreeReport {
    std::vector<Complaint> complaints;  ///< None: the code may be compiled.
    int iterations = 0;                 ///< Of the user's loops for one sample, at most.
    double cost = 0.0;
};

/// Parses `input` with glslang and checks what only a tree shows: types, bounds of loops, lengths
/// of arrays, recursion, cost, assignments to controls. For a sandboxed process: glslang is not
/// built for hostile text, and checkText() must have passed.
TreeReport checkTree(const TreeInput& input);

}  // namespace volcast::user_shader
