#include "renderer/base/printable.h"

#include <gtest/gtest.h>

namespace volcast::base {
namespace {

TEST(Printable, NothingCanEndTheLineOrTheQuotes) {
    EXPECT_EQ(printable("a\nb\r\tc\"d\\e\x1b[0m\x7f"), "a?b??c?d?e?[0m?");
    EXPECT_EQ(printable("Schädel.mhd"), "Schädel.mhd");
}

TEST(Printable, LongTextIsCut) {
    EXPECT_EQ(printable("abcdef", 3), "abc");
    EXPECT_EQ(printable(std::string(1000, 'x')).size(), 200U);
}

}  // namespace
}  // namespace volcast::base
