#include "renderer/gpu/program.h"

#include <vector>

namespace volcast::gpu {
namespace {

GLenum stageOf(Stage stage) {
    switch (stage) {
        case Stage::kVertex: return GL_VERTEX_SHADER;
        case Stage::kFragment: return GL_FRAGMENT_SHADER;
        case Stage::kCompute: return GL_COMPUTE_SHADER;
    }
    return GL_NONE;
}

const char* nameOf(Stage stage) {
    switch (stage) {
        case Stage::kVertex: return "vertex";
        case Stage::kFragment: return "fragment";
        case Stage::kCompute: return "compute";
    }
    return "";
}

std::string shaderLog(GLuint shader) {
    GLint length = 0;
    glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
    glGetShaderInfoLog(shader, length, &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    return log;
}

std::string programLog(GLuint program) {
    GLint length = 0;
    glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
    glGetProgramInfoLog(program, length, &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    return log;
}

Result<ShaderHandle> compile(Device& device, const char* label, const StageSource& source) {
    ShaderHandle shader{device, glCreateShader(stageOf(source.stage))};
    const char* text = source.text.data();
    const auto length = static_cast<GLint>(source.text.size());
    glShaderSource(shader.name(), 1, &text, &length);
    glCompileShader(shader.name());
    GLint compiled = GL_FALSE;
    glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_TRUE) return shader;
    const std::string log = shaderLog(shader.name());
    return fail(ErrorCode::kShaderBuild, std::string{label} + ": the " + nameOf(source.stage) +
                                             " shader does not compile:\n" +
                                             (source.translate ? source.translate(log) : log));
}

}  // namespace

Result<Program> Program::create(Device& device, const char* label,
                                std::span<const StageSource> stages) {
    assert(device.onDeviceThread());
    std::vector<ShaderHandle> shaders;
    Program program;
    program.handle_ = ProgramHandle{device, glCreateProgram()};
    const GLuint name = program.handle_.name();
    for (const StageSource& stage : stages) {
        Result<ShaderHandle> shader = compile(device, label, stage);
        if (!shader) return shader.error();
        glAttachShader(name, shader->name());
        shaders.push_back(std::move(*shader));
    }
    glLinkProgram(name);
    ++device.counters().programsBuilt;
    for (const ShaderHandle& shader : shaders) glDetachShader(name, shader.name());
    GLint linked = GL_FALSE;
    glGetProgramiv(name, GL_LINK_STATUS, &linked);
    if (linked != GL_TRUE) {
        return fail(ErrorCode::kShaderBuild,
                    std::string{label} + ": does not link:\n" + programLog(name));
    }
    glObjectLabel(GL_PROGRAM, name, -1, label);
    const Result<void> made = device.check(label);
    if (!made) return made.error();
    return program;
}

int Program::uniformOffset(const char* member) const {
    GLuint index = GL_INVALID_INDEX;
    glGetUniformIndices(handle_.name(), 1, &member, &index);
    if (index == GL_INVALID_INDEX) return -1;
    GLint offset = -1;
    glGetActiveUniformsiv(handle_.name(), 1, &index, GL_UNIFORM_OFFSET, &offset);
    return offset;
}

int Program::blockBytes(const char* block) const {
    const GLuint index = glGetUniformBlockIndex(handle_.name(), block);
    if (index == GL_INVALID_INDEX) return -1;
    GLint bytes = -1;
    glGetActiveUniformBlockiv(handle_.name(), index, GL_UNIFORM_BLOCK_DATA_SIZE, &bytes);
    return bytes;
}

}  // namespace volcast::gpu
