#include "renderer/mesh/level_cells.h"

#include <limits>
#include <string>

#include <epoxy/gl.h>

#include "renderer/mesh/dispatch.h"
#include "renderer/mesh/mesh_buffers.h"
#include "renderer/mesh/shared.h"

namespace volcast::mesh {
namespace {

constexpr std::size_t kPairBytes = 2 * sizeof(std::int32_t);

Result<void> makeList(gpu::Device& device, gpu::Buffer& list, std::size_t pairs) {
    if (list.valid() && list.bytes() == pairs * kPairBytes) return {};
    list = {};  // Both at once might not fit.
    auto made = gpu::Buffer::create(device, {.bytes = pairs * kPairBytes,
                                             .texels = gpu::TexelFormat::kRg32I,
                                             .label = "cells that meet levels"});
    if (!made) return made.error();
    list = std::move(*made);
    return {};
}

}  // namespace

Result<void> LevelCells::prepare(const DrawInputs& inputs, const gpu::Buffer& corners) {
    Key key{.mesh = MeshBuffers::of(*inputs.meshGpu).serial,
            .field = FieldBuffer::of(*inputs.field).serial,
            .levels = {inputs.levels.begin(), inputs.levels.end()}};
    if (key == key_) return {};
    key_ = {};  // Until all of it is made, nothing of it counts.
    count_ = 0;
    if (auto done = upload(inputs); !done) return done;
    // Counted first: a list of the right size says how long it is.
    if (auto done = makeList(*inputs.device, list_, 1); !done) return done;
    const auto found = list(inputs, corners);
    if (!found) return found.error();
    if (*found > static_cast<std::uint32_t>(std::numeric_limits<std::int32_t>::max())) {
        return fail(ErrorCode::kLimitExceeded, "isosurface: cells meet levels " +
                                                   std::to_string(*found) +
                                                   " times, at most 2147483647 can be drawn");
    }
    if (*found > 1) {
        if (auto done = makeList(*inputs.device, list_, *found); !done) return done;
        if (auto done = list(inputs, corners); !done) return done.error();
    }
    count_ = static_cast<int>(*found);
    key_ = std::move(key);
    return {};
}

Result<void> LevelCells::upload(const DrawInputs& inputs) {
    auto values = gpu::Buffer::create(
        *inputs.device,
        {.bytes = inputs.levels.size_bytes(), .texels = gpu::TexelFormat::kR32F, .label = "levels"},
        std::as_bytes(inputs.levels));
    if (!values) return values.error();
    values_ = std::move(*values);
    if (found_.valid()) return {};
    auto found = gpu::Buffer::create(*inputs.device,
                                     {.bytes = sizeof(std::uint32_t), .label = "count of cells"});
    if (!found) return found.error();
    found_ = std::move(*found);
    return {};
}

Result<std::uint32_t> LevelCells::list(const DrawInputs& inputs, const gpu::Buffer& corners) {
    const auto program = inputs.programs->compute("mesh/level_cells.comp.glsl",
                                                  {{"kValuesAt", valuesAt(inputs.field)}});
    if (!program) return program.error();
    (*program)->use();
    corners.bindTexels(shared::kCornerUnit);
    FieldBuffer::of(*inputs.field).values.bindTexels(shared::kFieldUnit);
    values_.bindTexels(shared::kLevelUnit);
    list_.bindStorage(shared::kNodeStorage);
    found_.bindStorage(shared::kCountStorage);
    std::uint32_t count = 0;
    glClearNamedBufferData(found_.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &count);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    dispatchEach(*inputs.device, MeshBuffers::of(*inputs.meshGpu).cellCount);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
    glGetNamedBufferSubData(found_.name(), 0, sizeof(count), &count);
    if (auto done = inputs.device->check("cells that meet levels"); !done) return done.error();
    return count;
}

void LevelCells::bind() const {
    values_.bindTexels(shared::kLevelUnit);
    list_.bindTexels(shared::kLevelCellUnit);
}

}  // namespace volcast::mesh
