#include "model/archive.hpp"

#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <utility>

#include "base/error.hpp"
#include "model/limits.hpp"

namespace cleancolor {

struct Archive::Zip {
  zip_t* handle = nullptr;
  ~Zip() { zip_discard(handle); }
};

namespace {

/// The entry's name as the zip file spells it: "/3D/My%20model.model" -> "3D/My model.model".
std::string entry_name(std::string_view path) {
  const auto hex = [](char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
                                  : -1;
  };
  while (path.starts_with('/')) path.remove_prefix(1);
  std::string name;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (path[i] == '%' && i + 2 < path.size() && hex(path[i + 1]) >= 0 && hex(path[i + 2]) >= 0) {
      name += char(hex(path[i + 1]) * 16 + hex(path[i + 2]));
      i += 2;
    } else {
      name += path[i];
    }
  }
  return name;
}

}  // namespace

bool is_zip(std::string_view bytes) {
  return bytes.starts_with("PK\x03\x04") || bytes.starts_with("PK\x05\x06");
}

Archive::Archive(std::string_view bytes, std::string name) : zip_(std::make_unique<Zip>()), name_(std::move(name)) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  if (source != nullptr) {
    zip_->handle = zip_open_from_source(source, ZIP_RDONLY | ZIP_CHECKCONS, &error);
    if (zip_->handle == nullptr) zip_source_free(source);
  }
  const std::string reason = zip_error_strerror(&error);
  zip_error_fini(&error);
  if (zip_->handle == nullptr)
    throw Error(
        fmt::format("{}: the zip archive is damaged or cut short ({}); export or download it again", name_, reason));
  if (zip_get_num_entries(zip_->handle, 0) == 0)
    throw Error(fmt::format("{}: the zip archive is empty; export the model again", name_));
}

Archive::~Archive() = default;

std::vector<std::string> Archive::entries() const {
  std::vector<std::string> names;
  const zip_int64_t count = zip_get_num_entries(zip_->handle, 0);
  for (zip_int64_t i = 0; i < count; ++i)
    if (const char* name = zip_get_name(zip_->handle, zip_uint64_t(i), 0)) names.emplace_back(name);
  return names;
}

std::optional<std::string> Archive::content(std::string_view entry) {
  const std::string wanted = entry_name(entry);
  zip_int64_t index = zip_name_locate(zip_->handle, wanted.c_str(), 0);
  if (index < 0) index = zip_name_locate(zip_->handle, wanted.c_str(), ZIP_FL_NOCASE);
  if (index < 0) return std::nullopt;

  zip_stat_t stat;
  const auto damaged = [&] {
    return Error(fmt::format("{}: entry {} is damaged or encrypted; export or download the file again", name_, wanted));
  };
  if (zip_stat_index(zip_->handle, zip_uint64_t(index), 0, &stat) != 0) throw damaged();
  if ((stat.valid & ZIP_STAT_SIZE) == 0 || (stat.valid & ZIP_STAT_COMP_SIZE) == 0) throw damaged();
  if (stat.size > max_unpacked_bytes - unpacked_bytes_ ||
      (stat.size > 1'000'000 && stat.size / max_packing_ratio > stat.comp_size))
    throw Error(fmt::format("{}: entry {} unpacks from {} to {} bytes, which no mesh does; the file is not trusted",
                            name_, wanted, stat.comp_size, stat.size));
  unpacked_bytes_ += stat.size;

  std::string content(stat.size, '\0');
  zip_file_t* file = zip_fopen_index(zip_->handle, zip_uint64_t(index), 0);
  if (file == nullptr) throw damaged();
  const zip_int64_t read = content.empty() ? 0 : zip_fread(file, content.data(), content.size());
  char beyond = 0;  // reading past the end makes libzip compare the checksum
  const bool whole = read == zip_int64_t(content.size()) && zip_fread(file, &beyond, 1) == 0;
  zip_fclose(file);
  if (!whole) throw damaged();
  return content;
}

}  // namespace cleancolor
