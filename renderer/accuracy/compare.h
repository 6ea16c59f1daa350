#pragma once

#include <span>
#include <vector>

#include "renderer/accuracy/measurement.h"
#include "renderer/reference/reference.h"

namespace volcast::accuracy {

struct Difference {
    Errors all;
    Errors inner;            ///< Without the pixels that `truth` has as near an edge.
    std::vector<float> off;  ///< By pixel: of the channel that is off most.
};

/// Compares `pixels` of a picture with the truth. `rgba`: linear, premultiplied, 4 a pixel, all of
/// a picture `width` pixels wide, rows from the top. A value that is no number is infinitely off.
Difference compare(const reference::Picture& truth, std::span<const glm::ivec2> pixels,
                   std::span<const float> rgba, int width);

}  // namespace volcast::accuracy
