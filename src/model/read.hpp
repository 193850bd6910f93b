// model/read.hpp
//
// Model files of any kind: STL, OBJ, PLY, AMF (plain or zipped), 3MF.
//
//   file  ->  its parts, in mm, in the order of the file
//
// What a file is, its content says; the extension only where the content does not. Meshes come as they are in the file:
// see model/check.hpp for making them printable.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/progress.hpp"
#include "model/mesh.hpp"

namespace cleancolor {

/// Throws Error where the file cannot be opened or used; names of parts start with the file's name.
std::vector<Part> read_model(const std::filesystem::path& path, const Progress& progress = {});

/// The same from memory; name: with its extension, for messages. An OBJ file is read without its material library.
std::vector<Part> read_model_bytes(std::string bytes, const std::string& name, const Progress& progress = {});

/// Parts of a zip archive: 3MF or zipped AMF.
std::vector<Part> read_archive(std::string_view bytes, const std::string& name, const Progress& progress = {});

}  // namespace cleancolor
