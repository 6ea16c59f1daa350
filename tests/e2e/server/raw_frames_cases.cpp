// RFC 6455, section by section, as bytes and what must follow.
#include "tests/e2e/server/raw_frames_cases.h"

#include "tests/e2e/server/raw_socket.h"

namespace volcast::test {

namespace {

using Then = RawCase::Then;

constexpr unsigned kProtocolError = 1002, kBadPayload = 1007, kTooBig = 1009;
constexpr std::size_t kLimit = 65536;  ///< SessionLimits::maxMessageBytes.

const std::string kAsk = R"({"ping":{"token":"7"}})";
const std::string kAnswer = R"("token":"7")";
const std::string kMalformed = "ERROR_CODE_MALFORMED_MESSAGE";

/// The question, with blanks up to `size` bytes.
std::string padded(std::size_t size) {
    return kAsk + std::string(size - kAsk.size(), ' ');
}

RawCase closed(std::string name, std::vector<std::string> sends, unsigned code = kProtocolError) {
    return {
        .name = std::move(name), .sends = std::move(sends), .then = Then::kClosed, .code = code};
}

RawCase replied(std::string name, std::vector<std::string> sends, std::string answer = kAnswer) {
    return {.name = std::move(name),
            .sends = std::move(sends),
            .then = Then::kReply,
            .answer = std::move(answer)};
}

std::vector<std::string> byteByByte(const std::string& text) {
    std::vector<std::string> bytes;
    for (const char c : text) bytes.emplace_back(1, c);
    return bytes;
}

}  // namespace

// Section 5.2, payload length: the smallest of three forms; and our own limit.
std::vector<RawCase> lengthCases() {
    std::vector<RawCase> cases;
    for (const std::size_t size :
         {std::size_t{125}, std::size_t{126}, std::size_t{127}, std::size_t{65535}, kLimit}) {
        cases.push_back(
            replied("text of " + std::to_string(size), {rawFrame(kText, padded(size))}));
    }
    cases.push_back(replied("empty text", {rawFrame(kText, "")}, kMalformed));
    // No bytes are a ClientMessage without a body.
    cases.push_back(replied("empty binary", {rawFrame(kBinary, "")}, kMalformed));
    cases.push_back(
        replied("binary of 65535", {rawFrame(kBinary, std::string(65535, '\xff'))}, kMalformed));
    cases.push_back(closed("text above the limit", {rawFrame(kText, padded(kLimit + 1))}, kTooBig));
    cases.push_back(closed("binary above the limit",
                           {rawFrame(kBinary, std::string(kLimit + 1, 'x'))}, kTooBig));
    cases.push_back(closed("header that says a gigabyte",
                           {rawFrame(kBinary, "", {.saysLength = 1U << 30U})}, kTooBig));
    cases.push_back(closed(
        "fragments above the limit together",
        {rawFrame(kText, padded(kLimit), {.fin = false}), rawFrame(kContinue, " ")}, kTooBig));
    cases.push_back(
        closed("2 bytes of length for 125", {rawFrame(kText, padded(125), {.lengthBytes = 2})}));
    cases.push_back(
        closed("2 bytes of length for none", {rawFrame(kText, "", {.lengthBytes = 2})}));
    cases.push_back(
        closed("8 bytes of length for 125", {rawFrame(kText, padded(125), {.lengthBytes = 8})}));
    cases.push_back(closed("8 bytes of length for 65535",
                           {rawFrame(kText, padded(65535), {.lengthBytes = 8})}));
    cases.push_back(replied("a frame byte by byte", byteByByte(rawFrame(kText, padded(130)))));
    cases.push_back(replied("header and payload apart",
                            {rawFrame(kText, kAsk).substr(0, 6), rawFrame(kText, kAsk).substr(6)}));
    return cases;
}

// Section 5.4.
std::vector<RawCase> fragmentCases() {
    const FrameForm more{.fin = false};
    std::vector<RawCase> cases;
    cases.push_back(replied("two fragments", {rawFrame(kText, kAsk.substr(0, 5), more),
                                              rawFrame(kContinue, kAsk.substr(5))}));
    cases.push_back(replied("three fragments, the middle one empty",
                            {rawFrame(kText, kAsk.substr(0, 5), more),
                             rawFrame(kContinue, "", more), rawFrame(kContinue, kAsk.substr(5))}));
    cases.push_back(
        replied("empty first fragment", {rawFrame(kText, "", more), rawFrame(kContinue, kAsk)}));
    cases.push_back(
        replied("empty last fragment", {rawFrame(kText, kAsk, more), rawFrame(kContinue, "")}));
    cases.push_back(replied("all fragments empty",
                            {rawFrame(kText, "", more), rawFrame(kContinue, "")}, kMalformed));
    std::vector<std::string> single{rawFrame(kText, kAsk.substr(0, 1), more)};
    for (std::size_t i = 1; i < kAsk.size(); ++i) {
        single.push_back(rawFrame(kContinue, kAsk.substr(i, 1), {.fin = i + 1 == kAsk.size()}));
    }
    cases.push_back(replied("a fragment a byte", single));
    std::string atOnce;
    for (const std::string& one : single) atOnce += one;
    cases.push_back(replied("a fragment a byte, in one write", {atOnce}));
    cases.push_back(
        replied("two messages in one write", {rawFrame(kPong, "") + rawFrame(kText, kAsk)}));
    cases.push_back(replied("binary in fragments",
                            {rawFrame(kBinary, "\xff", more), rawFrame(kContinue, "\xff")},
                            kMalformed));
    cases.push_back({.name = "ping between fragments",
                     .sends = {rawFrame(kBinary, "\xff", more), rawFrame(kPing, "between")},
                     .then = Then::kPong,
                     .answer = "between"});
    cases.push_back(replied("pong between fragments",
                            {rawFrame(kText, kAsk.substr(0, 9), more), rawFrame(kPong, "x"),
                             rawFrame(kContinue, kAsk.substr(9))}));
    cases.push_back(closed("close between fragments",
                           {rawFrame(kText, kAsk.substr(0, 9), more), closeFrame(1000)}, 1000));
    cases.push_back(closed("continuation of nothing", {rawFrame(kContinue, kAsk)}));
    cases.push_back(
        closed("unfinished continuation of nothing", {rawFrame(kContinue, kAsk, more)}));
    cases.push_back(
        closed("continuation behind a whole message",
               {rawFrame(kText, "{", more), rawFrame(kContinue, "}"), rawFrame(kContinue, "")}));
    cases.push_back(
        closed("text inside a message", {rawFrame(kText, "{", more), rawFrame(kText, "}")}));
    cases.push_back(
        closed("binary inside a message", {rawFrame(kText, "{", more), rawFrame(kBinary, "}")}));
    cases.push_back(closed("unfinished text inside a message",
                           {rawFrame(kText, "{", more), rawFrame(kText, "}", more)}));
    return cases;
}

// Section 5.5: at most 125 bytes, never in fragments.
std::vector<RawCase> controlCases() {
    std::vector<RawCase> cases;
    for (const std::size_t size : {0U, 1U, 124U, 125U}) {
        const std::string payload(size, 'p');
        cases.push_back({.name = "ping of " + std::to_string(size),
                         .sends = {rawFrame(kPing, payload)},
                         .then = Then::kPong,
                         .answer = payload});
        cases.push_back({.name = "pong of " + std::to_string(size) + " that nobody asked for",
                         .sends = {rawFrame(kPong, payload)}});
    }
    cases.push_back({.name = "ping of any bytes",
                     .sends = {rawFrame(kPing, std::string{"\x00\xff\x80", 3})},
                     .then = Then::kPong,
                     .answer = std::string{"\x00\xff\x80", 3}});
    cases.push_back({.name = "ping byte by byte",
                     .sends = byteByByte(rawFrame(kPing, "slow")),
                     .then = Then::kPong,
                     .answer = "slow"});
    for (const unsigned opcode : {kClose, kPing, kPong}) {
        const std::string which = "control frame " + std::to_string(opcode);
        cases.push_back(closed(which + " of 126 bytes", {rawFrame(opcode, std::string(126, 'x'))}));
        cases.push_back(
            closed(which + " of 65536 bytes", {rawFrame(opcode, std::string(65536, 'x'))}));
        cases.push_back(closed(which + " in fragments", {rawFrame(opcode, "", {.fin = false})}));
    }
    return cases;
}

// Section 5.2: reserved bits and opcodes; section 5.1: clients mask.
std::vector<RawCase> headerBitCases() {
    std::vector<RawCase> cases;
    for (const unsigned opcode : {kText, kBinary, kClose, kPing, kPong}) {
        const std::string which = " of opcode " + std::to_string(opcode);
        for (const unsigned bit : {4U, 2U, 1U}) {
            cases.push_back(closed("reserved bit " + std::to_string(bit) + which,
                                   {rawFrame(opcode, "", {.reserved = bit})}));
        }
        cases.push_back(closed("no mask" + which, {rawFrame(opcode, "", {.masked = false})}));
    }
    for (const unsigned opcode : {3U, 4U, 5U, 6U, 7U, 11U, 12U, 13U, 14U, 15U}) {
        cases.push_back(
            closed("reserved opcode " + std::to_string(opcode), {rawFrame(opcode, "")}));
    }
    cases.push_back(closed("compressed text, which was not negotiated",
                           {rawFrame(kText, "\xaa\x56\x2a\xc8\xcc\x4b\x57\xb2", {.reserved = 4})}));
    return cases;
}

// Section 8.1: text is UTF-8 (RFC 3629), checked over fragments.
std::vector<RawCase> textCases() {
    const std::vector<std::pair<const char*, std::string>> bad{
        {"a lone continuation byte", "\x80"},
        {"an overlong slash of 2 bytes", "\xc0\xaf"},
        {"an overlong nul of 2 bytes", "\xc0\x80"},
        {"an overlong slash of 3 bytes", "\xe0\x80\xaf"},
        {"an overlong slash of 4 bytes", "\xf0\x80\x80\xaf"},
        {"the first surrogate", "\xed\xa0\x80"},
        {"the last surrogate", "\xed\xbf\xbf"},
        {"a point above U+10FFFF", "\xf4\x90\x80\x80"},
        {"a start byte of 5 bytes", "\xf8\x88\x80\x80\x80"},
        {"byte FE", "\xfe"},
        {"byte FF", "\xff"},
        {"2 bytes that end after 1", "\xc3"},
        {"3 bytes that end after 2", "\xe2\x82"},
        {"4 bytes that end after 3", "\xf0\x9f\x98"},
        {"a start byte without its rest", "\xc3("},
    };
    std::vector<RawCase> cases;
    for (const auto& [name, bytes] : bad) {
        cases.push_back(
            closed(std::string{"text with "} + name, {rawFrame(kText, "{" + bytes)}, kBadPayload));
    }
    cases.push_back(closed("bad text in the second fragment",
                           {rawFrame(kText, "{", {.fin = false}), rawFrame(kContinue, "\xff")},
                           kBadPayload));
    cases.push_back(closed("a character cut at the message's end, over fragments",
                           {rawFrame(kText, "{\xe2", {.fin = false}), rawFrame(kContinue, "\x82")},
                           kBadPayload));
    const std::string word = "\xce\xba\xf0\x9f\x98\x80\xf4\x8f\xbf\xbf\xee\x80\x80";
    for (std::size_t at = 0; at <= word.size(); ++at) {
        cases.push_back(replied("good text in fragments after " + std::to_string(at) + " bytes",
                                {rawFrame(kText, word.substr(0, at), {.fin = false}),
                                 rawFrame(kContinue, word.substr(at))},
                                kMalformed));
    }
    cases.push_back(
        replied("binary need not be UTF-8", {rawFrame(kBinary, "\xff\xfe")}, kMalformed));
    return cases;
}

// Section 7.4: codes that may be sent come back; others are an error.
std::vector<RawCase> closeCases() {
    std::vector<RawCase> cases;
    for (const unsigned code : {1000U, 1001U, 1002U, 1003U, 1007U, 1008U, 1009U, 1010U, 1011U,
                                1012U, 1013U, 3000U, 3999U, 4000U, 4999U}) {
        cases.push_back(closed("close " + std::to_string(code), {closeFrame(code)}, code));
    }
    for (const unsigned code :
         {0U, 1U, 999U, 1004U, 1005U, 1006U, 1014U, 1015U, 1016U, 1100U, 2000U, 2999U}) {
        cases.push_back(
            closed("close " + std::to_string(code) + ", which is not sent", {closeFrame(code)}));
    }
    cases.push_back(closed("close without a code", {rawFrame(kClose, "")}, 1000));
    cases.push_back(closed("close with half a code", {rawFrame(kClose, "\x03")}));
    cases.push_back(closed("close with a reason of 123 bytes",
                           {closeFrame(1000, std::string(123, 'r'))}, 1000));
    // RFC 6455 asks to fail the connection (section 8.1) and leaves the code open.
    cases.push_back(closed("close with a reason that is not UTF-8", {closeFrame(1000, "\xff")}));
    cases.push_back(closed("messages behind a close are not read",
                           {closeFrame(1000) + rawFrame(kText, kAsk)}, 1000));
    return cases;
}

}  // namespace volcast::test
