// model/limits.hpp
//
// How much a model file may ask for: hostile or broken files must not take the machine down.
#pragma once

#include <cstddef>

namespace cleancolor {

inline constexpr std::size_t max_file_bytes = 256'000'000;
inline constexpr std::size_t max_triangles = 5'000'000;  // of all parts of a file together
inline constexpr std::size_t max_parts = 10'000;
inline constexpr std::size_t max_unpacked_bytes = 256'000'000;  // of all entries read from one archive
inline constexpr std::size_t max_packing_ratio = 250;           // meshes as XML pack 10 to 40 times
inline constexpr std::size_t max_xml_tree_bytes = 500'000'000;

}  // namespace cleancolor
