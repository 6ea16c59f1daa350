#include "renderer/gpu/target.h"

#include <array>
#include <string>

namespace volcast::gpu {
namespace {

void setEnabled(GLenum capability, bool on) {
    if (on) {
        glEnable(capability);
    } else {
        glDisable(capability);
    }
}

/// Equation and factors of `blend`; GL_MAX and GL_MIN have no factors.
void setBlend(Blend blend) {
    switch (blend) {
        case Blend::kNone: return;
        case Blend::kOver: glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA); break;
        case Blend::kAdd: glBlendFunc(GL_ONE, GL_ONE); break;
        case Blend::kUnder: glBlendFunc(GL_ONE_MINUS_DST_ALPHA, GL_ONE); break;
        case Blend::kMax: glBlendEquation(GL_MAX); return;
        case Blend::kMin: glBlendEquation(GL_MIN); return;
    }
    glBlendEquation(GL_FUNC_ADD);
}

}  // namespace

Result<Target> Target::create(Device& device, const char* label,
                              std::span<const Texture2D* const> colours, const Texture2D* depth) {
    assert(device.onDeviceThread());
    assert(colours.size() <= kMaxColours && (!colours.empty() || depth != nullptr));
    GLuint name = 0;
    glCreateFramebuffers(1, &name);
    Target target;
    target.handle_ = FramebufferHandle{device, name};
    target.size_ = colours.empty() ? depth->size() : colours.front()->size();
    std::array<GLenum, kMaxColours> buffers{};
    GLsizei count = 0;
    for (const Texture2D* colour : colours) {
        assert(colour->size() == target.size_);
        buffers[count] = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(count);
        glNamedFramebufferTexture(name, buffers[count], colour->name(), 0);
        ++count;
    }
    glNamedFramebufferDrawBuffers(name, count, buffers.data());
    if (depth != nullptr) {
        assert(depth->size() == target.size_);
        glNamedFramebufferTexture(name, GL_DEPTH_ATTACHMENT, depth->name(), 0);
    }
    glObjectLabel(GL_FRAMEBUFFER, name, -1, label);
    const GLenum status = glCheckNamedFramebufferStatus(name, GL_DRAW_FRAMEBUFFER);
    const Result<void> made = device.check(label);
    if (!made) return made.error();
    if (status != GL_FRAMEBUFFER_COMPLETE) {
        return fail(ErrorCode::kUnsupported, std::string{label} +
                                                 ": this GPU cannot draw into these textures, "
                                                 "status " +
                                                 std::to_string(status));
    }
    return target;
}

void Target::begin(const PassState& state) const {
    glBindFramebuffer(GL_FRAMEBUFFER, handle_.name());
    glViewport(0, 0, size_.x, size_.y);
    setEnabled(GL_BLEND, state.blend != Blend::kNone);
    setBlend(state.blend);
    const bool depth = state.depth != DepthTest::kNone;
    setEnabled(GL_DEPTH_TEST, depth);
    glDepthFunc(GL_GREATER);
    glDepthMask(depth ? GL_TRUE : GL_FALSE);
    setEnabled(GL_CULL_FACE, state.cull != Cull::kNone);
    glCullFace(state.cull == Cull::kFront ? GL_FRONT : GL_BACK);
    glFrontFace(GL_CCW);
}

void Target::clearColour(int index, const glm::vec4& value) const {
    glClearNamedFramebufferfv(handle_.name(), GL_COLOR, index, &value[0]);
}

void Target::clearInteger(int index, int value) const {
    const std::array<GLint, 4> values{value, value, value, value};
    glClearNamedFramebufferiv(handle_.name(), GL_COLOR, index, values.data());
}

void Target::clearDepth(float value) const {
    glDepthMask(GL_TRUE);
    glClearNamedFramebufferfv(handle_.name(), GL_DEPTH, 0, &value);
}

void Target::readRgba8(std::span<std::byte> pixels) const {
    assert(pixels.size() == static_cast<std::size_t>(size_.x) * size_.y * 4);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, handle_.name());
    glNamedFramebufferReadBuffer(handle_.name(), GL_COLOR_ATTACHMENT0);
    glReadPixels(0, 0, size_.x, size_.y, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
}

void Target::readRgba32F(std::span<float> pixels, int index) const {
    assert(pixels.size() == static_cast<std::size_t>(size_.x) * size_.y * 4);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, handle_.name());
    glNamedFramebufferReadBuffer(handle_.name(), GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(index));
    glReadPixels(0, 0, size_.x, size_.y, GL_RGBA, GL_FLOAT, pixels.data());
}

}  // namespace volcast::gpu
