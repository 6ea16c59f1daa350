#include "renderer/worker/fault_names.h"

#include <sstream>

#include <gmock/gmock.h>

namespace volcast::worker {
namespace {

using testing::HasSubstr;

TEST(FaultNames, EachNameOfTheListIsReadAndWrittenAgain) {
    std::istringstream lines{faultList()};
    std::string line;
    int count = 0;
    while (std::getline(lines, line)) {
        const std::string name = line.substr(0, line.find(' '));
        const auto spec = parseFault(name);
        ASSERT_TRUE(spec) << spec.error().message;
        EXPECT_EQ(static_cast<int>(spec->fault), count) << name;
        EXPECT_EQ(toText(*spec), name + ":0");
        ++count;
    }
    EXPECT_EQ(count, 13);
    EXPECT_EQ(toText(parseFault("gpu-reset:7").value()), "gpu-reset:7");
}

TEST(FaultNames, AnUnknownNameIsAnsweredWithAllThatThereAre) {
    for (const char* text : {"", "crash ", "Crash", "nonsense:3", ":1"}) {
        const auto spec = parseFault(text);
        ASSERT_FALSE(spec) << text;
        EXPECT_EQ(spec.error().code, ErrorCode::kInvalidArgument);
        EXPECT_THAT(spec.error().message, HasSubstr("there are crash, hang-in-draw, "));
        EXPECT_THAT(spec.error().message, HasSubstr("import-hang"));
    }
}

TEST(FaultNames, ChancesToLetPassAreANumber) {
    for (const char* text : {"crash:", "crash:-1", "crash:1x", "crash:4294967296", "crash:1:2"}) {
        const auto spec = parseFault(text);
        ASSERT_FALSE(spec) << text;
        EXPECT_THAT(spec.error().message, HasSubstr("is no number of chances")) << text;
    }
}

TEST(FaultNames, EachStrikesOneKindOfProcess) {
    EXPECT_EQ(struckBy(Fault::kCrash), FaultyProcess::kWorker);
    EXPECT_EQ(struckBy(Fault::kLoseGpu), FaultyProcess::kWorker);
    EXPECT_EQ(struckBy(Fault::kSpareExit), FaultyProcess::kSpare);
    EXPECT_EQ(struckBy(Fault::kImportCrash), FaultyProcess::kImport);
    EXPECT_EQ(struckBy(Fault::kImportHang), FaultyProcess::kImport);
}

}  // namespace
}  // namespace volcast::worker
