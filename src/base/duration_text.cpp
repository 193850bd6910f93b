#include "base/duration_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cleancolor {

std::string duration_text(double seconds) {
  const long long s = std::llround(std::max(0.0, seconds));
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {:02} s", s / 60, s % 60);
  const long long minutes = std::llround(std::max(0.0, seconds) / 60);
  return fmt::format("{} h {:02} min", minutes / 60, minutes % 60);
}

std::string duration_in_slicers_words(double seconds) {
  const auto s = std::llround(seconds);
  std::string text;
  if (s >= 86400) text += fmt::format("{}d ", s / 86400);
  if (s >= 3600) text += fmt::format("{}h ", s / 3600 % 24);
  if (s >= 60) text += fmt::format("{}m ", s / 60 % 60);
  return text + fmt::format("{}s", s % 60);
}

}  // namespace cleancolor
