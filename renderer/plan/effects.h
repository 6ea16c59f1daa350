#pragma once

namespace volcast::plan {

// Names of effects, as plans list them and clients show them.

inline constexpr const char* kVisible = "visible";  ///< The layer can show anything at all.
inline constexpr const char* kEndsAtSurfaces = "ends at surfaces";  ///< Opaque layers cut rays.
inline constexpr const char* kEarlyStop = "early stop";        ///< A ray may get opaque on its way.
inline constexpr const char* kCameraInside = "camera inside";  ///< Rays may begin within the data.

// Meshes
inline constexpr const char* kReEntry = "re-entry";  ///< A ray may leave the mesh and come back.
inline constexpr const char* kInterpolation = "interpolation";    ///< Values vary within a cell.
inline constexpr const char* kColourByValue = "colour by value";  ///< Surface: C(f).
inline constexpr const char* kHeadlight = "headlight";            ///< Surface: needs normals.

// Voxels; kInterpolation: trilinear instead of nearest.
inline constexpr const char* kEmptyBricks =
    "empty bricks";  ///< Bricks without a share are skipped.
inline constexpr const char* kStepEnlarged = "step enlarged";  ///< The step asked for is too small.

}  // namespace volcast::plan
