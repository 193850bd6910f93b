#include "model/read.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "base/error.hpp"
#include "model/amf.hpp"
#include "model/archive.hpp"
#include "model/limits.hpp"
#include "model/obj.hpp"
#include "model/ply.hpp"
#include "model/stl.hpp"
#include "model/text_scan.hpp"
#include "model/threemf.hpp"

namespace cleancolor {

namespace {

std::string file_bytes(const std::filesystem::path& path, const std::string& name) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw Error(fmt::format("{}: this is a folder; name a model file", name));
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) throw Error(fmt::format("{}: cannot be opened; check the name and the permissions", path.string()));
  const auto size = file.tellg();
  if (size < 0) throw Error(fmt::format("{}: cannot be read; name a plain file", name));
  if (std::uint64_t(size) > max_file_bytes)
    throw Error(fmt::format("{}: {} MB, more than {}; simplify the mesh", name, std::int64_t(size) / 1'000'000,
                            max_file_bytes / 1'000'000));
  std::string bytes(std::size_t(size), '\0');
  file.seekg(0);
  file.read(bytes.data(), std::streamsize(bytes.size()));
  if (!file) throw SystemError(fmt::format("{}: reading failed", name));
  return bytes;
}

/// ".stl", in lower case.
std::string extension_of(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  std::string extension = dot == std::string::npos ? "" : name.substr(dot);
  for (char& c : extension) c = c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
  return extension;
}

bool is_xml(std::string_view bytes) {
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && bytes[first] == '<';
}

/// What a file is that is certainly no model; empty where it may be one.
std::string_view foreign_kind(std::string_view bytes) {
  constexpr std::pair<std::string_view, std::string_view> signatures[] = {
      {"\x89PNG", "a PNG picture"}, {"\xFF\xD8\xFF", "a JPEG picture"}, {"%PDF", "a PDF document"},
      {"GIF8", "a GIF picture"},    {"\x1F\x8B", "a gzip archive"},     {"7z\xBC\xAF", "a 7z archive"},
      {"Rar!", "a RAR archive"},    {"glTF", "a glTF model"},           {"ISO-10303-21", "a STEP model"}};
  for (const auto& [signature, kind] : signatures)
    if (bytes.starts_with(signature)) return kind;
  return {};
}

/// Colours of the material libraries that lie beside the OBJ file.
MaterialColours colours_beside(const std::filesystem::path& path, std::string_view obj_bytes, const std::string& name,
                               const Progress& progress) {
  MaterialColours colours;
  for (const std::string& library : material_libraries(obj_bytes)) {
    std::ifstream file;
    const bool is_beside = library.find_first_of("/\\") == std::string::npos && library.size() < 200;
    if (is_beside) file.open(path.parent_path() / library, std::ios::binary);
    if (!file.is_open()) {
      progress.warn(fmt::format("{}: the material library {} is not beside it; materials go without colours", name,
                                shown(library)));
      continue;
    }
    std::string bytes(1'000'000, '\0');
    file.read(bytes.data(), std::streamsize(bytes.size()));
    colours.merge(read_mtl(std::string_view(bytes).substr(0, std::size_t(file.gcount()))));
  }
  return colours;
}

std::vector<Part> read_bytes(std::string bytes, const std::string& name, const MaterialColours& colours,
                             const Progress& progress) {
  const std::string extension = extension_of(name);
  if (bytes.empty()) throw Error(fmt::format("{}: the file is empty; export the model again", name));
  if (is_zip(bytes)) return read_archive(bytes, name, progress);
  if (const std::string_view kind = foreign_kind(bytes); !kind.empty())
    throw Error(fmt::format("{}: this is {}, not a model; give an STL, OBJ, PLY, AMF or 3MF file", name, kind));
  if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r")) return {read_ply(bytes, name, progress)};
  if (is_binary_stl(bytes) || extension == ".stl") return {read_stl(bytes, name, progress)};
  if (is_xml(bytes)) return read_amf(std::move(bytes), name, progress);
  if (extension == ".obj") return read_obj(bytes, name, colours);
  if (extension == ".3mf")
    throw Error(fmt::format("{}: this is no zip archive, as a 3MF file must be; export or download it again", name));
  if (extension == ".ply") return {read_ply(bytes, name, progress)};
  if (extension == ".amf") return read_amf(std::move(bytes), name, progress);
  if (is_keyword(Scanner(std::string_view(bytes).substr(0, 1000)).word(), "solid"))
    return {read_stl(bytes, name, progress)};
  throw Error(fmt::format("{}: of no known kind; give an STL, OBJ, PLY, AMF or 3MF file", name));
}

}  // namespace

std::vector<Part> read_archive(std::string_view bytes, const std::string& name, const Progress& progress) {
  Archive archive(bytes, name);
  std::string amf;
  for (const std::string& entry : archive.entries()) {
    if (extension_of(entry) == ".model") return read_3mf(archive, name, progress);
    if (extension_of(entry) == ".amf" && amf.empty()) amf = entry;
  }
  if (amf.empty()) return read_3mf(archive, name, progress);
  return read_amf(archive.content(amf).value_or(""), name, progress);
}

std::vector<Part> read_model(const std::filesystem::path& path, const Progress& progress) {
  const std::string name = path.filename().string();
  std::string bytes = file_bytes(path, name);
  MaterialColours colours;
  if (extension_of(name) == ".obj") colours = colours_beside(path, bytes, name, progress);
  return read_bytes(std::move(bytes), name, colours, progress);
}

std::vector<Part> read_model_bytes(std::string bytes, const std::string& name, const Progress& progress) {
  return read_bytes(std::move(bytes), name, {}, progress);
}

}  // namespace cleancolor
