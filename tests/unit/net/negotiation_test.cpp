#include "server/net/negotiation.h"

#include <gtest/gtest.h>

namespace volcast::net {
namespace {

TEST(AcceptEncoding, LetsGzipInByNameOrByStarUnlessItsWeightIsZero) {
    for (const char* header :
         {"gzip", "GZIP", "x-gzip", "br, gzip", "deflate,gzip;q=0.1", "gzip; q=1", "*",
          "identity;q=0, *;q=0.5", "br;q=1.0 , gzip;q=0.8, *;q=0"}) {
        EXPECT_TRUE(acceptsGzip(header)) << header;
    }
    for (const char* header : {"", "br", "identity", "gzip;q=0", "gzip;q=0.000", "gzip;q=x",
                               "*, gzip;q=0", "*;q=0", "gzipped", ",", ";q=1"}) {
        EXPECT_FALSE(acceptsGzip(header)) << header;
    }
}

TEST(IfNoneMatch, IsAListAndComparesWeakly) {
    for (const char* header : {"\"a-1\"", "W/\"a-1\"", "\"b\", \"a-1\"", "*", " \"a-1\" "}) {
        EXPECT_TRUE(namesEtag(header, "\"a-1\"")) << header;
    }
    for (const char* header : {"", "a-1", "\"a-1-gz\"", "\"b\", W/\"c\"", "w/\"a-1\""}) {
        EXPECT_FALSE(namesEtag(header, "\"a-1\"")) << header;
    }
}

}  // namespace
}  // namespace volcast::net
