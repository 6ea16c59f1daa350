#pragma once

#include <array>

#include "renderer/data/field.h"

namespace volcast::reference {

/// Vertex ids of a face, ascending: its name.
using FaceName = std::array<int, 3>;

/// One face where a ray meets it. Everything is computed from the face's vertices in the order of
/// their ids, so that both cells of a face get the same bits.
struct Crossing {
    double distance = 0.0;  ///< From the ray's origin; may be negative.
    double f = 0.0, g = 0.0;
    FaceName face{-1, -1, -1};
};

/// A ray in one cell: both fields are linear between its ends. `back` may lie in front of `front`
/// in a cell that float32 turned inside out.
struct Piece {
    Crossing front, back;
    int cell = -1;
    bool joined = false;  ///< Goes on through the face where the piece before it ended.
};

/// Values of a field as rays interpolate them; null where there is no field (then 0).
struct FieldValues {
    data::Association association = data::Association::kVertex;
    const float* values = nullptr;

    [[nodiscard]] double at(int cell, int corner, int vertex) const {
        if (values == nullptr) return 0.0;
        switch (association) {
            case data::Association::kCell: return values[cell];
            case data::Association::kCellVertex: return values[4L * cell + corner];
            case data::Association::kVertex: break;
        }
        return values[vertex];
    }
};

}  // namespace volcast::reference
