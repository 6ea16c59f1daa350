// A frame's prefix and header; a good prefix is written as it was read.
#include "protocol/framing.h"
#include "tests/fuzz/fuzz_target.h"

using namespace volcast;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto bytes = fuzz::bytesOf(data, size);
    if (const auto prefix = protocol::decodePrefix(bytes)) {
        const auto again = protocol::decodePrefix(bytes);
        fuzz::require(again.has_value() && *again == *prefix);
        const auto encoded = protocol::encode(*prefix);
        fuzz::require(std::equal(encoded.begin(), encoded.end(), bytes.begin()));
    }
    if (const auto frame = protocol::decodeFrame(bytes)) {
        fuzz::require(frame->payload.size() + protocol::kPrefixBytes + frame->prefix.headerBytes ==
                      size);
    }
    return 0;
}
