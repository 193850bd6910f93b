#include "viewer/array_file.hpp"

#include <bit>
#include <cstdint>

namespace cleancolor {
namespace {

static_assert(std::endian::native == std::endian::little, "the arrays are written as they lie in memory");

constexpr std::size_t head_bytes = 12;  // magic and length

constexpr std::size_t padded(std::size_t bytes) {
  return (bytes + 7) / 8 * 8;
}

}  // namespace

std::string array_file(std::span<const NamedArray> arrays, nlohmann::ordered_json header) {
  nlohmann::ordered_json& table = header["arrays"] = nlohmann::ordered_json::object();
  std::size_t offset = 0;
  for (const NamedArray& a : arrays) {
    table[std::string(a.name)] = {
        {"type", a.type}, {"components", a.components}, {"count", a.count}, {"offset", offset}};
    offset += padded(a.bytes.size());
  }
  std::string json = header.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  json.resize(padded(head_bytes + json.size()) - head_bytes, ' ');

  std::string file;
  file.reserve(head_bytes + json.size() + offset);
  file += "CCARRAY1";
  for (int shift = 0; shift < 32; shift += 8) file += char(json.size() >> shift & 0xff);
  file += json;
  for (const NamedArray& a : arrays) {
    file.append(reinterpret_cast<const char*>(a.bytes.data()), a.bytes.size());
    file.append(padded(a.bytes.size()) - a.bytes.size(), '\0');
  }
  return file;
}

}  // namespace cleancolor
