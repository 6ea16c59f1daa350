#include "server/video/video_encoders.h"

#include <cmath>
#include <mutex>
#include <string>

extern "C" {
#include <libavutil/log.h>
#include <libavutil/opt.h>
}

#include "server/video/hardware_frames.h"

namespace volcast::video {

namespace {

struct DictionaryDeleter {
    void operator()(AVDictionary* options) const noexcept { av_dict_free(&options); }
};

/// The library's own lines would stand between ours; what went wrong is in its results.
void silence() {
    static std::once_flag once;
    std::call_once(once, [] { av_log_set_level(AV_LOG_QUIET); });
}

}  // namespace

std::string avError(int code) {
    std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
    av_strerror(code, text.data(), text.size());
    return text.data();
}

Result<ContextPtr> openEncoder(const EncoderRow& row, glm::ivec2 size, int quality) {
    silence();
    const std::string name = row.name;
    const AVCodec* codec = avcodec_find_encoder_by_name(row.name);
    if (codec == nullptr) {
        return fail(ErrorCode::kUnsupported, "libavcodec has no encoder " + name);
    }
    ContextPtr context{avcodec_alloc_context3(codec)};
    if (!context) return fail(ErrorCode::kIo, name + ": no memory");
    context->width = size.x;
    context->height = size.y;
    context->pix_fmt = row.format;
    context->time_base = {1, 30};  // Of no meaning to a constant quality.
    context->framerate = {30, 1};
    context->bit_rate = 0;
    context->gop_size = 1 << 20;  // Keyframes are made when they are asked for.
    context->max_b_frames = 0;
    context->thread_count = 1;  // Many streams share the machine, each on a thread of the pool.
    context->colorspace = AVCOL_SPC_BT709;
    context->color_primaries = AVCOL_PRI_BT709;
    context->color_trc = AVCOL_TRC_IEC61966_2_1;
    context->color_range = AVCOL_RANGE_JPEG;  // Full: see yuv.h.
    context->chroma_sample_location = AVCHROMA_LOC_CENTER;
    if (row.format == AV_PIX_FMT_VAAPI) {
        const auto device = openVaapi();
        if (!device) return fail(ErrorCode::kUnsupported, name + ": " + device.error().message);
        if (const auto used = useFramesOf(**device, *context); !used) {
            return fail(ErrorCode::kUnsupported, name + ": " + used.error().message);
        }
    }
    AVDictionary* options = nullptr;
    for (const EncoderRow::Option& option : row.options) {
        if (option.name != nullptr) av_dict_set(&options, option.name, option.value, 0);
    }
    const double level = row.worst + (row.best - row.worst) * quality / 100.0;
    av_dict_set_int(&options, row.quantiser, std::lround(level), 0);
    const int opened = avcodec_open2(context.get(), codec, &options);
    const std::unique_ptr<AVDictionary, DictionaryDeleter> unused{options};
    if (opened < 0) return fail(ErrorCode::kUnsupported, name + ": " + avError(opened));
    if (const AVDictionaryEntry* entry = av_dict_get(options, "", nullptr, AV_DICT_IGNORE_SUFFIX)) {
        return fail(ErrorCode::kUnsupported, name + " does not know its option " + entry->key);
    }
    return context;
}

}  // namespace volcast::video
