#include "renderer/mesh/walk_cache.h"

#include <array>
#include <string>

#include <epoxy/gl.h>

#include "renderer/mesh/mesh_buffers.h"
#include "renderer/mesh/shared.h"
#include "renderer/mesh/walk_user.h"
#include "renderer/shading/shared.h"

namespace volcast::mesh {

namespace {

constexpr std::size_t kCounts = 4;  // In shaders/mesh/counts.glsl.
constexpr std::size_t kNodeBytes = sizeof(glm::ivec4);
constexpr std::size_t kFirstNodes = std::size_t{1} << 16;
constexpr const char* kBoundaryVertex = "mesh/boundary.vert.glsl";

}  // namespace

Result<void> WalkCache::prepare(const DrawInputs& inputs) {
    if (auto done = camera_.prepare(inputs); !done) return done;
    if (entriesOf_ == camera_.version()) return {};
    entriesOf_ = 0;  // Until all of it is made, nothing of it counts.
    if (auto done = allocate(inputs); !done) return done;
    if (auto done = findEntries(inputs); !done) return done;
    entriesOf_ = camera_.version();
    return {};
}

Result<void> WalkCache::allocate(const DrawInputs& inputs) {
    gpu::Device& device = *inputs.device;
    if (!counts_.valid()) {
        auto counts = gpu::Buffer::create(
            device,
            {.bytes = kCounts * sizeof(std::uint32_t), .updatable = true, .label = "walk counts"});
        if (!counts) return counts.error();
        counts_ = std::move(*counts);
    }
    if (heads_.size() == inputs.size) return {};
    auto heads = gpu::Texture2D::create(
        device, {.size = inputs.size, .format = gpu::PixelFormat::kR32I, .label = "mesh entries"});
    if (!heads) return heads.error();
    const std::array colours{&*heads};
    auto target = gpu::Target::create(device, "mesh entries", colours);
    if (!target) return target.error();
    headTarget_ = std::move(*target);
    heads_ = std::move(*heads);
    paused_ = {};  // Of another size.
    return {};
}

Result<void> WalkCache::findEntries(const DrawInputs& inputs) {
    if (inputs.mesh->convex) return drawEntries(inputs);
    if (!nodes_.valid()) {
        if (auto done = growNodes(*inputs.device, kFirstNodes); !done) return done;
    }
    // The second round has room for what the first one counted.
    for (int round = 0; round < 2; ++round) {
        clearCounts();
        if (auto done = drawEntries(inputs); !done) return done;
        const std::size_t counted = readCount(0);
        if (auto done = inputs.device->check("entry lists"); !done) return done;
        if (counted <= nodes_.bytes() / kNodeBytes) return {};
        if (auto done = growNodes(*inputs.device, counted + counted / 4); !done) return done;
    }
    return fail(ErrorCode::kLimitExceeded, "mesh: the entries of a picture changed while drawn");
}

Result<void> WalkCache::drawEntries(const DrawInputs& inputs) {
    const MeshBuffers& mesh = MeshBuffers::of(*inputs.meshGpu);
    const bool convex = inputs.mesh->convex;
    const auto program = inputs.programs->pass(
        kBoundaryVertex, convex ? "mesh/entry_face.frag.glsl" : "mesh/entry_list.frag.glsl",
        // Entries are found whatever lies before them.
        {{"kEndsAtSurfaces", false}, {"kDensityAt", shared::kValuesNowhere}});
    if (!program) return program.error();
    headTarget_.begin({});
    headTarget_.clearInteger(0, -1);
    (*program)->use();
    camera_.bindBlock();
    camera_.bindVertices();
    mesh.boundary.bindTexels(shared::kBoundaryUnit);
    if (!convex) {
        heads_.bindImage(shared::kHeadImage);
        nodes_.bindStorage(shared::kNodeStorage);
        counts_.bindStorage(shared::kCountStorage);
        glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);  // The shader writes the image.
    }
    inputs.device->draw(gpu::Primitive::kTriangles, 3 * mesh.boundaryCount);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    if (!convex) glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    return inputs.device->check("mesh entries");
}

Result<void> WalkCache::growNodes(gpu::Device& device, std::size_t nodes) {
    nodes_ = {};  // Both at once might not fit.
    auto made = gpu::Buffer::create(device, {.bytes = nodes * kNodeBytes,
                                             .texels = gpu::TexelFormat::kRgba32I,
                                             .label = "entry lists"});
    if (!made) return made.error();
    nodes_ = std::move(*made);
    return {};
}

void WalkCache::bind(const DrawInputs& inputs) const {
    const MeshBuffers& mesh = MeshBuffers::of(*inputs.meshGpu);
    camera_.bindBlock();
    camera_.bindVertices();
    mesh.cells.bindTexels(shared::kCellUnit);
    mesh.boundary.bindTexels(shared::kBoundaryUnit);
    if (inputs.field != nullptr) {
        FieldBuffer::of(*inputs.field).values.bindTexels(shared::kFieldUnit);
    }
    if (inputs.density != nullptr) {
        FieldBuffer::of(*inputs.density).values.bindTexels(shared::kDensityUnit);
    }
    if (inputs.psiTable != nullptr) inputs.psiTable->bindTexels(shading::shared::kPsiTableUnit);
    if (inputs.user != nullptr) bindOtherFields(*inputs.user);
    heads_.bind(shared::kEntryUnit);
    if (nodes_.valid()) nodes_.bindTexels(shared::kEntryNodeUnit);
    counts_.bindStorage(shared::kCountStorage);
}

void WalkCache::clearCounts() const {
    const std::uint32_t zero = 0;
    glClearNamedBufferData(counts_.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &zero);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

std::uint32_t WalkCache::readCount(std::size_t index) const {
    std::uint32_t count = 0;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(counts_.name(), static_cast<GLintptr>(index * sizeof(count)),
                            sizeof(count), &count);
    return count;
}

std::uint32_t WalkCache::unfinishedRays() const {
    return readCount(1);
}

void WalkCache::addSteps() {
    steps_ += readCount(2) + (std::uint64_t{readCount(3)} << 32);
}

Result<void> WalkCache::bindPausedRays(gpu::Device& device, std::size_t bytesARay) {
    const std::size_t bytes =
        static_cast<std::size_t>(heads_.size().x) * heads_.size().y * bytesARay;
    if (bytes > static_cast<std::size_t>(device.limits().storageBlockBytes)) {
        return fail(ErrorCode::kLimitExceeded,
                    "mesh: rays through so many cells need " + std::to_string(bytes) +
                        " bytes, this GPU has blocks of " +
                        std::to_string(device.limits().storageBlockBytes) +
                        " at most; draw a smaller picture");
    }
    if (!paused_.valid() || paused_.bytes() != bytes) {
        paused_ = {};
        auto made = gpu::Buffer::create(device, {.bytes = bytes, .label = "paused rays"});
        if (!made) return made.error();
        paused_ = std::move(*made);
    }
    const std::uint32_t zero = 0;
    glClearNamedBufferData(paused_.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &zero);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    paused_.bindStorage(shared::kPausedStorage);
    return {};
}

}  // namespace volcast::mesh
