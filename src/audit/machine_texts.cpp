#include "audit/machine_texts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>

#include "base/error.hpp"
#include "base/text_parts.hpp"
#include "reader/print.hpp"

namespace cleancolor {
namespace {

constexpr double farthest_mm = 1000;

// In the order of the values.
constexpr std::array<std::string_view, 2> offsets_in_words = {"slicer", "firmware"};
constexpr std::array<std::string_view, 4> idle_nozzle_words = {"same_height", "lifted", "parked", "docked"};

template <class T, std::size_t n>
T choice(std::string_view text, const std::array<std::string_view, n>& words, const std::string& where) {
  for (std::size_t i = 0; i < n; ++i)
    if (text == words[i]) return T(i);
  throw Error(fmt::format("{}: '{}' is none of {}", where, text, fmt::join(words, ", ")));
}

}  // namespace

std::vector<Vec2> nozzle_offsets_of(std::string_view text, const std::string& where) {
  std::vector<Vec2> offsets;
  for (const std::string_view point : split(text, ',')) {
    const std::size_t x = point.find('x');
    Vec2 at;
    if (x == point.npos || !parse_whole(point.substr(0, x), at.x) || !parse_whole(point.substr(x + 1), at.y) ||
        !(std::abs(at.x) <= farthest_mm) || !(std::abs(at.y) <= farthest_mm))
      throw Error(fmt::format("{}: '{}' is not like 33x0, mm in X and Y; say 0x0,33x0 for two nozzles", where, point));
    offsets.push_back(at);
  }
  if (offsets.size() > max_tools)
    throw Error(fmt::format("{}: {} nozzles; at most {} are possible", where, offsets.size(), max_tools));
  if (offsets.front() != Vec2{})
    throw Error(fmt::format("{}: the first nozzle is at 0x0; the others are given as seen from it", where));
  return offsets;
}

OffsetsIn offsets_in_of(std::string_view text, const std::string& where) {
  return choice<OffsetsIn>(text, offsets_in_words, where);
}

IdleNozzle idle_nozzle_of(std::string_view text, const std::string& where) {
  return choice<IdleNozzle>(text, idle_nozzle_words, where);
}

std::string_view idle_nozzle_word(IdleNozzle idle) {
  return idle_nozzle_words[std::size_t(idle)];
}

}  // namespace cleancolor
