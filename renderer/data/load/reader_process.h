#pragma once

#include <cstdint>
#include <string>

#include "renderer/base/file_descriptor.h"
#include "renderer/base/result.h"

namespace volcast::data::load {

/// A Python program that reads one file and writes records to a pipe (see reader_common.py).
class ReaderProcess {
public:
    /// Starts `program` on `path`. Errors: kNotFound (no Python), kIo.
    static Result<ReaderProcess> start(const std::string& program, const std::string& path);

    /// Where the records come from.
    [[nodiscard]] int records() const noexcept { return records_.get(); }

    /// Waits for its end, closing the pipe; empty for a normal one, else how it ended and the last
    /// line it wrote to stderr.
    std::string finish();

private:
    ReaderProcess(int pid, base::FileDescriptor records, base::FileDescriptor complaints)
        : pid_{pid}, records_{std::move(records)}, complaints_{std::move(complaints)} {}

    int pid_ = 0;
    base::FileDescriptor records_;
    base::FileDescriptor complaints_;
};

}  // namespace volcast::data::load
