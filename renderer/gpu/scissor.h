#pragma once

#include <epoxy/gl.h>
#include <glm/glm.hpp>

namespace volcast::gpu {

/// While it lives, draws change pixels of a rectangle alone. Passes know of none: it ends before
/// the next begins.
class Scissor {
public:
    /// `low`: its first column and row, row 0 at the top of the picture; `size`: at least 0.
    Scissor(glm::ivec2 low, glm::ivec2 size) noexcept {
        glEnable(GL_SCISSOR_TEST);
        glScissor(low.x, low.y, size.x, size.y);
    }
    Scissor(const Scissor&) = delete;
    Scissor& operator=(const Scissor&) = delete;
    Scissor(Scissor&&) = delete;
    Scissor& operator=(Scissor&&) = delete;
    ~Scissor() { glDisable(GL_SCISSOR_TEST); }
};

}  // namespace volcast::gpu
