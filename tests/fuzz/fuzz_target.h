#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

/// libFuzzer's entry: hands bytes that nobody chose to one parser. In ordinary builds
/// corpus_runner.cpp calls it with the files of a corpus.
extern "C" int LLVMFuzzerTestOneInput(  // NOLINT(readability-identifier-naming): libFuzzer's
    const std::uint8_t* data, std::size_t size);

namespace volcast::fuzz {

inline std::string_view textOf(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

inline std::span<const std::byte> bytesOf(const std::uint8_t* data, std::size_t size) {
    return std::as_bytes(std::span{data, size});
}

/// What a parser promises was broken: ends the process, so that the fuzzer keeps the input.
inline void require(bool holds) {
    if (!holds) __builtin_trap();
}

}  // namespace volcast::fuzz
