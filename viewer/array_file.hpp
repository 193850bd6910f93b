// viewer/array_file.hpp
//
// Array file: several arrays of numbers in one binary answer, ready for the typed arrays of a browser.
//
//   "CCARRAY1", u32 length of the JSON, JSON padded with blanks, arrays        (little-endian)
//
// The JSON is the caller's object with "arrays" added: {"position": {"type": "f32", "components": 3, "count": 12,
// "offset": 0}, ...}. An offset counts from the end of the JSON; it and the end of the JSON are multiples of 8, so
// every array can be used where it lies.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace cleancolor {

/// A view: the numbers must outlive it.
struct NamedArray {
  std::string_view name;
  std::string_view type;  // "u8", "u16", "u32", "f32"
  std::size_t components = 1;
  std::size_t count = 0;  // of points, not of numbers
  std::span<const std::byte> bytes;
};

template <class T>
constexpr std::string_view array_type() {
  if constexpr (std::is_same_v<T, float>) return "f32";
  if constexpr (std::is_same_v<T, std::uint32_t>) return "u32";
  if constexpr (std::is_same_v<T, std::uint16_t>) return "u16";
  if constexpr (std::is_same_v<T, std::uint8_t>) return "u8";
}

/// Requires: values.size() is a multiple of components.
template <class T>
NamedArray named_array(std::string_view name, const std::vector<T>& values, std::size_t components = 1) {
  return {name, array_type<T>(), components, values.size() / components, std::as_bytes(std::span(values))};
}

/// The whole file.  Requires: header is an object.
std::string array_file(std::span<const NamedArray> arrays,
                       nlohmann::ordered_json header = nlohmann::ordered_json::object());

}  // namespace cleancolor
