// A JSON message of a client, and our answer to a bad one, which quotes it.
#include "server/session/wire.h"
#include "tests/fuzz/fuzz_target.h"

using namespace volcast;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto message = session::readMessage(fuzz::bytesOf(data, size), session::Form::kJson);
    if (message) return 0;
    const auto answer =
        session::errorMessage(v1::ERROR_CODE_MALFORMED_MESSAGE, message.error().message);
    fuzz::require(!session::writeMessage(answer, session::Form::kJson).empty());
    return 0;
}
