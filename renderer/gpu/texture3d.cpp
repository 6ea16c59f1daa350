#include "renderer/gpu/texture3d.h"

#include <string>

namespace volcast::gpu {
namespace {

struct Layout {
    GLenum internal;
    GLenum external;
    std::size_t bytes;
};

Layout layoutOf(VoxelFormat format) {
    switch (format) {
        case VoxelFormat::kRg32F: return {.internal = GL_RG32F, .external = GL_RG, .bytes = 8};
        case VoxelFormat::kRgba32F:
            return {.internal = GL_RGBA32F, .external = GL_RGBA, .bytes = 16};
        case VoxelFormat::kF32: break;
    }
    return {.internal = GL_R32F, .external = GL_RED, .bytes = 4};
}

}  // namespace

Result<Texture3D> Texture3D::create(Device& device, const Texture3DDesc& desc) {
    assert(device.onDeviceThread());
    const int limit = device.limits().texture3DSide;
    for (int axis = 0; axis < 3; ++axis) {
        if (desc.size[axis] >= 1 && desc.size[axis] <= limit) continue;
        return fail(ErrorCode::kLimitExceeded,
                    std::string{desc.label} + ": " + std::to_string(desc.size[axis]) +
                        " voxels along axis " + std::to_string(axis) + ", this GPU allows 1 to " +
                        std::to_string(limit));
    }
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_3D, 1, &name);
    Texture3D texture;
    texture.device_ = &device;
    texture.handle_ = TextureHandle{device, name};
    texture.size_ = desc.size;
    texture.format_ = desc.format;
    glTextureStorage3D(name, 1, layoutOf(desc.format).internal, desc.size.x, desc.size.y,
                       desc.size.z);
    const GLint filter = desc.linear ? GL_LINEAR : GL_NEAREST;
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, filter);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, filter);
    for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R}) {
        glTextureParameteri(name, axis, GL_CLAMP_TO_EDGE);
    }
    glObjectLabel(GL_TEXTURE, name, -1, desc.label);
    const Result<void> made = device.check(desc.label);
    if (!made) return made.error();
    return texture;
}

Result<void> Texture3D::upload(int firstSlice, int slices, std::span<const std::byte> voxels) {
    assert(device_ != nullptr && device_->onDeviceThread());
    const Layout layout = layoutOf(format_);
    const std::size_t expected =
        static_cast<std::size_t>(size_.x) * size_.y * std::max(slices, 0) * layout.bytes;
    if (firstSlice < 0 || firstSlice + slices > size_.z || voxels.size() != expected) {
        return fail(ErrorCode::kInvalidArgument,
                    "slices " + std::to_string(firstSlice) + " + " + std::to_string(slices) +
                        ": got " + std::to_string(voxels.size()) + " bytes of voxels, expected " +
                        std::to_string(expected));
    }
    glTextureSubImage3D(handle_.name(), 0, 0, 0, firstSlice, size_.x, size_.y, slices,
                        layout.external, GL_FLOAT, voxels.data());
    ++device_->counters().textureUploads;
    device_->counters().uploadedBytes += voxels.size();
    return device_->check("voxels");
}

}  // namespace volcast::gpu
