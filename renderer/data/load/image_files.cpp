#include "renderer/data/load/image_files.h"

#include <algorithm>
#include <filesystem>

#include "renderer/data/load/formats.h"

namespace volcast::data::load {

namespace {

namespace fs = std::filesystem;

bool isImage(const fs::path& path) {
    const Format* format = formatOf(path.string());
    return format != nullptr && format->family == Family::kImages;
}

bool isDigit(char c) {
    return c >= '0' && c <= '9';
}

/// Compares names with the numbers in them as numbers: slice2 stands before slice10.
bool numberedLess(const std::string& a, const std::string& b) {
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < a.size() && j < b.size()) {
        if (!isDigit(a[i]) || !isDigit(b[j])) {
            if (a[i] != b[j]) return a[i] < b[j];
            ++i;
            ++j;
            continue;
        }
        const auto digits = [](const std::string& text, std::size_t& at) {
            while (at < text.size() && text[at] == '0') ++at;
            const std::size_t start = at;
            while (at < text.size() && isDigit(text[at])) ++at;
            return text.substr(start, at - start);
        };
        const std::string left = digits(a, i);
        const std::string right = digits(b, j);
        if (left.size() != right.size()) return left.size() < right.size();
        if (left != right) return left < right;
    }
    return a.size() - i < b.size() - j;
}

/// The name without its last number: files of one series have the same.
std::string seriesOf(const fs::path& path) {
    std::string stem = path.stem().string();
    std::size_t end = stem.size();
    while (end > 0 && !isDigit(stem[end - 1])) --end;
    std::size_t start = end;
    while (start > 0 && isDigit(stem[start - 1])) --start;
    return start == end
               ? std::string{}
               : stem.substr(0, start) + "#" + stem.substr(end) + path.extension().string();
}

Result<std::vector<std::string>> imagesOf(const fs::path& folder, const std::string& series) {
    std::vector<std::string> files;
    std::error_code error;
    for (fs::directory_iterator at{folder, error}, end; !error && at != end; at.increment(error)) {
        const fs::path& path = at->path();
        if (isImage(path) && (series.empty() || seriesOf(path) == series)) {
            files.push_back(path.string());
        }
    }
    if (error) return fail(ErrorCode::kIo, folder.string() + ": " + error.message());
    std::sort(files.begin(), files.end(), numberedLess);
    return files;
}

}  // namespace

Result<std::vector<std::string>> slicesOf(const std::string& path) {
    std::error_code error;
    if (fs::is_directory(path, error)) {
        auto files = imagesOf(path, {});
        if (files && files->empty()) {
            return fail(ErrorCode::kUnsupported, path + ": has no TIFF or PNG pictures");
        }
        return files;
    }
    const std::string series = seriesOf(path);
    if (series.empty()) return std::vector<std::string>{path};
    const fs::path folder = fs::path{path}.parent_path();
    return imagesOf(folder.empty() ? fs::path{"."} : folder, series);
}

}  // namespace volcast::data::load
