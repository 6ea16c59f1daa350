// Files of 1 MB that unpack to 1 GB are refused, and cost no more memory than an import may use.
#include <array>
#include <memory>
#include <sstream>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "renderer/base/sandbox.h"
#include "tests/e2e/import/import_fixture.h"

namespace volcast::test {
namespace {

constexpr auto kInvalid = ErrorCode::kInvalidArgument;
constexpr auto kLimit = ErrorCode::kLimitExceeded;

struct Refusal {
    int code = -1;      ///< -1: it was imported.
    long peakMib = -1;  ///< Of the importer or its reader, whichever took more.
    std::string message;
};

class Bomb : public Import {
protected:
    static constexpr long kMaxMib = 64;

    static void SetUpTestSuite() {
        bombs = std::make_unique<TempFolder>();
        ASSERT_EQ(bombs->python(content(VOLCAST_SOURCE_DIR "/tests/support/bombs.py")), "");
    }
    static void TearDownTestSuite() { bombs.reset(); }
    void SetUp() override { settings.maxMemoryBytes = std::uint64_t{kMaxMib} << 20; }

    /// Imports in a process of its own, which had no children before.
    [[nodiscard]] Refusal refusalOf(const std::string& path) {
        std::array<int, 2> ends{};
        EXPECT_EQ(::pipe(ends.data()), 0);
        const pid_t child = ::fork();
        if (child == 0) {
            const auto imported = import(path);
            rusage used{};
            ::getrusage(RUSAGE_CHILDREN, &used);
            std::ostringstream text;
            text << (imported ? -1 : static_cast<int>(imported.error().code)) << ' '
                 << used.ru_maxrss / 1024 << ' ' << (imported ? "" : imported.error().message);
            const std::string all = text.str();
            ::_exit(::write(ends[1], all.data(), all.size()) < 0 ? 1 : 0);
        }
        ::close(ends[1]);
        std::string text(4096, '\0');
        const ssize_t size = ::read(ends[0], text.data(), text.size());
        text.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
        ::close(ends[0]);
        ::waitpid(child, nullptr, 0);
        Refusal refusal;
        std::istringstream words{text};
        words >> refusal.code >> refusal.peakMib;
        std::getline(words, refusal.message);
        return refusal;
    }

    void expectDefused(const std::string& name, ErrorCode code, const std::string& reason) {
        const Refusal refusal = refusalOf(bombs->path(name));
        EXPECT_EQ(refusal.code, static_cast<int>(code)) << name << ": " << refusal.message;
        EXPECT_NE(refusal.message.find(bombs->path(name)), std::string::npos) << refusal.message;
        EXPECT_NE(refusal.message.find(reason), std::string::npos) << refusal.message;
        EXPECT_GT(refusal.peakMib, 0);
        // Python with VTK takes 60 MiB.
        constexpr long kMostMib = kMaxMib + 96;
        EXPECT_LT(refusal.peakMib, base::kLimitsAddressSpace ? kMostMib : 1024) << name;
    }

    static std::unique_ptr<TempFolder> bombs;
};
std::unique_ptr<TempFolder> Bomb::bombs;

TEST_F(Bomb, WhoseHeaderSaysLittleIsRefusedForWhatItHoldsMore) {
    for (const char* name : {"small.nrrd", "small.mha"}) {
        expectDefused(name, kInvalid, "holds more than the 64 bytes that its header says");
    }
    expectDefused("small.nii.gz", kInvalid, "holds more than the 416 bytes that its header says");
    expectDefused("small.vtu", kInvalid, "VTK's reader says: Zlib error");
}

TEST_F(Bomb, WhoseHeaderSaysMuchIsRefusedBeforeItIsUnpacked) {
    for (const char* name : {"honest.nrrd", "honest.mha", "honest.nii.gz"}) {
        expectDefused(name, kLimit, "unpacks to 1073741824 bytes, this import may use 67108864");
    }
    for (const char* name : {"honest.vtu", "large.vtu"}) {
        if (!base::kLimitsAddressSpace) continue;  // VTK finds its own way, or not.
        expectDefused(name, kLimit, "needs more memory");
    }
}

}  // namespace
}  // namespace volcast::test
