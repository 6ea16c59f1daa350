#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace volcast::test {

/// A folder of one test's own, removed with all that is in it.
class TempFolder {
public:
    TempFolder();
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;
    TempFolder(TempFolder&&) = delete;
    TempFolder& operator=(TempFolder&&) = delete;
    ~TempFolder();

    [[nodiscard]] std::string path(const std::string& name = {}) const;
    /// Writes a file and returns its path.
    std::string write(const std::string& name, std::string_view content) const;
    /// Runs a Python program (Debian's, with VTK and meshio) in this folder.
    ///
    /// Empty on success, else what it said.
    [[nodiscard]] std::string python(const std::string& program) const;

private:
    std::filesystem::path folder_;
};

/// The content of a file.
std::string content(const std::string& path);

/// Real data that is not part of the project: $VOLCAST_DATA, else shared/data beside the project's
/// folder; empty where there is none.
std::string realData();

/// The unit cube as text: five tetrahedra (.node, .ele) or the surface (.off, .stl).
std::string cubeNode(bool fromOne = false);
std::string cubeEle(bool fromOne = false);
std::string cubeOff();
std::string cubeStlText();

}  // namespace volcast::test
