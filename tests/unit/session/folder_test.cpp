#include <filesystem>
#include <fstream>
#include <optional>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/session/beneath.h"
#include "server/session/folder_scan.h"

namespace volcast::session {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;

class Folder : public testing::Test {
protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "volcast-folder-XXXXXX").string();
        ASSERT_NE(::mkdtemp(name.data()), nullptr);
        base = name;
        fs::create_directory(base / "data");
        data = base / "data";
    }
    void TearDown() override { fs::remove_all(base); }
    void write(const std::string& path, const std::string& text = "x") const {
        fs::create_directories((data / path).parent_path());
        std::ofstream{data / path} << text;
    }
    [[nodiscard]] std::vector<std::string> ids() const {
        const auto root = openFolder(data);
        std::vector<std::string> all;
        for (const FoundDataset& found : scanFolder(data, *root)) all.push_back(found.id);
        return all;
    }
    [[nodiscard]] std::uint64_t signature(const std::string& id) const {
        const auto root = openFolder(data);
        for (const FoundDataset& found : scanFolder(data, *root)) {
            if (found.id == id) return found.signature;
        }
        return 0;
    }
    fs::path base, data;
};

TEST_F(Folder, ListsWhatLoadersTakeByItsPath) {
    write("b.vtu");
    write("a/c.vtu");
    write("notes.doc");
    write(".hidden.vtu");
    EXPECT_THAT(ids(), ElementsAre("a/c.vtu", "b.vtu"));
}

TEST_F(Folder, AFolderOfImagesIsOneDataset) {
    for (const char* name : {"scan/1.tif", "scan/2.tif", "scan/3.tif"}) write(name);
    write("scan/mesh.vtu");
    EXPECT_THAT(ids(), ElementsAre("scan", "scan/mesh.vtu"));
}

TEST_F(Folder, LinksThatLeadOutAreNotListed) {
    std::ofstream{base / "secret.vtu"} << "x";
    write("inside.vtu");
    fs::create_symlink(base / "secret.vtu", data / "absolute.vtu");
    fs::create_symlink("../secret.vtu", data / "relative.vtu");
    fs::create_symlink("inside.vtu", data / "fine.vtu");
    fs::create_directory_symlink(base, data / "up");
    EXPECT_THAT(ids(), ElementsAre("fine.vtu", "inside.vtu"));
}

// Nobody writes to the FIFO: opening it must not wait for that.
TEST_F(Folder, FifosAndSocketsAreNotListedWhateverTheirNames) {
    write("file.vtu");
    ASSERT_EQ(::mkfifo((data / "fifo.vtu").c_str(), 0600), 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const std::string path = data / "socket.nrrd";
    ASSERT_LT(path.size(), sizeof address.sun_path);
    path.copy(address.sun_path, path.size());
    const base::FileDescriptor socket{::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)};
    ASSERT_EQ(::bind(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    EXPECT_THAT(ids(), ElementsAre("file.vtu"));
    const auto root = openFolder(data);
    ASSERT_TRUE(root.has_value());
    EXPECT_TRUE(openBeneath(*root, "fifo.vtu", Links::kRefuse).has_value());
    const auto refused = openBeneath(*root, "socket.nrrd", Links::kFollowInside);
    ASSERT_FALSE(refused.has_value());
    EXPECT_EQ(refused.error().code, ErrorCode::kNotFound);
}

TEST_F(Folder, NamesThatNoFileCanHaveAreAbsent) {
    write("file");
    const auto root = openFolder(data);
    ASSERT_TRUE(root.has_value());
    using namespace std::string_literals;
    const std::string longName(300, 'a'), longPath = std::string(5000, '.') + "/file";
    for (const std::string& path : {"file\0"s, "file\0.vtu"s, "\0"s, "folder\0/file"s, longName,
                                    longName + "/file", longPath}) {
        for (const Links links : {Links::kFollowInside, Links::kRefuse}) {
            const auto file = openBeneath(*root, path, links);
            ASSERT_FALSE(file.has_value()) << path;
            EXPECT_EQ(file.error().code, ErrorCode::kNotFound) << file.error().message;
        }
    }
}

TEST_F(Folder, TheSignatureFollowsTheFileAndItsCompanions) {
    write("a.mhd", "1");
    write("a.raw", "1");
    const std::uint64_t before = signature("a.mhd");
    EXPECT_EQ(signature("a.mhd"), before);
    write("a.raw", "12");
    EXPECT_NE(signature("a.mhd"), before);
}

TEST_F(Folder, NothingOutsideCanBeOpened) {
    std::ofstream{base / "secret"} << "x";
    write("file");
    fs::create_symlink("file", data / "link");
    const auto root = openFolder(data);
    ASSERT_TRUE(root.has_value());
    EXPECT_TRUE(openBeneath(*root, "file", Links::kRefuse).has_value());
    EXPECT_TRUE(openBeneath(*root, "link", Links::kFollowInside).has_value());
    for (const char* path : {"../secret", "/etc/passwd", "a/../../secret", "link", "..", ""}) {
        const auto file = openBeneath(*root, path, Links::kRefuse);
        ASSERT_FALSE(file.has_value()) << path;
        EXPECT_EQ(file.error().code, ErrorCode::kNotFound) << path;
    }
}

TEST_F(Folder, LinksAreFollowedAsFarAsTheyStayInside) {
    std::ofstream{base / "secret"} << "x";
    write("file");
    write("deep/inner/file");
    fs::create_symlink("deep/./inner//../../file", data / "round");
    fs::create_directory_symlink("inner", data / "deep" / "folder");
    fs::create_symlink("folder/../../round", data / "deep" / "chain");
    fs::create_symlink("loop", data / "loop");
    fs::create_symlink("deep/../../secret", data / "out");
    fs::create_symlink(base / "secret", data / "absolute");
    fs::create_directory_symlink("..", data / "up");
    const auto root = openFolder(data);
    ASSERT_TRUE(root.has_value());
    const auto open = [&](const char* path, Links links) {
        const auto file = openBeneath(*root, path, links);
        return file ? std::optional<ErrorCode>{} : file.error().code;
    };
    for (const char* path : {"round", "deep/folder/file", "deep/chain", "deep//folder/./file",
                             "deep/inner/../../file", "deep/", "."}) {
        EXPECT_EQ(open(path, Links::kFollowInside), std::nullopt) << path;
    }
    for (const char* path : {"loop", "out", "absolute", "up/secret", "up", "file/", "file/.",
                             "deep/folder/../../../secret", "loop/file"}) {
        EXPECT_EQ(open(path, Links::kFollowInside), ErrorCode::kNotFound) << path;
    }
    for (const char* path : {"round", "deep/folder/file", "deep/folder/", "loop"}) {
        EXPECT_EQ(open(path, Links::kRefuse), ErrorCode::kNotFound) << path;
    }
}

TEST_F(Folder, AFolderThatIsNoneIsRefused) {
    write("file");
    EXPECT_EQ(openFolder(data / "missing").error().code, ErrorCode::kNotFound);
    EXPECT_EQ(openFolder(data / "file").error().code, ErrorCode::kInvalidArgument);
}

}  // namespace
}  // namespace volcast::session
