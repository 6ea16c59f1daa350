#include "server/session/folder_scan.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <map>
#include <sys/stat.h>

#include "server/session/beneath.h"
#include "server/workers/import_service.h"

namespace volcast::session {

namespace {

namespace fs = std::filesystem;

struct File {
    std::string name;
    std::uint64_t signature = 0;
};

std::uint64_t mix(std::uint64_t hash, std::uint64_t value) {
    return (hash ^ value) * 0x9e3779b97f4a7c15ULL + (hash >> 29U);
}

std::string extension(const std::string& name) {
    std::string text = fs::path{name}.extension().string();
    std::ranges::transform(text, text.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

std::string joined(const std::string& folder, const std::string& name) {
    return (fs::path{folder} / name).string();
}

bool isImage(const std::string& name) {
    static constexpr std::array kImages{".tif", ".tiff", ".png", ".exr", ".dcm", ".jpg", ".jpeg"};
    return std::ranges::find(kImages, extension(name)) != kImages.end();
}

/// Walks the tree and gathers datasets.
class Scan {
public:
    Scan(const std::string& folder, const base::FileDescriptor& root)
        : folder_{folder}, root_{root} {}

    void enter(const std::string& relative, int depth) {
        std::vector<File> files;
        std::vector<std::string> folders;
        std::error_code ignored;  // A folder that cannot be listed holds nothing for us.
        for (fs::directory_iterator at{folder_ / relative, ignored}, end; at != end;
             at.increment(ignored)) {
            if (++seen_ > kMaxScanEntries) return;
            const std::string name = at->path().filename().string();
            if (name.empty() || name.front() == '.') continue;
            const std::string path = joined(relative, name);
            if (!at->is_symlink(ignored) && at->is_directory(ignored)) {
                folders.push_back(path);
            } else {
                addFile(files, name, path);
            }
        }
        gather(relative, files);
        if (depth >= kMaxScanDepth) return;
        for (const std::string& next : folders) enter(next, depth + 1);
    }

    std::vector<FoundDataset> take() {
        std::ranges::sort(found_, {}, &FoundDataset::id);
        return std::move(found_);
    }

private:
    void addFile(std::vector<File>& files, const std::string& name, const std::string& path) {
        // Opening goes through the kernel's check, so a link out of the folder is not listed.
        const auto file = openBeneath(root_, path, Links::kFollowInside);
        struct stat status {};
        if (!file || ::fstat(file->get(), &status) != 0 || !S_ISREG(status.st_mode)) {
            if (!file && file.error().code == ErrorCode::kIo) files.push_back({name, 0});
            return;
        }
        std::uint64_t signature = mix(1, static_cast<std::uint64_t>(status.st_size));
        signature = mix(signature, static_cast<std::uint64_t>(status.st_mtim.tv_sec));
        signature = mix(signature, static_cast<std::uint64_t>(status.st_mtim.tv_nsec));
        files.push_back({name, signature});
    }

    void gather(const std::string& relative, const std::vector<File>& files) {
        std::map<std::string, int> images;
        for (const File& file : files) {
            if (isImage(file.name)) ++images[extension(file.name)];
        }
        const bool stack = std::ranges::any_of(images, [](auto& kind) { return kind.second > 1; });
        if (stack) addStack(relative, files);
        for (const File& file : files) {
            if (stack && isImage(file.name)) continue;
            if (!workers::isImportable(file.name)) continue;
            const std::string id = joined(relative, file.name);
            found_.push_back({id, file.name, withCompanions(file, files)});
        }
    }

    void addStack(const std::string& relative, const std::vector<File>& files) {
        std::uint64_t signature = 2;
        for (const File& file : files) {
            if (isImage(file.name)) signature += file.signature;  // In any order of listing.
        }
        const fs::path path = relative.empty() ? folder_ : fs::path{relative};
        found_.push_back({relative.empty() ? "." : relative, path.filename().string(), signature});
    }

    static std::uint64_t withCompanions(const File& file, const std::vector<File>& files) {
        const std::string stem = fs::path{file.name}.stem().string();
        std::uint64_t signature = 3;
        for (const File& other : files) {
            if (fs::path{other.name}.stem() == stem) signature += other.signature;
        }
        return signature;
    }

    fs::path folder_;
    const base::FileDescriptor& root_;
    std::size_t seen_ = 0;
    std::vector<FoundDataset> found_;
};

}  // namespace

std::vector<FoundDataset> scanFolder(const std::string& folder, const base::FileDescriptor& root) {
    std::error_code ignored;
    const fs::path whole = fs::canonical(folder, ignored);
    Scan scan{ignored ? folder : whole.string(), root};
    scan.enter("", 0);
    return scan.take();
}

}  // namespace volcast::session
