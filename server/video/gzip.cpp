#include "server/video/gzip.h"

#include <memory>

#include <libdeflate.h>

namespace volcast::video {

namespace {

constexpr int kLevel = 9;

struct CompressorDeleter {
    void operator()(libdeflate_compressor* compressor) const noexcept {
        libdeflate_free_compressor(compressor);
    }
};

}  // namespace

Result<std::string> gzip(std::string_view content) {
    const std::unique_ptr<libdeflate_compressor, CompressorDeleter> compressor{
        libdeflate_alloc_compressor(kLevel)};
    if (!compressor) return fail(ErrorCode::kIo, "gzip: no memory for a compressor");
    std::string packed(libdeflate_gzip_compress_bound(compressor.get(), content.size()), '\0');
    const std::size_t size = libdeflate_gzip_compress(compressor.get(), content.data(),
                                                      content.size(), packed.data(), packed.size());
    if (size == 0) return fail(ErrorCode::kIo, "gzip: the text could not be compressed");
    packed.resize(size);
    return packed;
}

}  // namespace volcast::video
