// PNG written by hand: the generic libraries spend most of their time on choices that are fixed
// here. Format: W3C, Portable Network Graphics (PNG) Specification, second edition, 2003.
#include <array>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string_view>

#include <libdeflate.h>

#include "server/video/encoder.h"
#include "server/video/image_check.h"

namespace volcast::video {

namespace {

constexpr int kDeflateLevel = 1;
constexpr std::byte kUpFilter{2};
constexpr std::byte kBitsPerSample{8};
constexpr std::byte kColourTypeRgba{6};
constexpr std::array<std::uint8_t, 8> kSignature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};

struct CompressorDeleter {
    void operator()(libdeflate_compressor* compressor) const noexcept {
        libdeflate_free_compressor(compressor);
    }
};

libdeflate_compressor* threadCompressor() {
    thread_local const std::unique_ptr<libdeflate_compressor, CompressorDeleter> compressor{
        libdeflate_alloc_compressor(kDeflateLevel)};
    return compressor.get();
}

/// A block of memory that is not cleared first.
struct Block {
    explicit Block(std::size_t count) : bytes{new std::byte[count]}, size{count} {}
    std::unique_ptr<std::byte[]> bytes;
    std::size_t size;
};

/// Each row: the filter's number, then the differences to the row above (zeros above the first).
Block filterUp(const ImageView& image) {
    const std::size_t rowBytes = std::size_t{4} * static_cast<std::size_t>(image.size.x);
    const auto rows = static_cast<std::size_t>(image.size.y);
    Block filtered{rows * (rowBytes + 1)};
    std::byte* out = filtered.bytes.get();
    *out++ = kUpFilter;
    std::memcpy(out, image.rgba.data(), rowBytes);
    out += rowBytes;
    for (std::size_t row = 1; row < rows; ++row) {
        const auto* above =
            reinterpret_cast<const std::uint8_t*>(image.rgba.data()) + (row - 1) * rowBytes;
        const std::uint8_t* current = above + rowBytes;
        *out++ = kUpFilter;
        auto* difference = reinterpret_cast<std::uint8_t*>(out);
        for (std::size_t i = 0; i < rowBytes; ++i) {
            difference[i] = static_cast<std::uint8_t>(current[i] - above[i]);
        }
        out += rowBytes;
    }
    return filtered;
}

std::array<std::byte, 4> bigEndian(std::uint32_t value) {
    return {std::byte(value >> 24), std::byte(value >> 16), std::byte(value >> 8),
            std::byte(value)};
}

void append(std::vector<std::byte>& out, std::span<const std::byte> bytes) {
    out.insert(out.end(), bytes.begin(), bytes.end());
}

/// Length, type, content, and the checksum over type and content.
void appendChunk(std::vector<std::byte>& out, std::string_view type,
                 std::span<const std::byte> content) {
    append(out, bigEndian(static_cast<std::uint32_t>(content.size())));
    const std::size_t checkedFrom = out.size();
    append(out, std::as_bytes(std::span{type}));
    append(out, content);
    const std::uint32_t checksum =
        libdeflate_crc32(0, out.data() + checkedFrom, out.size() - checkedFrom);
    append(out, bigEndian(checksum));
}

std::array<std::byte, 13> imageHeader(glm::ivec2 size) {
    std::array<std::byte, 13> header{};
    const auto width = bigEndian(static_cast<std::uint32_t>(size.x));
    const auto height = bigEndian(static_cast<std::uint32_t>(size.y));
    std::memcpy(header.data(), width.data(), width.size());
    std::memcpy(header.data() + 4, height.data(), height.size());
    header[8] = kBitsPerSample;
    header[9] = kColourTypeRgba;
    return header;  // The rest stays 0: deflate, adaptive filters, not interlaced.
}

}  // namespace

Result<std::vector<std::byte>> encodePng(const ImageView& image) {
    if (Result<void> valid = check(image); !valid) return std::move(valid).error();
    libdeflate_compressor* compressor = threadCompressor();
    if (compressor == nullptr) return fail(ErrorCode::kIo, "PNG: no memory for a compressor");

    const Block filtered = filterUp(image);
    Block compressed{libdeflate_zlib_compress_bound(compressor, filtered.size)};
    const std::size_t size = libdeflate_zlib_compress(
        compressor, filtered.bytes.get(), filtered.size, compressed.bytes.get(), compressed.size);
    if (size == 0) return fail(ErrorCode::kIo, "PNG: the picture could not be compressed");

    constexpr std::byte kRelativeColorimetric{1};
    std::vector<std::byte> png;
    png.reserve(size + 128);
    append(png, std::as_bytes(std::span{kSignature}));
    appendChunk(png, "IHDR", imageHeader(image.size));
    appendChunk(png, "sRGB", std::span{&kRelativeColorimetric, 1});
    appendChunk(png, "IDAT", {compressed.bytes.get(), size});
    appendChunk(png, "IEND", {});
    return png;
}

}  // namespace volcast::video
