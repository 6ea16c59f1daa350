#include "server/commands/client_folder.h"

#include <fstream>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace volcast::commands {
namespace {

namespace fs = std::filesystem;

void writePage(const fs::path& folder) {
    fs::create_directories(folder);
    std::ofstream{folder / "index.html"} << "<!doctype html>";
}

// build/release/bin/volcast and build/web_client; web_client itself is the source.
TEST(ClientFolder, OfABuildIsBesideTheBuildsFolder) {
    const support::TemporaryFolder build;
    EXPECT_EQ(clientFolderOf(build.path() / "release/bin/volcast"), build.path() / "web_client");
    writePage(build.path() / "web_client");
    EXPECT_EQ(clientFolderOf(build.path() / "release/bin/volcast"), build.path() / "web_client");
}

TEST(ClientFolder, OfAnInstalledServerIsBesideItsPrograms) {
    const support::TemporaryFolder opt;
    writePage(opt.path() / "web_client");
    writePage(opt.path() / "volcast/web_client");
    EXPECT_EQ(clientFolderOf(opt.path() / "volcast/bin/volcast"),
              opt.path() / "volcast/web_client");
}

}  // namespace
}  // namespace volcast::commands
