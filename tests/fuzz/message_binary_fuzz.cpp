// A binary message of a client; what is read can be written and read again.
#include "server/session/wire.h"
#include "tests/fuzz/fuzz_target.h"

using namespace volcast;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto message = session::readMessage(fuzz::bytesOf(data, size), session::Form::kBinary);
    if (!message) return 0;
    const std::string bytes = message->SerializeAsString();
    fuzz::require(
        session::readMessage(std::as_bytes(std::span{bytes}), session::Form::kBinary).has_value());
    return 0;
}
