#include "renderer/worker/probe.h"

#include <google/protobuf/util/json_util.h>

#include "renderer/gpu/device.h"
#include "volcast/internal/v1/worker.pb.h"

namespace volcast::worker {

namespace {

namespace wire = volcast::internal::v1;

void put(wire::OpenedDevice* message, const gpu::DeviceInfo& info) {
    message->set_platform(info.platform);
    message->set_egl_vendor(info.eglVendor);
    message->set_egl_version(info.eglVersion);
    message->set_gl_vendor(info.glVendor);
    message->set_gl_renderer(info.glRenderer);
    message->set_gl_version(info.glVersion);
    message->set_glsl_version(info.glslVersion);
    message->set_robust(info.robust);
    message->set_software(info.software);
    message->set_texture_side(info.limits.textureSide);
    message->set_texture_3d_side(info.limits.texture3DSide);
    message->set_texel_buffer_texels(info.limits.texelBufferTexels);
    message->set_uniform_block_bytes(info.limits.uniformBlockBytes);
    message->set_storage_block_bytes(info.limits.storageBlockBytes);
    message->set_viewport_side(info.limits.viewportSide);
}

}  // namespace

std::string probe(const std::string& gpu) {
    wire::Probe message;
    const gpu::EglListing listing = gpu::listEgl();
    message.set_surfaceless(listing.surfaceless);
    message.set_device_platform(listing.devices);
    message.set_client_extensions(listing.clientExtensions);
    for (const gpu::EglDeviceInfo& device : listing.deviceList) {
        wire::ProbedDevice* added = message.add_devices();
        added->set_gpu(std::to_string(device.index));
        added->set_path(device.path);
        added->set_software(device.software);
    }
    if (auto device = gpu::Device::create({.gpu = gpu}); device) {
        put(message.mutable_opened(), (*device)->info());
    } else {
        message.set_error(device.error().message);
    }
    google::protobuf::util::JsonPrintOptions options;
    options.always_print_primitive_fields = true;
    options.preserve_proto_field_names = true;
    std::string text;
    // Our own message always has a JSON form.
    static_cast<void>(google::protobuf::util::MessageToJsonString(message, &text, options));
    return text;
}

}  // namespace volcast::worker
