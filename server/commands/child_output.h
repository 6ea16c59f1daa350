#pragma once

#include <string>
#include <vector>

#include "renderer/base/result.h"

namespace volcast::commands {

struct ChildOutput {
    bool succeeded = false;  ///< Exit code 0.
    std::string text;        ///< What it printed.
    std::string ending;      ///< "exited with code 1", "killed by signal 11 (...)".
};

/// Runs a program to its end, at most 30 s; its stderr is ours.
///
/// Errors: kNotFound (no such program), kIo, kTimeout.
Result<ChildOutput> outputOf(const std::string& program, const std::vector<std::string>& arguments);

}  // namespace volcast::commands
