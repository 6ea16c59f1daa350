#pragma once

/// The Python readers of this folder, built into the program from the files of the same names.
namespace volcast::data::load::sources {

extern const char* const kReaderCommon;
extern const char* const kVtkImport;
extern const char* const kGridImport;
extern const char* const kXdmfImport;
extern const char* const kGmshImport;

}  // namespace volcast::data::load::sources
