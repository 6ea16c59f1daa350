#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace volcast::shading {

/// A function body found in GLSL text.
struct FunctionDefinition {
    std::string name;
    int line = 0;  ///< Of the opening brace, from 1.
};

/// The functions defined at the outermost level of `source`, in order. Comments are skipped;
/// prototypes do not count.
std::vector<FunctionDefinition> functionDefinitions(std::string_view source);

}  // namespace volcast::shading
