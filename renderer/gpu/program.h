#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include <glm/glm.hpp>

#include "renderer/base/result.h"
#include "renderer/gpu/handle.h"

namespace volcast::gpu {

enum class Stage { kVertex, kFragment, kCompute };

/// One stage's GLSL, and how to make the driver's log about it readable.
struct StageSource {
    Stage stage = Stage::kFragment;
    std::string_view text;
    std::function<std::string(std::string_view)> translate;  ///< May be empty.
};

/// A linked program. Its inputs are bound by the numbers written in the shaders.
class Program {
public:
    /// Compiles and links. The log in the message names file and line where `translate` knows.
    ///
    /// Errors: kShaderBuild.
    static Result<Program> create(Device& device, const char* label,
                                  std::span<const StageSource> stages);

    Program() = default;

    void use() const noexcept { glUseProgram(handle_.name()); }

    /// The driver's byte offset of `member` in its uniform block, or -1; for tests of layouts.
    [[nodiscard]] int uniformOffset(const char* member) const;
    /// The driver's size in bytes of the uniform block `block`, or -1.
    [[nodiscard]] int blockBytes(const char* block) const;

    [[nodiscard]] GLuint name() const noexcept { return handle_.name(); }

private:
    ProgramHandle handle_;
};

}  // namespace volcast::gpu
