#include "tests/support/import_files.h"

#include <array>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <sys/wait.h>

namespace volcast::test {

namespace fs = std::filesystem;

TempFolder::TempFolder() {
    std::string pattern = (fs::temp_directory_path() / "volcast-test-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
    folder_ = pattern;
}

TempFolder::~TempFolder() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
}

std::string TempFolder::path(const std::string& name) const {
    return name.empty() ? folder_.string() : (folder_ / name).string();
}

std::string TempFolder::write(const std::string& name, std::string_view content) const {
    std::ofstream file{folder_ / name, std::ios::binary};
    file.write(content.data(), static_cast<std::streamsize>(content.size()));
    return path(name);
}

std::string TempFolder::python(const std::string& program) const {
    write("make_file.py", program);
    const std::string command =
        "cd '" + folder_.string() + "' && /usr/bin/python3 -I make_file.py > make_file.log 2>&1";
    const int status = std::system(command.c_str());
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
    return "python failed: " + content(path("make_file.log"));
}

std::string content(const std::string& path) {
    std::ifstream file{path, std::ios::binary};
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

std::string realData() {
    const char* named = std::getenv("VOLCAST_DATA");
    const fs::path folder =
        named != nullptr ? fs::path{named} : fs::path{VOLCAST_SOURCE_DIR} / "../shared/data";
    std::error_code ignored;
    return fs::is_directory(folder, ignored) ? folder.string() : std::string{};
}

namespace {

constexpr std::array<std::array<int, 3>, 8> kCorners{
    {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
constexpr std::array<std::array<int, 4>, 5> kTetra{
    {{0, 1, 2, 5}, {0, 2, 3, 7}, {0, 5, 7, 4}, {2, 7, 5, 6}, {0, 2, 7, 5}}};
constexpr std::array<std::array<int, 4>, 6> kFaces{
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

}  // namespace

std::string cubeNode(bool fromOne) {
    std::ostringstream text;
    text << "# eight corners; attributes: sum twice_x\n8 3 2 0\n";
    for (std::size_t i = 0; i < kCorners.size(); ++i) {
        const auto& p = kCorners.at(i);
        text << i + (fromOne ? 1 : 0) << ' ' << p[0] << ' ' << p[1] << ' ' << p[2] << "  "
             << p[0] + p[1] + p[2] << ' ' << 2 * p[0] << "  # a corner\n";
    }
    return text.str();
}

std::string cubeEle(bool fromOne) {
    std::ostringstream text;
    text << "5 4 1\n";
    for (std::size_t i = 0; i < kTetra.size(); ++i) {
        text << i + (fromOne ? 1 : 0);
        for (const int v : kTetra.at(i)) text << ' ' << v + (fromOne ? 1 : 0);
        text << ' ' << 10 + i << '\n';
    }
    return text.str();
}

std::string cubeOff() {
    std::ostringstream text;
    text << "OFF\n8 6 12\n";
    for (const auto& p : kCorners) text << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
    for (const auto& f : kFaces) {
        text << "4 " << f[0] << ' ' << f[1] << ' ' << f[2] << ' ' << f[3] << '\n';
    }
    return text.str();
}

std::string cubeStlText() {
    std::ostringstream text;
    text << "solid cube\n";
    for (const auto& f : kFaces) {
        for (const std::array<int, 3> triangle :
             {std::array<int, 3>{f[0], f[1], f[2]}, std::array<int, 3>{f[0], f[2], f[3]}}) {
            text << " facet normal 0 0 0\n  outer loop\n";
            for (const int v : triangle) {
                const auto& p = kCorners.at(static_cast<std::size_t>(v));
                text << "   vertex " << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
            }
            text << "  endloop\n endfacet\n";
        }
    }
    text << "endsolid cube\n";
    return text.str();
}

}  // namespace volcast::test
