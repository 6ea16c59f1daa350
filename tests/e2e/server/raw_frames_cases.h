#pragma once

#include <string>
#include <vector>

namespace volcast::test {

/// What must follow when a client that has said hello sends some bytes.
struct RawCase {
    enum class Then {
        kAlive,   ///< Nothing is said, and a ping is answered.
        kPong,    ///< A pong with `answer`, and a ping is answered.
        kReply,   ///< A text message that contains `answer`, and a ping is answered.
        kClosed,  ///< A close frame with `code`, and the end of the connection.
    };
    std::string name;
    std::vector<std::string> sends;  ///< Written one by one.
    Then then = Then::kAlive;
    std::string answer = {};
    unsigned code = 0;
};

std::vector<RawCase> lengthCases();
std::vector<RawCase> fragmentCases();
std::vector<RawCase> controlCases();
std::vector<RawCase> headerBitCases();
std::vector<RawCase> textCases();
std::vector<RawCase> closeCases();

}  // namespace volcast::test
