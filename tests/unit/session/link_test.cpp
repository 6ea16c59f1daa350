#include "server/session/link.h"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sys/resource.h>
#include <sys/stat.h>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace volcast::session {
namespace {

using std::chrono::seconds;
using std::chrono::system_clock;

const system_clock::time_point kNow{seconds{1'800'000'000}};

TEST(Link, WhatWasSignedIsRead) {
    const LinkKey key = *LinkKey::random();
    const Link link{.view = "a-view_id", .role = v1::ROLE_CONTROL, .expires = kNow + seconds{5}};
    const auto text = signLink(link, key);
    ASSERT_TRUE(text.has_value());
    EXPECT_EQ(
        text->find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_"),
        std::string::npos);
    const auto read = readLink(*text, key, kNow);
    ASSERT_TRUE(read.has_value()) << read.error().message;
    EXPECT_EQ(read->view, link.view);
    EXPECT_EQ(read->role, link.role);
    EXPECT_EQ(read->expires, link.expires);
    EXPECT_NE(*signLink(link, key), *text) << "without a nonce";
}

TEST(Link, ExpiresWhenItSays) {
    const LinkKey key = *LinkKey::random();
    const auto text = signLink({.view = "v", .expires = kNow + seconds{5}}, key);
    EXPECT_TRUE(readLink(*text, key, kNow + seconds{4}).has_value());
    const auto late = readLink(*text, key, kNow + seconds{5});
    ASSERT_FALSE(late.has_value());
    EXPECT_EQ(late.error().message, "the link has expired");
}

// Views of all three lengths modulo 3: base64 ends differently.
TEST(Link, AnyChangeOfAnyCharacterIsRefused) {
    const LinkKey key = *LinkKey::random();
    const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
    for (const char* view : {"v", "vw", "vwx"}) {
        const std::string text = *signLink({.view = view, .expires = kNow + seconds{5}}, key);
        ASSERT_TRUE(readLink(text, key, kNow).has_value());
        for (std::size_t at = 0; at < text.size(); ++at) {
            for (const char letter : letters + "+/=. \n") {
                if (letter == text[at]) continue;
                std::string forged = text;
                forged[at] = letter;
                EXPECT_FALSE(readLink(forged, key, kNow).has_value()) << at << letter;
            }
            EXPECT_FALSE(readLink(text.substr(0, at), key, kNow).has_value()) << at;
        }
        for (const char* tail : {"A", "AA", "AAA", "AAAA", "=", "==", "\n"}) {
            EXPECT_FALSE(readLink(text + tail, key, kNow).has_value()) << tail;
        }
    }
}

TEST(Link, OfAnotherServersKeyIsRefused) {
    const std::string text =
        *signLink({.view = "v", .expires = kNow + seconds{5}}, *LinkKey::random());
    EXPECT_FALSE(readLink(text, *LinkKey::random(), kNow).has_value());
}

TEST(Link, HugeTextIsRefused) {
    EXPECT_FALSE(readLink(std::string(1 << 20, 'A'), *LinkKey::random(), kNow).has_value());
    EXPECT_FALSE(readLink("", *LinkKey::random(), kNow).has_value());
}

TEST(Access, IsReadInItsRoleUntilItExpires) {
    const LinkKey key = *LinkKey::random();
    for (const v1::Role role : {v1::ROLE_WATCH, v1::ROLE_CONTROL}) {
        const auto token = signAccess({.role = role, .expires = kNow + seconds{5}}, key);
        ASSERT_TRUE(token.has_value());
        const auto read = readAccess(*token, key, kNow + seconds{4});
        ASSERT_TRUE(read.has_value()) << read.error().message;
        EXPECT_EQ(read->role, role);
        EXPECT_EQ(read->expires, kNow + seconds{5});
        const auto late = readAccess(*token, key, kNow + seconds{5});
        ASSERT_FALSE(late.has_value());
        EXPECT_EQ(late.error().message, "the access token has expired");
    }
}

TEST(Access, IsNoLinkAndNoLinkIsOne) {
    const LinkKey key = *LinkKey::random();
    const auto expires = kNow + seconds{5};
    const std::string token = *signAccess({.role = v1::ROLE_CONTROL, .expires = expires}, key);
    EXPECT_FALSE(readLink(token, key, kNow).has_value());
    const std::string link =
        *signLink({.view = "v", .role = v1::ROLE_CONTROL, .expires = expires}, key);
    EXPECT_FALSE(readAccess(link, key, kNow).has_value());
    EXPECT_FALSE(readAccess(token, *LinkKey::random(), kNow).has_value());
    EXPECT_FALSE(readAccess("", key, kNow).has_value());
}

TEST(LinkKey, AFileIsMadeOnceForItsOwnerAndReadAgain) {
    const support::TemporaryFolder folder;
    const std::string path = (folder.path() / "key").string();
    const auto first = LinkKey::fromFile(path);
    ASSERT_TRUE(first.has_value()) << first.error().message;
    const auto again = LinkKey::fromFile(path);
    ASSERT_TRUE(again.has_value()) << again.error().message;
    EXPECT_EQ(first->sign("link", "x"), again->sign("link", "x"));
    EXPECT_NE(first->sign("link", "x"), first->sign("resume", "x"));
    struct stat status {};
    ASSERT_EQ(::stat(path.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777U, 0600U);
    ASSERT_EQ(::chmod(path.c_str(), 0640), 0);
    const auto open = LinkKey::fromFile(path);
    ASSERT_FALSE(open.has_value());
    EXPECT_NE(open.error().message.find("chmod 600"), std::string::npos) << open.error().message;
}

// What is there is never overwritten, and nothing else is left in the folder.
TEST(LinkKey, OfSeveralMadeAtOnceOneStaysAndAllHaveIt) {
    const support::TemporaryFolder folder;
    const std::string path = (folder.path() / "key").string();
    std::vector<LinkKey::Signature> signatures(8);
    std::vector<std::thread> threads;
    for (LinkKey::Signature& signature : signatures) {
        threads.emplace_back([&] {
            const auto key = LinkKey::fromFile(path);
            if (key) signature = key->sign("link", "x");
        });
    }
    for (std::thread& thread : threads) thread.join();
    const auto kept = LinkKey::fromFile(path);
    ASSERT_TRUE(kept.has_value()) << kept.error().message;
    for (const LinkKey::Signature& one : signatures) EXPECT_EQ(one, kept->sign("link", "x"));
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator{folder.path()}, {}), 1);
}

// A disk on which nothing can be written, until something can.
TEST(LinkKey, AWriteThatFailsLeavesNothingThatALaterStartTrips) {
    const support::TemporaryFolder folder;
    const std::string path = (folder.path() / "key").string();
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto ignored = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{.rlim_cur = 10, .rlim_max = before.rlim_max};  // Bytes: less than a key.
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    const auto refused = LinkKey::fromFile(path);
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
    std::signal(SIGXFSZ, ignored);
    ASSERT_FALSE(refused.has_value());
    EXPECT_EQ(refused.error().code, ErrorCode::kIo);
    EXPECT_EQ(refused.error().message.find(path), 0U) << refused.error().message;
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
    EXPECT_TRUE(LinkKey::fromFile(path).has_value());
}

TEST(LinkKey, WhatIsNoKeyIsRefused) {
    const support::TemporaryFolder folder;
    const std::string path = (folder.path() / "key").string();
    for (const std::string& text :
         {std::string{"short"}, std::string(64, 'g'), std::string(66, 'a')}) {
        std::ofstream{path} << text;
        ASSERT_EQ(::chmod(path.c_str(), 0600), 0);
        EXPECT_FALSE(LinkKey::fromFile(path).has_value()) << text;
    }
    EXPECT_FALSE(LinkKey::fromFile((folder.path() / "none" / "key").string()).has_value());
}

}  // namespace
}  // namespace volcast::session
