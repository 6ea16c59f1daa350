#include "server/video/hardware_frames.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

extern "C" {
#include <libavutil/hwcontext.h>
}

#include "server/video/video_encoders.h"

namespace volcast::video {

namespace {

std::vector<std::string> renderNodes(const std::filesystem::path& folder) {
    std::vector<std::string> nodes;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator{folder, ignored}) {
        if (entry.path().filename().string().starts_with("renderD")) {
            nodes.push_back(entry.path().string());
        }
    }
    std::ranges::sort(nodes);
    return nodes;
}

}  // namespace

Result<BufferPtr> openVaapi(const std::filesystem::path& folder) {
    std::string tried;
    for (const std::string& node : renderNodes(folder)) {
        AVBufferRef* device = nullptr;
        const int opened =
            av_hwdevice_ctx_create(&device, AV_HWDEVICE_TYPE_VAAPI, node.c_str(), nullptr, 0);
        if (opened >= 0) return BufferPtr{device};
        tried += (tried.empty() ? "" : "; ") + node + ": " + avError(opened);
    }
    if (tried.empty()) tried = "there is no render node " + (folder / "renderD*").string();
    return fail(ErrorCode::kUnsupported, tried);
}

Result<void> useFramesOf(AVBufferRef& device, AVCodecContext& context) {
    BufferPtr frames{av_hwframe_ctx_alloc(&device)};
    if (!frames) return fail(ErrorCode::kUnsupported, "no memory for its pictures");
    auto& desc = *reinterpret_cast<AVHWFramesContext*>(frames->data);
    desc.format = context.pix_fmt;
    desc.sw_format = AV_PIX_FMT_NV12;
    desc.width = context.width;
    desc.height = context.height;
    if (const int made = av_hwframe_ctx_init(frames.get()); made < 0) {
        return fail(ErrorCode::kUnsupported, avError(made));
    }
    context.hw_frames_ctx = frames.release();  // Given back with the context.
    return {};
}

Result<FramePtr> toNv12(const AVFrame& planes) {
    FramePtr made{av_frame_alloc()};
    if (!made) return fail(ErrorCode::kIo, "no memory");
    made->format = AV_PIX_FMT_NV12;
    made->width = planes.width;
    made->height = planes.height;
    if (const int got = av_frame_get_buffer(made.get(), 0); got < 0) {
        return fail(ErrorCode::kIo, avError(got));
    }
    const auto row = [](const AVFrame& frame, std::size_t plane, int y) {
        return frame.data[plane] + std::ptrdiff_t{frame.linesize[plane]} * y;
    };
    for (int y = 0; y < planes.height; ++y) {
        std::memcpy(row(*made, 0, y), row(planes, 0, y), static_cast<std::size_t>(planes.width));
    }
    for (int y = 0; y < planes.height / 2; ++y) {
        std::uint8_t* out = row(*made, 1, y);
        for (int x = 0; x < planes.width / 2; ++x) {
            *out++ = row(planes, 1, y)[x];
            *out++ = row(planes, 2, y)[x];
        }
    }
    return made;
}

Result<FramePtr> uploaded(const AVCodecContext& context, const AVFrame& planes) {
    const auto interleaved = toNv12(planes);
    if (!interleaved) return interleaved.error();
    FramePtr made{av_frame_alloc()};
    if (!made) return fail(ErrorCode::kIo, "no memory");
    int done = av_hwframe_get_buffer(context.hw_frames_ctx, made.get(), 0);
    if (done >= 0) done = av_hwframe_transfer_data(made.get(), interleaved->get(), 0);
    if (done >= 0) done = av_frame_copy_props(made.get(), &planes);
    if (done < 0) return fail(ErrorCode::kIo, avError(done));
    return made;
}

}  // namespace volcast::video
