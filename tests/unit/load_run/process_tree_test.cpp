#include "server/load/process_tree.h"

#include <unistd.h>

#include <gtest/gtest.h>

#include "server/workers/child_process.h"

namespace volcast::load {
namespace {

TEST(ProcessTree, CountsOurselvesAndOurChildren) {
    const auto alone = treeUse(::getpid());
    ASSERT_TRUE(alone.has_value());
    EXPECT_EQ(alone->processes, 1U);
    EXPECT_GE(alone->rootThreads, 1U);
    EXPECT_GE(alone->rootDescriptors, 3U);
    EXPECT_GT(alone->rootBytes, 100'000U);
    EXPECT_EQ(alone->treeBytes, alone->rootBytes);
    EXPECT_EQ(alone->treeThreads, alone->rootThreads);
    EXPECT_EQ(alone->treeDescriptors, alone->rootDescriptors);
    const auto child = workers::ChildProcess::spawn(
        {.program = "/bin/sleep", .arguments = {"60"}, .environment = {}});
    ASSERT_TRUE(child.has_value());
    auto both = treeUse(::getpid());
    // A program that is just being started has no memory yet.
    while (both && both->treeBytes == both->rootBytes) both = treeUse(::getpid());
    ASSERT_TRUE(both.has_value());
    EXPECT_EQ(both->processes, 2U);
    EXPECT_GT(both->treeBytes, both->rootBytes);
    EXPECT_EQ(both->treeThreads, both->rootThreads + 1);
    EXPECT_GE(both->treeDescriptors, both->rootDescriptors);
}

TEST(ProcessTree, OfNoProcessIsEmpty) {
    EXPECT_FALSE(treeUse(0x7fffffff).has_value());
}

}  // namespace
}  // namespace volcast::load
