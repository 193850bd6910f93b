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

}  // namespace cleancolor
