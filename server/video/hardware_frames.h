#pragma once

#include <filesystem>
#include <memory>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavutil/frame.h>
}

#include "renderer/base/result.h"

namespace volcast::video {

struct BufferDeleter {
    void operator()(AVBufferRef* buffer) const noexcept { av_buffer_unref(&buffer); }
};
using BufferPtr = std::unique_ptr<AVBufferRef, BufferDeleter>;
struct FrameDeleter {
    void operator()(AVFrame* frame) const noexcept { av_frame_free(&frame); }
};
using FramePtr = std::unique_ptr<AVFrame, FrameDeleter>;

/// VAAPI on the first of the render nodes (renderD128 and on) in `folder` that it opens on.
///
/// Errors: kUnsupported (no such node; or what each of them said).
Result<BufferPtr> openVaapi(const std::filesystem::path& folder = "/dev/dri");

/// Lets `context`, not opened yet, take pictures in the memory of `device`, NV12 of its own size.
///
/// Errors: kUnsupported (the device makes no such memory).
Result<void> useFramesOf(AVBufferRef& device, AVCodecContext& context);

/// NV12 (Cb and Cr in turns in one plane) of planes in YUV420P.
///
/// Errors: kIo (no memory).
Result<FramePtr> toNv12(const AVFrame& planes);

/// `planes` (YUV420P) in the memory that `context` takes pictures from.
///
/// Errors: kIo (libav's words).
Result<FramePtr> uploaded(const AVCodecContext& context, const AVFrame& planes);

}  // namespace volcast::video
