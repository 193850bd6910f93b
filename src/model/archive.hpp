// model/archive.hpp
//
// Archive: the entries of a zip file that lies in memory. Nothing is ever written to disc, so entry names are harmless.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cleancolor {

/// Whether the bytes start like a zip file, if only an empty one.
bool is_zip(std::string_view bytes);

class Archive {
 public:
  /// bytes must outlive the archive; name: of the file, for messages.  Throws Error where this is no sound zip file.
  Archive(std::string_view bytes, std::string name);
  ~Archive();
  Archive(const Archive&) = delete;
  Archive& operator=(const Archive&) = delete;

  std::vector<std::string> entries() const;

  /// The content of an entry; nothing where there is none of this name. A leading slash, %20 and case do not matter.
  ///
  /// Throws Error where it is damaged or encrypted, where it unpacks to more than max_packing_ratio times its size, or
  /// where all entries read so far come to more than max_unpacked_bytes.
  std::optional<std::string> content(std::string_view entry);

 private:
  struct Zip;
  std::unique_ptr<Zip> zip_;
  std::string name_;
  std::size_t unpacked_bytes_ = 0;
};

}  // namespace cleancolor
