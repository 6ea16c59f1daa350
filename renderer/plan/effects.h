#pragma once

namespace volcast::plan {

// Names of effects, as plans list them and clients show them.

inline constexpr const char* kVisible = "visible";  ///< The layer can show anything at all.
inline constexpr const char* kEndsAtSurfaces = "ends at surfaces";  ///< Opaque layers cut rays.
inline constexpr const char* kEarlyStop = "early stop";        ///< A ray may get opaque on its way.
inline constexpr const char* kCameraInside = "camera inside";  ///< Rays may begin within the data.

inline constexpr const char* kSecondField = "second field";  ///< g is not f.
inline constexpr const char* kInterval = "interval";         ///< Only values in an interval count.
inline constexpr const char* kClipPlanes = "clip planes";    ///< Planes cut the data.
inline constexpr const char* kScale = "scale";               ///< Values are not taken as they are.
inline constexpr const char* kAccuracy = "accuracy";         ///< Why this integrator.
inline constexpr const char* kColours = "colours";           ///< The map has more than one colour.

// Meshes
inline constexpr const char* kCellsLeftOut = "cells left out";  ///< By markers, or without a value.
inline constexpr const char* kGradient = "gradient";  ///< Lit isosurface: needs the field's slope.
inline constexpr const char* kEdges = "edges";        ///< Wireframe.
inline constexpr const char* kSplitting = "splitting";  ///< Pieces are cut where the map bends.
inline constexpr const char* kVisibilityOrder = "visibility order";  ///< Cells must be sorted.
/// Isosurfaces and a volume, or several isosurfaces, of one mesh share one walk.
inline constexpr const char* kLevelsInVolume = "isosurfaces in the volume";
inline constexpr const char* kSharedWalk = "shared walk";
inline constexpr const char* kCellsOfLevels =
    "cells of levels";                               ///< Isosurface: only cells that meet a level.
inline constexpr const char* kReEntry = "re-entry";  ///< A ray may leave the mesh and come back.
inline constexpr const char* kInterpolation = "interpolation";    ///< Values vary within a cell.
inline constexpr const char* kColourByValue = "colour by value";  ///< Surface: C(f).
inline constexpr const char* kHeadlight = "headlight";            ///< Surface: needs normals.

// Voxels; kInterpolation: trilinear or tricubic instead of nearest.
inline constexpr const char* kEmptyBricks =
    "empty bricks";                                   ///< Bricks without a share are skipped.
inline constexpr const char* kBricks = "bricks";      ///< Voxels are loaded by bricks, as needed.
inline constexpr const char* kChannels = "channels";  ///< Several are drawn together.
inline constexpr const char* kLight = "light";    ///< Volume: needs the field's slope at samples.
inline constexpr const char* kJitter = "jitter";  ///< Samples are not in the middle of steps.
/// Some voxels are NaN, and nothing is where they would count.
inline constexpr const char* kVoxelsWithoutValue = "voxels without value";
inline constexpr const char* kUserShader =
    "user shader";  ///< A user's code says what samples show.
inline constexpr const char* kStepEnlarged = "step enlarged";  ///< The step asked for is too small.

}  // namespace volcast::plan
