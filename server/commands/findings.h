#pragma once

#include <string>
#include <vector>

namespace volcast::commands {

/// One thing that `doctor` looked at.
struct Finding {
    std::string group;  ///< "graphics", "codecs", "import", "sandbox".
    std::string name;
    bool ok = false;
    bool required = false;  ///< The service cannot run without it.
    std::string detail;     ///< What was found, or why not.
    std::string cost;       ///< What is lost where it is missing.
};

/// EGL platforms and devices, GL version and limits: asked in processes of their own, because a
/// driver may crash. Ends with a picture drawn by a real worker.
std::vector<Finding> findGraphics(const std::string& gpu);
std::vector<Finding> findCodecs();
/// The import programs, and the Python modules that some formats need.
std::vector<Finding> findImportFormats();
std::vector<Finding> findSandbox();

}  // namespace volcast::commands
