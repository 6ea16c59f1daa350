#include "renderer/data/load/record_stream.h"

#include <cerrno>
#include <cstring>
#include <unistd.h>

namespace volcast::data::load {

namespace {

constexpr std::uint32_t kMaxText = 64 * 1024;

struct Header {
    std::uint32_t kind = 0;
    std::uint32_t textBytes = 0;
    std::uint64_t dataBytes = 0;
};
static_assert(sizeof(Header) == 16);

}  // namespace

Result<void> RecordStream::read(void* target, std::uint64_t size) {
    auto* place = static_cast<char*>(target);
    while (size > 0) {
        const ssize_t got = ::read(fd_, place, size);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) {
            return fail(ErrorCode::kIo, std::string{"its reader: "} + std::strerror(errno));
        }
        if (got == 0) {
            ended_ = true;
            return fail(ErrorCode::kInvalidArgument, "its reader stopped early");
        }
        place += got;
        size -= static_cast<std::uint64_t>(got);
    }
    return {};
}

Result<Record> RecordStream::next() {
    Header header;
    auto done = read(&header, sizeof header);
    if (!done) return done.error();
    if (header.kind < static_cast<std::uint32_t>(RecordKind::kProgress) ||
        header.kind > static_cast<std::uint32_t>(RecordKind::kEnd) || header.textBytes > kMaxText) {
        return fail(ErrorCode::kInvalidArgument, "its reader sent nonsense");
    }
    if (header.dataBytes > left_) {
        return fail(ErrorCode::kLimitExceeded,
                    "holds more than the import may use (" + std::to_string(header.dataBytes) +
                        " bytes in one array, " + std::to_string(left_) + " left)");
    }
    left_ -= header.dataBytes;
    Record record{.kind = static_cast<RecordKind>(header.kind),
                  .text = std::string(header.textBytes, '\0'),
                  .dataBytes = header.dataBytes};
    done = read(record.text.data(), record.text.size());
    if (!done) return done.error();
    return record;
}

}  // namespace volcast::data::load
