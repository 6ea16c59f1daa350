#include "renderer/gpu/texture3d.h"

#include <string>

namespace volcast::gpu {
namespace {

struct Layout {
    GLenum internal = GL_NONE;
    GLenum external = GL_NONE;
    GLenum type = GL_NONE;
    std::size_t bytes = 0;
};

Layout layoutOf(VoxelFormat format) {
    switch (format) {
        case VoxelFormat::kF32: return {GL_R32F, GL_RED, GL_FLOAT, 4};
        case VoxelFormat::kRg32F: return {GL_RG32F, GL_RG, GL_FLOAT, 8};
        case VoxelFormat::kRgba32F: return {GL_RGBA32F, GL_RGBA, GL_FLOAT, 16};
        case VoxelFormat::kR8U: return {GL_R8UI, GL_RED_INTEGER, GL_UNSIGNED_BYTE, 1};
        case VoxelFormat::kR16U: return {GL_R16UI, GL_RED_INTEGER, GL_UNSIGNED_SHORT, 2};
        case VoxelFormat::kR32U: return {GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, 4};
    }
    return {};
}

std::string describe(const glm::ivec3& v) {
    return std::to_string(v.x) + " x " + std::to_string(v.y) + " x " + std::to_string(v.z);
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
    return upload({0, 0, firstSlice}, {size_.x, size_.y, slices}, voxels);
}

Result<void> Texture3D::upload(glm::ivec3 first, glm::ivec3 size,
                               std::span<const std::byte> voxels) {
    assert(device_ != nullptr && device_->onDeviceThread());
    const Layout layout = layoutOf(format_);
    const glm::ivec3 filled = glm::max(size, glm::ivec3{0});
    const std::size_t expected =
        static_cast<std::size_t>(filled.x) * filled.y * filled.z * layout.bytes;
    if (glm::any(glm::lessThan(first, glm::ivec3{0})) ||
        glm::any(glm::greaterThan(first + size, size_)) || voxels.size() != expected) {
        return fail(ErrorCode::kInvalidArgument,
                    describe(size) + " voxels from " + describe(first) + " of " + describe(size_) +
                        ": got " + std::to_string(voxels.size()) + " bytes, expected " +
                        std::to_string(expected));
    }
    glTextureSubImage3D(handle_.name(), 0, first.x, first.y, first.z, size.x, size.y, size.z,
                        layout.external, layout.type, voxels.data());
    ++device_->counters().textureUploads;
    device_->counters().uploadedBytes += voxels.size();
    return device_->check("voxels");
}

}  // namespace volcast::gpu
