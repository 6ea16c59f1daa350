#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "renderer/base/result.h"

namespace volcast::data::load {

/// What a record of a reader says; numbers as in reader_common.py.
enum class RecordKind : std::uint32_t {
    kProgress = 1,
    kWarning,
    kRefused,
    kFormat,
    kPoints,
    kCells,
    kField,
    kGrid,
    kChannel,
    kEnd,
};

struct Record {
    RecordKind kind = RecordKind::kEnd;
    std::string text;
    std::uint64_t dataBytes = 0;  ///< That follow; take them with readData().
};

/// Reads records of a process that is not trusted from a pipe.
class RecordStream {
public:
    /// All data together may have `maxBytes`.
    RecordStream(int fd, std::uint64_t maxBytes) : fd_{fd}, left_{maxBytes} {}

    /// Errors: kInvalidArgument (ended within or before a record, unknown kind, text too long),
    /// kLimitExceeded (more data than allowed), kIo.
    Result<Record> next();

    /// Fills `size` bytes. Errors: kInvalidArgument (the stream ended), kIo.
    Result<void> read(void* target, std::uint64_t size);

    /// The record's data as values of T. Errors: as read(), and a size that is no multiple of T's.
    template <class T>
    Result<std::vector<T>> values(const Record& record) {
        if (record.dataBytes % sizeof(T) != 0) {
            return fail(ErrorCode::kInvalidArgument, "its reader sent a part of a number");
        }
        std::vector<T> result(record.dataBytes / sizeof(T));
        auto done = read(result.data(), record.dataBytes);
        if (!done) return done.error();
        return result;
    }

    /// True once the other end has closed the pipe.
    [[nodiscard]] bool ended() const noexcept { return ended_; }

private:
    int fd_;
    std::uint64_t left_;
    bool ended_ = false;
};

}  // namespace volcast::data::load
