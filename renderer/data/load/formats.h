#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace volcast::data::load {

/// Who reads a format.
enum class Family { kTetgenMesh, kSurface, kImages, kVtk, kGrid, kMeshio };

/// One kind of file, told by the end of its name.
struct Format {
    std::string_view suffix;  ///< In lower case.
    std::string_view name;    ///< As users see it.
    Family family;
};

/// Longer suffixes stand before those that end them.
inline constexpr std::array kFormats{
    Format{".nii.gz", "NIfTI", Family::kGrid},
    Format{".nii", "NIfTI", Family::kGrid},
    Format{".nrrd", "NRRD", Family::kGrid},
    Format{".nhdr", "NRRD", Family::kGrid},
    Format{".mhd", "MetaImage", Family::kGrid},
    Format{".mha", "MetaImage", Family::kGrid},
    Format{".vtu", "VTU", Family::kVtk},
    Format{".vti", "VTI", Family::kVtk},
    Format{".vtk", "VTK", Family::kVtk},
    Format{".ex2", "Exodus", Family::kVtk},
    Format{".exo", "Exodus", Family::kVtk},
    Format{".e", "Exodus", Family::kVtk},
    Format{".xdmf", "XDMF", Family::kMeshio},
    Format{".msh", "Gmsh", Family::kMeshio},
    Format{".node", "TetGen", Family::kTetgenMesh},
    Format{".poly", "TetGen", Family::kSurface},
    Format{".smesh", "TetGen", Family::kSurface},
    Format{".off", "OFF", Family::kSurface},
    Format{".stl", "STL", Family::kSurface},
    Format{".ply", "PLY", Family::kSurface},
    Format{".tiff", "TIFF", Family::kImages},
    Format{".tif", "TIFF", Family::kImages},
    Format{".png", "PNG", Family::kImages},
};

/// The format that `path` is called after, or null.
inline const Format* formatOf(std::string_view path) {
    std::string name{path};
    std::transform(name.begin(), name.end(), name.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    const auto* found = std::find_if(kFormats.begin(), kFormats.end(), [&](const Format& format) {
        return name.size() > format.suffix.size() && name.ends_with(format.suffix);
    });
    return found == kFormats.end() ? nullptr : found;
}

}  // namespace volcast::data::load
