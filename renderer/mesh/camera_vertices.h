#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "renderer/gpu/buffer.h"
#include "renderer/mesh/walk.h"

namespace volcast::mesh {

/// How one camera sees a mesh: the mesh block, and the vertices in camera space beside the value of
/// a field at vertices. Both evaluators need it.
class CameraVertices {
public:
    /// Makes everything fit `inputs`; what is still right is kept. Binds nothing.
    ///
    /// Errors: kShaderBuild, kOutOfGpuMemory, kLimitExceeded.
    Result<void> prepare(const DrawInputs& inputs);

    void bindBlock() const;
    void bindVertices() const;

    /// Grows whenever the mesh or the camera is another one; 0 before the first.
    [[nodiscard]] std::uint64_t version() const noexcept { return version_; }
    /// Where perspective rays come from, data space: the eye, moved into the cell that it is in.
    [[nodiscard]] const glm::dvec3& eye() const noexcept { return eye_; }

private:
    /// What the contents were made from.
    struct Key {
        std::uint64_t mesh = 0, field = 0, camera = 0;
        int valuesAt = -1;
        friend bool operator==(const Key&, const Key&) = default;
    };

    Result<void> allocate(const DrawInputs& inputs);
    void lookFrom(const DrawInputs& inputs);
    Result<void> transform(const DrawInputs& inputs, bool carried);

    Key key_;
    gpu::Buffer block_, vertices_;
    glm::dvec3 eye_{0.0};
    std::uint64_t version_ = 0;
    int startCell_ = -1;  ///< Where the search for the eye's cell starts next time.
};

}  // namespace volcast::mesh
