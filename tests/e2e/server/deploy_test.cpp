// What deploy/ ships, as far as it can be looked at without root.
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>

#include "tests/e2e/server/shell.h"

namespace volcast::test {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kUnit = VOLCAST_SOURCE_DIR "/deploy/systemd/volcast.service";

// The score is systemd's own: 0 exposes nothing, 10 everything; what it calls OK ends at 5.
TEST(SystemdUnit, IsHardenedAsSystemdCounts) {
    if (!std::filesystem::exists("/usr/bin/systemd-analyze")) {
        GTEST_SKIP() << "systemd-analyze is not here";
    }
    const auto [text, status] = outputOf(
        std::string{"systemd-analyze security --no-pager --offline=true --threshold=20 "} + kUnit);
    EXPECT_EQ(status, 0) << text;
    EXPECT_THAT(text, HasSubstr("Overall exposure level for volcast.service: 1.5 OK"));
    EXPECT_THAT(text, Not(HasSubstr("ignoring")));
}

// llvmpipe maps what it compiles as writable and executable.
TEST(SystemdUnit, LetsMesaCompile) {
    std::ifstream file{kUnit};
    const std::string text{std::istreambuf_iterator<char>{file}, {}};
    EXPECT_THAT(text, HasSubstr("\nMemoryDenyWriteExecute=no\n"));
    EXPECT_THAT(text, HasSubstr("\nKillMode=mixed\n"));
}

}  // namespace
}  // namespace volcast::test
